# SPDX-License-Identifier: MIT
"""What is taken, what is refused, and how that is said."""

import numpy as np
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
        "rounded": sc.round_outwards(boxes.astype(float)),
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
    [("float64", "round_outwards"), ("float16", "astype"), ("int64", "astype"), (">f4", "astype"), ("bool", "astype"),
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
    with pytest.raises(ValueError, match=r"boxes has shape \(.*it must be \(n, 6\), \(n, 2, 3\), a tuple"):
        sc.BoxTree(np.zeros(shape, dtype=np.float32))


def test_pairs_and_columns_must_fit():
    zeros = np.zeros((4, 3), dtype=np.float32)
    with pytest.raises(ValueError, match=r"lo, has shape \(4, 3\), but .*hi, has \(3, 3\)"):
        sc.BoxTree((zeros, zeros[:3]))
    with pytest.raises(ValueError, match=r"boxes\[3\] has shape \(2,\), but boxes\[0\] has \(4,\)"):
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


def test_float64_is_rounded_outwards_on_request():
    random = np.random.default_rng(12)
    lo = random.random((1000, 3))
    boxes = np.hstack([lo, lo + random.random((1000, 3))])
    rounded = sc.round_outwards(boxes)
    assert rounded.dtype == np.float32
    lower, upper = rounded[:, :3].astype(float), rounded[:, 3:].astype(float)
    assert (lower <= boxes[:, :3]).all() and (upper >= boxes[:, 3:]).all()
    assert (np.nextafter(rounded[:, :3], INF).astype(float) > boxes[:, :3]).all()
    assert (np.nextafter(rounded[:, 3:], -INF).astype(float) < boxes[:, 3:]).all()
    np.testing.assert_array_equal(sc.round_outwards((boxes[:, :3], boxes[:, 3:])), rounded)
    np.testing.assert_array_equal(sc.round_outwards(boxes.reshape(-1, 2, 3)), rounded)
    np.testing.assert_array_equal(sc.round_outwards(boxes[0]), rounded[0])
    np.testing.assert_array_equal(
        sc.round_outwards([-1e300, 1e300, -np.inf, -1e300, 1e300, np.inf]),
        np.float32([-INF, 3.4028235e38, -INF, -3.4028235e38, INF, INF]),
    )
    assert np.isnan(sc.round_outwards([np.nan] * 6)).all()
    for wrong in (boxes[:, :5], boxes[:, 0], np.zeros((2, 2, 2, 3))):
        with pytest.raises(ValueError, match="boxes have shape"):
            sc.round_outwards(wrong)
    with pytest.raises(TypeError, match="integers"):
        sc.round_outwards([0, 0, 0, 1, 1, 2**60 + 1])


def test_spheres_of_float64_are_rounded_outwards_on_request():
    random = np.random.default_rng(13)
    spheres = random.random((1000, 4)) * 10
    spheres[0] = (1, 2, 3, 4)
    rounded = sc.round_spheres_outwards(spheres).astype(float)
    moved = np.linalg.norm(rounded[:, :3] - spheres[:, :3], axis=1)
    assert (rounded[:, 3] >= spheres[:, 3] + moved).all()
    assert (rounded[:, 3] <= spheres[:, 3] + 2 * moved + 2e-6).all()
    np.testing.assert_array_equal(rounded[0], spheres[0])
    pair = sc.round_spheres_outwards((spheres[:, :3], spheres[:, 3]))
    np.testing.assert_array_equal(pair.astype(float), rounded)


def test_results_own_their_memory(boxes, a, b):
    tree = sc.BoxTree(boxes)
    shafts = sc.Shafts.between(a, b)
    results = [*tree.list(shafts, times=True), tree.cull(shafts), tree.count(shafts), *tree.first_contact(shafts), tree.order]
    copies = [result.copy() for result in results]
    tree.update(boxes[::-1].copy())
    del tree, shafts
    for result, copy in zip(results, copies):
        assert result.flags.writeable
        np.testing.assert_array_equal(result, copy)
        result[...] = 0
