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
    index: int

class NeedsRefit(RuntimeError): ...

class IndexLists:
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
    def pairs(self) -> npt.NDArray[np.uint32]: ...

class Shafts:
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
    ) -> Shafts: ...
    @staticmethod
    def swept(
        bodies: _Floats,
        displacements: _Floats,
        *,
        planes: _Floats | None = None,
        contact: _Contact = "closed",
        rounding: _Rounding | None = None,
    ) -> Shafts: ...
    @staticmethod
    def swept_infinite(
        bodies: _Floats,
        directions: _Floats,
        *,
        planes: _Floats | None = None,
        contact: _Contact = "closed",
        rounding: _Rounding | None = None,
    ) -> Shafts: ...
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
    ) -> Shafts: ...
    @staticmethod
    def concatenate(parts: Sequence[Shafts | ConvexHull]) -> Shafts: ...
    def __len__(self) -> int: ...
    def __getitem__(self, key: SupportsIndex | slice | npt.ArrayLike) -> Shafts: ...
    @property
    def shape(self) -> tuple[int, ...]: ...
    @property
    def a(self) -> npt.NDArray[np.float32]: ...
    @property
    def b(self) -> npt.NDArray[np.float32]: ...
    @property
    def open_contact(self) -> _Bools: ...
    def with_contact(self, contact: _Contact) -> Shafts: ...
    def completed(self) -> Shafts: ...
    def occluded_by_polygon(self, corners: _Floats) -> _Bools: ...

class ConvexHull:
    def __init__(self, points: _Floats, directions: _Floats | None = None, test: _HullTest = "exact") -> None: ...
    @staticmethod
    def between_polygons(p: _Floats, q: _Floats, test: _HullTest = "exact") -> ConvexHull: ...
    @staticmethod
    def frustum(matrix: _Floats, depth: _Depth, test: _HullTest = "exact") -> ConvexHull: ...
    def casters(self, light: _Floats) -> ConvexHull: ...
    def casters_towards(self, towards_sun: _Floats) -> ConvexHull: ...
    @property
    def box(self) -> npt.NDArray[np.float32]: ...
    @property
    def points(self) -> npt.NDArray[np.float32]: ...
    @property
    def directions(self) -> npt.NDArray[np.float32]: ...
    @property
    def test(self) -> str: ...

class Bounds:
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
    ) -> _Bits: ...
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
    ) -> _Bools: ...
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
    ) -> Tuple[_Bits, _Bits]: ...
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
    ) -> _Numbers: ...
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
    ) -> Tuple[_Numbers, _Numbers]: ...
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
    ) -> _Lists: ...
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
    ) -> Tuple[_Lists, _Lists]: ...
    def set_layers(self, layers: _Integers, indices: _Integers | None = None) -> None: ...
    def clear_layers(self) -> None: ...
    @property
    def has_layers(self) -> bool: ...

class Boxes(Bounds):
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
    ) -> _Contacts: ...
    def entry_times(self, shafts: Shafts, indices: _Integers) -> npt.NDArray[np.float32]: ...
    def occluded(
        self,
        shafts: _Asked,
        b: _Floats | None = None,
        *,
        exclude: _Integers | None = None,
        exclude_each: _Integers | None = None,
        exclude_mask: npt.ArrayLike | None = None,
        layer_mask: _Integers | None = None,
    ) -> _Bools: ...
    def find_occluder(
        self,
        shafts: _Asked,
        b: _Floats | None = None,
        *,
        exclude: _Integers | None = None,
        exclude_each: _Integers | None = None,
        exclude_mask: npt.ArrayLike | None = None,
        layer_mask: _Integers | None = None,
    ) -> _Numbers: ...
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
    ) -> _Lists: ...

class BoxView(Boxes):
    def __init__(self, boxes: _Floats) -> None: ...

class BoxStream(Boxes):
    def __init__(self, boxes: _Floats, rounding: _Rounding | None = None) -> None: ...
    def update(self, boxes: _Floats, first: int = 0, rounding: _Rounding | None = None) -> None: ...
    @property
    def memory_bytes(self) -> int: ...

class BoxTree(Boxes):
    def __init__(self, boxes: _Floats, rounding: _Rounding | None = None) -> None: ...
    def update(
        self, boxes: _Floats, indices: _Integers | None = None, rounding: _Rounding | None = None
    ) -> None: ...
    def refit(self) -> None: ...
    @property
    def needs_refit(self) -> bool: ...
    def rebuild(self) -> None: ...
    def reorder(self) -> None: ...
    def sah_ratio(self) -> float: ...
    @property
    def order(self) -> npt.NDArray[np.uint32]: ...
    @property
    def box(self) -> npt.NDArray[np.float32]: ...
    @property
    def memory_bytes(self) -> int: ...

class BoxTreeSnapshot(Boxes):
    @property
    def bound_count(self) -> int: ...
    @property
    def box(self) -> npt.NDArray[np.float32]: ...

class DynamicBoxTree(Boxes):
    def __init__(self) -> None: ...
    def insert(
        self, boxes: _Floats, layers: _Integers | None = None, rounding: _Rounding | None = None
    ) -> int | npt.NDArray[np.int64]: ...
    def erase(self, ids: _Integers) -> None: ...
    def move(self, ids: _Integers, boxes: _Floats, rounding: _Rounding | None = None) -> None: ...
    def move_by(self, ids: _Integers, displacements: _Floats) -> None: ...
    def commit(self) -> None: ...
    def rebuild(self) -> None: ...
    def snapshot(self) -> BoxTreeSnapshot: ...
    def values(self, ids: _Integers) -> npt.NDArray[np.float32]: ...
    def __contains__(self, id: int) -> bool: ...
    def ids_of(self, indices: _Integers) -> npt.NDArray[np.int64]: ...
    @property
    def bound_count(self) -> int: ...
    @property
    def memory_bytes(self) -> int: ...
    def set_sorted_per_change(self, sorted_per_change: float) -> None: ...
    @property
    def upkeep(self) -> dict[str, float]: ...

class Spheres(Bounds):
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
    ) -> _Contacts: ...
    def entry_times(self, shafts: Shafts, indices: _Integers) -> npt.NDArray[np.float32]: ...

class SphereView(Spheres):
    def __init__(self, spheres: _Floats) -> None: ...

class SphereStream(Spheres):
    def __init__(self, spheres: _Floats, rounding: _Rounding | None = None) -> None: ...
    def update(self, spheres: _Floats, first: int = 0, rounding: _Rounding | None = None) -> None: ...
    @property
    def memory_bytes(self) -> int: ...

class SphereTree(Spheres):
    def __init__(self, spheres: _Floats, rounding: _Rounding | None = None) -> None: ...
    def update(
        self, spheres: _Floats, indices: _Integers | None = None, rounding: _Rounding | None = None
    ) -> None: ...
    def refit(self) -> None: ...
    @property
    def needs_refit(self) -> bool: ...
    def rebuild(self) -> None: ...
    def reorder(self) -> None: ...
    def sah_ratio(self) -> float: ...
    @property
    def order(self) -> npt.NDArray[np.uint32]: ...
    @property
    def box(self) -> npt.NDArray[np.float32]: ...
    @property
    def memory_bytes(self) -> int: ...

class SphereTreeSnapshot(Spheres):
    @property
    def bound_count(self) -> int: ...
    @property
    def box(self) -> npt.NDArray[np.float32]: ...

class DynamicSphereTree(Spheres):
    def __init__(self) -> None: ...
    def insert(
        self, spheres: _Floats, layers: _Integers | None = None, rounding: _Rounding | None = None
    ) -> int | npt.NDArray[np.int64]: ...
    def erase(self, ids: _Integers) -> None: ...
    def move(self, ids: _Integers, spheres: _Floats, rounding: _Rounding | None = None) -> None: ...
    def move_by(self, ids: _Integers, displacements: _Floats) -> None: ...
    def commit(self) -> None: ...
    def rebuild(self) -> None: ...
    def snapshot(self) -> SphereTreeSnapshot: ...
    def values(self, ids: _Integers) -> npt.NDArray[np.float32]: ...
    def __contains__(self, id: int) -> bool: ...
    def ids_of(self, indices: _Integers) -> npt.NDArray[np.int64]: ...
    @property
    def bound_count(self) -> int: ...
    @property
    def memory_bytes(self) -> int: ...
    def set_sorted_per_change(self, sorted_per_change: float) -> None: ...
    @property
    def upkeep(self) -> dict[str, float]: ...

class Triangles(Bounds): ...

class TriangleView(Triangles):
    def __init__(self, triangles: _Floats) -> None: ...

class TriangleStream(Triangles):
    def __init__(self, triangles: _Floats, faces: _Integers | None = None) -> None: ...
    def update(self, triangles: _Floats, first: int = 0, faces: _Integers | None = None) -> None: ...
    @property
    def memory_bytes(self) -> int: ...

class TriangleTree(Triangles):
    def __init__(self, triangles: _Floats, faces: _Integers | None = None) -> None: ...
    def update(
        self, triangles: _Floats, indices: _Integers | None = None, faces: _Integers | None = None
    ) -> None: ...
    def refit(self) -> None: ...
    @property
    def needs_refit(self) -> bool: ...
    def rebuild(self) -> None: ...
    def reorder(self) -> None: ...
    def sah_ratio(self) -> float: ...
    @property
    def order(self) -> npt.NDArray[np.uint32]: ...
    @property
    def box(self) -> npt.NDArray[np.float32]: ...
    @property
    def memory_bytes(self) -> int: ...

class Patches:
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
    def has_planes(self) -> bool: ...
    @property
    def order(self) -> npt.NDArray[np.uint32]: ...

class Occluders:
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
    def found(self) -> dict[str, int]: ...
    @property
    def first(self) -> dict[str, int]: ...
    def box(self, occluder: int) -> npt.NDArray[np.float32]: ...
    def triangles(self, occluder: int) -> npt.NDArray[np.uint32]: ...

class Visibility:
    @property
    def counts(self) -> dict[str, int]: ...
    @property
    def blocks(self) -> npt.NDArray[np.uint32]: ...
    @property
    def sights(self) -> npt.NDArray[np.uint8]: ...
    @property
    def undecided(self) -> npt.NDArray[np.uint32]: ...
    @property
    def candidates(self) -> IndexLists | None: ...
    @property
    def order_a(self) -> npt.NDArray[np.uint32]: ...
    @property
    def order_b(self) -> npt.NDArray[np.uint32]: ...
    @property
    def occluders(self) -> Occluders: ...
    def pairs(self, sight: _Sight) -> npt.NDArray[np.uint32]: ...
    def fractions(self, *, rays: int = 64, error: float = 0.0, seed: int = 1) -> npt.NDArray[np.float32]: ...
    def bits(self, sight: _Sight, *, packed: bool = False) -> _Bits: ...

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
) -> Visibility: ...
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
) -> dict[str, int]: ...
def merged_boxes(boxes: _Floats) -> npt.NDArray[np.float32]: ...
def inscribed_box(corners: _Floats) -> npt.NDArray[np.float32]: ...
class Origin:
    def __init__(self, at: npt.ArrayLike = (0, 0, 0)) -> None: ...
    @staticmethod
    def for_points(points: npt.ArrayLike) -> Origin: ...
    @property
    def at(self) -> npt.NDArray[np.float64]: ...
    def boxes(self, boxes: npt.ArrayLike, *, within: bool = False) -> npt.NDArray[np.float32]: ...
    def spheres(self, spheres: npt.ArrayLike) -> npt.NDArray[np.float32]: ...
    def planes(self, planes: npt.ArrayLike, box: npt.ArrayLike) -> npt.NDArray[np.float32]: ...
    def points(self, points: npt.ArrayLike) -> npt.NDArray[np.float32]: ...
    def to_world(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...
class ViewFactors:
    @property
    def data(self) -> npt.NDArray[np.float64]: ...
    @property
    def indices(self) -> npt.NDArray[np.int32]: ...
    @property
    def indptr(self) -> npt.NDArray[np.int64]: ...
    @property
    def shape(self) -> tuple[int, int]: ...
    @property
    def area(self) -> npt.NDArray[np.float64]: ...
    @property
    def row_sum(self) -> npt.NDArray[np.float64]: ...
    @property
    def error(self) -> npt.NDArray[np.float64]: ...
    @property
    def left_out(self) -> npt.NDArray[np.float64]: ...
    @property
    def counts(self) -> dict[str, int]: ...
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
) -> ViewFactors: ...
def view_factor(from_corners: _Floats, to_corners: _Floats) -> float: ...
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
) -> npt.NDArray[np.float32]: ...
def points(points: _Floats, *, rounding: _Rounding | None = None) -> npt.NDArray[np.float32]: ...
def view_planes(matrix: _Floats, depth: _Depth) -> npt.NDArray[np.float32]: ...
def available_isas() -> list[str]: ...
def active_isa() -> str: ...
def select_isa(isa: str) -> None: ...
def concurrency() -> int: ...
