# SPDX-License-Identifier: MIT
"""Shaft culling: what can stand between two objects, what a moving body can hit, what lies in a shadow.

Bounds are float32 arrays: boxes (n, 6) or (n, 2, 3), spheres (n, 4), triangles (n, 3, 3). Make a tree of them, make
shafts, and ask:

    tree = shaftcull.BoxTree(boxes)
    lists = tree.list(a, b)             # lists[i]: the boxes that may stand between a[i] and b[i]
    shafts = shaftcull.Shafts.swept(bodies, displacements)
    indices, times = tree.first_contact(shafts)            # which box each body hits first, and when
    found = shaftcull.visibility(patches, solids=walls, triangles=mesh)    # of all pairs, what sees what

Answers are those of real arithmetic for the float32 given, and the same bits on every machine.
"""

from shaftcull._lists import IndexLists

try:
    from shaftcull._shaftcull import (
        BadBound,
        Bounds,
        Boxes,
        BoxStream,
        BoxTree,
        BoxTreeSnapshot,
        BoxView,
        ConvexHull,
        DynamicBoxTree,
        DynamicSphereTree,
        NeedsRefit,
        Occluders,
        Origin,
        Patches,
        Shafts,
        Spheres,
        SphereStream,
        SphereTree,
        SphereTreeSnapshot,
        SphereView,
        Triangles,
        TriangleStream,
        TriangleTree,
        TriangleView,
        ViewFactors,
        Visibility,
        __version__,
        active_isa,
        available_isas,
        concurrency,
        count_visibility,
        inscribed_box,
        lit_fractions,
        merged_boxes,
        points,
        select_isa,
        view_factor,
        view_factors,
        view_planes,
        visibility,
    )
except ModuleNotFoundError as error:
    if error.name != "shaftcull._shaftcull":
        raise
    raise ImportError(
        f"{__path__[0]} has no compiled module. If it belongs to the sources, start Python in another folder."
    ) from error

__all__ = [name for name in list(globals()) if not name.startswith("_")] + ["__version__"]
