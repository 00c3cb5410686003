# SPDX-License-Identifier: MIT
"""Arrays of shafts, hulls, spheres and triangles."""

import numpy as np
import oracle
import pytest
import shaftcull as sc
from choices import check_options
from conftest import some_boxes


def test_shafts_are_indexed_as_arrays_are(a, b, boxes):
    shafts = sc.Shafts.between(a, b)
    stream = sc.BoxStream(boxes)
    every = stream.cull(shafts)
    assert len(shafts) == 40 and shafts.shape == (40,) and shafts[3].shape == ()
    mask = every.sum(1) > 3
    none = np.array([], dtype=int)
    keys = (slice(5, 9), slice(None), slice(None, None, -3), slice(9, 5), [3, 1, -1], mask, none, ...)
    for key in keys:
        np.testing.assert_array_equal(stream.cull(shafts[key]), every[key])
        np.testing.assert_array_equal(shafts[key].a, a[key])
    for key in (0, -1, np.int64(7)):
        np.testing.assert_array_equal(stream.cull(shafts[key]), every[key])
    np.testing.assert_array_equal([shaft.b for shaft in shafts], b)
    np.testing.assert_array_equal(stream.cull(shafts[5:30][2:20][1]), every[8])


def test_slices_outlive_their_array(a, b, boxes):
    part = sc.Shafts.between(a, b)[3:5]
    np.testing.assert_array_equal(sc.BoxTree(boxes).cull(part), sc.BoxTree(boxes).cull(a[3:5], b[3:5]))


def test_pairs_name_boxes(a, b, boxes):
    pairs = np.random.default_rng(14).integers(0, 40, (60, 2))
    stream = sc.BoxStream(boxes)
    np.testing.assert_array_equal(
        stream.cull(sc.Shafts.between(a, b, pairs=pairs)), stream.cull(a[pairs[:, 0]], b[pairs[:, 1]])
    )
    shadows = sc.Shafts.shadow(a - 20, b, pairs=pairs)
    np.testing.assert_array_equal(
        stream.cull(shadows), stream.cull(sc.Shafts.shadow(a[pairs[:, 0]] - 20, b[pairs[:, 1]]))
    )


def test_one_goes_with_each_of_many(a, b, boxes):
    stream = sc.BoxStream(boxes)
    for made, one_by_one in (
        (sc.Shafts.between(a, b[0]), [sc.Shafts.between(x, b[0]) for x in a]),
        (sc.Shafts.between(a[0], b), [sc.Shafts.between(a[0], y) for y in b]),
        (sc.Shafts.swept(a, [1, 2, 3]), [sc.Shafts.swept(x, [1, 2, 3]) for x in a]),
        (sc.Shafts.swept(a[0], b[:, 3:]), [sc.Shafts.swept(a[0], y[3:]) for y in b]),
        (sc.Shafts.swept_infinite(a, [0, 0, -1]), [sc.Shafts.swept_infinite(x, [0, 0, -1]) for x in a]),
        (sc.Shafts.shadow(a[0] - 20, b), [sc.Shafts.shadow(a[0] - 20, y) for y in b]),
    ):
        np.testing.assert_array_equal(stream.cull(made), [stream.cull(shaft) for shaft in one_by_one])


def test_points_are_boxes():
    np.testing.assert_array_equal(sc.points([1, 2, 3]), [1, 2, 3, 1, 2, 3])
    light, receiver = [0, 0, 10], [-1, -1, 0, 1, 1, 0]
    casters = sc.Shafts.between(sc.points([light]), receiver)
    tree = sc.BoxTree([[0, 0, 5, 1, 1, 6], [3, 3, 5, 4, 4, 6]])
    np.testing.assert_array_equal(tree.cull(casters), [[True, False]])
    hidden = sc.Shafts.shadow(sc.points(light), [-1, -1, 5, 1, 1, 5])
    np.testing.assert_array_equal(sc.BoxTree([[1, 1, 0, 2, 2, 1], [5, 5, 0, 6, 6, 1]]).cull(hidden), [True, False])


def test_reprs_say_what_there_is(a, b, boxes):
    shafts = sc.Shafts.between(a, b)
    assert repr(shafts) == "<shaftcull.Shafts of shape (40,)>"
    assert repr(shafts[0]).startswith("<shaftcull.Shafts of shape (): a [")
    assert repr(sc.BoxTree(boxes)) == "<shaftcull.BoxTree of 150 boxes>"
    assert repr(sc.BoxView(np.asfortranarray(boxes))) == "<shaftcull.BoxView of 150 boxes>"
    assert repr(sc.TriangleTree(np.zeros((2, 3, 3), np.float32))) == "<shaftcull.TriangleTree of 2 triangles>"
    assert repr(sc.ConvexHull([[0, 0, 0]])) == "<shaftcull.ConvexHull of 1 points and 0 directions>"
    assert sc.BoxTree.__module__ == "shaftcull"


# Hulls.

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=np.float32)
# Looks along -z from the origin: x and y within z, depth from 1 to 9 in 0 <= z <= w.
VIEW = np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1.125, -1.125], [0, 0, -1, 0]], dtype=np.float32)


def test_hulls_go_where_shafts_go():
    boxes = some_boxes(15, 200)
    corners = np.vstack([CUBE, CUBE + [4, 2, 1]]).astype(np.float32)
    hull = sc.ConvexHull(corners)
    shafts = sc.Shafts.between([0, 0, 0, 1, 1, 1], [4, 2, 1, 5, 3, 2])
    for make in (sc.BoxTree, sc.BoxStream):
        holder = make(boxes)
        np.testing.assert_array_equal(holder.classify(hull), holder.classify(shafts))
        np.testing.assert_array_equal(np.sort(holder.list(hull)), np.sort(holder.list(shafts)))
        both = sc.Shafts.concatenate([hull, shafts, hull])
        np.testing.assert_array_equal(holder.cull(both), [holder.cull(hull)] * 3)
        with pytest.raises(ValueError, match="hull"):
            holder.first_contact(hull)
        touching = sc.BoxStream(np.array([[-1, -1, -1, 0, 9, 9], [0, 0, 0, 1, 1, 1]], np.float32))
        np.testing.assert_array_equal(touching.cull(both), [[True, True]] * 3)
        opened = both.with_contact("open")
        np.testing.assert_array_equal(opened.open_contact, [True] * 3)
        np.testing.assert_array_equal(touching.cull(opened), [[False, True]] * 3)
    np.testing.assert_array_equal(hull.box, [0, 0, 0, 5, 3, 2])
    np.testing.assert_array_equal(hull.points, corners)


def test_hulls_between_two_ends_are_asked_what_blocks_them():
    p = np.array([[0, 0, 0], [0, 2, 0], [0, 2, 2]], np.float32)
    q = p + np.array([9, 0, 0], np.float32)
    hull = sc.ConvexHull.between_polygons(p, q)
    np.testing.assert_array_equal(hull.points, np.vstack([p, q]))
    walls = sc.BoxTree(np.array([[4, -9, -9, 5, 9, 9], [4, 1, 1, 5, 9, 9], [40, -9, -9, 41, 9, 9]], np.float32))
    assert walls.occluded(hull) and walls.list_occluders(hull).tolist() == [0] and walls.find_occluder(hull) == 0
    leaning = np.array([[4, -9, -9], [5, 9, -9], [5, 9, 9], [4, -9, 9]], np.float32)
    assert sc.Shafts.concatenate([hull]).occluded_by_polygon(leaning).tolist() == [True]
    with pytest.raises(ValueError, match="between_polygons"):
        walls.occluded(sc.ConvexHull(p))
    with pytest.raises(ValueError, match="q has no corner"):
        sc.ConvexHull.between_polygons(p, np.zeros((0, 3), np.float32))


def test_conservative_hulls_keep_boxes_that_no_single_face_leaves_out():
    corners = np.array([[0, 0, 0], [8, 2, 1], [1, 9, 3], [2, 1, 7]], np.float32)
    beyond_a_corner, inside, far = [-1, 10, 4, 3, 11, 6], [2, 2, 2, 3, 3, 3], [20, 0, 0, 21, 1, 1]
    boxes = np.array([beyond_a_corner, inside, far], np.float32)
    exact, rough = (sc.ConvexHull(corners, test=test) for test in ("exact", "conservative"))
    assert (exact.test, rough.test) == ("exact", "conservative")
    for make in (sc.BoxTree, sc.BoxStream):
        holder = make(boxes)
        assert holder.cull(exact).tolist() == [False, True, False]
        assert holder.cull(rough).tolist() == [True, True, False]


def test_shafts_keep_the_hulls_that_they_were_made_of():
    tree = sc.BoxTree(some_boxes(15, 200))
    wanted = tree.cull(sc.ConvexHull(CUBE))
    part = sc.Shafts.concatenate([sc.ConvexHull(CUBE), sc.ConvexHull(CUBE * 2)])[:1][[0, 0]]
    rubbish = [sc.ConvexHull(CUBE + np.float32(i)) for i in range(100)]
    np.testing.assert_array_equal(tree.cull(part), [wanted, wanted])
    assert len(rubbish) == 100


def test_frusta_see_what_is_in_view():
    view = sc.ConvexHull.frustum(VIEW, "zero_to_one")
    tree = sc.BoxTree([[0, 0, -3, 1, 1, -2], [0, 0, 2, 1, 1, 3], [4, 0, -3, 5, 1, -2], [0, 0, -12, 1, 1, -10]])
    np.testing.assert_array_equal(tree.cull(view), [True, False, False, False])
    light = view.casters([0, 20, -5])
    np.testing.assert_array_equal(tree.cull(light), [True, False, False, False])
    above = sc.BoxTree([[0, 15, -5, 1, 16, -4], [9, 15, -5, 10, 16, -4]])
    np.testing.assert_array_equal(above.cull(view), [False, False])
    np.testing.assert_array_equal(above.cull(light), [True, False])
    sun = view.casters_towards([0, 1, 0])
    np.testing.assert_array_equal(above.cull(sun), [True, False])
    np.testing.assert_array_equal(sun.directions, [[0, 1, 0]])
    assert sc.view_planes(VIEW, "zero_to_one").shape == (6, 4)
    np.testing.assert_array_equal(
        tree.cull(sc.Shafts.between([0, 0, -3, 0, 0, -3], [9, 0, -3, 9, 0, -3], planes_a=sc.view_planes(VIEW, "zero_to_one"))),
        [True, False, False, False],
    )
    opengl = sc.ConvexHull.frustum(VIEW, "minus_one_to_one")
    assert opengl.box[5] > view.box[5]
    for wrong, match in (
        (lambda: sc.ConvexHull.frustum(VIEW, "reversed"), "'reversed'"),
        (lambda: sc.ConvexHull.frustum(VIEW, "zero_to_one", test="quick"), "'quick'.*'exact' or 'conservative'"),
        (lambda: sc.ConvexHull(np.zeros((1, 3), np.float32), test="quick"), "'quick'.*'exact' or 'conservative'"),
        (lambda: sc.ConvexHull.frustum(VIEW[:3], "zero_to_one"), r"matrix has shape \(3, 4\)"),
        (lambda: sc.ConvexHull.frustum(np.zeros((4, 4), np.float32), "zero_to_one"), "invertible|matrix"),
        (lambda: sc.ConvexHull([]), "point"),
        (lambda: sc.ConvexHull(np.zeros((33, 3), np.float32)), "32"),
        (lambda: sc.ConvexHull([[0, 0, 0]], [[0, 0, 0]]), "direction"),
        (lambda: view.casters([[0, 0, 0]]), r"light has shape \(1, 3\)"),
    ):
        with pytest.raises(ValueError, match=match):
            wrong()


# Spheres.


def some_spheres(seed, count):
    random = np.random.default_rng(seed)
    return np.hstack([random.random((count, 3)) * 16 - 8, random.random((count, 1)) * 2]).astype(np.float32)


def sphere_layouts(spheres):
    return {
        "rows": spheres,
        "columns": np.asfortranarray(spheres),
        "pair": (spheres[:, :3], spheres[:, 3]),
        "pair by columns": (np.asfortranarray(spheres[:, :3]), spheres[:, 3].copy()),
        "four columns": tuple(np.ascontiguousarray(spheres.T)),
        "backwards": spheres[::-1].copy()[::-1],
        "list": spheres.tolist(),
    }


@pytest.mark.parametrize("layout", sphere_layouts(some_spheres(1, 2)))
@pytest.mark.parametrize("make", [sc.SphereTree, sc.SphereStream])
def test_spheres_are_outside_beyond_their_radius(make, layout, a, b):
    spheres = some_spheres(16, 60)
    a, b = a[:10], b[:10]
    distances = np.array([[oracle.distance(oracle.between(x, y), s) for s in spheres[:, :3]] for x, y in zip(a, b)])
    assert (abs(distances - spheres[:, 3]) > 1e-9).all()
    holder = make(sphere_layouts(spheres)[layout])
    kept = distances <= spheres[:, 3]
    assert kept.any() and not kept.all()
    np.testing.assert_array_equal(holder.cull(a, b), kept)
    np.testing.assert_array_equal(holder.count(a, b), kept.sum(1))
    shafts = sc.Shafts.between(a, b)
    indices, times = holder.first_contact(shafts)
    lists = holder.list(shafts, times=True)
    for row in range(10):
        if kept[row].any():
            mine = lists.times[lists.offsets[row] : lists.offsets[row + 1]]
            assert times[row] == mine.min() and indices[row] in lists[row]
        else:
            assert indices[row] == -1
    overlapping, inside = holder.count_classified(shafts)
    np.testing.assert_array_equal(overlapping + inside, kept.sum(1))
    np.testing.assert_array_equal(holder.classify(shafts)[1].sum(1), inside)


def test_sphere_views_answer_as_streams_do(a, b):
    spheres = some_spheres(17, 100)
    stream = sc.SphereStream(spheres)
    for given in (np.asfortranarray(spheres), tuple(np.ascontiguousarray(spheres.T))):
        np.testing.assert_array_equal(sc.SphereView(given).cull(a, b), stream.cull(a, b))
    with pytest.raises(ValueError, match="copies nothing"):
        sc.SphereView(spheres)
    with pytest.raises(sc.BadBound, match="7.*radius") as raised:
        bad = spheres.copy()
        bad[7, 3] = -1
        sc.SphereTree(bad)
    assert raised.value.index == 7
    with pytest.raises(TypeError, match="rounding='outwards'"):
        sc.SphereTree(spheres.astype(float))
    with pytest.raises(ValueError, match=r"\(n, 4\)"):
        sc.SphereTree(spheres[:, :3])
    tree = sc.SphereTree(spheres)
    tree.update(spheres[::-1].copy())
    np.testing.assert_array_equal(tree.cull(a, b), stream.cull(a, b)[:, ::-1])
    assert not hasattr(tree, "occluded")


@pytest.mark.parametrize("layout", ["tree", "stream", "view"])
def test_every_option_goes_with_spheres(layout, a, b):
    spheres = some_spheres(17, 100)
    make = {"tree": sc.SphereTree, "stream": sc.SphereStream, "view": lambda x: sc.SphereView(np.asfortranarray(x))}
    holder, shafts = make[layout](spheres), sc.Shafts.between(a * 4, b * 4)
    check_options(holder, shafts)
    found, times = holder.first_contact(shafts, exclude=4, layer_mask=0b110)
    lists = holder.list(shafts, exclude=4, layer_mask=0b110, times=True)
    for row, mine, index, time in zip(lists, np.split(lists.times, lists.offsets[1:-1]), found, times):
        assert time == mine.min(initial=np.inf) and (index in row or index == -1)


# Triangles.


def some_triangles(seed, count):
    random = np.random.default_rng(seed)
    corner = random.integers(-8, 8, (count, 1, 3))
    return (corner + random.integers(0, 4, (count, 3, 3))).astype(np.float32)


def triangle_holders(triangles):
    vertices = triangles.reshape(-1, 3)
    faces = np.arange(len(vertices)).reshape(-1, 3)
    wide = np.zeros((len(vertices), 5), dtype=np.float32)
    wide[:, 1:4] = vertices
    yield sc.TriangleTree(triangles)
    yield sc.TriangleStream(triangles)
    yield sc.TriangleStream(triangles.reshape(-1, 9))
    yield sc.TriangleStream(triangles.tolist())
    yield sc.TriangleStream(np.asfortranarray(triangles))
    yield sc.TriangleView(np.asfortranarray(triangles))
    yield sc.TriangleView(np.ascontiguousarray(triangles.reshape(-1, 9).T).T)
    yield sc.TriangleView(tuple(np.ascontiguousarray(triangles.reshape(-1, 9).T)))
    yield sc.TriangleStream(triangles[::-1].copy()[::-1])
    for dtype in (np.int64, np.uint32, np.int16):
        yield sc.TriangleTree(vertices, faces.astype(dtype))
        yield sc.TriangleStream(wide[:, 1:4], faces.astype(dtype))


def test_triangles_answer_alike_wherever_they_are(a, b):
    a, b = a * 2, b * 2
    triangles = some_triangles(18, 200)
    around = np.hstack([triangles.min(1), triangles.max(1)])
    boxes = sc.BoxStream(around).cull(a, b)
    exact = sc.TriangleStream(triangles).cull(a, b)
    assert (exact <= boxes).all() and (exact != boxes).any() and exact.any()
    corners = sc.BoxStream(np.tile(triangles.reshape(-1, 3), 2)).cull(a, b).reshape(len(a), -1, 3)
    inside = corners.all(2)
    assert (corners.any(2) <= exact).all() and inside.any()
    shafts = sc.Shafts.between(a, b)
    for holder in triangle_holders(triangles):
        assert len(holder) == 200
        np.testing.assert_array_equal(holder.cull(shafts), exact)
        np.testing.assert_array_equal(holder.cull(shafts, triangle_test="vertices"), boxes)
        np.testing.assert_array_equal(holder.classify(shafts), [exact, inside])
        np.testing.assert_array_equal(holder.classify(shafts, triangle_test="vertices"), [boxes, inside])
        np.testing.assert_array_equal(holder.count(shafts), exact.sum(1))
        np.testing.assert_array_equal(holder.any(shafts), exact.any(1))
        lists = holder.list(shafts)
        for row, bits in zip(lists, exact):
            np.testing.assert_array_equal(np.sort(row), np.flatnonzero(bits))
        assert holder.count(shafts[0]) == exact[0].sum() and holder.any(shafts[0]) is bool(exact[0].any())
        np.testing.assert_array_equal(holder.list(shafts[5]), lists[5])
        np.testing.assert_array_equal(holder.cull(shafts[5]), exact[5])


def test_every_option_goes_with_triangles(a, b):
    triangles = some_triangles(18, 200)
    shafts = sc.Shafts.between(a * 4, b * 4)
    for test in ("exact", "vertices"):
        check_options(sc.TriangleStream(triangles), shafts, triangle_test=test)
        check_options(sc.TriangleView(np.asfortranarray(triangles)), shafts, triangle_test=test)
        check_options(sc.TriangleTree(triangles), shafts, with_layers=False, triangle_test=test)


def test_triangles_are_asked_less_than_boxes():
    triangles, shaft = some_triangles(18, 20), sc.Shafts.between([0] * 6, [1] * 6)
    tree, stream = sc.TriangleTree(triangles), sc.TriangleStream(triangles)
    for holder in (tree, stream):
        assert not any(hasattr(holder, verb) for verb in ("first_contact", "entry_times", "occluded", "list_occluders"))
        with pytest.raises(ValueError):
            holder.list(shaft, times=True)
        with pytest.raises(ValueError, match="layer_mask"):
            holder.cull(shaft, layer_mask=1)
    with pytest.raises(ValueError, match="a tree of triangles has no layers"):
        tree.set_layers([1] * 20)
    tree.clear_layers()
    assert not tree.has_layers


def test_a_slanted_triangle_is_passed_by_where_its_box_is_not():
    triangle = np.array([[[0, 0, 0], [10, 10, 0], [10, 10, 1]]], dtype=np.float32)
    shaft = sc.Shafts.between([6, 1, 0, 7, 2, 1], [8, 1, 0, 9, 2, 1])
    tree = sc.TriangleTree(triangle)
    assert tree.any(shaft, triangle_test="vertices") and not tree.any(shaft)


def test_bad_triangles_are_refused():
    triangles = some_triangles(19, 10)
    triangles[4, 1, 1] = np.nan
    for make in (sc.TriangleTree, sc.TriangleStream):
        with pytest.raises(sc.BadBound, match="4") as raised:
            make(triangles)
        assert raised.value.index == 4
        with pytest.raises(IndexError, match="faces: number 2 is 3, but there are 3 vertices"):
            make(np.zeros((3, 3), np.float32), [[0, 1, 3]])
        with pytest.raises(IndexError, match="-1"):
            make(np.zeros((3, 3), np.float32), [[0, 1, -1]])
        with pytest.raises(ValueError, match=r"faces must have shape \(f, 3\)"):
            make(np.zeros((3, 3), np.float32), [0, 1, 2])
        with pytest.raises(ValueError, match=r"\(n, 3, 3\)"):
            make(np.zeros((3, 3), np.float32))
        with pytest.raises(TypeError, match="float64"):
            make(np.zeros((3, 3, 3)))
    tree = sc.TriangleTree(some_triangles(19, 10))
    hull = sc.ConvexHull(CUBE)
    assert tree.cull(hull, triangle_test="vertices").shape == (10,)
    inside, beside = [[0.2, 0.2, 0.2], [0.4, 0.2, 0.2], [0.2, 0.4, 0.2]], [[1.6, 0.8, 0], [0.8, 1.6, 0], [1.6, 1.6, 0]]
    two = sc.TriangleTree(np.array([inside, beside], np.float32))
    assert two.cull(hull).tolist() == [True, False]
    assert two.cull(hull, triangle_test="vertices").tolist() == [True, True]
    with pytest.raises(ValueError, match="triangle_test is 'loose'; it must be 'exact' or 'vertices'"):
        tree.cull(hull, triangle_test="loose")
    with pytest.raises(ValueError, match="copies nothing"):
        sc.TriangleView(some_triangles(19, 10))
    stream = sc.TriangleStream(some_triangles(19, 10))
    stream.update(some_triangles(20, 2), first=3)
    stream.update(np.zeros((3, 3), np.float32), first=9, faces=[[0, 1, 2]])
    changed = some_triangles(19, 10)
    changed[3:5], changed[9] = some_triangles(20, 2), 0
    shafts = sc.Shafts.between(some_boxes(2, 9), some_boxes(3, 9))
    np.testing.assert_array_equal(stream.cull(shafts), sc.TriangleStream(changed).cull(shafts))


def test_trees_of_triangles_are_updated():
    values, moved = some_triangles(21, 300), some_triangles(22, 300)
    tree, hull = sc.TriangleTree(values), sc.ConvexHull(CUBE)
    now = moved.copy()
    tree.update(moved)
    assert sorted(tree.list(hull)) == list(sc.TriangleStream(now).list(hull))
    tree.update(values[3:5], indices=[7, 9])
    now[[7, 9]] = values[3:5]
    assert tree.needs_refit
    with pytest.raises(sc.NeedsRefit):
        tree.list(hull)
    tree.refit()
    assert sorted(tree.list(hull)) == list(sc.TriangleStream(now).list(hull))
    tree.rebuild()
    assert tree.sah_ratio() == 1
    order = tree.order
    tree.reorder()
    assert sorted(tree.list(hull)) == list(sc.TriangleStream(now[order]).list(hull))
    faces = np.arange(900, dtype=np.int32).reshape(-1, 3)
    tree.update(now.reshape(-1, 3), faces=faces)
    assert sorted(tree.list(hull)) == list(sc.TriangleStream(now).list(hull))
    with pytest.raises(ValueError, match="299"):
        tree.update(now[:299])
