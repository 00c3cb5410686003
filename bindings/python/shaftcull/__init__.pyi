# SPDX-License-Identifier: MIT
from typing import Any, Callable, Iterator, Literal, Sequence, SupportsIndex, Tuple, Union

import numpy as np
import numpy.typing as npt

__version__: str

# Arrays of the shapes and dtypes that the docstrings state, tuples of such arrays, and lists of numbers.
_Floats = Any
_Integers = npt.ArrayLike
_Rounding = Literal["outwards"]
_Contact = Literal["closed", "open"]
_Depth = Literal["zero_to_one", "minus_one_to_one"]
_Sight = Literal["undecided", "clear", "occluded", "facing_away"]
_Test = Literal["exact", "vertices"]
_HullTest = Literal["exact", "conservative"]

_Bits = npt.NDArray[Any]  # of bool, or of uint64 if they stay packed
# These depend on the shape of the shafts, which types do not express.
_Bools = Any  # a bool, or NDArray[bool]
_Numbers = Any  # an int, or NDArray[int64]
_Times = Any  # a float, or NDArray[float32]
_Contacts = Tuple[Any, ...]  # _Numbers, _Times and, with normals, NDArray[float32]
_Lists = Any  # NDArray[uint32], or IndexLists; NDArray[uint32] with times is Tuple[NDArray[uint32], NDArray[float32]]
_Asked = Union["Shafts", "ConvexHull", _Floats]

class BadBound(ValueError):
    """A bound, point or shaft of an array cannot be used: NaN, lo > hi, a negative radius, or a number that is not
    finite where it must be. The attribute `index` is its position, counted from 0.
    """
    index: int

class NeedsRefit(RuntimeError):
    """A tree was queried after update() with indices and before refit()."""

class IndexLists:
    """Lists of indices, one per shaft: the result of list() and similar calls for n shafts.

    lists[i]: uint32 (k,), the list of shaft i, a view of `indices`. i is an integer, which may count from the end;
        IndexError if it is out of range. len() is n, and iterating gives the lists in order.
    offsets: int64 (n + 1,): list i is indices[offsets[i]:offsets[i + 1]].
    indices: uint32, all lists, one after another.
    times: float32, one time per index; None unless list() was called with times=True.

    IndexLists can be pickled, and made from saved arrays: IndexLists(offsets, indices, times).
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
    """An array of shafts, of shape (n,), or () for one shaft.

    between(), swept(), swept_infinite(), shadow() and concatenate() make shafts. Shafts never change, and take
    832 bytes each. An integer index gives one shaft, a slice of step 1 gives a view, and other indices give
    copies.
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
        """Shafts between boxes. A shaft holds all segments from a[i] to b[i], and so everything that can stand between
        the two. Two single boxes make one shaft, of shape (). Otherwise the shape is (n,), or (m,) with pairs.

        a, b: boxes, float32: (n, 6) with lo x, y, z, then hi x, y, z; (n, 2, 3); a tuple (lo, hi) of (n, 3); a tuple
            of six (n,); or one box, (6,) or (2, 3), which is paired with every box of the other argument.
        pairs: integers (m, 2): shaft i is between a[pairs[i, 0]] and b[pairs[i, 1]].
        planes_a, planes_b: float32 (n, k, 4), k planes per box, or (k, 4) for all boxes: normal and offset. Bounds
            with normal . p > offset at all their points p are left out. At most 16 planes per shaft in all. Planes
            are never rounded outwards: no float32 half-space contains a float64 one, unless their normals are
            parallel.
        contact: 'closed' keeps bounds that only touch a shaft, 'open' does not.
        rounding: 'outwards' also accepts boxes of float64; each shaft then contains the shaft of the given boxes.

        TypeError or ValueError names the argument that does not fit. BadBound, with the index, for a box that is not
        finite or has lo > hi; IndexError for an index in pairs that is out of range. Runs on the calling thread.
        Other threads of Python continue.
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
        """The volumes that bodies sweep when they move by displacements: bodies[i] + t * displacements[i], t from
        0 to 1. The end position of a body need not be a float32, and is not rounded.

        bodies: boxes, as for between(). displacements: float32 (n, 3), or (3,) for all bodies.
        planes: float32 (n, k, 4), k planes per shaft, or (k, 4) for all shafts. contact: as for between().
        rounding: 'outwards' also accepts float64. Displacements are rounded to nearest, and bodies grow by the
            rounding error, so each shaft contains the exact volume.

        Errors and threads: as for between().
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
        """The volumes that bodies sweep when they move in directions without end: bodies[i] + t * directions[i],
        t >= 0. swept_infinite(receivers, towards_sun) contains everything that can cast the sun's shadow on
        receivers.

        bodies: boxes, as for between(). directions: float32 (n, 3) of any length but 0, or (3,) for all bodies.
        planes, contact: as for swept().
        rounding: 'outwards' also accepts bodies of float64; each shaft then contains the given body. Directions must
            be float32, since a rounded direction leads to other places at a great distance.

        Errors and threads: as for between().
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
        """The volumes that occluders can shadow from lights, or hide from viewpoints: all points behind occluders[i] as
        seen from points of lights[i], and the occluder itself.

        lights, occluders: boxes, as for between(); a light and its occluder must be apart. A light may be a point:
            points() makes its box.
        reach: the shadow ends at this multiple of the distance of the occluder from the light; 1 or more. With None,
            it has no end.
        pairs, planes_lights, planes_occluders, contact: as for between().
        rounding: 'outwards' also accepts float64; each shaft then contains the exact shadow.

        Errors and threads: as for between(). ValueError for a light and an occluder that are not apart.
        """
    @staticmethod
    def concatenate(parts: Sequence[Shafts | ConvexHull]) -> Shafts:
        """All shafts of several Shafts and ConvexHulls, in the given order: shape (n,). The result keeps the hulls
        alive.

        parts: a sequence of Shafts and ConvexHulls. TypeError for other parts.
        """
    def __len__(self) -> int: ...
    def __getitem__(self, key: SupportsIndex | slice | npt.ArrayLike) -> Shafts:
        """One or several shafts, selected as in NumPy by an integer, a slice, or an array of integers (k,) or of bool
        (n,). IndexError for an index out of range.
        """
    @property
    def shape(self) -> tuple[int, ...]:
        """A tuple of int: (n,), or () for one shaft."""
    @property
    def a(self) -> npt.NDArray[np.float32]:
        """float32 (n, 6) or (6,): the boxes where shafts begin; for a convex hull, the box around it."""
    @property
    def b(self) -> npt.NDArray[np.float32]:
        """float32 (n, 6) or (6,): the boxes where shafts end, rounded to nearest; without end, a box on the way."""
    @property
    def open_contact(self) -> _Bools:
        """bool (n,), or a bool: whether bounds that only touch a shaft are left out."""
    def with_contact(self, contact: _Contact) -> Shafts:
        """Copies that keep ('closed') or leave out ('open') bounds that only touch them. For a hull, use
        Shafts.concatenate([hull]). ValueError for other values.
        """
    def completed(self) -> Shafts:
        """Copies whose joining planes are computed, in about 65 ns per shaft. Answers are the same. This pays off for
        shafts of several queries about spheres, or about bounds that are inside.
        """
    def occluded_by_polygon(self, corners: _Floats) -> _Bools:
        """Whether a convex polygon, such as a wall at any angle, hides one end of a shaft from the other. bool (n,), or
        a bool for one shaft.

        corners: float32 (k, 3) in order, either way round, k >= 3. ValueError for fewer corners, for corners that
            are not finite, and for shafts that are not between boxes or polygons. Runs on the calling thread. Other
            threads of Python continue.
        """

class ConvexHull:
    """The convex hull of up to 32 points and directions: a view frustum, the volume whose objects cast shadows into
    a view, the volume between polygons. It can be used wherever one shaft can.

    points: float32 (n, 3), 1 to 32 together with the directions. directions: float32 (m, 3), not 0: the hull has
        no end in these directions. float64 raises TypeError, since a hull of rounded points need not contain the
        given hull.
    test: 'exact' or 'conservative'. With 'conservative', boxes are outside only if they are beyond one face, as
        in the usual test of a view by its planes. This test is faster, and keeps some boxes beside edges and
        corners. Casters have the test of their view.

    Answers for boxes and triangles are exact; answers for spheres err to the safe side. Queries for times refuse
    a hull. Queries for occluders refuse a hull that was not made by between_polygons(). Contact is closed;
    Shafts.concatenate([hull]).with_contact('open') leaves out bounds that only touch the hull.
    """
    def __init__(self, points: _Floats, directions: _Floats | None = None, test: _HullTest = "exact") -> None: ...
    @staticmethod
    def between_polygons(p: _Floats, q: _Floats, test: _HullTest = "exact") -> ConvexHull:
        """The ConvexHull of two ends, such as polygons or turned boxes. Each end is the convex hull of its corners.
        Queries about occluders accept this hull: they find solids that hide one end from the other.

        p, q: float32 (n, 3), corners in any order, 1 or more each and at most 32 together. test: as for ConvexHull.

        TypeError or ValueError for other arguments.
        """
    @staticmethod
    def frustum(matrix: _Floats, depth: _Depth, test: _HullTest = "exact") -> ConvexHull:
        """The volume that a view-projection matrix shows: a ConvexHull.

        matrix: float32 (4, 4) that maps column vectors: matrix @ (x, y, z, 1) is in clip space. Round a matrix of
            float64 with astype(numpy.float32).
        depth: 'zero_to_one' (Direct3D, Vulkan, Metal) or 'minus_one_to_one' (OpenGL).
        test: as for ConvexHull.

        TypeError or ValueError for other arguments, and for a matrix that cannot be inverted.
        """
    def casters(self, light: _Floats) -> ConvexHull:
        """The ConvexHull of all points that can cast a shadow into this view, from a light at a point.

        light: float32 (3,). TypeError or ValueError for other arguments, and if the hull would need more than 32
            corners.
        """
    def casters_towards(self, towards_sun: _Floats) -> ConvexHull:
        """The ConvexHull of all points that can cast a shadow into this view, from a sun in a direction.

        towards_sun: float32 (3,), not 0. TypeError or ValueError for other arguments.
        """
    @property
    def box(self) -> npt.NDArray[np.float32]:
        """float32 (6,): the box around the hull, infinite on the sides to which directions lead."""
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
    """Boxes, spheres or triangles in a view, a stream or a tree, and the queries of shafts against them. Answers do
    not depend on the container. len() is the number of bounds.
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
        """Which bounds the shafts keep (bounds that are not outside): bool (n, bounds), or (bounds,) for one shaft.
        With packed=True, uint64 (n, (bounds + 63) // 64): bit i % 64 of word i // 64 is for bound i.

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as for Shafts.between().
        exclude: integers (k,), or one integer: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of bounds to leave out per shaft, such as the two objects at its
            ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds that are in none of these layers.
        only: integers (k,): tests only these bounds, such as candidates of a larger shaft, in the given order.
        triangle_test: 'exact'; for triangles also 'vertices', which is faster and keeps more triangles.

        TypeError, ValueError or IndexError names the argument that does not fit. NeedsRefit for a tree that needs
        refit(). RuntimeError for bounds that another thread is changing. A query of one shaft runs on the calling
        thread, a query of n shafts on all processors. Other threads of Python continue, and may make queries, too.
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

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as for Shafts.between().
        exclude: integers (k,), or one integer: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of bounds to leave out per shaft, such as the two objects at its
            ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds that are in none of these layers.
        only: integers (k,): tests only these bounds, such as candidates of a larger shaft, in the given order.
        triangle_test: 'exact'; for triangles also 'vertices', which is faster and keeps more triangles.

        TypeError, ValueError or IndexError names the argument that does not fit. NeedsRefit for a tree that needs
        refit(). RuntimeError for bounds that another thread is changing. A query of one shaft runs on the calling
        thread, a query of n shafts on all processors. Other threads of Python continue, and may make queries, too.
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
        """Which bounds the shafts keep, and which of these are inside: a tuple of two arrays like that of cull().

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as for Shafts.between().
        exclude: integers (k,), or one integer: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of bounds to leave out per shaft, such as the two objects at its
            ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds that are in none of these layers.
        only: integers (k,): tests only these bounds, such as candidates of a larger shaft, in the given order.
        triangle_test: 'exact'; for triangles also 'vertices', which is faster and keeps more triangles.

        TypeError, ValueError or IndexError names the argument that does not fit. NeedsRefit for a tree that needs
        refit(). RuntimeError for bounds that another thread is changing. A query of one shaft runs on the calling
        thread, a query of n shafts on all processors. Other threads of Python continue, and may make queries, too.
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

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as for Shafts.between().
        exclude: integers (k,), or one integer: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of bounds to leave out per shaft, such as the two objects at its
            ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds that are in none of these layers.
        limit: an integer, 0 or more: stops after this many results per shaft.
        only: integers (k,): tests only these bounds, such as candidates of a larger shaft, in the given order.
        triangle_test: 'exact'; for triangles also 'vertices', which is faster and keeps more triangles.

        TypeError, ValueError or IndexError names the argument that does not fit. NeedsRefit for a tree that needs
        refit(). RuntimeError for bounds that another thread is changing. A query of one shaft runs on the calling
        thread, a query of n shafts on all processors. Other threads of Python continue, and may make queries, too.
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

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as for Shafts.between().
        exclude: integers (k,), or one integer: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of bounds to leave out per shaft, such as the two objects at its
            ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds that are in none of these layers.
        only: integers (k,): tests only these bounds, such as candidates of a larger shaft, in the given order.
        triangle_test: 'exact'; for triangles also 'vertices', which is faster and keeps more triangles.

        TypeError, ValueError or IndexError names the argument that does not fit. NeedsRefit for a tree that needs
        refit(). RuntimeError for bounds that another thread is changing. A query of one shaft runs on the calling
        thread, a query of n shafts on all processors. Other threads of Python continue, and may make queries, too.
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
        ascend; lists of a tree are in tree order. With times=True, IndexLists.times (for one shaft, a second array)
        has the times at which the moving box reaches each box or sphere: float32, as in first_contact().

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as for Shafts.between().
        exclude: integers (k,), or one integer: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of bounds to leave out per shaft, such as the two objects at its
            ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds that are in none of these layers.
        limit: an integer, 0 or more: stops after this many results per shaft.
        only: integers (k,): tests only these bounds, such as candidates of a larger shaft, in the given order.
        triangle_test: 'exact'; for triangles also 'vertices', which is faster and keeps more triangles.

        TypeError, ValueError or IndexError names the argument that does not fit. NeedsRefit for a tree that needs
        refit(). RuntimeError for bounds that another thread is changing. A query of one shaft runs on the calling
        thread, a query of n shafts on all processors. Other threads of Python continue, and may make queries, too.
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
        """The indices of the bounds that overlap the shafts, and of those that are inside: two results like that of
        list().

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as for Shafts.between().
        exclude: integers (k,), or one integer: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of bounds to leave out per shaft, such as the two objects at its
            ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds that are in none of these layers.
        only: integers (k,): tests only these bounds, such as candidates of a larger shaft, in the given order.
        triangle_test: 'exact'; for triangles also 'vertices', which is faster and keeps more triangles.

        TypeError, ValueError or IndexError names the argument that does not fit. NeedsRefit for a tree that needs
        refit(). RuntimeError for bounds that another thread is changing. A query of one shaft runs on the calling
        thread, a query of n shafts on all processors. Other threads of Python continue, and may make queries, too.
        """
    def set_layers(self, layers: _Integers, indices: _Integers | None = None) -> None:
        """Puts bounds into layers, by which queries select bounds (layer_mask): bit l is set if the bound is in layer
        l. A TriangleTree has no layers.

        layers: integers (bounds,) from 0 to 2**32 - 1, which are copied; with indices, integers (k,), the layers of
            these bounds.

        ValueError for another number of layers, IndexError for an index out of range, RuntimeError if another thread
        uses this object.
        """
    def clear_layers(self) -> None:
        """Removes all layers. RuntimeError if another thread uses this object."""
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
        """The bound that the moving box of each shaft reaches first, and the time: a tuple of indices, int64 (n,), and
        times, float32 (n,); for one shaft, an int and a float. They are -1 and infinity if the box reaches no bound.
        Time is 0 at a and 1 at b: at time 1, a swept body has moved by its whole displacement. Times are rounded
        down; the first bound is determined exactly. With normals=True, a third array has the normals of contact:
        float32 (n, 3), or (3,) for one shaft. They have unit length, and point from the bound towards the moving
        box. For a box, the normal is one of +-x, +-y and +-z. It is zero if the two overlap at the start, or touch
        at the start without the box moving into the bound. ValueError for hulls.

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as for Shafts.between().
        exclude: integers (k,), or one integer: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of bounds to leave out per shaft, such as the two objects at its
            ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds that are in none of these layers.
        only: integers (k,): tests only these bounds, such as candidates of a larger shaft, in the given order.
        skip_overlapping: True leaves out bounds that the box overlaps at the start. With closed contact, these are
            all bounds that touch it; with open contact, those that reach into it, so a wall beside the box still
            stops it.

        TypeError, ValueError or IndexError names the argument that does not fit. NeedsRefit for a tree that needs
        refit(). RuntimeError for bounds that another thread is changing. A query of one shaft runs on the calling
        thread, a query of n shafts on all processors. Other threads of Python continue, and may make queries, too.
        """
    def entry_times(self, shafts: Shafts, indices: _Integers) -> npt.NDArray[np.float32]:
        """The times at which the moving box of one shaft reaches bounds: float32 (k,), as in first_contact(). Infinity
        for bounds that the shaft does not keep.

        shafts: Shafts of shape (). indices: integers (k,). ValueError for more shafts and for hulls, IndexError for
            an index out of range, NeedsRefit for a tree that needs refit(). Runs on the calling thread. Other
            threads of Python continue.
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
        """Whether one of the boxes, which are solid, hides one end of a shaft from the other: every segment between the
        relative interiors of a and b passes through the box, and does not only touch it. bool (n,), or a bool for
        one shaft. ValueError for shafts that are not between boxes or polygons.

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as for Shafts.between().
        exclude: integers (k,), or one integer: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of bounds to leave out per shaft, such as the two objects at its
            ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds that are in none of these layers.

        TypeError, ValueError or IndexError names the argument that does not fit. NeedsRefit for a tree that needs
        refit(). RuntimeError for bounds that another thread is changing. A query of one shaft runs on the calling
        thread, a query of n shafts on all processors. Other threads of Python continue, and may make queries, too.
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
        """The index of a box that hides one end of a shaft from the other, as in occluded(): int64 (n,), or an int for
        one shaft; -1 if no box does.

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as for Shafts.between().
        exclude: integers (k,), or one integer: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of bounds to leave out per shaft, such as the two objects at its
            ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds that are in none of these layers.

        TypeError, ValueError or IndexError names the argument that does not fit. NeedsRefit for a tree that needs
        refit(). RuntimeError for bounds that another thread is changing. A query of one shaft runs on the calling
        thread, a query of n shafts on all processors. Other threads of Python continue, and may make queries, too.
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
        """The indices of all boxes that hide one end of a shaft from the other, as in occluded(): a result like that of
        list().

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as for Shafts.between().
        exclude: integers (k,), or one integer: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of bounds to leave out per shaft, such as the two objects at its
            ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds that are in none of these layers.
        limit: an integer, 0 or more: stops after this many results per shaft.

        TypeError, ValueError or IndexError names the argument that does not fit. NeedsRefit for a tree that needs
        refit(). RuntimeError for bounds that another thread is changing. A query of one shaft runs on the calling
        thread, a query of n shafts on all processors. Other threads of Python continue, and may make queries, too.
        """

class BoxView(Boxes):
    """Boxes in arrays of the caller, which are kept and never copied.

    boxes: float32, each coordinate in contiguous memory of its own:
        a transpose of (6, n), numpy.asfortranarray(boxes), or a tuple of six (n,).

    Values are not checked, and may change between queries. Shafts keep a bound with NaN. ValueError for other layouts.
    """
    def __init__(self, boxes: _Floats) -> None: ...

class BoxStream(Boxes):
    """A checked copy of boxes, in separate aligned streams: 24 bytes per bound.

    boxes: float32
        (n, 6) of lo and hi, (n, 2, 3), a tuple (lo, hi) of (n, 3), a tuple of six (n,), or (6,) or (2, 3) for one.
    rounding: 'outwards' also accepts float64, and rounds lo down and hi up: boxes that are outside are then
        outside as given, too. Round solids (occluded()) to nearest instead: a larger solid hides too much.

    BadBound, with the first bad index, for NaN and lo > hi; lo = infinity and hi = -infinity is the empty box.
    TypeError or ValueError for other arrays.
    """
    def __init__(self, boxes: _Floats, rounding: _Rounding | None = None) -> None: ...
    def update(self, boxes: _Floats, first: int = 0, rounding: _Rounding | None = None) -> None:
        """Replaces the bounds from `first` on with the given bounds, in the form that the class takes.

        TypeError, ValueError or BadBound names the argument or bound that is wrong; then nothing is changed.
        RuntimeError if another thread uses this object. Other threads of Python continue during the call.
        """
    @property
    def memory_bytes(self) -> int:
        """The memory that it holds, in bytes: int."""

class BoxTree(Boxes):
    """A tree over a copy of boxes, sorted by space, for many queries: 28 bytes per bound, at most
    2**32 - 1 bounds. Answers equal those of a BoxStream.

    boxes: float32
        (n, 6) of lo and hi, (n, 2, 3), a tuple (lo, hi) of (n, 3), a tuple of six (n,), or (6,) or (2, 3) for one.
    rounding: 'outwards' also accepts float64, and rounds lo down and hi up: boxes that are outside are then
        outside as given, too. Round solids (occluded()) to nearest instead: a larger solid hides too much.

    BadBound, with the first bad index, for NaN and lo > hi; lo = infinity and hi = -infinity is the empty box.
    TypeError or ValueError for other arrays.

    Any number of threads may query one tree at once. No other call may run during a change, such as update().
    """
    def __init__(self, boxes: _Floats, rounding: _Rounding | None = None) -> None: ...
    def update(
        self, boxes: _Floats, indices: _Integers | None = None, rounding: _Rounding | None = None
    ) -> None:
        """Gives bounds new values, in the form that the class takes: all bounds, in the order of their indices; or the
        bounds at `indices`, integers (k,), and then refit() is due before the next query. IndexError for an index
        out of range.

        TypeError, ValueError or BadBound names the argument or bound that is wrong; then nothing is changed.
        RuntimeError if another thread uses this object. Other threads of Python continue during the call.
        """
    def refit(self) -> None:
        """Fits the nodes to bounds that were updated by indices. RuntimeError if another thread uses the tree."""
    @property
    def needs_refit(self) -> bool:
        """bool: whether bounds were updated by indices since the last refit()."""
    def rebuild(self) -> None:
        """Sorts the bounds again, as they are now. Indices stay, `order` changes. This pays off when sah_ratio() is 2
        or 3. RuntimeError if another thread uses the tree.
        """
    def reorder(self) -> None:
        """Renumbers the bounds by their positions in the order of the tree. RuntimeError if another thread uses the
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
        """The memory that it holds, in bytes: int."""

class BoxTreeSnapshot(Boxes):
    """The boxes of a DynamicBoxTree after one commit(), as returned by snapshot() of the tree.
    The snapshot never changes. len() is above all indices.
    """
    @property
    def bound_count(self) -> int:
        """The number of bounds: int."""
    @property
    def box(self) -> npt.NDArray[np.float32]:
        """float32 (6,): the box around all bounds."""

class DynamicBoxTree(Boxes):
    """A tree of boxes that are inserted, erased and moved. Changes name bounds by ids, and queries see changes after
    commit(). An id never denotes another bound, even if its index is used again. Answers equal those of a
    BoxStream.

        tree = shaftcull.DynamicBoxTree()
        ids = tree.insert(boxes)
        tree.commit()
        kept = tree.list(a, b)                   # indices: ids & 0xffffffff

    One thread at a time may change the tree. Other threads query the result of snapshot(), also during a commit().
    len() is above all indices: cull() and exclude_mask have that many bounds, and cull() gives False for an index
    without a bound.

    ValueError for an id without a bound.
    BadBound for NaN and lo > hi; lo = infinity and hi = -infinity is the empty box.
    """
    def __init__(self) -> None: ...
    def insert(
        self, boxes: _Floats, layers: _Integers | None = None, rounding: _Rounding | None = None
    ) -> int | npt.NDArray[np.int64]:
        """Inserts boxes, in the form that a BoxTree takes, and returns their ids: int64 (n,),
        or an int for one. ids & 0xffffffff are the indices that queries return.

        layers: integers from 0 to 2**32 - 1, one or (n,): the layers of each bound; all layers if not given.

        TypeError, ValueError or BadBound names the argument that does not fit; then nothing is inserted.
        """
    def erase(self, ids: _Integers) -> None:
        """Erases bounds. ids: integers (k,), or one integer. ValueError for an id that occurs twice."""
    def move(self, ids: _Integers, boxes: _Floats, rounding: _Rounding | None = None) -> None:
        """Gives bounds new values, one per id. ValueError for an id without a bound, BadBound for bad values."""
    def move_by(self, ids: _Integers, displacements: _Floats) -> None:
        """Moves bounds by vectors: float32 (k, 3), or (3,) for one id. ValueError for an id that occurs twice."""
    def commit(self) -> None:
        """Makes all changes visible to queries. RuntimeError if another thread uses the tree."""
    def rebuild(self) -> None:
        """Makes all changes visible, and sorts all bounds again: for a world that was built step by step and then stays
        the same.
        """
    def snapshot(self) -> BoxTreeSnapshot:
        """The state of the last commit(), as a BoxTreeSnapshot."""
    def values(self, ids: _Integers) -> npt.NDArray[np.float32]:
        """The values of bounds, with all changes: float32, one row per id, or a row for a single id. ValueError for an
        id without a bound.
        """
    def __contains__(self, id: int) -> bool:
        """Whether an id has a bound, with all changes."""
    def ids_of(self, indices: _Integers) -> npt.NDArray[np.int64]:
        """The ids of the bounds that have these indices now: int64 (k,). -1 for an index without a bound. IndexError
        for a value that is not an index.
        """
    @property
    def bound_count(self) -> int:
        """The number of bounds, with all changes: int."""
    @property
    def memory_bytes(self) -> int:
        """The memory that it holds, in bytes: int."""
    def set_sorted_per_change(self, sorted_per_change: float) -> None:
        """Sets how many bounds a commit may re-sort per change; 2 at first. A larger number keeps queries faster, and
        makes commits slower. ValueError for a negative or infinite number.
        """
    @property
    def upkeep(self) -> dict[str, float]:
        """A dict of numbers after the last commit(): blocks; sah_ratio, the growth of nodes since they were sorted, 1
        at best; waiting, bounds to be sorted again; sorted_last, bounds that the commit sorted.
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
        """The bound that the moving box of each shaft reaches first, and the time: a tuple of indices, int64 (n,), and
        times, float32 (n,); for one shaft, an int and a float. They are -1 and infinity if the box reaches no bound.
        Time is 0 at a and 1 at b: at time 1, a swept body has moved by its whole displacement. Times are rounded
        down; the first bound is determined exactly. With normals=True, a third array has the normals of contact:
        float32 (n, 3), or (3,) for one shaft. They have unit length, and point from the bound towards the moving
        box. For a box, the normal is one of +-x, +-y and +-z. It is zero if the two overlap at the start, or touch
        at the start without the box moving into the bound. ValueError for hulls.

        shafts, b: Shafts of shape (n,) or (); a ConvexHull; or boxes a and b, as for Shafts.between().
        exclude: integers (k,), or one integer: bounds to leave out for all shafts, such as the moving body itself.
        exclude_each: integers (n, k) or (n,): a row of bounds to leave out per shaft, such as the two objects at its
            ends.
        exclude_mask: bool (bounds,): True leaves a bound out for all shafts.
        layer_mask: integers from 0 to 2**32 - 1, one or (n,): leaves out bounds that are in none of these layers.
        only: integers (k,): tests only these bounds, such as candidates of a larger shaft, in the given order.
        skip_overlapping: True leaves out bounds that the box overlaps at the start. With closed contact, these are
            all bounds that touch it; with open contact, those that reach into it, so a wall beside the box still
            stops it.

        TypeError, ValueError or IndexError names the argument that does not fit. NeedsRefit for a tree that needs
        refit(). RuntimeError for bounds that another thread is changing. A query of one shaft runs on the calling
        thread, a query of n shafts on all processors. Other threads of Python continue, and may make queries, too.
        """
    def entry_times(self, shafts: Shafts, indices: _Integers) -> npt.NDArray[np.float32]:
        """The times at which the moving box of one shaft reaches bounds: float32 (k,), as in first_contact(). Infinity
        for bounds that the shaft does not keep.

        shafts: Shafts of shape (). indices: integers (k,). ValueError for more shafts and for hulls, IndexError for
            an index out of range, NeedsRefit for a tree that needs refit(). Runs on the calling thread. Other
            threads of Python continue.
        """

class SphereView(Spheres):
    """Spheres in arrays of the caller, which are kept and never copied.

    spheres: float32, each coordinate in contiguous memory of its own:
        a transpose of (4, n), numpy.asfortranarray(spheres), or a tuple of four (n,).

    Values are not checked, and may change between queries. Shafts keep a bound with NaN. ValueError for other layouts.
    """
    def __init__(self, spheres: _Floats) -> None: ...

class SphereStream(Spheres):
    """A checked copy of spheres, in separate aligned streams: 16 bytes per bound.

    spheres: float32
        (n, 4) of centre and radius, a tuple (centres, radii) of (n, 3) and (n,), a tuple of four (n,), or (4,) for one.
    rounding: 'outwards' also accepts float64. Centres are rounded to nearest, and radii grow: each sphere
        contains the given sphere.

    BadBound, with the first bad index, for NaN, centres that are not finite, and radii below 0.
    TypeError or ValueError for other arrays.
    """
    def __init__(self, spheres: _Floats, rounding: _Rounding | None = None) -> None: ...
    def update(self, spheres: _Floats, first: int = 0, rounding: _Rounding | None = None) -> None:
        """Replaces the bounds from `first` on with the given bounds, in the form that the class takes.

        TypeError, ValueError or BadBound names the argument or bound that is wrong; then nothing is changed.
        RuntimeError if another thread uses this object. Other threads of Python continue during the call.
        """
    @property
    def memory_bytes(self) -> int:
        """The memory that it holds, in bytes: int."""

class SphereTree(Spheres):
    """A tree over a copy of spheres, sorted by space, for many queries: 20 bytes per bound, at most
    2**32 - 1 bounds. Answers equal those of a SphereStream.

    spheres: float32
        (n, 4) of centre and radius, a tuple (centres, radii) of (n, 3) and (n,), a tuple of four (n,), or (4,) for one.
    rounding: 'outwards' also accepts float64. Centres are rounded to nearest, and radii grow: each sphere
        contains the given sphere.

    BadBound, with the first bad index, for NaN, centres that are not finite, and radii below 0.
    TypeError or ValueError for other arrays.

    Any number of threads may query one tree at once. No other call may run during a change, such as update().
    """
    def __init__(self, spheres: _Floats, rounding: _Rounding | None = None) -> None: ...
    def update(
        self, spheres: _Floats, indices: _Integers | None = None, rounding: _Rounding | None = None
    ) -> None:
        """Gives bounds new values, in the form that the class takes: all bounds, in the order of their indices; or the
        bounds at `indices`, integers (k,), and then refit() is due before the next query. IndexError for an index
        out of range.

        TypeError, ValueError or BadBound names the argument or bound that is wrong; then nothing is changed.
        RuntimeError if another thread uses this object. Other threads of Python continue during the call.
        """
    def refit(self) -> None:
        """Fits the nodes to bounds that were updated by indices. RuntimeError if another thread uses the tree."""
    @property
    def needs_refit(self) -> bool:
        """bool: whether bounds were updated by indices since the last refit()."""
    def rebuild(self) -> None:
        """Sorts the bounds again, as they are now. Indices stay, `order` changes. This pays off when sah_ratio() is 2
        or 3. RuntimeError if another thread uses the tree.
        """
    def reorder(self) -> None:
        """Renumbers the bounds by their positions in the order of the tree. RuntimeError if another thread uses the
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
        """The memory that it holds, in bytes: int."""

class SphereTreeSnapshot(Spheres):
    """The spheres of a DynamicSphereTree after one commit(), as returned by snapshot() of the tree.
    The snapshot never changes. len() is above all indices.
    """
    @property
    def bound_count(self) -> int:
        """The number of bounds: int."""
    @property
    def box(self) -> npt.NDArray[np.float32]:
        """float32 (6,): the box around all bounds."""

class DynamicSphereTree(Spheres):
    """A tree of spheres that are inserted, erased and moved. Changes name bounds by ids, and queries see changes after
    commit(). An id never denotes another bound, even if its index is used again. Answers equal those of a
    SphereStream.

        tree = shaftcull.DynamicSphereTree()
        ids = tree.insert(spheres)
        tree.commit()
        kept = tree.list(a, b)                   # indices: ids & 0xffffffff

    One thread at a time may change the tree. Other threads query the result of snapshot(), also during a commit().
    len() is above all indices: cull() and exclude_mask have that many bounds, and cull() gives False for an index
    without a bound.

    ValueError for an id without a bound.
    BadBound for NaN, centres that are not finite, and radii below 0.
    """
    def __init__(self) -> None: ...
    def insert(
        self, spheres: _Floats, layers: _Integers | None = None, rounding: _Rounding | None = None
    ) -> int | npt.NDArray[np.int64]:
        """Inserts spheres, in the form that a SphereTree takes, and returns their ids: int64 (n,),
        or an int for one. ids & 0xffffffff are the indices that queries return.

        layers: integers from 0 to 2**32 - 1, one or (n,): the layers of each bound; all layers if not given.

        TypeError, ValueError or BadBound names the argument that does not fit; then nothing is inserted.
        """
    def erase(self, ids: _Integers) -> None:
        """Erases bounds. ids: integers (k,), or one integer. ValueError for an id that occurs twice."""
    def move(self, ids: _Integers, spheres: _Floats, rounding: _Rounding | None = None) -> None:
        """Gives bounds new values, one per id. ValueError for an id without a bound, BadBound for bad values."""
    def move_by(self, ids: _Integers, displacements: _Floats) -> None:
        """Moves bounds by vectors: float32 (k, 3), or (3,) for one id. ValueError for an id that occurs twice."""
    def commit(self) -> None:
        """Makes all changes visible to queries. RuntimeError if another thread uses the tree."""
    def rebuild(self) -> None:
        """Makes all changes visible, and sorts all bounds again: for a world that was built step by step and then stays
        the same.
        """
    def snapshot(self) -> SphereTreeSnapshot:
        """The state of the last commit(), as a SphereTreeSnapshot."""
    def values(self, ids: _Integers) -> npt.NDArray[np.float32]:
        """The values of bounds, with all changes: float32, one row per id, or a row for a single id. ValueError for an
        id without a bound.
        """
    def __contains__(self, id: int) -> bool:
        """Whether an id has a bound, with all changes."""
    def ids_of(self, indices: _Integers) -> npt.NDArray[np.int64]:
        """The ids of the bounds that have these indices now: int64 (k,). -1 for an index without a bound. IndexError
        for a value that is not an index.
        """
    @property
    def bound_count(self) -> int:
        """The number of bounds, with all changes: int."""
    @property
    def memory_bytes(self) -> int:
        """The memory that it holds, in bytes: int."""
    def set_sorted_per_change(self, sorted_per_change: float) -> None:
        """Sets how many bounds a commit may re-sort per change; 2 at first. A larger number keeps queries faster, and
        makes commits slower. ValueError for a negative or infinite number.
        """
    @property
    def upkeep(self) -> dict[str, float]:
        """A dict of numbers after the last commit(): blocks; sah_ratio, the growth of nodes since they were sorted, 1
        at best; waiting, bounds to be sorted again; sorted_last, bounds that the commit sorted.
        """

class Triangles(Bounds):
    """Triangles: a TriangleView, a TriangleStream or a TriangleTree."""

class TriangleView(Triangles):
    """Triangles in arrays of the caller, which are kept and never copied.

    triangles: float32, each coordinate in contiguous memory of its own:
        a transpose of (9, n), numpy.asfortranarray(triangles), or a tuple of nine (n,).

    Values are not checked, and may change between queries. Shafts keep a bound with NaN. ValueError for other layouts.
    """
    def __init__(self, triangles: _Floats) -> None: ...

class TriangleStream(Triangles):
    """A checked copy of triangles, in separate aligned streams: 36 bytes per bound.

    triangles: float32
        (n, 3, 3), (n, 9), a tuple of nine (n,), or vertices (v, 3) with faces (f, 3).
    faces: integers (f, 3), counted from 0: the vertices of each triangle. IndexError for an index out of range.

    Triangles are never rounded outwards, since no float32 triangle need contain a given float64 triangle:
    triangles.astype(numpy.float32) rounds to nearest.

    BadBound, with the first bad index, for coordinates that are not finite.
    TypeError or ValueError for other arrays.
    """
    def __init__(self, triangles: _Floats, faces: _Integers | None = None) -> None: ...
    def update(self, triangles: _Floats, first: int = 0, faces: _Integers | None = None) -> None:
        """Replaces the bounds from `first` on with the given bounds, in the form that the class takes.

        TypeError, ValueError or BadBound names the argument or bound that is wrong; then nothing is changed.
        RuntimeError if another thread uses this object. Other threads of Python continue during the call.
        """
    @property
    def memory_bytes(self) -> int:
        """The memory that it holds, in bytes: int."""

class TriangleTree(Triangles):
    """A tree over a copy of triangles, sorted by space, for many queries: 40 bytes per bound, at most
    2**32 - 1 bounds. Answers equal those of a TriangleStream.

    triangles: float32
        (n, 3, 3), (n, 9), a tuple of nine (n,), or vertices (v, 3) with faces (f, 3).
    faces: integers (f, 3), counted from 0: the vertices of each triangle. IndexError for an index out of range.

    Triangles are never rounded outwards, since no float32 triangle need contain a given float64 triangle:
    triangles.astype(numpy.float32) rounds to nearest.

    BadBound, with the first bad index, for coordinates that are not finite.
    TypeError or ValueError for other arrays.

    Any number of threads may query one tree at once. No other call may run during a change, such as update().
    """
    def __init__(self, triangles: _Floats, faces: _Integers | None = None) -> None: ...
    def update(
        self, triangles: _Floats, indices: _Integers | None = None, faces: _Integers | None = None
    ) -> None:
        """Gives bounds new values, in the form that the class takes: all bounds, in the order of their indices; or the
        bounds at `indices`, integers (k,), and then refit() is due before the next query. IndexError for an index
        out of range.

        TypeError, ValueError or BadBound names the argument or bound that is wrong; then nothing is changed.
        RuntimeError if another thread uses this object. Other threads of Python continue during the call.
        """
    def refit(self) -> None:
        """Fits the nodes to bounds that were updated by indices. RuntimeError if another thread uses the tree."""
    @property
    def needs_refit(self) -> bool:
        """bool: whether bounds were updated by indices since the last refit()."""
    def rebuild(self) -> None:
        """Sorts the bounds again, as they are now. Indices stay, `order` changes. This pays off when sah_ratio() is 2
        or 3. RuntimeError if another thread uses the tree.
        """
    def reorder(self) -> None:
        """Renumbers the bounds by their positions in the order of the tree. RuntimeError if another thread uses the
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
        """The memory that it holds, in bytes: int."""

class Patches:
    """Patches in a tree, for several calls of visibility(). They never change. len() is the number of patches.

    boxes: float32 (n, 6), or as for BoxStream: boxes around facets, points, or cells of a volume. Or corners of
        convex polygons, float32 (n, k, 3) or a list of arrays (k, 3), 3 to 8 corners each: a polygon faces the
        side from which its corners run counter-clockwise, and takes no plane from `planes`.
    sides: 'both' is for polygons that are seen from both sides; two polygons in one plane face away. Boxes
        without planes are seen from all sides.
    planes: float32 (n, 4), or (4,) for all: normal and offset. A patch faces where its normal points. Planes are
        never rounded outwards: round planes of float64 with astype(numpy.float32).
    rounding: 'outwards' also accepts boxes of float64, and contains them: pairs that are clear or occluded are
        so as given, too.

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
    """The occluders between patches, for several calls of visibility(). They never change. len() is the number of
    occluders. They are numbered from 0: first the boxes of `boxes`, then solids, hulls, polygons, and groups of
    triangles.

    boxes: boxes around things that may hide something: float32 (n, 6), or as for BoxStream.
    solids: solid boxes, such as walls. They make pairs 'occluded', also if several form one larger box together.
    hulls: solid convex hulls: float32 (n, k, 3), or a list of (k, 3), with 4 or more corners each.
    polygons: flat convex polygons without thickness: arrays as for hulls, with 3 or more corners in order.
    triangles, faces: a mesh, float32 (n, 3, 3), or vertices (v, 3) with faces, integers (f, 3).
    groups: integers (g + 1,): group i has triangles groups[i] to groups[i + 1]. With None, the library makes
        groups.
    find_solids: True finds bodies, walls and floors in the triangles, which make pairs 'occluded'; `found` has
        their numbers. They are not occluders, except for bodies that are upright boxes. Without groups, these
        follow the groups of triangles, and their own triangles are in no group. Closed surfaces must face
        outwards to be bodies. Pass Patches instead of True if only these are compared: then bodies may be open
        on or beyond one face of the box around them, as buildings without a bottom are on level ground.
    rounding: 'outwards' also accepts `boxes` of float64, and contains them: a pair that is clear is so as given,
        too. The other arguments are never rounded outwards, since a larger solid hides too much: use
        astype(numpy.float32).

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
        find_solids: bool | Patches = False,
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
        {'boxes': 0, 'triangles': 12}.
        """
    def box(self, occluder: int) -> npt.NDArray[np.float32]:
        """The box around one occluder: float32 (6,). IndexError for a number out of range."""
    def triangles(self, occluder: int) -> npt.NDArray[np.uint32]:
        """The triangles of one occluder: uint32 (k,), empty unless it is a group of triangles. IndexError for a number
        out of range.
        """

class Visibility:
    """The answers of visibility() for all pairs. pairs() and bits() return the pairs with one answer; `blocks` and
    `undecided` hold the same pairs in less memory. Arrays are read-only, and keep the Visibility alive.
    """
    @property
    def counts(self) -> dict[str, int]:
        """The number of pairs that are 'undecided', 'clear', 'occluded' and 'facing_away': a dict of int."""
    @property
    def blocks(self) -> npt.NDArray[np.uint32]:
        """Decided pairs, in blocks: uint32 (p, 4). A row is first_a, count_a, first_b, count_b: every pair of a patch
        of order_a[first_a:first_a + count_a] and a patch of order_b[first_b:first_b + count_b] has the answer in
        `sights`.
        """
    @property
    def sights(self) -> npt.NDArray[np.uint8]:
        """The answer for all pairs of each pair block: uint8 (p,): 1 clear, 2 occluded, 3 facing_away."""
    @property
    def undecided(self) -> npt.NDArray[np.uint32]:
        """Undecided pairs: uint32 (n, 2), indices of patches."""
    @property
    def candidates(self) -> IndexLists | None:
        """The candidates of each undecided pair, which are the occluders that reach between its patches: IndexLists of
        n ascending lists; None if candidates were not requested.
        """
    @property
    def order_a(self) -> npt.NDArray[np.uint32]:
        """The order to which pair blocks refer: uint32 (a,), indices of patches. A copy."""
    @property
    def order_b(self) -> npt.NDArray[np.uint32]:
        """The same for patches_b: uint32 (b,); for one set with itself it is order_a."""
    @property
    def occluders(self) -> Occluders:
        """The occluders that stood between patches: Occluders."""
    def pairs(self, sight: _Sight) -> npt.NDArray[np.uint32]:
        """All pairs with one answer: uint32 (n, 2), indices of patches; for one set with itself, each pair once.

        sight: 'undecided', 'clear', 'occluded' or 'facing_away'; ValueError for other values. Other threads of
            Python continue.
        """
    def fractions(self, *, rays: int = 64, error: float = 0.0, seed: int = 1) -> npt.NDArray[np.float32]:
        """The visible fraction of each undecided pair, by rays between points of both patches: float32 (n,), from
        0 to 1. A box counts as solid.

        rays: the number of rays per pair, 1 to 65536. error: a pair gets fewer rays if its standard error is at most
        this. seed: determines the points. ValueError for other values, without candidates, and for patches that are
        boxes with an interior. Other threads of Python continue.
        """
    def bits(self, sight: _Sight, *, packed: bool = False) -> _Bits:
        """Which pairs have one answer: bool (a, b). With packed=True, uint64 (a, (b + 63) // 64), 64 pairs per word.
        For one set with itself, both bits of a pair are set.

        sight: 'undecided', 'clear', 'occluded' or 'facing_away'; ValueError for other values. Other threads of
            Python continue.
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
    part: int = 0,
    parts: int = 1,
    progress: Callable[[int, int], object] | None = None,
    candidates: bool = True,
) -> Visibility:
    """Which patches see each other. Each pair of patches gets one answer: nothing stands between them ('clear'),
    one solid hides each from the other ('occluded'), one lies behind the plane of the other ('facing_away'), or
    none of these ('undecided'). All answers are exact for the float32 given. Returns a Visibility, which takes
    20 bytes per pair block, 16 per undecided pair, and 4 per candidate.

    patches, patches_b: boxes, float32 (n, 6); corners, float32 (n, k, 3); or Patches. Without patches_b, every
        two patches are one pair.
    planes, planes_b: for patches that face one side: float32 (n, 4), or (4,) for all; normal and offset.
    occluders: boxes around things that may hide something; or Occluders, and then none of the arguments from
        solids to groups.
    solids, hulls, polygons, triangles with faces, groups: other objects between patches, as for Occluders.
    rounding: 'outwards' also accepts boxes of float64 for patches and `occluders`, as for Patches and Occluders.
    contact: 'open' leaves out occluders that only touch a shaft, so a patch may lie on an occluder; 'closed'
        does not.
    tolerance: how far in front of a plane a point may be and still count as behind it, for rounded corners.
    solids_around_ends: whether a solid that a patch reaches into may make pairs of the patch 'occluded'.
    memory: limit in bytes for answers in progress, 1 MB or more.
    part, parts: divides all pairs into `parts` parts and answers part `part`, 0 to parts - 1, so that several
        processes can share the work. Each pair is in exactly one part.
    progress: called as progress(done, total) several times per second, on this thread; if it raises, the call
        ends.
    candidates: whether undecided pairs come with candidates, the occluders that reach between the patches.

    TypeError, ValueError, IndexError or BadBound names the argument that does not fit. Runs on all processors.
    Other threads of Python continue, and Ctrl-C ends the call. RuntimeError in a child of fork() whose parent
    has made parallel calls.
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
    part: int = 0,
    parts: int = 1,
    progress: Callable[[int, int], object] | None = None,
) -> dict[str, int]:
    """The number of pairs that are 'undecided', 'clear', 'occluded' and 'facing_away': a dict of int, like the
    counts of visibility(). It stores nothing per pair.

    patches, patches_b: boxes, float32 (n, 6); corners, float32 (n, k, 3); or Patches. Without patches_b, every
        two patches are one pair.
    planes, planes_b: for patches that face one side: float32 (n, 4), or (4,) for all; normal and offset.
    occluders: boxes around things that may hide something; or Occluders, and then none of the arguments from
        solids to groups.
    solids, hulls, polygons, triangles with faces, groups: other objects between patches, as for Occluders.
    rounding: 'outwards' also accepts boxes of float64 for patches and `occluders`, as for Patches and Occluders.
    contact: 'open' leaves out occluders that only touch a shaft, so a patch may lie on an occluder; 'closed'
        does not.
    tolerance: how far in front of a plane a point may be and still count as behind it, for rounded corners.
    solids_around_ends: whether a solid that a patch reaches into may make pairs of the patch 'occluded'.
    memory: limit in bytes for answers in progress, 1 MB or more.
    part, parts: divides all pairs into `parts` parts and answers part `part`, 0 to parts - 1, so that several
        processes can share the work. Each pair is in exactly one part.
    progress: called as progress(done, total) several times per second, on this thread; if it raises, the call
        ends.

    TypeError, ValueError, IndexError or BadBound names the argument that does not fit. Runs on all processors.
    Other threads of Python continue, and Ctrl-C ends the call. RuntimeError in a child of fork() whose parent
    has made parallel calls.
    """
def merged_boxes(boxes: _Floats) -> npt.NDArray[np.float32]:
    """Larger solid boxes that cover exactly the space of the given boxes: pieces of a wall that share a face become
    one box. float32 (m, 6); the boxes may overlap.

    boxes: float32 (n, 6), or as for BoxStream. BadBound, with the index, for a box that is not finite or has
        lo > hi. Other threads of Python continue.
    """
def inscribed_box(corners: _Floats) -> npt.NDArray[np.float32]:
    """A large box inside the convex hull of points: float32 (6,). It lies in the hull exactly.

    corners: float32 (k, 3), 4 to 32 points. ValueError for another number of points, or a point that is not
        finite.
    """
class Origin:
    """A point of a world in float64 to which coordinates are relative. Near the origin, floats are fine. A bound
    that is outside the shaft between two boxes from boxes() is outside in the world, too. Make solids that hide,
    and boxes that are to contain others, with within=True. Values that bounds and shafts refuse are not refused
    here: NaN and lo > hi stay.
    """
    def __init__(self, at: npt.ArrayLike = (0, 0, 0)) -> None: ...
    @staticmethod
    def for_points(points: npt.ArrayLike) -> Origin:
        """An origin near the middle of points (n, 3), such as the corners of a scene. Its coordinates are multiples of
        a power of two. ValueError for no points, and for a point that is not finite.
        """
    @property
    def at(self) -> npt.NDArray[np.float64]:
        """The point of the world where the origin is: float64 (3,)."""
    def boxes(self, boxes: npt.ArrayLike, *, within: bool = False) -> npt.NDArray[np.float32]:
        """The smallest float32 boxes that contain the given boxes; with within=True, the largest float32 boxes within
        them, or the empty box if there is none. float32 of the same shape.

        boxes: (n, 6) of lo and hi, or (6,) for one. TypeError or ValueError for other arrays. Other threads of
            Python continue.
        """
    def spheres(self, spheres: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """Spheres of float32 that contain the given spheres: centres are rounded to nearest, and radii grow. float32 of
        the same shape.

        spheres: (n, 4) of centre and radius, or (4,) for one. TypeError or ValueError for other arrays. Other
            threads of Python continue.
        """
    def planes(self, planes: npt.ArrayLike, box: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """Planes of float32 that keep all points of a box that the given planes keep: normal . p <= offset. Normals are
        rounded to nearest, and offsets grow. float32 of the same shape.

        planes: (n, 4) of normal and offset, or (4,) for one. box: (6,) of lo and hi, in the world. TypeError or
            ValueError for other arrays, and for what is not finite or is beyond the largest float32. Other threads of
            Python continue.
        """
    def points(self, points: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """The nearest float32 to each coordinate, for vertices of triangles, corners of patches and points of hulls.
        float32 of the same shape.

        points: (n, 3), or (3,) for one. TypeError or ValueError for other arrays. Other threads of Python continue.
        """
    def to_world(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The positions of points in the world: float64 of the same shape.

        points: float32 (n, 3), or (3,) for one. TypeError or ValueError for other arrays.
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
        """The patch to which each factor is, ascending in a row: int32 (nnz,)."""
    @property
    def indptr(self) -> npt.NDArray[np.int64]:
        """Where the factors of each row begin; then the end of the last: int64 (n + 1,)."""
    @property
    def shape(self) -> tuple[int, int]:
        """(n, n), for n patches."""
    @property
    def area(self) -> npt.NDArray[np.float64]:
        """The area of each patch: float64 (n,)."""
    @property
    def row_sum(self) -> npt.NDArray[np.float64]:
        """The sum of each row, left-out factors included: float64 (n,). 1 - row_sum is the share that meets no patch:
        the sky.
        """
    @property
    def error(self) -> npt.NDArray[np.float64]:
        """The estimated standard error of each sum: float64 (n,)."""
    @property
    def left_out(self) -> npt.NDArray[np.float64]:
        """The part of each sum that is left out, because factors are below `least`: float64 (n,)."""
    @property
    def counts(self) -> dict[str, int]:
        """The number of pairs that are 'undecided', 'clear', 'occluded' and 'facing_away': a dict of int."""
def view_factors(
    patches: _Floats | Sequence[_Floats] | Patches,
    *,
    planes: _Floats | None = None,
    occluders: _Floats | Occluders | None = None,
    triangles: _Floats | None = None,
    faces: _Integers | None = None,
    rays: int = 4096,
    error: float = 1e-05,
    seed: int = 1,
    least: float = 0.0,
    close_rows: bool = False,
    tolerance: float = 0.0,
    memory: int = 268435456,
    part: int = 0,
    parts: int = 1,
    progress: Callable[[int, int], object] | None = None,
) -> ViewFactors:
    """The view factors of every two patches. Clear pairs have view_factor(), and pairs that are occluded or face
    away have 0. For all other pairs, rays estimate the factors. The result has the same bits for any number of
    processors. Returns a ViewFactors.

    patches: corners, float32 (n, k, 3), counterclockwise as seen from the side to which they radiate; flat
        boxes, float32 (n, 6), with planes; or Patches. planes: float32 (n, 4), or (4,) for all.
    occluders: boxes, which count as solid; or Occluders. triangles with faces: the objects between patches,
        including the bodies that patches belong to, in place of Occluders; the call finds solids in them.
    rays: the largest number of rays per pair, 1 to 65536. error: a pair gets fewer rays if the standard error of
        its factors is at most this. seed: determines the points of rays.
    least: pairs both of whose factors are below this are left out; left_out has their sums.
    close_rows: whether rows are scaled to sum to 1, as those of a closed room do; ValueError if the sums are far from
        1.
    tolerance: as for visibility(). memory: limit in bytes for answers in progress, without the factors, 1 MB or
        more.
    part, parts: as for visibility(). The sum of the matrices of all parts is the matrix of all pairs. row_sum and
        left_out are summed, too, and `error` is the square root of the sum of squares. `close_rows` needs parts=1.
    progress: called as progress(done, total) several times per second, on this thread; if it raises, the call
        ends.

    TypeError, ValueError, IndexError or BadBound names the argument that does not fit; patches without planes,
    and Patches with sides='both', do not fit. Runs on all processors. Other threads of Python continue, and
    Ctrl-C ends the call. RuntimeError in a child of fork() whose parent has made parallel calls.
    """
def view_factor(from_corners: _Floats, to_corners: _Floats) -> float:
    """The view factor from one flat convex polygon to another with nothing between them, from 0 to 1. The part of a
    polygon that is behind the plane of the other does not count. The error is below 1e-8 of the factor, or
    1e-11.

    from_corners, to_corners: float32 (k, 3), 3 to 8 corners, counterclockwise as seen from the front. ValueError
        for another number of corners, for a corner that is not finite, and if the first polygon has no area.
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
    """The fraction of each patch that is lit from each direction, by rays: float32 (n, m), from 0 to 1. 0 if the
    patch faces away. If each direction to the sun stands for some hours, lit @ hours are the hours of sun.

    patches, planes, occluders, triangles, faces: as for view_factors(), but Patches may have sides='both'.
    directions: directions to lights that are infinitely far away, float32 (m, 3), of any length.
    rays: the number of rays from a patch to each light, 1 to 65536. error: a patch gets fewer rays if its
        standard error is at most this.
    seed: determines the points. tolerance: as for visibility().

    TypeError, ValueError, IndexError or BadBound names the argument that does not fit. Runs on all processors.
    Other threads of Python continue. RuntimeError in a child of fork() whose parent has made parallel calls.
    """
def points(points: _Floats, *, rounding: _Rounding | None = None) -> npt.NDArray[np.float32]:
    """Boxes that are points, for viewpoints and point lights: float32 (n, 6) for points (n, 3), or (6,) for (3,).

    points: float32. rounding: 'outwards' also accepts float64; each box then contains its point. TypeError or
        ValueError for other arguments.
    """
def view_planes(matrix: _Floats, depth: _Depth) -> npt.NDArray[np.float32]:
    """The planes of a view frustum, with normals outwards, for cutting shafts to the view: float32 (k, 4), k up to
    6, normal and offset.

    matrix, depth: as for ConvexHull.frustum(). TypeError or ValueError for other arguments.
    """
def available_isas() -> list[str]:
    """Names of the instruction sets that this machine can run, slowest first."""
def active_isa() -> str:
    """The name of the instruction set in use. Answers do not depend on it."""
def select_isa(isa: str) -> None:
    """Makes all threads use an instruction set from now on: one of available_isas(). ValueError for others."""
def concurrency() -> int:
    """The number of threads that a call for many shafts uses."""
