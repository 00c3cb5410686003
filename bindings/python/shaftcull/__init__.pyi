# SPDX-License-Identifier: MIT
from typing import Any, Callable, Iterator, Literal, Sequence, SupportsIndex, Tuple, Union

import numpy as np
import numpy.typing as npt

__version__: str

# Arrays of the shapes and dtypes that the docstrings say, tuples of such, and lists of numbers.
_Floats = Any
_Integers = npt.ArrayLike
_Rounding = Literal["outwards"]
_Contact = Literal["closed", "open"]
_Depth = Literal["zero_to_one", "minus_one_to_one"]
_Sight = Literal["undecided", "clear", "occluded", "facing_away"]
_Test = Literal["exact", "vertices"]
_HullTest = Literal["exact", "conservative"]

_Bits = npt.NDArray[Any]  # of bool, or uint64 if they stay packed
# These depend on the shape of the shafts, which types do not say.
_Bools = Any  # a bool, or NDArray[bool]
_Numbers = Any  # an int, or NDArray[int64]
_Times = Any  # a float, or NDArray[float32]
_Contacts = Tuple[Any, ...]  # _Numbers, _Times; and with normals NDArray[float32]
_Lists = Any  # NDArray[uint32], or IndexLists; NDArray[uint32] with times is Tuple[NDArray[uint32], NDArray[float32]]
_Asked = Union["Shafts", "ConvexHull", _Floats]

class BadBound(ValueError):
    """A bound, a point or a shaft of an array cannot be used: NaN, lo > hi, a negative radius, or a number that is
    not finite where it must be. Attribute index: its position, from 0 on.
    """
    index: int

class NeedsRefit(RuntimeError):
    """A query of a tree came after update() with indices and before refit()."""

class IndexLists:
    """Lists of indices, one for each of n shafts: the result of list() and its like for many shafts.

    lists[i]: uint32 (k,), the list of shaft i, a view of `indices`. i is an integer, which may count from the end;
        IndexError for one that names nothing. len() is n, and iterating gives the lists in order.
    offsets: int64 (n + 1,): list i is indices[offsets[i]:offsets[i + 1]].
    indices: uint32, all lists one behind the other.
    times: float32, a time for each of `indices`; None, unless list() was called with times=True.

    They can be pickled, and made of arrays that were saved: IndexLists(offsets, indices, times).
    """
    offsets: npt.NDArray[np.int64]
    indices: npt.NDArray[np.uint32]
    times: npt.NDArray[np.float32] | None
    def __init__(
        self,
        offsets: npt.NDArray[np.int64],
        indices: npt.NDArray[np.uint32],
        times: npt.NDArray[np.float32] | None = None,
    ) -> None: ...
    def __len__(self) -> int: ...
    def __getitem__(self, shaft: SupportsIndex) -> npt.NDArray[np.uint32]: ...
    def __iter__(self) -> Iterator[npt.NDArray[np.uint32]]: ...
    def pairs(self) -> npt.NDArray[np.uint32]:
        """All lists as pairs of a shaft and a bound, in order: uint32 (len(indices), 2). A copy."""

class Shafts:
    """An array of shafts: of shape (n,), or () for one shaft.

    between(), swept(), swept_infinite(), shadow() and concatenate() make shafts, which never change and take
    832 bytes each. An integer as index gives one shaft, a slice of step 1 a view, and others copies.
    """
    @staticmethod
    def between(
        a: _Floats,
        b: _Floats,
        *,
        pairs: _Integers | None = None,
        planes_a: _Floats | None = None,
        planes_b: _Floats | None = None,
        contact: _Contact = "closed",
        rounding: _Rounding | None = None,
    ) -> Shafts:
        """Shafts between boxes: all segments from a[i] to b[i], and what can stand between the two. Two single boxes
        make one shaft, of shape (). Otherwise the shape is (n,), or (m,) with pairs.

        a, b: boxes, float32: (n, 6) with lo x, y, z, then hi x, y, z; (n, 2, 3); a tuple (lo, hi) of (n, 3); a
            tuple of six (n,); or one box, (6,) or (2, 3), which goes with each of the other.
        pairs: integers (m, 2): shaft i is between a[pairs[i, 0]] and b[pairs[i, 1]].
        planes_a, planes_b: float32 (n, k, 4), k planes for each box, or (k, 4) for all: normal and offset. Bounds
            with normal . p > offset are left out. At most 16 in all for a shaft. Planes are never rounded outwards:
            no float32 half-space contains a float64 one, unless their normals are parallel.
        contact: 'closed' keeps bounds that only touch a shaft, 'open' does not.
        rounding: 'outwards' takes boxes of float64, too; each shaft then contains the given one.

        TypeError or ValueError names the argument that does not fit; BadBound, with the index, is for a box that is
        not finite or has lo > hi, IndexError for a pair that names nothing. Many shafts are formed on the calling
        thread; others go on.
        """
    @staticmethod
    def swept(
        bodies: _Floats,
        displacements: _Floats,
        *,
        planes: _Floats | None = None,
        contact: _Contact = "closed",
        rounding: _Rounding | None = None,
    ) -> Shafts:
        """The volumes that bodies sweep over when they move by displacements: bodies[i] + t * displacements[i], t from
        0 to 1. Where a body ends need not be a float32, and is not rounded.

        bodies: boxes, as those of between(). displacements: float32 (n, 3), or (3,) for all bodies.
        planes: float32 (n, k, 4), k planes for each shaft, or (k, 4) for all. contact: as those of between().
        rounding: 'outwards' takes float64, too. Bodies grow by what rounding the displacements to nearest leaves
            out, so each shaft contains the given one.

        Errors and threads: as those of between().
        """
    @staticmethod
    def swept_infinite(
        bodies: _Floats,
        directions: _Floats,
        *,
        planes: _Floats | None = None,
        contact: _Contact = "closed",
        rounding: _Rounding | None = None,
    ) -> Shafts:
        """The volumes that bodies sweep over when they move in directions without end: bodies[i] + t * directions[i],
        t >= 0. What can cast the sun's shadow on receivers is in swept_infinite(receivers, towards_sun).

        bodies: boxes, as those of between(). directions: float32 (n, 3) of any length but 0, or (3,) for all
            bodies.
        planes, contact: as those of swept().
        rounding: 'outwards' takes bodies of float64, too, and contains them. Directions must be float32: a rounded
            one leads elsewhere, far enough away.

        Errors and threads: as those of between().
        """
    @staticmethod
    def shadow(
        lights: _Floats,
        occluders: _Floats,
        reach: float | None = None,
        *,
        pairs: _Integers | None = None,
        planes_lights: _Floats | None = None,
        planes_occluders: _Floats | None = None,
        contact: _Contact = "closed",
        rounding: _Rounding | None = None,
    ) -> Shafts:
        """The volumes that occluders can shadow from lights, or hide from viewpoints: all points behind occluders[i]
        as seen from points of lights[i], and the occluder itself.

        lights, occluders: boxes, as those of between(), which must be apart. A light may be a point: points() makes
            its box.
        reach: 1 or more: how many times as far from the light as the occluder the shadow goes. None: without end.
        pairs, planes_lights, planes_occluders, contact: as those of between().
        rounding: 'outwards' takes float64, too; each shaft then contains the given one.

        Errors and threads: as those of between(); ValueError for a light and an occluder that are not apart.
        """
    @staticmethod
    def concatenate(parts: Sequence[Shafts | ConvexHull]) -> Shafts:
        """All shafts of several Shafts and ConvexHulls, in that order: shape (n,). Hulls live as long as the result.

        parts: a sequence of Shafts and ConvexHulls. TypeError for others.
        """
    def __len__(self) -> int: ...
    def __getitem__(self, key: SupportsIndex | slice | npt.ArrayLike) -> Shafts:
        """One shaft, or several, as NumPy's index gives them: an integer, a slice, an array of integers (k,) or of
        bool (n,). IndexError for one that names nothing.
        """
    @property
    def shape(self) -> tuple[int, ...]:
        """A tuple of int: (n,), or () for one shaft."""
    @property
    def a(self) -> npt.NDArray[np.float32]:
        """float32 (n, 6) or (6,): the boxes where shafts begin; for a convex hull the box around it."""
    @property
    def b(self) -> npt.NDArray[np.float32]:
        """float32 (n, 6) or (6,): where shafts end, rounded to nearest; if they have no end, somewhere on their way."""
    @property
    def open_contact(self) -> _Bools:
        """bool (n,), or a bool: whether bounds that only touch a shaft are left out."""
    def with_contact(self, contact: _Contact) -> Shafts:
        """Copies that keep bounds which only touch them ('closed') or do not ('open'); of a hull, copies of
        Shafts.concatenate([hull]). ValueError for other words.
        """
    def completed(self) -> Shafts:
        """Copies with their planes worked out, about 65 ns each. It pays for shafts of several queries about spheres,
        or about bounds that are inside; answers are the same.
        """
    def occluded_by_polygon(self, corners: _Floats) -> _Bools:
        """Whether a convex polygon hides one end of a shaft from the other: a wall at any angle. bool (n,), or a bool
        for one shaft.

        corners: float32 (k, 3) in order, either way round, k >= 3. ValueError for fewer or ones that are not finite,
            and for shafts that are not between boxes. It runs on the calling thread; others go on.
        """

class ConvexHull:
    """The convex hull of up to 32 points and directions, which goes where one shaft goes: view frusta, volumes
    whose objects cast shadows into view, volumes between polygons.

    points: float32 (n, 3), 1 to 32 with the directions. directions: float32 (m, 3), not 0: the hull has no end
        that way. float64 is a TypeError: a hull of rounded points need not contain the given hull.
    test: 'exact', or 'conservative': boxes are outside only if they are beyond one face, as in the usual test of a
        view by its planes. It is quicker, and keeps some boxes beside edges and corners. Casters take that of
        their view.

    Boxes and triangles are answered exactly, spheres to the safe side. Queries for times refuse a hull, and
    queries for occluders one that is not made by between_polygons(). Contact is closed;
    Shafts.concatenate([hull]).with_contact('open') leaves out bounds that only touch the hull.
    """
    def __init__(self, points: _Floats, directions: _Floats | None = None, test: _HullTest = "exact") -> None: ...
    @staticmethod
    def between_polygons(p: _Floats, q: _Floats, test: _HullTest = "exact") -> ConvexHull:
        """The ConvexHull of two ends: polygons, turned boxes or others, each the convex hull of its corners. Queries
        about occluders take it: what hides one end from the other.

        p, q: float32 (n, 3), corners in any order, 1 or more each and 32 together. test: as that of ConvexHull.

        TypeError or ValueError for others.
        """
    @staticmethod
    def frustum(matrix: _Floats, depth: _Depth = "zero_to_one", test: _HullTest = "exact") -> ConvexHull:
        """The volume that a view-projection matrix shows: a ConvexHull.

        matrix: float32 (4, 4) that maps column vectors: matrix @ (x, y, z, 1) is in clip space. Round a matrix of
            float64 by astype(numpy.float32).
        depth: 'zero_to_one' (Direct3D, Vulkan, Metal) or 'minus_one_to_one' (OpenGL).
        test: as that of ConvexHull.

        TypeError or ValueError for other arguments, and for a matrix that cannot be inverted.
        """
    def casters(self, light: _Floats) -> ConvexHull:
        """The ConvexHull of all points that can cast a shadow into this view by a light at a point.

        light: float32 (3,). TypeError or ValueError for others, and where the hull would need more than 32 corners.
        """
    def casters_towards(self, towards_sun: _Floats) -> ConvexHull:
        """The ConvexHull of all points that can cast a shadow into this view by a sun in a direction.

        towards_sun: float32 (3,), not 0. TypeError or ValueError for others.
        """
    @property
    def box(self) -> npt.NDArray[np.float32]:
        """float32 (6,): the box around the hull, infinite where directions lead."""
    @property
    def points(self) -> npt.NDArray[np.float32]:
        """float32 (n, 3), as given."""
    @property
    def directions(self) -> npt.NDArray[np.float32]:
        """float32 (m, 3), as given."""
    @property
    def test(self) -> str:
        """'exact' or 'conservative', as given."""

class Bounds:
    """Boxes, spheres or triangles, in a view, a stream or a tree, and the queries that shafts make of them.
    Answers do not depend on the container. len() is the number of bounds.
    """
    def __len__(self) -> int: ...
    def cull(
        self,
        shafts: _Asked,
        b: _Floats | None = None,
        *,
        exclude: _Integers | None = None,
        exclude_each: _Integers | None = None,
        exclude_mask: npt.ArrayLike | None = None,
        layer_mask: _Integers | None = None,
        only: _Integers | None = None,
        triangle_test: _Test = "exact",
        packed: bool = False,
    ) -> _Bits:
        """Which bounds the shafts keep, as they are not outside: bool (n, bounds), or (bounds,) for one shaft. With
        packed=True uint64 (n, (bounds + 63) // 64): bit i % 64 of word i // 64 is bound i.

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as Shafts.between() takes them.
        exclude: integers (k,), or one: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of indices for each of n shafts, such as its own two ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds in none of these layers.
        only: integers (k,): looks only at these bounds, such as candidates of a larger shaft, in their order.
        triangle_test: 'exact'; for triangles also 'vertices', which is cheaper and keeps more.

        TypeError, ValueError or IndexError names the argument that does not fit; NeedsRefit is for a tree that needs
        refit(), RuntimeError for bounds that another thread is changing. One shaft runs on the calling thread, n on
        all processors; other threads of Python go on, and may make queries, too.
        """
    def any(
        self,
        shafts: _Asked,
        b: _Floats | None = None,
        *,
        exclude: _Integers | None = None,
        exclude_each: _Integers | None = None,
        exclude_mask: npt.ArrayLike | None = None,
        layer_mask: _Integers | None = None,
        only: _Integers | None = None,
        triangle_test: _Test = "exact",
    ) -> _Bools:
        """Whether the shafts keep any bound: bool (n,), or a bool for one shaft.

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as Shafts.between() takes them.
        exclude: integers (k,), or one: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of indices for each of n shafts, such as its own two ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds in none of these layers.
        only: integers (k,): looks only at these bounds, such as candidates of a larger shaft, in their order.
        triangle_test: 'exact'; for triangles also 'vertices', which is cheaper and keeps more.

        TypeError, ValueError or IndexError names the argument that does not fit; NeedsRefit is for a tree that needs
        refit(), RuntimeError for bounds that another thread is changing. One shaft runs on the calling thread, n on
        all processors; other threads of Python go on, and may make queries, too.
        """
    def classify(
        self,
        shafts: _Asked,
        b: _Floats | None = None,
        *,
        exclude: _Integers | None = None,
        exclude_each: _Integers | None = None,
        exclude_mask: npt.ArrayLike | None = None,
        layer_mask: _Integers | None = None,
        only: _Integers | None = None,
        triangle_test: _Test = "exact",
        packed: bool = False,
    ) -> Tuple[_Bits, _Bits]:
        """Which bounds the shafts keep, and which of these are inside: a tuple of two arrays as that of cull().

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as Shafts.between() takes them.
        exclude: integers (k,), or one: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of indices for each of n shafts, such as its own two ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds in none of these layers.
        only: integers (k,): looks only at these bounds, such as candidates of a larger shaft, in their order.
        triangle_test: 'exact'; for triangles also 'vertices', which is cheaper and keeps more.

        TypeError, ValueError or IndexError names the argument that does not fit; NeedsRefit is for a tree that needs
        refit(), RuntimeError for bounds that another thread is changing. One shaft runs on the calling thread, n on
        all processors; other threads of Python go on, and may make queries, too.
        """
    def count(
        self,
        shafts: _Asked,
        b: _Floats | None = None,
        *,
        exclude: _Integers | None = None,
        exclude_each: _Integers | None = None,
        exclude_mask: npt.ArrayLike | None = None,
        layer_mask: _Integers | None = None,
        limit: int | None = None,
        only: _Integers | None = None,
        triangle_test: _Test = "exact",
    ) -> _Numbers:
        """How many bounds the shafts keep: int64 (n,), or an int for one shaft.

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as Shafts.between() takes them.
        exclude: integers (k,), or one: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of indices for each of n shafts, such as its own two ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds in none of these layers.
        limit: an integer of 0 or more: stops at so many results for each shaft, the first ones.
        only: integers (k,): looks only at these bounds, such as candidates of a larger shaft, in their order.
        triangle_test: 'exact'; for triangles also 'vertices', which is cheaper and keeps more.

        TypeError, ValueError or IndexError names the argument that does not fit; NeedsRefit is for a tree that needs
        refit(), RuntimeError for bounds that another thread is changing. One shaft runs on the calling thread, n on
        all processors; other threads of Python go on, and may make queries, too.
        """
    def count_classified(
        self,
        shafts: _Asked,
        b: _Floats | None = None,
        *,
        exclude: _Integers | None = None,
        exclude_each: _Integers | None = None,
        exclude_mask: npt.ArrayLike | None = None,
        layer_mask: _Integers | None = None,
        only: _Integers | None = None,
        triangle_test: _Test = "exact",
    ) -> Tuple[_Numbers, _Numbers]:
        """How many bounds overlap the shafts and how many are inside: two int64 (n,), or two int for one shaft.

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as Shafts.between() takes them.
        exclude: integers (k,), or one: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of indices for each of n shafts, such as its own two ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds in none of these layers.
        only: integers (k,): looks only at these bounds, such as candidates of a larger shaft, in their order.
        triangle_test: 'exact'; for triangles also 'vertices', which is cheaper and keeps more.

        TypeError, ValueError or IndexError names the argument that does not fit; NeedsRefit is for a tree that needs
        refit(), RuntimeError for bounds that another thread is changing. One shaft runs on the calling thread, n on
        all processors; other threads of Python go on, and may make queries, too.
        """
    def list(
        self,
        shafts: _Asked,
        b: _Floats | None = None,
        *,
        exclude: _Integers | None = None,
        exclude_each: _Integers | None = None,
        exclude_mask: npt.ArrayLike | None = None,
        layer_mask: _Integers | None = None,
        limit: int | None = None,
        only: _Integers | None = None,
        triangle_test: _Test = "exact",
        times: bool = False,
    ) -> _Lists:
        """The indices of the bounds that the shafts keep: IndexLists of n lists, or uint32 (k,) for one shaft. Lists
        ascend; those of a tree have its order. With times=True, IndexLists.times, or a second array for one shaft,
        tells when the moving box reaches each box or sphere: float32, as first_contact() says.

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as Shafts.between() takes them.
        exclude: integers (k,), or one: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of indices for each of n shafts, such as its own two ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds in none of these layers.
        limit: an integer of 0 or more: stops at so many results for each shaft, the first ones.
        only: integers (k,): looks only at these bounds, such as candidates of a larger shaft, in their order.
        triangle_test: 'exact'; for triangles also 'vertices', which is cheaper and keeps more.

        TypeError, ValueError or IndexError names the argument that does not fit; NeedsRefit is for a tree that needs
        refit(), RuntimeError for bounds that another thread is changing. One shaft runs on the calling thread, n on
        all processors; other threads of Python go on, and may make queries, too.
        """
    def list_classified(
        self,
        shafts: _Asked,
        b: _Floats | None = None,
        *,
        exclude: _Integers | None = None,
        exclude_each: _Integers | None = None,
        exclude_mask: npt.ArrayLike | None = None,
        layer_mask: _Integers | None = None,
        only: _Integers | None = None,
        triangle_test: _Test = "exact",
    ) -> Tuple[_Lists, _Lists]:
        """The indices of the bounds that overlap the shafts, and of those that are inside: two results as of list().

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as Shafts.between() takes them.
        exclude: integers (k,), or one: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of indices for each of n shafts, such as its own two ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds in none of these layers.
        only: integers (k,): looks only at these bounds, such as candidates of a larger shaft, in their order.
        triangle_test: 'exact'; for triangles also 'vertices', which is cheaper and keeps more.

        TypeError, ValueError or IndexError names the argument that does not fit; NeedsRefit is for a tree that needs
        refit(), RuntimeError for bounds that another thread is changing. One shaft runs on the calling thread, n on
        all processors; other threads of Python go on, and may make queries, too.
        """
    def set_layers(self, layers: _Integers, indices: _Integers | None = None) -> None:
        """Puts bounds into layers, which queries choose by (layer_mask): bit l says that a bound is in layer l. A
        TriangleTree has none.

        layers: integers (bounds,) from 0 to 2**32 - 1, which are copied; with indices, integers (k,), those of these.

        ValueError for another number of them, IndexError for an index that names nothing, RuntimeError if another
        thread uses this object.
        """
    def clear_layers(self) -> None:
        """Forgets all layers. RuntimeError if another thread uses this object."""
    @property
    def has_layers(self) -> bool:
        """bool: whether bounds are in layers."""

class Boxes(Bounds):
    """Boxes: a BoxView, a BoxStream or a BoxTree."""
    def first_contact(
        self,
        shafts: _Asked,
        b: _Floats | None = None,
        *,
        exclude: _Integers | None = None,
        exclude_each: _Integers | None = None,
        exclude_mask: npt.ArrayLike | None = None,
        layer_mask: _Integers | None = None,
        only: _Integers | None = None,
        skip_overlapping: bool = False,
        normals: bool = False,
    ) -> _Contacts:
        """Which bound the moving box of each shaft reaches first, and when: a tuple of indices, int64 (n,), and times,
        float32 (n,); an int and a float for one shaft. -1 and infinity if it reaches none. Time is 0 at a and 1 at
        b: a swept body has moved by its whole displacement at 1. Times are rounded down; which bound is first is
        decided exactly. With normals=True a third array, float32 (n, 3), or (3,) for one shaft: normals of contact, of
        unit length, from the bound towards the moving box. For a box it is one of +-x, +-y and +-z; zero if the two
        overlap at the start, or touch there without the box moving into the bound. ValueError for hulls.

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as Shafts.between() takes them.
        exclude: integers (k,), or one: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of indices for each of n shafts, such as its own two ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds in none of these layers.
        only: integers (k,): looks only at these bounds, such as candidates of a larger shaft, in their order.
        skip_overlapping: True leaves out bounds that the box overlaps at the start: with closed contact all that touch
            it, with open contact those that reach into it, so that a wall beside it still stops it.

        TypeError, ValueError or IndexError names the argument that does not fit; NeedsRefit is for a tree that needs
        refit(), RuntimeError for bounds that another thread is changing. One shaft runs on the calling thread, n on
        all processors; other threads of Python go on, and may make queries, too.
        """
    def entry_times(self, shafts: Shafts, indices: _Integers) -> npt.NDArray[np.float32]:
        """When the moving box of one shaft reaches bounds: float32 (k,), as first_contact() says; infinity for bounds
        that the shaft does not keep.

        shafts: Shafts of shape (). indices: integers (k,). ValueError for more shafts and for hulls, IndexError for
            an index that names nothing, NeedsRefit for a tree that needs refit(). It runs on the calling thread;
            others go on.
        """
    def occluded(
        self,
        shafts: _Asked,
        b: _Floats | None = None,
        *,
        exclude: _Integers | None = None,
        exclude_each: _Integers | None = None,
        exclude_mask: npt.ArrayLike | None = None,
        layer_mask: _Integers | None = None,
    ) -> _Bools:
        """Whether one of the boxes, which are solid, hides one end of a shaft from the other: every segment between
        the relative interiors of a and b passes through it, which is more than to touch it. bool (n,), or a bool
        for one shaft. ValueError for shafts that are not between boxes.

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as Shafts.between() takes them.
        exclude: integers (k,), or one: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of indices for each of n shafts, such as its own two ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds in none of these layers.

        TypeError, ValueError or IndexError names the argument that does not fit; NeedsRefit is for a tree that needs
        refit(), RuntimeError for bounds that another thread is changing. One shaft runs on the calling thread, n on
        all processors; other threads of Python go on, and may make queries, too.
        """
    def find_occluder(
        self,
        shafts: _Asked,
        b: _Floats | None = None,
        *,
        exclude: _Integers | None = None,
        exclude_each: _Integers | None = None,
        exclude_mask: npt.ArrayLike | None = None,
        layer_mask: _Integers | None = None,
    ) -> _Numbers:
        """The index of a box that hides one end of a shaft from the other, as occluded() says: int64 (n,), or an int
        for one shaft; -1 for none.

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as Shafts.between() takes them.
        exclude: integers (k,), or one: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of indices for each of n shafts, such as its own two ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds in none of these layers.

        TypeError, ValueError or IndexError names the argument that does not fit; NeedsRefit is for a tree that needs
        refit(), RuntimeError for bounds that another thread is changing. One shaft runs on the calling thread, n on
        all processors; other threads of Python go on, and may make queries, too.
        """
    def list_occluders(
        self,
        shafts: _Asked,
        b: _Floats | None = None,
        *,
        exclude: _Integers | None = None,
        exclude_each: _Integers | None = None,
        exclude_mask: npt.ArrayLike | None = None,
        layer_mask: _Integers | None = None,
        limit: int | None = None,
    ) -> _Lists:
        """The indices of all boxes that hide one end of a shaft from the other (occluded()): a result as of list().

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as Shafts.between() takes them.
        exclude: integers (k,), or one: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of indices for each of n shafts, such as its own two ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds in none of these layers.
        limit: an integer of 0 or more: stops at so many results for each shaft, the first ones.

        TypeError, ValueError or IndexError names the argument that does not fit; NeedsRefit is for a tree that needs
        refit(), RuntimeError for bounds that another thread is changing. One shaft runs on the calling thread, n on
        all processors; other threads of Python go on, and may make queries, too.
        """

class BoxView(Boxes):
    """Boxes in arrays of the caller's, which are kept and never copied.

    boxes: float32, each coordinate in memory of its own, entry beside entry:
        a transpose of (6, n), numpy.asfortranarray(boxes), or a tuple of six (n,).

    Values are not checked, and may change between queries. Shafts keep a bound with NaN. ValueError for other layouts.
    """
    def __init__(self, boxes: _Floats) -> None: ...

class BoxStream(Boxes):
    """A copy of boxes, checked, in separate aligned streams: 24 bytes for each.

    boxes: float32
        (n, 6) of lo and hi, (n, 2, 3), a tuple (lo, hi) of (n, 3), a tuple of six (n,), or (6,) or (2, 3) for one.
    rounding: 'outwards' takes float64, too, and rounds lo down and hi up: boxes that are outside then are outside
        as given. Round solids (occluded()) to nearest instead: a larger one hides too much.

    BadBound, with the index of the first, for NaN and lo > hi; lo = infinity and hi = -infinity is the empty box.
    TypeError or ValueError for other arrays.
    """
    def __init__(self, boxes: _Floats, rounding: _Rounding | None = None) -> None: ...
    def update(self, boxes: _Floats, first: int = 0, rounding: _Rounding | None = None) -> None:
        """Replaces bounds from `first` on, as many as are given, which are as those of the class.

        TypeError, ValueError or BadBound says which argument or bound is wrong; then nothing is changed.
        RuntimeError if another thread uses this object. Other threads of Python go on meanwhile.
        """
    @property
    def memory_bytes(self) -> int:
        """Bytes of memory that it holds: int."""

class BoxTree(Boxes):
    """A tree over a copy of boxes, sorted by space, for many queries: 28 bytes for each, at most 2**32 - 1.
    Answers equal those of a BoxStream.

    boxes: float32
        (n, 6) of lo and hi, (n, 2, 3), a tuple (lo, hi) of (n, 3), a tuple of six (n,), or (6,) or (2, 3) for one.
    rounding: 'outwards' takes float64, too, and rounds lo down and hi up: boxes that are outside then are outside
        as given. Round solids (occluded()) to nearest instead: a larger one hides too much.

    BadBound, with the index of the first, for NaN and lo > hi; lo = infinity and hi = -infinity is the empty box.
    TypeError or ValueError for other arrays.

    Any number of threads may query one tree at once. A change, such as update(), must be alone.
    """
    def __init__(self, boxes: _Floats, rounding: _Rounding | None = None) -> None: ...
    def update(
        self, boxes: _Floats, indices: _Integers | None = None, rounding: _Rounding | None = None
    ) -> None:
        """Gives bounds new values, which are as those of the class: all bounds, in the order of their indices; or
        those at `indices`, integers (k,), and then refit() is due before the next query. IndexError for an index
        that names nothing.

        TypeError, ValueError or BadBound says which argument or bound is wrong; then nothing is changed.
        RuntimeError if another thread uses this object. Other threads of Python go on meanwhile.
        """
    def refit(self) -> None:
        """Fits the nodes to bounds that were updated by indices. RuntimeError if another thread uses the tree."""
    @property
    def needs_refit(self) -> bool:
        """bool: whether bounds were updated by indices since the last refit()."""
    def rebuild(self) -> None:
        """Sorts the bounds again, as they are now. Indices stay, `order` changes. It pays when sah_ratio() is 2 or 3.
        RuntimeError if another thread uses the tree.
        """
    def reorder(self) -> None:
        """Numbers the bounds again, by their places in the order of the tree. RuntimeError if another thread uses the
        tree.
        """
    def sah_ratio(self) -> float:
        """How much larger the smallest nodes have become since the tree was built: float, 1 at first.
        NeedsRefit if the tree needs refit().
        """
    @property
    def order(self) -> npt.NDArray[np.uint32]:
        """uint32 (bounds,): the indices of the bounds in the order of the tree. A copy."""
    @property
    def box(self) -> npt.NDArray[np.float32]:
        """float32 (6,): the box around all bounds. NeedsRefit if the tree needs refit()."""
    @property
    def memory_bytes(self) -> int:
        """Bytes of memory that it holds: int."""

class BoxTreeSnapshot(Boxes):
    """The boxes of a DynamicBoxTree at one commit(): what snapshot() of the tree returns.
    It never changes. len() is above all indices.
    """
    @property
    def alive(self) -> int:
        """The number of bounds: int."""
    @property
    def box(self) -> npt.NDArray[np.float32]:
        """float32 (6,): the box around all bounds."""

class DynamicBoxTree(Boxes):
    """A tree of boxes that are inserted, erased and moved. Changes are made by ids, and queries see them after
    commit(). An id never means another bound, even when its index is used again. Answers equal those of a
    BoxStream.

        tree = shaftcull.DynamicBoxTree()
        ids = tree.insert(boxes)
        tree.commit()
        kept = tree.list(a, b)                   # indices: ids & 0xffffffff

    One thread at a time may change the tree. Others query what snapshot() returns, also during a commit().
    len() is above all indices: cull() and exclude_mask have that many bounds, and those of an index without a
    bound are False.

    ValueError for an id of no bound.
    BadBound for NaN and lo > hi; lo = infinity and hi = -infinity is the empty box.
    """
    def __init__(self) -> None: ...
    def insert(
        self, boxes: _Floats, layers: _Integers | None = None, rounding: _Rounding | None = None
    ) -> int | npt.NDArray[np.int64]:
        """Inserts boxes, which are as those of the tree without changes, and returns their
        ids: int64 (n,), or an int for one. ids & 0xffffffff are indices, as queries return them.

        layers: integers from 0 to 2**32 - 1, one or (n,): the layers of each; all layers if not given.

        TypeError, ValueError or BadBound names the argument that does not fit; then nothing is inserted.
        """
    def erase(self, ids: _Integers) -> None:
        """Erases bounds. ids: integers (k,), or one. ValueError for one that occurs twice."""
    def move(self, ids: _Integers, boxes: _Floats, rounding: _Rounding | None = None) -> None:
        """Gives bounds new values: one for each id. ValueError for an id of no bound, BadBound for bad values."""
    def move_by(self, ids: _Integers, displacements: _Floats) -> None:
        """Moves bounds by vectors: float32 (k, 3), or (3,) for one id. ValueError for an id that occurs twice."""
    def commit(self) -> None:
        """Makes all changes visible to queries. RuntimeError if another thread uses the tree."""
    def rebuild(self) -> None:
        """commit(), and sorts all bounds again: for a world that was built bit by bit and stays."""
    def snapshot(self) -> BoxTreeSnapshot:
        """The state of the last commit(), as a BoxTreeSnapshot."""
    def values(self, ids: _Integers) -> npt.NDArray[np.float32]:
        """The values of bounds, with all changes: float32, a row for each id, or a row for one. ValueError for an id of
        no bound.
        """
    def __contains__(self, id: int) -> bool:
        """Whether an id has a bound, with all changes."""
    def ids_of(self, indices: _Integers) -> npt.NDArray[np.int64]:
        """The ids that have these indices now: int64 (k,). -1 for an index without a bound. IndexError for what is no
        index.
        """
    @property
    def alive(self) -> int:
        """The number of bounds, with all changes: int."""
    @property
    def memory_bytes(self) -> int:
        """Bytes of memory that it holds: int."""
    def set_upkeep(self, sorted_per_change: float) -> None:
        """How many bounds commits sort again, at most, for each change; 2 at first. More keep queries faster, and make
        commits slower. ValueError for a negative or infinite number.
        """
    @property
    def upkeep(self) -> dict[str, float]:
        """dict of numbers after the last commit(): blocks; growth, of nodes since they were sorted, 1 at best; waiting,
        bounds to be sorted again; sorted_last, bounds that the commit sorted.
        """

class Spheres(Bounds):
    """Spheres: a SphereView, a SphereStream or a SphereTree."""
    def first_contact(
        self,
        shafts: _Asked,
        b: _Floats | None = None,
        *,
        exclude: _Integers | None = None,
        exclude_each: _Integers | None = None,
        exclude_mask: npt.ArrayLike | None = None,
        layer_mask: _Integers | None = None,
        only: _Integers | None = None,
        skip_overlapping: bool = False,
        normals: bool = False,
    ) -> _Contacts:
        """Which bound the moving box of each shaft reaches first, and when: a tuple of indices, int64 (n,), and times,
        float32 (n,); an int and a float for one shaft. -1 and infinity if it reaches none. Time is 0 at a and 1 at
        b: a swept body has moved by its whole displacement at 1. Times are rounded down; which bound is first is
        decided exactly. With normals=True a third array, float32 (n, 3), or (3,) for one shaft: normals of contact, of
        unit length, from the bound towards the moving box. For a box it is one of +-x, +-y and +-z; zero if the two
        overlap at the start, or touch there without the box moving into the bound. ValueError for hulls.

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as Shafts.between() takes them.
        exclude: integers (k,), or one: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of indices for each of n shafts, such as its own two ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds in none of these layers.
        only: integers (k,): looks only at these bounds, such as candidates of a larger shaft, in their order.
        skip_overlapping: True leaves out bounds that the box overlaps at the start: with closed contact all that touch
            it, with open contact those that reach into it, so that a wall beside it still stops it.

        TypeError, ValueError or IndexError names the argument that does not fit; NeedsRefit is for a tree that needs
        refit(), RuntimeError for bounds that another thread is changing. One shaft runs on the calling thread, n on
        all processors; other threads of Python go on, and may make queries, too.
        """
    def entry_times(self, shafts: Shafts, indices: _Integers) -> npt.NDArray[np.float32]:
        """When the moving box of one shaft reaches bounds: float32 (k,), as first_contact() says; infinity for bounds
        that the shaft does not keep.

        shafts: Shafts of shape (). indices: integers (k,). ValueError for more shafts and for hulls, IndexError for
            an index that names nothing, NeedsRefit for a tree that needs refit(). It runs on the calling thread;
            others go on.
        """

class SphereView(Spheres):
    """Spheres in arrays of the caller's, which are kept and never copied.

    spheres: float32, each coordinate in memory of its own, entry beside entry:
        a transpose of (4, n), numpy.asfortranarray(spheres), or a tuple of four (n,).

    Values are not checked, and may change between queries. Shafts keep a bound with NaN. ValueError for other layouts.
    """
    def __init__(self, spheres: _Floats) -> None: ...

class SphereStream(Spheres):
    """A copy of spheres, checked, in separate aligned streams: 16 bytes for each.

    spheres: float32
        (n, 4) of centre and radius, a tuple (centres, radii) of (n, 3) and (n,), a tuple of four (n,), or (4,) for one.
    rounding: 'outwards' takes float64, too. Centres are rounded to nearest, and radii grow: each sphere contains
        the given one.

    BadBound, with the index of the first, for NaN, centres that are not finite, and radii below 0.
    TypeError or ValueError for other arrays.
    """
    def __init__(self, spheres: _Floats, rounding: _Rounding | None = None) -> None: ...
    def update(self, spheres: _Floats, first: int = 0, rounding: _Rounding | None = None) -> None:
        """Replaces bounds from `first` on, as many as are given, which are as those of the class.

        TypeError, ValueError or BadBound says which argument or bound is wrong; then nothing is changed.
        RuntimeError if another thread uses this object. Other threads of Python go on meanwhile.
        """
    @property
    def memory_bytes(self) -> int:
        """Bytes of memory that it holds: int."""

class SphereTree(Spheres):
    """A tree over a copy of spheres, sorted by space, for many queries: 20 bytes for each, at most 2**32 - 1.
    Answers equal those of a SphereStream.

    spheres: float32
        (n, 4) of centre and radius, a tuple (centres, radii) of (n, 3) and (n,), a tuple of four (n,), or (4,) for one.
    rounding: 'outwards' takes float64, too. Centres are rounded to nearest, and radii grow: each sphere contains
        the given one.

    BadBound, with the index of the first, for NaN, centres that are not finite, and radii below 0.
    TypeError or ValueError for other arrays.

    Any number of threads may query one tree at once. A change, such as update(), must be alone.
    """
    def __init__(self, spheres: _Floats, rounding: _Rounding | None = None) -> None: ...
    def update(
        self, spheres: _Floats, indices: _Integers | None = None, rounding: _Rounding | None = None
    ) -> None:
        """Gives bounds new values, which are as those of the class: all bounds, in the order of their indices; or
        those at `indices`, integers (k,), and then refit() is due before the next query. IndexError for an index
        that names nothing.

        TypeError, ValueError or BadBound says which argument or bound is wrong; then nothing is changed.
        RuntimeError if another thread uses this object. Other threads of Python go on meanwhile.
        """
    def refit(self) -> None:
        """Fits the nodes to bounds that were updated by indices. RuntimeError if another thread uses the tree."""
    @property
    def needs_refit(self) -> bool:
        """bool: whether bounds were updated by indices since the last refit()."""
    def rebuild(self) -> None:
        """Sorts the bounds again, as they are now. Indices stay, `order` changes. It pays when sah_ratio() is 2 or 3.
        RuntimeError if another thread uses the tree.
        """
    def reorder(self) -> None:
        """Numbers the bounds again, by their places in the order of the tree. RuntimeError if another thread uses the
        tree.
        """
    def sah_ratio(self) -> float:
        """How much larger the smallest nodes have become since the tree was built: float, 1 at first.
        NeedsRefit if the tree needs refit().
        """
    @property
    def order(self) -> npt.NDArray[np.uint32]:
        """uint32 (bounds,): the indices of the bounds in the order of the tree. A copy."""
    @property
    def box(self) -> npt.NDArray[np.float32]:
        """float32 (6,): the box around all bounds. NeedsRefit if the tree needs refit()."""
    @property
    def memory_bytes(self) -> int:
        """Bytes of memory that it holds: int."""

class SphereTreeSnapshot(Spheres):
    """The spheres of a DynamicSphereTree at one commit(): what snapshot() of the tree returns.
    It never changes. len() is above all indices.
    """
    @property
    def alive(self) -> int:
        """The number of bounds: int."""
    @property
    def box(self) -> npt.NDArray[np.float32]:
        """float32 (6,): the box around all bounds."""

class DynamicSphereTree(Spheres):
    """A tree of spheres that are inserted, erased and moved. Changes are made by ids, and queries see them after
    commit(). An id never means another bound, even when its index is used again. Answers equal those of a
    SphereStream.

        tree = shaftcull.DynamicSphereTree()
        ids = tree.insert(spheres)
        tree.commit()
        kept = tree.list(a, b)                   # indices: ids & 0xffffffff

    One thread at a time may change the tree. Others query what snapshot() returns, also during a commit().
    len() is above all indices: cull() and exclude_mask have that many bounds, and those of an index without a
    bound are False.

    ValueError for an id of no bound.
    BadBound for NaN, centres that are not finite, and radii below 0.
    """
    def __init__(self) -> None: ...
    def insert(
        self, spheres: _Floats, layers: _Integers | None = None, rounding: _Rounding | None = None
    ) -> int | npt.NDArray[np.int64]:
        """Inserts spheres, which are as those of the tree without changes, and returns their
        ids: int64 (n,), or an int for one. ids & 0xffffffff are indices, as queries return them.

        layers: integers from 0 to 2**32 - 1, one or (n,): the layers of each; all layers if not given.

        TypeError, ValueError or BadBound names the argument that does not fit; then nothing is inserted.
        """
    def erase(self, ids: _Integers) -> None:
        """Erases bounds. ids: integers (k,), or one. ValueError for one that occurs twice."""
    def move(self, ids: _Integers, spheres: _Floats, rounding: _Rounding | None = None) -> None:
        """Gives bounds new values: one for each id. ValueError for an id of no bound, BadBound for bad values."""
    def move_by(self, ids: _Integers, displacements: _Floats) -> None:
        """Moves bounds by vectors: float32 (k, 3), or (3,) for one id. ValueError for an id that occurs twice."""
    def commit(self) -> None:
        """Makes all changes visible to queries. RuntimeError if another thread uses the tree."""
    def rebuild(self) -> None:
        """commit(), and sorts all bounds again: for a world that was built bit by bit and stays."""
    def snapshot(self) -> SphereTreeSnapshot:
        """The state of the last commit(), as a SphereTreeSnapshot."""
    def values(self, ids: _Integers) -> npt.NDArray[np.float32]:
        """The values of bounds, with all changes: float32, a row for each id, or a row for one. ValueError for an id of
        no bound.
        """
    def __contains__(self, id: int) -> bool:
        """Whether an id has a bound, with all changes."""
    def ids_of(self, indices: _Integers) -> npt.NDArray[np.int64]:
        """The ids that have these indices now: int64 (k,). -1 for an index without a bound. IndexError for what is no
        index.
        """
    @property
    def alive(self) -> int:
        """The number of bounds, with all changes: int."""
    @property
    def memory_bytes(self) -> int:
        """Bytes of memory that it holds: int."""
    def set_upkeep(self, sorted_per_change: float) -> None:
        """How many bounds commits sort again, at most, for each change; 2 at first. More keep queries faster, and make
        commits slower. ValueError for a negative or infinite number.
        """
    @property
    def upkeep(self) -> dict[str, float]:
        """dict of numbers after the last commit(): blocks; growth, of nodes since they were sorted, 1 at best; waiting,
        bounds to be sorted again; sorted_last, bounds that the commit sorted.
        """

class Triangles(Bounds):
    """Triangles: a TriangleView, a TriangleStream or a TriangleTree."""

class TriangleView(Triangles):
    """Triangles in arrays of the caller's, which are kept and never copied.

    triangles: float32, each coordinate in memory of its own, entry beside entry:
        a transpose of (9, n), numpy.asfortranarray(triangles), or a tuple of nine (n,).

    Values are not checked, and may change between queries. Shafts keep a bound with NaN. ValueError for other layouts.
    """
    def __init__(self, triangles: _Floats) -> None: ...

class TriangleStream(Triangles):
    """A copy of triangles, checked, in separate aligned streams: 36 bytes for each.

    triangles: float32
        (n, 3, 3), (n, 9), a tuple of nine (n,), or vertices (v, 3) with faces (f, 3).
    faces: integers (f, 3) from 0 on: the vertices of each triangle. IndexError for one that names nothing.

    Triangles are never rounded outwards, since none of float32 need contain a given one of float64:
    triangles.astype(numpy.float32) rounds to nearest.

    BadBound, with the index of the first, for coordinates that are not finite.
    TypeError or ValueError for other arrays.
    """
    def __init__(self, triangles: _Floats, faces: _Integers | None = None) -> None: ...
    def update(self, triangles: _Floats, first: int = 0, faces: _Integers | None = None) -> None:
        """Replaces bounds from `first` on, as many as are given, which are as those of the class.

        TypeError, ValueError or BadBound says which argument or bound is wrong; then nothing is changed.
        RuntimeError if another thread uses this object. Other threads of Python go on meanwhile.
        """
    @property
    def memory_bytes(self) -> int:
        """Bytes of memory that it holds: int."""

class TriangleTree(Triangles):
    """A tree over a copy of triangles, sorted by space, for many queries: 40 bytes for each, at most 2**32 - 1.
    Answers equal those of a TriangleStream.

    triangles: float32
        (n, 3, 3), (n, 9), a tuple of nine (n,), or vertices (v, 3) with faces (f, 3).
    faces: integers (f, 3) from 0 on: the vertices of each triangle. IndexError for one that names nothing.

    Triangles are never rounded outwards, since none of float32 need contain a given one of float64:
    triangles.astype(numpy.float32) rounds to nearest.

    BadBound, with the index of the first, for coordinates that are not finite.
    TypeError or ValueError for other arrays.

    Any number of threads may query one tree at once. A change, such as update(), must be alone.
    """
    def __init__(self, triangles: _Floats, faces: _Integers | None = None) -> None: ...
    def update(
        self, triangles: _Floats, indices: _Integers | None = None, faces: _Integers | None = None
    ) -> None:
        """Gives bounds new values, which are as those of the class: all bounds, in the order of their indices; or
        those at `indices`, integers (k,), and then refit() is due before the next query. IndexError for an index
        that names nothing.

        TypeError, ValueError or BadBound says which argument or bound is wrong; then nothing is changed.
        RuntimeError if another thread uses this object. Other threads of Python go on meanwhile.
        """
    def refit(self) -> None:
        """Fits the nodes to bounds that were updated by indices. RuntimeError if another thread uses the tree."""
    @property
    def needs_refit(self) -> bool:
        """bool: whether bounds were updated by indices since the last refit()."""
    def rebuild(self) -> None:
        """Sorts the bounds again, as they are now. Indices stay, `order` changes. It pays when sah_ratio() is 2 or 3.
        RuntimeError if another thread uses the tree.
        """
    def reorder(self) -> None:
        """Numbers the bounds again, by their places in the order of the tree. RuntimeError if another thread uses the
        tree.
        """
    def sah_ratio(self) -> float:
        """How much larger the smallest nodes have become since the tree was built: float, 1 at first.
        NeedsRefit if the tree needs refit().
        """
    @property
    def order(self) -> npt.NDArray[np.uint32]:
        """uint32 (bounds,): the indices of the bounds in the order of the tree. A copy."""
    @property
    def box(self) -> npt.NDArray[np.float32]:
        """float32 (6,): the box around all bounds. NeedsRefit if the tree needs refit()."""
    @property
    def memory_bytes(self) -> int:
        """Bytes of memory that it holds: int."""

class Patches:
    """Patches for several calls of visibility(), in a tree. They never change. len() is their number.

    boxes: float32 (n, 6), or as those of BoxStream: around facets, points, or cells of a volume. Or corners of
        convex polygons, float32 (n, k, 3) or a list of arrays (k, 3), 3 to 8 of them: a polygon faces the side
        from which its corners run counter-clockwise, and has no plane of `planes`.
    sides: 'both' is for polygons that are seen from both sides; two in one plane face away. Boxes without
        planes are seen from all sides.
    planes: float32 (n, 4), or (4,) for all: normal and offset. A patch faces where its normal points. Planes
        are never rounded outwards: round those of float64 by astype(numpy.float32).
    rounding: 'outwards' takes boxes of float64, too, and contains them: pairs that are clear or occluded are so
        as given.

    BadBound, with the index, for a box that is not finite or has lo > hi, and for a plane without a normal.
    TypeError or ValueError for other arrays.
    """
    def __init__(
        self,
        boxes: _Floats | Sequence[_Floats],
        planes: _Floats | None = None,
        *,
        rounding: _Rounding | None = None,
        sides: Literal["front", "both"] = "front",
    ) -> None: ...
    def __len__(self) -> int: ...
    @property
    def has_planes(self) -> bool:
        """bool: whether the patches have planes."""
    @property
    def order(self) -> npt.NDArray[np.uint32]:
        """uint32 (n,): the indices of the patches in the order of the tree, neighbours in space together. A copy."""

class Occluders:
    """All that stands between patches, for several calls of visibility(). It never changes. len() is the number of
    occluders, which are numbered from 0 on: first those of `boxes`, then solids, hulls, polygons, and groups of
    triangles.

    boxes: around things that may hide something: float32 (n, 6), or as those of BoxStream.
    solids: solid boxes, as walls are. They make pairs 'occluded', also where several are one larger box together.
    hulls: convex hulls that are solid: float32 (n, k, 3), or a list of (k, 3), of 4 corners or more each.
    polygons: flat convex polygons without thickness: such arrays, of 3 corners or more in order.
    triangles, faces: a mesh, float32 (n, 3, 3), or vertices (v, 3) with faces, integers (f, 3).
    groups: integers (g + 1,): group i has triangles groups[i] to groups[i + 1]. None: the library makes groups.
    find_solids: True finds bodies, walls and floors in the triangles, which make pairs 'occluded'. They are no
        occluders: `found` says how many there are. Closed surfaces must face outwards to be bodies.
    rounding: 'outwards' takes `boxes` of float64, too, and contains them: a pair that is clear is so as given. The
        others are never rounded outwards, since a larger solid hides too much: use astype(numpy.float32).

    BadBound, with the index, for a value that is not finite or lo > hi. TypeError, ValueError or IndexError
    names the argument that does not fit.
    """
    def __init__(
        self,
        boxes: _Floats | None = None,
        *,
        solids: _Floats | None = None,
        hulls: _Floats | None = None,
        polygons: _Floats | None = None,
        triangles: _Floats | None = None,
        faces: _Integers | None = None,
        groups: _Integers | None = None,
        find_solids: bool = False,
        rounding: _Rounding | None = None,
    ) -> None: ...
    def __len__(self) -> int: ...
    @property
    def found(self) -> dict[str, int]:
        """How many solids were found in the triangles: a dict with 'hulls' (convex bodies), 'polygons' and
        'inner_boxes' (boxes inside other bodies); empty without find_solids.
        """
    @property
    def first(self) -> dict[str, int]:
        """The number of the first occluder of each argument that was given: a dict such as
        {'solids': 0, 'triangles': 12}. Boxes are 'occluders'.
        """
    def box(self, occluder: int) -> npt.NDArray[np.float32]:
        """The box around one occluder: float32 (6,). IndexError for a number that names nothing."""
    def triangles(self, occluder: int) -> npt.NDArray[np.uint32]:
        """The triangles of one occluder: uint32 (k,), none if it is no group of triangles. IndexError for a number
        that names nothing.
        """

class Visibility:
    """The answers of visibility() for all pairs. pairs() and bits() give the pairs of one kind; `blocks` and
    `undecided` are the same pairs in less memory. Arrays are read-only, and keep the Visibility alive.
    """
    @property
    def counts(self) -> dict[str, int]:
        """How many pairs are 'undecided', 'clear', 'occluded' and 'facing_away': a dict of int."""
    @property
    def blocks(self) -> npt.NDArray[np.uint32]:
        """Pairs that are decided, in blocks: uint32 (p, 4). A row is first_a, count_a, first_b, count_b: each patch of
        order_a[first_a:first_a + count_a] with each of order_b[first_b:first_b + count_b] is as `sights` says.
        """
    @property
    def sights(self) -> npt.NDArray[np.uint8]:
        """The kind of all pairs of each pair block: uint8 (p,): 1 clear, 2 occluded, 3 facing_away."""
    @property
    def undecided(self) -> npt.NDArray[np.uint32]:
        """Pairs that are undecided: uint32 (n, 2), indices of patches."""
    @property
    def candidates(self) -> IndexLists | None:
        """The candidates of each undecided pair, which are the occluders that reach between its patches: IndexLists of
        n lists, whose numbers ascend; or None, if there are no candidates.
        """
    @property
    def order_a(self) -> npt.NDArray[np.uint32]:
        """The order that pair blocks refer to: uint32 (a,), indices of patches. A copy."""
    @property
    def order_b(self) -> npt.NDArray[np.uint32]:
        """The same of patches_b: uint32 (b,); for one set with itself it is order_a."""
    @property
    def occluders(self) -> Occluders:
        """What stood between: Occluders."""
    def pairs(self, sight: _Sight) -> npt.NDArray[np.uint32]:
        """All pairs of one kind: uint32 (n, 2), indices of patches; for one set with itself each pair once.

        sight: 'undecided', 'clear', 'occluded' or 'facing_away'; ValueError for others. Other threads go on.
        """
    def fractions(self, *, rays: int = 64, error: float = 0.0, seed: int = 1) -> npt.NDArray[np.float32]:
        """Which part of each undecided pair is visible, by rays between points of both patches: float32 (n,), from 0
        to 1. A box counts as solid.

        rays: how many of each pair, 1 to 65536. error: a pair gets fewer if its standard error is at most this.
        seed: chooses the points. ValueError for others, without candidates, and for patches that are boxes with an
        interior. Other threads go on.
        """
    def bits(self, sight: _Sight, *, packed: bool = False) -> _Bits:
        """Which pairs are of one kind: bool (a, b). With packed=True uint64 (a, (b + 63) // 64) instead, 64 pairs to a
        word. For one set with itself both bits of a pair are set.

        sight: 'undecided', 'clear', 'occluded' or 'facing_away'; ValueError for others. Other threads go on.
        """

def visibility(
    patches: _Floats | Sequence[_Floats] | Patches,
    patches_b: _Floats | Sequence[_Floats] | Patches | None = None,
    *,
    planes: _Floats | None = None,
    planes_b: _Floats | None = None,
    occluders: _Floats | Occluders | None = None,
    solids: _Floats | None = None,
    hulls: _Floats | None = None,
    polygons: _Floats | None = None,
    triangles: _Floats | None = None,
    faces: _Integers | None = None,
    groups: _Integers | None = None,
    rounding: _Rounding | None = None,
    contact: _Contact = "open",
    tolerance: float = 0.0,
    solids_around_ends: bool = True,
    memory: int = 268435456,
    progress: Callable[[int, int], object] | None = None,
    candidates: bool = True,
) -> Visibility:
    """Which patches see each other. Of every pair: whether nothing stands between ('clear'), one solid hides all
    ('occluded'), one lies behind the plane of the other ('facing_away'), or none of these ('undecided'). All
    are exact for the float32 given. Returns a Visibility, which takes 20 bytes for each pair block, 16 for each
    undecided pair, and 4 for each candidate.

    patches, patches_b: boxes, float32 (n, 6), corners, float32 (n, k, 3), or Patches. Without patches_b, each two
        patches are one pair.
    planes, planes_b: for patches that have a side: float32 (n, 4), or (4,) for all; normal and offset.
    occluders: boxes around things that may hide something; or Occluders, and then none of the five that follow.
    solids, hulls, polygons, triangles with faces, groups: what else stands between, as Occluders say.
    rounding: 'outwards' takes boxes of float64, too, of patches and `occluders`, as Patches and Occluders say.
    contact: 'open' leaves out what only touches a shaft, so a patch may lie on an occluder; 'closed' does not.
    tolerance: how far in front of a plane a point may be and still count as behind it, for rounded corners.
    solids_around_ends: whether a solid that reaches around a patch makes its pairs 'occluded'.
    memory: bytes that answers under way may take, 1 MB or more.
    progress: called as progress(done, total) some times a second, on this thread; if it raises, the call ends.
    candidates: whether undecided pairs come with candidates, the occluders that reach between.

    TypeError, ValueError, IndexError or BadBound names the argument that does not fit. It runs on all
    processors; other threads of Python go on, and Ctrl-C ends it. RuntimeError in a child of fork() whose
    parent has used all processors.
    """
def count_visibility(
    patches: _Floats | Sequence[_Floats] | Patches,
    patches_b: _Floats | Sequence[_Floats] | Patches | None = None,
    *,
    planes: _Floats | None = None,
    planes_b: _Floats | None = None,
    occluders: _Floats | Occluders | None = None,
    solids: _Floats | None = None,
    hulls: _Floats | None = None,
    polygons: _Floats | None = None,
    triangles: _Floats | None = None,
    faces: _Integers | None = None,
    groups: _Integers | None = None,
    rounding: _Rounding | None = None,
    contact: _Contact = "open",
    tolerance: float = 0.0,
    solids_around_ends: bool = True,
    memory: int = 268435456,
    progress: Callable[[int, int], object] | None = None,
) -> dict[str, int]:
    """How many pairs are 'undecided', 'clear', 'occluded' and 'facing_away': a dict of int, as the counts of
    visibility(). It keeps nothing of any pair.

    patches, patches_b: boxes, float32 (n, 6), corners, float32 (n, k, 3), or Patches. Without patches_b, each two
        patches are one pair.
    planes, planes_b: for patches that have a side: float32 (n, 4), or (4,) for all; normal and offset.
    occluders: boxes around things that may hide something; or Occluders, and then none of the five that follow.
    solids, hulls, polygons, triangles with faces, groups: what else stands between, as Occluders say.
    rounding: 'outwards' takes boxes of float64, too, of patches and `occluders`, as Patches and Occluders say.
    contact: 'open' leaves out what only touches a shaft, so a patch may lie on an occluder; 'closed' does not.
    tolerance: how far in front of a plane a point may be and still count as behind it, for rounded corners.
    solids_around_ends: whether a solid that reaches around a patch makes its pairs 'occluded'.
    memory: bytes that answers under way may take, 1 MB or more.
    progress: called as progress(done, total) some times a second, on this thread; if it raises, the call ends.

    TypeError, ValueError, IndexError or BadBound names the argument that does not fit. It runs on all
    processors; other threads of Python go on, and Ctrl-C ends it. RuntimeError in a child of fork() whose
    parent has used all processors.
    """
def merged_boxes(boxes: _Floats) -> npt.NDArray[np.float32]:
    """Larger solid boxes that cover what the given boxes cover and nothing else: pieces of a wall that share a
    face become one. float32 (m, 6); they may overlap.

    boxes: float32 (n, 6), or as those of BoxStream. BadBound, with the index, for one that is not finite or has
        lo > hi. Other threads of Python go on.
    """
def inscribed_box(corners: _Floats) -> npt.NDArray[np.float32]:
    """A large box inside the convex hull of points: float32 (6,). It lies in the hull exactly.

    corners: float32 (k, 3), 4 to 32 points. ValueError for another number of them, or one that is not finite.
    """
class Origin:
    """A point of a world in float64 that coordinates are relative to. Near it floats are fine. What is outside of the
    shaft between two boxes from boxes() is outside in the world, too. Solids that hide, and boxes that are to contain
    others, are made with within=True. Nothing is refused that bounds and shafts refuse: NaN and lo > hi stay.
    """
    def __init__(self, at: npt.ArrayLike = (0, 0, 0)) -> None: ...
    @staticmethod
    def near(points: npt.ArrayLike) -> Origin:
        """An origin near the middle of points (n, 3), such as the corners of a scene. Its coordinates are multiples
        of a power of two. ValueError for no points, and for one that is not finite.
        """
    @property
    def at(self) -> npt.NDArray[np.float64]:
        """Where it is: float64 (3,)."""
    def boxes(self, boxes: npt.ArrayLike, *, within: bool = False) -> npt.NDArray[np.float32]:
        """The smallest boxes of float32 that contain these, or the largest within them: the empty box where there is
        none. float32 of the same shape.

        boxes: (n, 6) of lo and hi, or (6,) for one. TypeError or ValueError for others. Other threads of Python
            go on.
        """
    def spheres(self, spheres: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """Spheres of float32 that contain these: centres are rounded to nearest, and radii grow. float32 of the same
        shape.

        spheres: (n, 4) of centre and radius, or (4,) for one. TypeError or ValueError for others. Other threads of
            Python go on.
        """
    def points(self, points: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """The nearest float32 of each coordinate, for vertices of triangles, corners of patches and points of hulls.
        float32 of the same shape.

        points: (n, 3), or (3,) for one. TypeError or ValueError for others. Other threads of Python go on.
        """
    def to_world(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Where points are in the world: float64 of the same shape.

        points: float32 (n, 3), or (3,) for one. TypeError or ValueError for others.
        """
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...
class ViewFactors:
    """View factors of all pairs, as a sparse matrix in rows:
    scipy.sparse.csr_array((f.data, f.indices, f.indptr), f.shape). Row i has the factors from patch i.
    """
    @property
    def data(self) -> npt.NDArray[np.float64]:
        """The factors, which are above 0, row by row: float64 (nnz,)."""
    @property
    def indices(self) -> npt.NDArray[np.int32]:
        """To which patch each factor is, ascending in a row: int32 (nnz,)."""
    @property
    def indptr(self) -> npt.NDArray[np.int64]:
        """Where the factors of each row begin, and then where the last end: int64 (n + 1,)."""
    @property
    def shape(self) -> tuple[int, int]:
        """(n, n), for n patches."""
    @property
    def area(self) -> npt.NDArray[np.float64]:
        """The area of each patch: float64 (n,)."""
    @property
    def row_sum(self) -> npt.NDArray[np.float64]:
        """The sum of each row, with what is left out: float64 (n,). 1 - row_sum is what meets no patch, as the sky."""
    @property
    def error(self) -> npt.NDArray[np.float64]:
        """The estimated standard error of each sum: float64 (n,)."""
    @property
    def left_out(self) -> npt.NDArray[np.float64]:
        """Which part of each sum is left out, as it is below `least`: float64 (n,)."""
    @property
    def counts(self) -> dict[str, int]:
        """How many pairs are 'undecided', 'clear', 'occluded' and 'facing_away': a dict of int."""
def view_factors(
    patches: _Floats | Sequence[_Floats] | Patches,
    *,
    planes: _Floats | None = None,
    occluders: _Floats | Occluders | None = None,
    triangles: _Floats | None = None,
    faces: _Integers | None = None,
    rays: int = 4096,
    error: float = 2e-05,
    seed: int = 1,
    least: float = 0.0,
    close: bool = False,
    tolerance: float = 0.0,
    memory: int = 268435456,
    progress: Callable[[int, int], object] | None = None,
) -> ViewFactors:
    """The view factors of each two patches: of clear pairs as view_factor(), of others by rays, and 0 of pairs that
    one solid hides and that face away. The same bits for any number of processors. Returns a ViewFactors.

    patches: corners, float32 (n, k, 3), counterclockwise as seen from where they radiate; boxes that are flat,
        float32 (n, 6), with planes; or Patches. planes: float32 (n, 4), or (4,) for all.
    occluders: boxes, which count as solid; or Occluders. triangles with faces: what stands between, the patches' own
        bodies included, in place of Occluders; solids are looked for in them.
    rays: most rays of a pair, 1 to 65536. error: a pair gets fewer if the standard error of its factors is at most
        this. seed: chooses the points of rays.
    least: pairs both of whose factors are below this are left out; left_out has their sums.
    close: whether rows are scaled to sum to 1, as those of a closed room do; ValueError if they are far from it.
    tolerance: as of visibility(). memory: bytes that answers under way may take, besides the factors, 1 MB or more.
    progress: called as progress(done, total) some times a second, on this thread; if it raises, the call ends.

    TypeError, ValueError, IndexError or BadBound names the argument that does not fit; also for patches without
    planes, and for Patches with sides='both'. It runs on all processors; other threads of Python go on, and
    Ctrl-C ends it. RuntimeError in a child of fork() whose parent has used all processors.
    """
def view_factor(from_corners: _Floats, to_corners: _Floats) -> float:
    """The view factor from one flat convex polygon to another with nothing between them, from 0 to 1. What is
    behind the other's plane does not count. The error is below 1e-8 of it, or 1e-11.

    from_corners, to_corners: float32 (k, 3), 3 to 8 corners, counterclockwise as seen from the front. ValueError for
        another number of them, for one that is not finite, and if the first polygon has no area.
    """
def lit_fractions(
    patches: _Floats | Sequence[_Floats] | Patches,
    directions: _Floats,
    *,
    planes: _Floats | None = None,
    occluders: _Floats | Occluders | None = None,
    triangles: _Floats | None = None,
    faces: _Integers | None = None,
    rays: int = 64,
    error: float = 0.0,
    seed: int = 1,
    tolerance: float = 0.0,
) -> npt.NDArray[np.float32]:
    """Which part of each patch is lit from each direction, by rays: float32 (n, m), from 0 to 1. 0 where the patch
    faces away. lit @ hours are hours of sun, for directions to the sun that each stand for some hours.

    patches, planes, occluders, triangles, faces: as of view_factors(), but Patches may have sides='both'.
    directions: to lights that are infinitely far away, float32 (m, 3), of any length.
    rays: from a patch to each light, 1 to 65536. error: fewer if the standard error is at most this.
    seed: chooses the points. tolerance: as of visibility().

    TypeError, ValueError, IndexError or BadBound names the argument that does not fit. It runs on all
    processors; other threads of Python go on. RuntimeError in a child of fork() whose parent has used all
    processors.
    """
def points(points: _Floats, *, rounding: _Rounding | None = None) -> npt.NDArray[np.float32]:
    """Boxes that are points, for viewpoints and point lights: float32 (n, 6) of points (n, 3), or (6,) of (3,).

    points: float32. rounding: 'outwards' takes float64, too, and each box contains its point. TypeError or
        ValueError for others.
    """
def view_planes(matrix: _Floats, depth: _Depth = "zero_to_one") -> npt.NDArray[np.float32]:
    """The planes of a view frustum, with normals outwards, to cut shafts to the view: float32 (k, 4), k up to 6,
    normal and offset.

    matrix, depth: as those of ConvexHull.frustum(). TypeError or ValueError for other arguments.
    """
def available_isas() -> list[str]:
    """Names of the instruction sets that this machine can run, slowest first."""
def active_isa() -> str:
    """The name of the instruction set in use. Answers do not depend on it."""
def select_isa(isa: str) -> None:
    """Uses an instruction set from now on, in all threads: one of available_isas(). ValueError for another one."""
def concurrency() -> int:
    """How many threads a call for many shafts uses."""
