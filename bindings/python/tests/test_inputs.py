# SPDX-License-Identifier: MIT
"""What is taken, what is refused, and how that is said."""

import pickle
from fractions import Fraction as F

import numpy as np
import oracle
import pytest
import shaftcull as sc
from conftest import some_boxes

NAN, INF = np.float32(np.nan), np.float32(np.inf)


def layouts(boxes):
    """The same boxes as all that is taken for boxes."""
    wide = np.zeros((len(boxes), 9), dtype=np.float32)
    wide[:, 2:8] = boxes
    columns = np.ascontiguousarray(boxes.T)
    swapped = np.ascontiguousarray(boxes[::-1])
    bytes_of = np.zeros(boxes.nbytes + 1, dtype=np.uint8)
    odd = bytes_of[1:].view(np.float32).reshape(boxes.shape)
    odd[:] = boxes
    return {
        "rows": boxes,
        "corners": boxes.reshape(-1, 2, 3),
        "columns": columns.T,
        "fortran": np.asfortranarray(boxes),
        "corners by columns": np.asfortranarray(boxes.reshape(-1, 2, 3)),
        "pair": (boxes[:, :3], boxes[:, 3:]),
        "separate pair": (boxes[:, :3].copy(), boxes[:, 3:].copy()),
        "pair of different strides": (boxes[:, :3], boxes[:, 3:].copy()),
        "pair by columns": (np.asfortranarray(boxes[:, :3]), np.asfortranarray(boxes[:, 3:])),
        "six columns": tuple(columns),
        "six strided columns": tuple(boxes.T),
        "part of records": wide[:, 2:8],
        "backwards": swapped[::-1],
        "every second": np.repeat(boxes, 2, axis=0)[::2],
        "misaligned": odd,
        "misaligned columns": np.frombuffer(b"\0" + columns.tobytes(), np.float32, boxes.size, 1).reshape(6, -1).T,
        "list": boxes.tolist(),
        "read-only": np.frombuffer(boxes.tobytes(), dtype=np.float32).reshape(-1, 6),
        "memoryview": memoryview(boxes),
    }


@pytest.mark.parametrize("layout", layouts(some_boxes(1, 2)))
def test_every_layout_of_boxes_is_the_same(layout, a, b):
    boxes = some_boxes(11, 100)
    wanted = sc.BoxTree(boxes).cull(a, b)
    given = layouts(boxes)[layout]
    for make in (sc.BoxTree, sc.BoxStream):
        holder = make(given)
        np.testing.assert_array_equal(holder.cull(a, b), wanted)
        holder.update(layouts(boxes[::-1].copy())[layout])
        np.testing.assert_array_equal(holder.cull(a, b), wanted[:, ::-1])
    np.testing.assert_array_equal(sc.Shafts.between(given, b[0]).a, boxes)


def test_broadcast_arrays_are_boxes():
    one = some_boxes(1, 1)
    shafts = sc.Shafts.between(np.broadcast_to(one, (5, 6)), np.broadcast_to(one[0], (5, 6)))
    np.testing.assert_array_equal(shafts.b, np.tile(one, (5, 1)))


def test_views_copy_nothing_and_see_changes():
    boxes = np.array([[0, 0, 0, 1, 1, 1]], dtype=np.float32)
    columns = np.asfortranarray(np.repeat(boxes, 3, axis=0))
    view = sc.BoxView(columns)
    shaft = sc.Shafts.between(boxes[0], boxes[0])
    assert view.count(shaft) == 3
    columns[1] += 5
    assert view.count(shaft) == 2
    spheres = np.asfortranarray(np.ones((3, 4), dtype=np.float32))
    sphere_view = sc.SphereView(spheres)
    spheres[0, :3] = 9
    assert sphere_view.count(shaft) == 2
    triangles = np.zeros((9, 3), dtype=np.float32)
    triangle_view = sc.TriangleView(triangles.T)
    triangles[:, 0] = 9
    assert triangle_view.count(shaft) == 2


def test_views_keep_their_arrays_alive(boxes, a, b):
    wanted = sc.BoxStream(boxes).count(a, b)
    views = [sc.BoxView(np.asfortranarray(boxes)), sc.BoxView(tuple(boxes.T.copy()))]
    views.append(sc.BoxView((np.asfortranarray(boxes[:, :3]), np.asfortranarray(boxes[:, 3:]))))
    rubbish = [np.full(boxes.size, 7, dtype=np.float32) for _ in range(100)]
    for view in views:
        np.testing.assert_array_equal(view.count(a, b), wanted)
    assert len(rubbish) == 100


@pytest.mark.parametrize("layout", ["rows", "corners", "separate pair", "six strided columns", "misaligned columns"])
def test_views_refuse_what_they_would_have_to_copy(layout, boxes):
    with pytest.raises(ValueError, match="copies nothing"):
        sc.BoxView(layouts(boxes)[layout])


def test_single_boxes_have_many_shapes():
    for box in ([0, 0, 0, 1, 2, 3], [[0, 0, 0], [1, 2, 3]], ([0, 0, 0], [1, 2, 3]), np.float32([0, 0, 0, 1, 2, 3])):
        shaft = sc.Shafts.between(box, box)
        assert shaft.shape == ()
        np.testing.assert_array_equal(shaft.a, [0, 0, 0, 1, 2, 3])
    many = sc.Shafts.between([[0, 0, 0, 1, 2, 3]], [0, 0, 0, 1, 2, 3])
    assert many.shape == (1,)


@pytest.mark.parametrize(
    "dtype, advice",
    [("float64", "rounding='outwards'"), ("float16", "astype"), ("int64", "astype"), (">f4", "astype"), ("bool", "astype"),
     ("complex64", "astype"), ("object", "astype"), ("float128", "astype")],
)  # fmt: skip
def test_other_dtypes_are_refused_with_advice(dtype, advice, boxes):
    with pytest.raises(TypeError, match=f"boxes has dtype {dtype}; it must be float32.*{advice}"):
        sc.BoxTree(boxes.astype(dtype))


def test_lists_are_taken_only_if_they_are_float32_exactly():
    assert sc.BoxTree([[0.5, 0, 0, 1, 1, 1]]).box[0] == 0.5
    with pytest.raises(TypeError, match="0.1, which is no float32"):
        sc.BoxTree([[0.1, 0, 0, 1, 1, 1]])
    with pytest.raises(TypeError, match="no float32"):
        sc.BoxTree([[0, 0, 0, 1, 1, 2**24 + 1]])
    with pytest.raises(TypeError, match="no float32"):
        sc.BoxTree([[0, 0, 0, 1, 1, 1e300]])
    with pytest.raises(TypeError):
        sc.BoxTree(None)
    with pytest.raises((TypeError, ValueError)):
        sc.BoxTree([["a"] * 6])


@pytest.mark.parametrize("shape", [(5,), (7,), (3, 5), (3, 3), (2, 3, 3), (6, 4), (3, 2, 6), (1, 1, 2, 3), ()])
def test_other_shapes_are_refused_with_all_that_are_taken(shape):
    with pytest.raises(ValueError, match=r"boxes has shape \(.*it must be \(n, 6\) of lo and hi, \(n, 2, 3\), a tuple"):
        sc.BoxTree(np.zeros(shape, dtype=np.float32))


def test_pairs_and_columns_must_fit():
    zeros = np.zeros((4, 3), dtype=np.float32)
    with pytest.raises(ValueError, match=r"boxes\[1\] has shape \(3, 3\); it must be that of boxes\[0\], \(4, 3\)"):
        sc.BoxTree((zeros, zeros[:3]))
    with pytest.raises(ValueError, match=r"boxes\[3\] has shape \(2,\); it must be that of boxes\[0\], \(4,\)"):
        sc.BoxTree((zeros[:, 0],) * 3 + (zeros[:2, 0],) * 3)
    with pytest.raises(TypeError, match=r"boxes\[1\] has dtype float64"):
        sc.BoxTree((zeros, zeros.astype(float)))


@pytest.mark.parametrize("make", [sc.BoxTree, sc.BoxStream])
def test_bad_boxes_are_named_by_index(make, boxes):
    for column, value, what in ((1, NAN, "lo.y is not a number"), (3, -99, "is above")):
        for layout in (np.array, np.asfortranarray):
            bad = layout(boxes)
            bad[77, column] = value
            bad[99, column] = value
            with pytest.raises(sc.BadBound, match=f"77.*{what}") as raised:
                make(bad)
            assert raised.value.index == 77 and isinstance(raised.value, ValueError)
    holder = make(boxes)
    with pytest.raises(sc.BadBound):
        holder.update(bad)
    np.testing.assert_array_equal(holder.cull(boxes[0], boxes[9]), make(boxes).cull(boxes[0], boxes[9]))


def test_bad_ends_of_shafts_are_named_by_argument_and_index(a, b):
    bad = b.copy()
    bad[13, 2] = NAN
    with pytest.raises(sc.BadBound, match="b: .*13.*lo.z is not a number") as raised:
        sc.Shafts.between(a, bad)
    assert raised.value.index == 13
    bad[13, :3] = -INF
    with pytest.raises(sc.BadBound, match="13"):
        sc.Shafts.between(a, bad)
    with pytest.raises(sc.BadBound, match="not finite"):
        sc.Shafts.swept(a, np.full((len(a), 3), INF))
    with pytest.raises(sc.BadBound, match="0"):
        sc.Shafts.swept_infinite(a, [0, 0, 0])
    with pytest.raises(ValueError, match="apart"):
        sc.Shafts.shadow(a, a)
    with pytest.raises(ValueError, match="reach"):
        sc.Shafts.shadow(a - 30, a, 0.5)


def test_sizes_that_do_not_fit_are_said(a, b, boxes):
    tree = sc.BoxTree(boxes)
    shafts = sc.Shafts.between(a, b)
    for wrong, match in (
        (lambda: sc.Shafts.between(a, b[:3]), "40 boxes in a, but 3 in b"),
        (lambda: sc.Shafts.swept(a, b[:3, :3]), "40 bodies, but 3 displacements"),
        (lambda: sc.Shafts.swept(a, b), r"displacements has shape \(40, 6\); it must be \(n, 3\)"),
        (lambda: sc.Shafts.between(a, b, planes_a=np.zeros((3, 1, 4), np.float32)), r"planes_a has shape \(3, 1, 4\)"),
        (lambda: sc.Shafts.between(a, b, planes_a=np.zeros((1, 4), np.float32)), "normal"),
        (lambda: sc.Shafts.between(a, b, contact="ajar"), "'ajar'; it must be 'closed' or 'open'"),
        (lambda: tree.list(shafts, exclude_each=[1, 2]), r"exclude_each must have shape \(40, k\)"),
        (lambda: tree.list(shafts[0], exclude_each=[1, 2]), "for one shaft pass exclude$"),
        (lambda: tree.list(shafts, exclude=[[1, 2]] * 40), r"exclude must .*\(k,\).*; exclude_each has a row"),
        (lambda: tree.list(shafts, only=[[1, 2]]), r"only must be an index or have shape \(k,\)"),
        (lambda: tree.list(shafts, exclude_mask=[True]), r"exclude_mask has shape \(1,\); it must be \(150,\)"),
        (lambda: tree.list(shafts, layer_mask=[1, 2]), "layer_mask has 2 sets of layers for 40 shafts"),
        (lambda: tree.update(boxes[:3]), "3"),
        (lambda: tree.update(boxes[:3], indices=[1, 2]), "2"),
        (lambda: sc.BoxStream(boxes).update(boxes[:3], first=148), "148"),
        (lambda: tree.count(shafts, limit=-1), "limit is -1; it must be 0 or more"),
        (lambda: tree.entry_times(shafts, [1]), "one shaft"),
        (lambda: sc.Shafts.between(a, b, pairs=[1, 2]), r"pairs must have shape \(n, 2\)"),
        (lambda: sc.select_isa("mmx"), "no instruction set 'mmx'"),
    ):
        with pytest.raises(ValueError, match=match):
            wrong()


def test_wrong_types_are_said(a, b, boxes):
    tree = sc.BoxTree(boxes)
    shafts = sc.Shafts.between(a, b)
    for wrong, match in (
        (lambda: tree.list(a), "two arguments a and b"),
        (lambda: tree.list(shafts, b), "these are shafts already"),
        (lambda: tree.list(shafts, exclude_each=np.zeros((40, 1))), "exclude_each has dtype float64; it must be"),
        (lambda: tree.list(shafts, exclude_mask=np.zeros(150, int)), "exclude_mask has dtype int64; it must be bool"),
        (lambda: tree.list(shafts, only=np.zeros(3, bool)), "only has dtype bool"),
        (lambda: tree.count(shafts, limit=1.5), "float"),
        (lambda: len(shafts[0]), r"shape \(\)"),
        (lambda: shafts[0][0], r"shape \(\)"),
        (lambda: sc.Shafts.swept(a, b[:, :3].astype(float)), "displacements has dtype float64"),
    ):
        with pytest.raises(TypeError, match=match):
            wrong()


def test_indices_that_name_nothing_are_index_errors(a, b, boxes):
    tree = sc.BoxTree(boxes)
    shafts = sc.Shafts.between(a, b)
    for wrong, match in (
        (lambda: shafts[40], "index 40 is out of range for 40 shafts"),
        (lambda: shafts[-41], "index -41"),
        (lambda: shafts[[0, 41]], "41"),
        (lambda: shafts[np.zeros(3, bool)], "boolean"),
        (lambda: tree.list(shafts, exclude=150), "exclude: number 0 is 150, but there are 150 bounds"),
        (lambda: tree.list(shafts, exclude_each=np.full((40, 2), 150)), "exclude_each: number 0 is 150, but there are"),
        (lambda: tree.list(shafts, only=[3, -1]), "only: number 1 is -1"),
        (lambda: tree.entry_times(shafts[0], [2**40]), "indices: number 0 is 1099511627776"),
        (lambda: tree.update(boxes[:1], indices=[150]), "150"),
        (lambda: sc.Shafts.between(a, b[:9], pairs=[[0, 1], [2, 9]]), r"pair 1 is \(2, 9\), but there are 40 and 9"),
    ):
        with pytest.raises(IndexError, match=match):
            wrong()


def test_a_shaft_that_cannot_be_asked_is_named_among_all(a, b, boxes):
    between, swept = sc.Shafts.between(a, b), sc.Shafts.swept(a, b[:, :3])
    shafts = sc.Shafts.concatenate([between, between, swept])
    for holder in (sc.BoxTree(boxes), sc.BoxStream(boxes)):
        with pytest.raises(ValueError, match="80"):
            holder.occluded(shafts)
        with pytest.raises(ValueError, match="80"):
            holder.list_occluders(shafts)


# float64.


def exactly(numbers):
    return np.array([[F(float(x)) for x in row] for row in numbers])


def boxes_of_float64(seed, count=200):
    random = np.random.default_rng(seed)
    lo = random.random((count, 3)) * 10
    boxes = np.hstack([lo, lo + random.random((count, 3))])
    boxes[0] = (1, 2, 3, 4, 5, 6)  # need not be rounded
    return boxes


def test_boxes_of_float64_are_rounded_outwards_and_no_further():
    boxes = boxes_of_float64(12)
    shafts = sc.Shafts.between(boxes, boxes[0], rounding="outwards")
    lower, upper = shafts.a[:, :3], shafts.a[:, 3:]
    assert (lower <= boxes[:, :3]).all() and (upper >= boxes[:, 3:]).all()
    assert (np.nextafter(lower, INF).astype(float) > boxes[:, :3]).all()
    assert (np.nextafter(upper, -INF).astype(float) < boxes[:, 3:]).all()
    np.testing.assert_array_equal(shafts.a[0], boxes[0])
    columns = tuple(boxes.T)
    mixed = (np.float32(boxes[:, :3]), boxes[:, 3:])
    pair, fortran = (boxes[:, :3], boxes[:, 3:]), np.asfortranarray(boxes)
    for given in (boxes.reshape(-1, 2, 3), pair, columns, boxes.tolist(), fortran):
        np.testing.assert_array_equal(sc.Shafts.between(given, boxes[0], rounding="outwards").a, shafts.a)
    np.testing.assert_array_equal(sc.Shafts.between(mixed, boxes[0], rounding="outwards").a[:, 3:], upper)
    one = sc.Shafts.between(boxes[1], boxes[0], rounding="outwards")
    assert one.shape == () and (one.a == shafts.a[1]).all()
    huge = [-1e300, 1e300, -np.inf, -1e300, 1e300, np.inf]
    np.testing.assert_array_equal(
        sc.BoxTree([huge], rounding="outwards").box, np.float32([-INF, 3.4028235e38, -INF, -3.4028235e38, INF, INF])
    )


def test_what_is_outside_for_rounded_bounds_is_outside_for_the_given_ones():
    boxes, a, b = boxes_of_float64(12), boxes_of_float64(13, 20), boxes_of_float64(14, 20)
    kept = oracle.bits([oracle.between(x, y) for x, y in zip(a, b)], boxes, oracle.kept)
    shafts = sc.Shafts.between(a, b, rounding="outwards")
    tree, stream = sc.BoxTree(boxes, rounding="outwards"), sc.BoxStream(boxes, rounding="outwards")
    np.testing.assert_array_equal(tree.cull(shafts), stream.cull(shafts))
    assert (kept <= tree.cull(shafts)).all() and kept.any() and not tree.cull(shafts).all()
    tree.update(boxes[::-1].copy(), rounding="outwards")
    stream.update(boxes[:100][::-1], first=100, rounding="outwards")
    np.testing.assert_array_equal(tree.cull(shafts)[:, ::-1], sc.BoxTree(boxes, rounding="outwards").cull(shafts))
    np.testing.assert_array_equal(stream.cull(shafts)[:, 100:], tree.cull(shafts)[:, 100:])
    tree.update(boxes[:1], indices=[7], rounding="outwards")
    tree.refit()
    first = sc.BoxTree(boxes[:1], rounding="outwards").cull(shafts)[:, 0]
    np.testing.assert_array_equal(tree.cull(shafts)[:, 7], first)


def test_spheres_of_float64_are_contained():
    random = np.random.default_rng(13)
    spheres = random.random((300, 4)) * 10
    ways = random.normal(size=(300, 3))
    points = np.float32(spheres[:, :3] + ways * (spheres[:, 3:] / np.linalg.norm(ways, axis=1, keepdims=True)))
    tree = sc.SphereTree(spheres, rounding="outwards")
    kept = np.diagonal(tree.cull(sc.points(points), sc.points(points)))  # of points, at the surface of a sphere each
    squares = ((exactly(points) - exactly(spheres[:, :3])) ** 2).sum(1)
    within = squares <= exactly(spheres[:, 3:])[:, 0] ** 2
    assert kept[within].all() and 100 < within.sum() < 200
    assert not kept[squares > exactly(spheres[:, 3:] + 3e-6)[:, 0] ** 2].any() and not kept.all()
    pair = sc.SphereStream((spheres[:, :3], spheres[:, 3]), rounding="outwards")
    exact = sc.SphereStream([[1, 2, 3, 4]], rounding="outwards")
    a, b = some_boxes(2, 40), some_boxes(3, 40)
    np.testing.assert_array_equal(pair.cull(a, b), tree.cull(a, b))
    np.testing.assert_array_equal(exact.cull(a, b), sc.SphereStream([[1, 2, 3, 4]]).cull(a, b))
    with pytest.raises(sc.BadBound, match="sphere 1.*radius"):
        sc.SphereTree([[0.1, 0, 0, 0], [0.1, 0, 0, -1e-300]], rounding="outwards")


def test_swept_bodies_of_float64_are_contained_all_the_way():
    bodies, by = boxes_of_float64(15, 60), np.random.default_rng(15).normal(size=(60, 3)) * 100
    shafts = sc.Shafts.swept(bodies, by, rounding="outwards")
    start, step = exactly(bodies), exactly(by)
    moved = exactly(shafts.a)
    rounded = exactly(by.astype(np.float32))  # the displacement of the shafts
    for t in (F(0), F(1, 3), F(1)):
        assert (moved[:, :3] + t * rounded <= start[:, :3] + t * step).all()
        assert (moved[:, 3:] + t * rounded >= start[:, 3:] + t * step).all()
    assert abs(shafts.a - bodies).max() < 1e-4
    bodies32, by32 = bodies.astype(np.float32), by.astype(np.float32)
    np.testing.assert_array_equal(sc.Shafts.swept(bodies32, by32, rounding="outwards").a, bodies32)
    assert sc.Shafts.swept_infinite(bodies, [0, 0, -1], rounding="outwards").shape == (60,)
    with pytest.raises(TypeError, match="directions has dtype float64.*rounds to nearest"):
        sc.Shafts.swept_infinite(bodies, by, rounding="outwards")


def test_shadows_and_points_of_float64_are_contained():
    light, occluder = boxes_of_float64(16, 9) + [[0, 0, 50] * 2], boxes_of_float64(17, 9)
    shafts = sc.Shafts.shadow(light, occluder, 1.1, rounding="outwards")
    with pytest.raises(TypeError, match="reach: number 0 is 1.1, which is no float32"):
        sc.Shafts.shadow(light.astype(np.float32), occluder.astype(np.float32), 1.1)
    points = np.random.default_rng(18).random((300, 3)) * [10, 10, 12] - [0, 0, 4]
    boxes = sc.points(points, rounding="outwards")
    assert (boxes[:, :3] <= points).all() and (boxes[:, 3:] >= points).all() and (boxes[:, :3] < boxes[:, 3:]).any()
    kept = oracle.bits([oracle.shadow(x, y, 1.1) for x, y in zip(light, occluder)], np.tile(points, 2), oracle.kept)
    assert kept.any() and (kept <= sc.BoxTree(boxes).cull(shafts)).all()
    assert sc.points(points[0], rounding="outwards").shape == (6,)


def test_patches_and_occluders_of_float64_are_contained():
    patches, between = boxes_of_float64(19, 40), boxes_of_float64(20, 10)
    found = sc.visibility(patches, occluders=between, rounding="outwards")
    same = sc.visibility(sc.Patches(patches, rounding="outwards"), occluders=sc.Occluders(between, rounding="outwards"))
    assert found.counts == same.counts and found.counts["clear"] > 10
    assert sc.count_visibility(patches, occluders=between, rounding="outwards") == found.counts
    np.testing.assert_array_equal(found.occluders.box(3), sc.BoxTree(between[3:4], rounding="outwards").box)
    for i, j in found.pairs("clear"):
        assert not any(oracle.kept(oracle.between(patches[i], patches[j]), box) for box in between)


@pytest.mark.parametrize(
    "call, name",
    [
        (lambda x: sc.Occluders(solids=x(6), rounding="outwards"), "solids"),
        (lambda x: sc.Occluders(polygons=[x(3)] * 3, rounding="outwards"), r"polygons\[0\]"),
        (lambda x: sc.Occluders(triangles=x(9), rounding="outwards"), "triangles"),
        (lambda x: sc.Patches([[0] * 6] * 3, x(4), rounding="outwards"), "planes"),
        (lambda x: sc.Shafts.between([0] * 6, [1] * 6, planes_a=x(4), rounding="outwards"), "planes_a"),
        (lambda x: sc.TriangleTree(x(9)), "triangles"),
        (lambda x: sc.TriangleStream(x(3), [[0, 1, 2]]), "triangles"),
        (lambda x: sc.ConvexHull(x(3)), "points"),
        (lambda x: sc.ConvexHull.frustum(x(4), "zero_to_one"), "matrix"),
        (lambda x: sc.view_planes(x(4), "zero_to_one"), "matrix"),
        (lambda x: sc.merged_boxes(x(6)), "boxes"),
        (lambda x: sc.inscribed_box(x(3)), "corners"),
        (lambda x: sc.view_factor(x(3), [[0] * 3] * 3), "from_corners"),
    ],
)
def test_what_cannot_be_rounded_outwards_is_refused(call, name):
    with pytest.raises(TypeError, match=f"{name} has dtype float64; it must be float32: .*astype.* rounds to nearest"):
        call(lambda columns: np.full((3, columns), 0.1))


def test_the_error_for_float64_says_what_would_be_right():
    boxes, spheres = boxes_of_float64(12), np.full((3, 4), 0.1)
    for call, advice in (
        (lambda: sc.BoxTree(boxes), "rounding='outwards'"),
        (lambda: sc.SphereStream(spheres), "rounding='outwards'"),
        (lambda: sc.Shafts.swept(boxes, boxes[:, :3]), "rounding='outwards'"),
        (lambda: sc.BoxView(np.asfortranarray(boxes)), "a BoxStream copies, and may round"),
        (lambda: sc.SphereView(np.asfortranarray(spheres)), "a SphereStream copies"),
        (lambda: sc.BoxTree([]).count(boxes, boxes), r"Shafts.between\(\) takes rounding='outwards'"),
    ):
        with pytest.raises(TypeError, match=f"has dtype float64; it must be float32: .*{advice}"):
            call()
    with pytest.raises(ValueError, match="rounding is 'up'; it must be 'outwards' or None"):
        sc.BoxTree(boxes, rounding="up")
    with pytest.raises(TypeError, match="integers that are no float64"):
        sc.BoxTree([[0, 0, 0, 1, 1, 2**60 + 1]], rounding="outwards")
    with pytest.raises(sc.BadBound, match="box 1: lo.x is not a number") as raised:
        sc.BoxTree([[0.1] * 6, [np.nan] * 6], rounding="outwards")
    assert raised.value.index == 1


# Results.


def test_many_lists_are_one_object(boxes, a, b):
    tree = sc.BoxTree(boxes)
    shafts = sc.Shafts.between(a, b)
    lists = tree.list(shafts, times=True)
    assert isinstance(lists, sc.IndexLists) and len(lists) == 40
    assert lists.offsets.dtype == np.int64 and lists.indices.dtype == np.uint32 and lists.times.dtype == np.float32
    assert lists.offsets.shape == (41,) and lists.indices.shape == lists.times.shape == (lists.offsets[-1],)
    rows = [tree.list(shafts[i]) for i in range(40)]
    assert 0 in map(len, rows) and max(map(len, rows)) > 3
    for i, (row, wanted) in enumerate(zip(lists, rows)):
        for found in (row, lists[i], lists[i - 40], lists[np.int64(i)]):
            assert found.dtype == np.uint32 and np.shares_memory(found, lists.indices) == (len(wanted) > 0)
            np.testing.assert_array_equal(found, wanted)
    pairs = lists.pairs()
    assert pairs.dtype == np.uint32 and pairs.shape == (len(lists.indices), 2)
    np.testing.assert_array_equal(pairs, [(i, bound) for i, row in enumerate(rows) for bound in row])
    kept = np.zeros((40, len(boxes)), dtype=bool)
    kept[tuple(pairs.T)] = True
    np.testing.assert_array_equal(kept, tree.cull(shafts))
    assert repr(lists) == f"<shaftcull.IndexLists of 40 shafts, {len(pairs)} indices, with times>"
    for wrong, error in ((40, IndexError), (-41, IndexError), (1.5, TypeError), (slice(3), TypeError)):
        with pytest.raises(error):
            lists[wrong]
    overlap, inside = tree.list_classified(shafts)
    for some in (overlap, inside, tree.list_occluders(shafts), tree.list(shafts)):
        assert isinstance(some, sc.IndexLists) and len(some) == 40 and some.times is None
    none = tree.list(shafts[:0])
    assert len(none) == 0 and list(none) == [] and none.pairs().shape == (0, 2)


def test_lists_are_pickled_and_made_again(boxes, a, b):
    lists = sc.BoxTree(boxes).list(sc.Shafts.between(a, b), times=True)
    for same in (pickle.loads(pickle.dumps(lists)), sc.IndexLists(lists.offsets, lists.indices, lists.times)):
        assert type(same) is sc.IndexLists
        for name in ("offsets", "indices", "times"):
            np.testing.assert_array_equal(getattr(same, name), getattr(lists, name))


def test_results_own_their_memory(boxes, a, b):
    tree = sc.BoxTree(boxes)
    shafts = sc.Shafts.between(a, b)
    lists = tree.list(shafts, times=True)
    results = [lists.offsets, lists.indices, lists.times, tree.cull(shafts), tree.count(shafts)]
    results += [*tree.first_contact(shafts), tree.order]
    copies = [result.copy() for result in results]
    tree.update(boxes[::-1].copy())
    del tree, shafts
    for result, copy in zip(results, copies):
        assert result.flags.writeable
        np.testing.assert_array_equal(result, copy)
        result[...] = 0


def test_an_origin_makes_bounds_that_contain_what_they_are_given():
    rng = np.random.default_rng(5)
    at = np.array([4512345.0, 500000.0, 100.0])
    origin = sc.Origin(at)
    assert origin.at.tolist() == at.tolist() and origin == sc.Origin(tuple(at)) and repr(origin) == f"Origin({at.tolist()})"
    assert len({origin, sc.Origin(at), sc.Origin()}) == 2
    middle = at + rng.uniform(-500, 500, (200, 3))
    half = rng.uniform(0, 3, (200, 3))
    boxes = np.hstack([middle - half, middle + half])
    around, within = origin.boxes(boxes), origin.boxes(boxes, within=True)
    assert around.dtype == np.float32 and around.shape == (200, 6)
    for i in range(200):
        for axis in range(3):
            lo = F(boxes[i, axis]) - F(at[axis])
            hi = F(boxes[i, 3 + axis]) - F(at[axis])
            assert F(float(around[i, axis])) <= lo <= F(float(within[i, axis]))
            assert F(float(within[i, 3 + axis])) <= hi <= F(float(around[i, 3 + axis]))
    assert np.abs(around - within).max() < 1e-4
    assert sc.BoxStream(around).count(sc.Shafts.between(around[0], around[1])) >= 2

    spheres = np.hstack([middle, half[:, :1]])
    for sphere, given in zip(origin.spheres(spheres), spheres):
        off = sum((F(float(sphere[k])) - (F(given[k]) - F(at[k]))) ** 2 for k in range(3))
        assert (F(float(sphere[3])) - F(given[3])) ** 2 >= off and sphere[3] >= given[3]
    points = origin.points(middle)
    np.testing.assert_array_equal(points, (middle - at).astype(np.float32))
    np.testing.assert_allclose(origin.to_world(points), middle, atol=1e-4)

    region = np.hstack([at - 1000, at + 1000])
    planes = np.hstack([rng.uniform(-1, 1, (200, 3)), np.empty((200, 1))])
    planes[:, 3] = (planes[:, :3] * middle).sum(axis=1)
    for plane, given in zip(origin.planes(planes, region), planes):
        for corner in np.ndindex(2, 2, 2):
            point = [F(region[3 * corner[k] + k]) for k in range(3)]
            is_kept = sum(F(given[k]) * point[k] for k in range(3)) <= F(given[3])
            assert not is_kept or sum(F(float(plane[k])) * (point[k] - F(at[k])) for k in range(3)) <= F(float(plane[3]))
    np.testing.assert_array_equal(origin.planes([1, 0, 0, at[0] + 0.5], region), [1, 0, 0, 0.5])

    near = sc.Origin.for_points(middle)
    assert np.abs(near.at - middle.mean(axis=0)).max() < 100 and (near.at % 8 == 0).all()
    one = origin.boxes(boxes[0])
    assert one.shape == (6,) and (one == around[0]).all()
    assert origin.boxes(np.empty((0, 6))).shape == (0, 6)
    # What lies between two floats has no box within, and what is wrong is refused by whoever takes it.
    assert sc.Origin().boxes([0.1, 0, 0, 0.1, 1, 1], within=True).tolist() == [np.inf] * 3 + [-np.inf] * 3
    with pytest.raises(sc.BadBound):
        sc.BoxStream(origin.boxes([[np.nan, 0, 0, 1, 1, 1]]))
    for wrong, error in [
        (lambda: sc.Origin((0, np.inf, 0)), "not finite"),
        (lambda: sc.Origin((0, 0)), r"shape \(2,\)"),
        (lambda: origin.boxes(middle), r"shape \(200, 3\); it must be \(n, 6\), or \(6,\) for one"),
        (lambda: origin.spheres(middle), r"\(n, 4\)"),
        (lambda: origin.points(boxes), r"\(n, 3\)"),
        (lambda: origin.planes(middle, region), r"\(n, 4\)"),
        (lambda: origin.planes(planes, boxes), r"box has shape \(200, 6\); it must be \(6,\)"),
        (lambda: origin.planes([[1, 0, 0, 0], [1, 0, np.nan, 0]], region), "plane 1 is not finite"),
        (lambda: origin.planes(planes, region[[3, 4, 5, 0, 1, 2]]), "lo <= hi"),
        (lambda: origin.to_world(boxes.astype(np.float32)), r"\(n, 3\)"),
        (lambda: sc.Origin.for_points(np.empty((0, 3))), "points is empty"),
        (lambda: sc.Origin.for_points([[0, 0, np.nan]]), "not finite"),
        (lambda: sc.Origin.for_points([[0, 0, np.nan], [1, 1, 1]]), "not finite"),
        (lambda: sc.Origin.for_points([[0, 0, 0], [1, np.inf, 1], [2, 2, 2]]), "not finite"),
    ]:
        with pytest.raises(ValueError, match=error):
            wrong()
    with pytest.raises(TypeError):
        origin.boxes(np.array([["a"] * 6]))
    with pytest.raises(TypeError):
        origin.to_world(middle)
