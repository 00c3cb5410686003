# SPDX-License-Identifier: MIT
from typing import Any, Callable, Literal, Sequence, SupportsIndex, Tuple, Union

import numpy as np
import numpy.typing as npt

__version__: str

# float32 arrays of the shapes that the docstrings say, tuples of such, and lists of numbers that are float32 exactly.
_Floats = Any
_Integers = npt.ArrayLike
_Contact = Literal["closed", "open"]
_Depth = Literal["zero_to_one", "minus_one_to_one"]
_Sight = Literal["undecided", "clear", "occluded", "facing_away"]
_Test = Literal["exact", "vertices"]

_Bits = npt.NDArray[Any]  # of bool, or uint64 if they stay packed
# What follows depends on the shape of the shafts, which types do not say.
_Bools = Any  # a bool, or NDArray[bool]
_Numbers = Any  # an int, or NDArray[int64]
_Times = Any  # a float, or NDArray[float32]
_Lists = Any  # NDArray[uint32]; or offsets and indices, Tuple[NDArray[int64], NDArray[uint32]]; with times one more
_Asked = Union["Shafts", "ConvexHull", _Floats]

class BadBound(ValueError):
    index: int

class NeedsRefit(RuntimeError): ...

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
    ) -> Shafts: ...
    @staticmethod
    def swept(
        bodies: _Floats, displacements: _Floats, *, planes: _Floats | None = None, contact: _Contact = "closed"
    ) -> Shafts: ...
    @staticmethod
    def swept_infinite(
        bodies: _Floats, directions: _Floats, *, planes: _Floats | None = None, contact: _Contact = "closed"
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
    def __init__(self, points: _Floats, directions: _Floats | None = None) -> None: ...
    @staticmethod
    def frustum(matrix: _Floats, depth: _Depth = "zero_to_one") -> ConvexHull: ...
    def casters(self, light: _Floats) -> ConvexHull: ...
    def casters_towards(self, towards_sun: _Floats) -> ConvexHull: ...
    @property
    def box(self) -> npt.NDArray[np.float32]: ...
    @property
    def points(self) -> npt.NDArray[np.float32]: ...
    @property
    def directions(self) -> npt.NDArray[np.float32]: ...

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
    ) -> Tuple[_Numbers, _Times]: ...
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
    def __init__(self, boxes: _Floats) -> None: ...
    def update(self, boxes: _Floats, first: int = 0) -> None: ...
    @property
    def memory_bytes(self) -> int: ...

class BoxTree(Boxes):
    def __init__(self, boxes: _Floats) -> None: ...
    def update(self, boxes: _Floats, indices: _Integers | None = None) -> None: ...
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
    ) -> Tuple[_Numbers, _Times]: ...
    def entry_times(self, shafts: Shafts, indices: _Integers) -> npt.NDArray[np.float32]: ...

class SphereView(Spheres):
    def __init__(self, spheres: _Floats) -> None: ...

class SphereStream(Spheres):
    def __init__(self, spheres: _Floats) -> None: ...
    def update(self, spheres: _Floats, first: int = 0) -> None: ...
    @property
    def memory_bytes(self) -> int: ...

class SphereTree(Spheres):
    def __init__(self, spheres: _Floats) -> None: ...
    def update(self, spheres: _Floats, indices: _Integers | None = None) -> None: ...
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
    @property
    def order(self) -> npt.NDArray[np.uint32]: ...
    @property
    def box(self) -> npt.NDArray[np.float32]: ...
    @property
    def memory_bytes(self) -> int: ...

class Patches:
    def __init__(self, boxes: _Floats, planes: _Floats | None = None) -> None: ...
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
    ) -> None: ...
    def __len__(self) -> int: ...
    @property
    def first(self) -> dict[str, int]: ...
    def box(self, occluder: int) -> npt.NDArray[np.float32]: ...
    def triangles(self, occluder: int) -> npt.NDArray[np.uint32]: ...

class Visibility:
    @property
    def counts(self) -> dict[str, int]: ...
    @property
    def products(self) -> npt.NDArray[np.uint32]: ...
    @property
    def sights(self) -> npt.NDArray[np.uint8]: ...
    @property
    def undecided(self) -> npt.NDArray[np.uint32]: ...
    @property
    def offsets(self) -> npt.NDArray[np.int64] | None: ...
    @property
    def candidates(self) -> npt.NDArray[np.uint32] | None: ...
    @property
    def order_a(self) -> npt.NDArray[np.uint32]: ...
    @property
    def order_b(self) -> npt.NDArray[np.uint32]: ...
    @property
    def occluders(self) -> Occluders: ...
    def pairs(self, sight: _Sight) -> npt.NDArray[np.uint32]: ...
    def bits(self, sight: _Sight, *, packed: bool = False) -> _Bits: ...

def visibility(
    patches: _Floats | Patches,
    patches_b: _Floats | Patches | None = None,
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
    contact: _Contact = "open",
    solids_around_ends: bool = True,
    candidates: bool = True,
    memory: int = 268435456,
    progress: Callable[[int, int], object] | None = None,
) -> Visibility: ...
def count_visibility(
    patches: _Floats | Patches,
    patches_b: _Floats | Patches | None = None,
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
    contact: _Contact = "open",
    solids_around_ends: bool = True,
    memory: int = 268435456,
    progress: Callable[[int, int], object] | None = None,
) -> dict[str, int]: ...
def merged_boxes(boxes: _Floats) -> npt.NDArray[np.float32]: ...
def inscribed_box(corners: _Floats) -> npt.NDArray[np.float32]: ...
def round_outwards(boxes: Any) -> npt.NDArray[np.float32]: ...
def round_spheres_outwards(spheres: Any) -> npt.NDArray[np.float32]: ...
def points(points: _Floats) -> npt.NDArray[np.float32]: ...
def view_planes(matrix: _Floats, depth: _Depth = "zero_to_one") -> npt.NDArray[np.float32]: ...
def available_isas() -> list[str]: ...
def active_isa() -> str: ...
def select_isa(isa: str) -> None: ...
def concurrency() -> int: ...
