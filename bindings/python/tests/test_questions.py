# SPDX-License-Identifier: MIT
"""Every question, of every holder of boxes, against the definition."""

import numpy as np
import oracle
import pytest
import shaftcull as sc
from choices import check_options, choices, layers_of, lists_of_bits, rows, same_lists
from conftest import some_boxes

HOLDERS = {
    "tree": sc.BoxTree,
    "stream": sc.BoxStream,
    "view": lambda boxes: sc.BoxView(np.asfortranarray(boxes)),
}


@pytest.fixture(params=HOLDERS)
def holder(request, boxes):
    return HOLDERS[request.param](boxes)


KINDS = {
    "between": lambda a, b: (sc.Shafts.between(a, b), [oracle.between(x, y) for x, y in zip(a, b)]),
    "swept": lambda a, b: (sc.Shafts.swept(a, b[:, :3]), [oracle.swept(x, y[:3]) for x, y in zip(a, b)]),
    "without end": lambda a, b: (
        sc.Shafts.swept_infinite(a, b[:, :3] + np.float32(0.25)),
        [oracle.swept(x, y[:3] + np.float32(0.25), None) for x, y in zip(a, b)],
    ),
    "shadow": lambda a, b: (sc.Shafts.shadow(a - 20, b), [oracle.shadow(x - 20, y) for x, y in zip(a, b)]),
    "reach": lambda a, b: (sc.Shafts.shadow(a - 20, b, 1.25), [oracle.shadow(x - 20, y, 1.25) for x, y in zip(a, b)]),
}


@pytest.mark.parametrize("kind", KINDS)
def test_bits_counts_lists_and_times_are_those_of_the_definition(kind, holder, boxes, a, b):
    shafts, defined = KINDS[kind](a, b)
    kept = oracle.bits(defined, boxes, oracle.kept)
    assert kept.any() and not kept.all()
    np.testing.assert_array_equal(holder.cull(shafts), kept)
    np.testing.assert_array_equal(holder.count(shafts), kept.sum(1))
    np.testing.assert_array_equal(holder.count(shafts, limit=3), np.minimum(kept.sum(1), 3))
    np.testing.assert_array_equal(holder.any(shafts), kept.any(1))
    same_lists(rows(holder.list(shafts)), lists_of_bits(kept))
    lists = holder.list(shafts, times=True)
    for shaft, row, entered in zip(defined, rows(lists), np.split(lists.times, lists.offsets[1:-1])):
        np.testing.assert_array_equal(entered, [oracle.entry_time(shaft, boxes[i]) for i in row])
    for some, every in zip(rows(holder.list(shafts, limit=2)), rows(holder.list(shafts))):
        np.testing.assert_array_equal(some, every[:2])
    found, when = holder.first_contact(shafts)
    wanted = [oracle.first(shaft, boxes) for shaft in defined]
    np.testing.assert_array_equal(found, [index for index, _ in wanted])
    np.testing.assert_array_equal(when, [time for _, time in wanted])


@pytest.mark.parametrize("kind", ["between", "swept"])
def test_inside_is_that_of_the_definition(kind, holder, boxes, a, b):
    shafts, defined = KINDS[kind](a * 4, b * 4)
    kept = oracle.bits(defined, boxes, oracle.kept)
    inside = oracle.bits(defined, boxes, oracle.inside)
    assert inside.any() and (inside != kept).any()
    np.testing.assert_array_equal(holder.classify(shafts), [kept, inside])
    overlapping, contained = holder.count_classified(shafts)
    np.testing.assert_array_equal(overlapping, (kept & ~inside).sum(1))
    np.testing.assert_array_equal(contained, inside.sum(1))
    overlapping, contained = holder.list_classified(shafts)
    same_lists(rows(overlapping), lists_of_bits(kept & ~inside))
    same_lists(rows(contained), lists_of_bits(inside))
    np.testing.assert_array_equal(holder.cull(shafts.completed()), kept)


def test_one_shaft_has_the_answers_of_its_row(holder, boxes, a, b):
    shafts = sc.Shafts.between(a * 2, b * 2)
    lists = holder.list(shafts)
    for i in range(len(shafts)):
        one, row = shafts[i], lists[i]
        np.testing.assert_array_equal(holder.cull(one), holder.cull(shafts)[i])
        np.testing.assert_array_equal(holder.classify(one), np.array(holder.classify(shafts))[:, i])
        assert holder.count(one) == holder.count(shafts)[i] and isinstance(holder.count(one), int)
        assert holder.count(one, limit=2) == holder.count(shafts, limit=2)[i]
        assert holder.any(one) is bool(holder.any(shafts)[i])
        assert holder.count_classified(one) == tuple(x[i] for x in holder.count_classified(shafts))
        np.testing.assert_array_equal(holder.list(one), row)
        np.testing.assert_array_equal(holder.list(one, limit=3), row[:3])
        np.testing.assert_array_equal(holder.list(one, times=True)[1], holder.entry_times(one, row))
        for mine, all_of_them in zip(holder.list_classified(one), holder.list_classified(shafts)):
            np.testing.assert_array_equal(mine, all_of_them[i])
        assert holder.first_contact(one) == tuple(x[i] for x in holder.first_contact(shafts))
        np.testing.assert_array_equal(holder.list(one, only=row[::-1]), row[::-1])
        assert holder.occluded(one) is bool(holder.occluded(shafts)[i])
        assert holder.find_occluder(one) == holder.find_occluder(shafts)[i]
        np.testing.assert_array_equal(holder.list_occluders(one), holder.list_occluders(shafts)[i])


def test_boxes_ask_as_shafts_between_them_do(holder, a, b):
    np.testing.assert_array_equal(holder.cull(a, b), holder.cull(sc.Shafts.between(a, b)))
    np.testing.assert_array_equal(holder.list(a, b[0]).pairs(), holder.list(sc.Shafts.between(a, b[0])).pairs())
    assert holder.count(a[0], b[0]) == holder.count(a, b)[0]


def test_only_candidates_are_listed_in_their_order(holder, boxes, a, b):
    shafts = sc.Shafts.between(a, b)
    candidates = np.random.default_rng(5).permutation(len(boxes))[:70]
    kept = holder.cull(shafts)
    wanted = [[i for i in candidates if row[i]] for row in kept]
    found = rows(holder.list(shafts, only=candidates))
    assert [list(row) for row in found] == wanted


def test_packed_bits_are_the_same_bits(holder, boxes, a, b):
    shafts = sc.Shafts.between(a, b)
    words = holder.cull(shafts, packed=True)
    assert words.shape == (len(a), (len(boxes) + 63) // 64) and words.dtype == np.uint64
    unpacked = np.unpackbits(words.view(np.uint8), axis=1, bitorder="little")[:, : len(boxes)].astype(bool)
    np.testing.assert_array_equal(unpacked, holder.cull(shafts))
    assert holder.cull(shafts[0], packed=True).shape == words.shape[1:]


def test_a_wall_blocks_and_a_post_does_not():
    wall, post = [0, -9, -9, 1, 9, 9], [0, -9, 0, 1, 9, 0.5]
    for make in HOLDERS.values():
        for solids, by in (([wall], 0), ([post], -1), ([post, wall], 1)):
            holder = make(np.array(solids, dtype=np.float32))
            shafts = sc.Shafts.between([[-5, 0, 0, -4, 1, 1]] * 2, [[5, 0, 0, 6, 1, 1], [-5, 5, 5, -4, 6, 6]])
            np.testing.assert_array_equal(holder.occluded(shafts), [by >= 0, False])
            np.testing.assert_array_equal(holder.find_occluder(shafts), [by, -1])
            np.testing.assert_array_equal(holder.list_occluders(shafts)[0], [by] if by >= 0 else [])
    square = [[0, -9, -9], [0, 9, -9], [1, 9, 9], [1, -9, 9]]
    np.testing.assert_array_equal(shafts.occluded_by_polygon(square), [True, False])
    assert shafts[0].occluded_by_polygon(square) is True


def test_open_contact_leaves_out_what_touches():
    patch, other = [0, 0, 0, 1, 1, 0], [0, 0, 4, 1, 1, 4]
    tree = sc.BoxTree([[0, 0, -1, 1, 1, 0], [0, 0, 2, 1, 1, 3], [1, 0, 0, 2, 1, 4]])
    shafts = sc.Shafts.between(patch, other)
    np.testing.assert_array_equal(tree.cull(shafts), [True, True, True])
    np.testing.assert_array_equal(tree.cull(shafts.with_contact("open")), [False, True, False])
    np.testing.assert_array_equal(tree.cull(sc.Shafts.between(patch, other, contact="open")), [False, True, False])
    assert shafts.with_contact("open").open_contact is True and shafts.open_contact is False
    moving = sc.Shafts.swept([patch], [0, 0, 4], contact="open")
    np.testing.assert_array_equal(tree.cull(moving), [[False, True, False]])


def test_planes_leave_out_what_is_beyond_them():
    a, b = some_boxes(7, 5), some_boxes(8, 5) + 1
    boxes = some_boxes(9, 200)
    for_all = np.array([[0, 0, 1, 0.25]], dtype=np.float32)
    for_each = np.tile(np.array([1, 0, 0, 0], dtype=np.float32), (5, 1, 1))
    for_each[:, 0, 3] = np.arange(5) - 2
    behind = boxes[:, 2] <= 0.25
    low = boxes[None, :, 0] <= for_each[:, 0, 3, None]
    tree = sc.BoxTree(boxes)
    every = tree.cull(a, b)
    assert (every & behind).sum() < every.sum() and (every & low).sum() < every.sum()
    np.testing.assert_array_equal(tree.cull(sc.Shafts.between(a, b, planes_a=for_all)), every & behind)
    both = sc.Shafts.between(a, b, planes_a=for_each, planes_b=for_all)
    np.testing.assert_array_equal(tree.cull(both), every & behind & low)
    moving = sc.Shafts.swept(a, b[:, :3], planes=for_each)
    np.testing.assert_array_equal(tree.cull(moving), tree.cull(sc.Shafts.swept(a, b[:, :3])) & low)
    copied = sc.Shafts.swept(a[0], b[:, :3], planes=for_all)
    np.testing.assert_array_equal(tree.cull(copied), tree.cull(sc.Shafts.swept(a[0], b[:, :3])) & behind)


def test_every_option_goes_with_every_holder_and_question(holder, a, b):
    check_options(holder, sc.Shafts.between(a * 4, b * 4))


def test_first_contact_is_among_the_bounds_that_options_leave(holder, boxes, a, b):
    shafts, defined = KINDS["swept"](a, b)
    times = [[oracle.times(shaft, box) for box in boxes] for shaft in defined]
    kept = np.array([[time is not None for time in row] for row in times])
    holder.set_layers(layers_of(len(boxes)))
    for options, left in choices(kept, layers_of(len(boxes))):
        reached = [
            min(((row[i][0], i) for i in np.flatnonzero(bits)), default=(None, -1))
            for row, bits in zip(times, kept & left)
        ]
        found, when = holder.first_contact(shafts, **options)
        np.testing.assert_array_equal(found, [index for _, index in reached])
        entered = [np.inf if i < 0 else oracle.entry_time(shaft, boxes[i]) for shaft, (_, i) in zip(defined, reached)]
        np.testing.assert_array_equal(when, np.float32(entered))
        lists = holder.list(shafts, times=True, **options)
        for row, mine, first in zip(rows(lists), np.split(lists.times, lists.offsets[1:-1]), entered):
            assert len(row) == len(mine) and mine.min(initial=np.inf) == first
    me = int(kept[3].argmax())
    assert holder.first_contact(shafts[3], exclude=me) == tuple(x[3] for x in holder.first_contact(shafts, exclude=me))


@pytest.mark.parametrize("hold", [sc.BoxStream, sc.BoxTree])
def test_first_contact_skips_what_overlaps_the_start(hold):
    floor, overlapping = [-9, -1, -9, 9, 0, 9], [0.5, 0.5, 0, 2, 2, 2]
    wall, far = [1, 0, 0, 2, 1, 1], [4, 0, 0, 5, 1, 1]
    holder = hold(np.float32([floor, overlapping, wall, far]))
    ends = np.float32([0, 0, 0, 1, 1, 1]), np.float32([8, 0, 0, 9, 1, 1])
    closed, opened = sc.Shafts.between(*ends), sc.Shafts.between(*ends, contact="open")
    assert holder.first_contact(closed) == (0, 0) == holder.first_contact(closed, skip_overlapping=False)
    assert holder.first_contact(closed, skip_overlapping=True) == (3, 0.375)
    assert holder.first_contact(opened) == (1, 0)
    assert holder.first_contact(opened, skip_overlapping=True) == (2, 0)
    found, when = holder.first_contact(*(np.stack([end, end]) for end in ends), skip_overlapping=True)
    assert found.tolist() == [3, 3] and when.tolist() == [0.375, 0.375]
    assert holder.first_contact(closed, skip_overlapping=True, exclude=3) == (-1, np.inf)
    with pytest.raises(TypeError, match="first_contact"):
        holder.first_contact(closed, skip_overlapping="yes")
    with pytest.raises(TypeError, match="count"):
        holder.count(closed, skip_overlapping=True)


@pytest.mark.parametrize("hold", [sc.BoxStream, sc.BoxTree])
def test_normals_of_contact_point_from_the_box_to_the_body(hold):
    floor, wall = [-9, -1, -9, 9, 0, 9], [4, 0, 0, 5, 1, 1]
    holder = hold(np.float32([floor, wall]))
    body = np.float32([0, 0.5, 0, 1, 1.5, 1])
    shafts = sc.Shafts.swept(body, np.float32([[0, -4, 0], [8, 0, 0], [0, 4, 0]]))
    found, when, normals = holder.first_contact(shafts, normals=True)
    assert normals.dtype == np.float32 and normals.tolist() == [[0, 1, 0], [-1, 0, 0], [0, 0, 0]]
    np.testing.assert_array_equal((found, when), holder.first_contact(shafts))
    index, time, normal = holder.first_contact(shafts[0], normals=True)
    assert (index, time, normal.tolist()) == (0, 0.125, [0, 1, 0]) and normal.shape == (3,)
    assert holder.first_contact(shafts[:0], normals=True)[2].shape == (0, 3)
    ball = sc.SphereTree(np.float32([[8, 4.5, 0.5, 5]]))  # 4, 3 and 5
    normal = ball.first_contact(sc.Shafts.swept(body, [16, 0, 0]), normals=True)[2]
    np.testing.assert_array_equal(normal, np.float32([-0.8, -0.6, 0]))


def test_solids_are_left_out_as_other_bounds_are():
    walls = np.array([[0, -9, -9, 1, 9, 9], [2, -9, -9, 3, 9, 9], [0, -9, 0, 1, 9, 0.5]], dtype=np.float32)
    shafts = sc.Shafts.between([[-5, 0, 0, -4, 1, 1]] * 2, [6, 0, 0, 7, 1, 1])
    for make in HOLDERS.values():
        holder = make(walls)
        holder.set_layers([1, 2, 4])
        for options, wanted in (
            (dict(), [[0, 1], [0, 1]]),
            (dict(exclude=0), [[1], [1]]),
            (dict(exclude=[0, 1]), [[], []]),
            (dict(exclude_each=[[0, 0], [0, 1]]), [[1], []]),
            (dict(exclude_each=[1, 0]), [[0], [1]]),
            (dict(exclude_mask=[True, False, False]), [[1], [1]]),
            (dict(layer_mask=0b110), [[1], [1]]),
            (dict(layer_mask=[1, 4]), [[0], []]),
            (dict(layer_mask=3, exclude=1, exclude_each=[2, 0]), [[0], []]),
        ):
            np.testing.assert_array_equal(holder.occluded(shafts, **options), [len(row) > 0 for row in wanted])
            blocking = rows(holder.list_occluders(shafts, **options))
            same_lists(blocking, wanted)
            np.testing.assert_array_equal(
                holder.find_occluder(shafts, **options), [row[0] if len(row) else -1 for row in blocking]
            )
            for some, every in zip(rows(holder.list_occluders(shafts, limit=1, **options)), blocking):
                np.testing.assert_array_equal(some, every[:1])
        assert holder.occluded(shafts[0], exclude=0) is True and holder.occluded(shafts[0], exclude=[0, 1]) is False
        assert holder.find_occluder(shafts[0], layer_mask=2) == 1 and holder.find_occluder(shafts[0], layer_mask=4) == -1
        np.testing.assert_array_equal(holder.list_occluders(shafts[0], exclude=1), [0])
        assert len(holder.list_occluders(shafts[0], limit=1)) == 1


def test_layers_are_changed_and_forgotten(holder, boxes, a, b):
    every = holder.cull(a, b)
    layers = 1 << (np.arange(len(boxes)) % 5)
    assert not holder.has_layers
    with pytest.raises(ValueError, match="layer_mask chooses among layers, and these bounds have none"):
        holder.cull(a, b, layer_mask=1)
    with pytest.raises(ValueError, match="layers"):
        holder.set_layers([1], indices=[0])
    holder.set_layers(layers)
    assert holder.has_layers
    np.testing.assert_array_equal(holder.cull(a, b, layer_mask=0b101), every & ((layers & 0b101) != 0))
    holder.set_layers([0, 2**32 - 1, 8], indices=[1, 2, 3])
    layers[[1, 2, 3]] = 0, 2**32 - 1, 8
    for mask in (0, 1, 8, 2**31, 2**32 - 1):
        np.testing.assert_array_equal(holder.cull(a, b, layer_mask=mask), every & ((layers & mask) != 0))
    np.testing.assert_array_equal(holder.cull(a, b), every)
    for wrong, error, words in (
        (lambda: holder.set_layers([1, 2]), ValueError, "150 bounds.*2"),
        (lambda: holder.set_layers([-1] * 150), ValueError, "0 to 2"),
        (lambda: holder.set_layers([2**32] * 150), ValueError, "0 to 2"),
        (lambda: holder.set_layers([1, 2], indices=[1]), ValueError, "1 ind.*2"),
        (lambda: holder.set_layers([1], indices=[150]), IndexError, "indices: number 0 is 150"),
        (lambda: holder.set_layers([0.5] * 150), TypeError, "integers"),
    ):
        with pytest.raises(error, match=words):
            wrong()
    np.testing.assert_array_equal(holder.cull(a, b, layer_mask=8), every & ((layers & 8) != 0))
    holder.clear_layers()
    assert not holder.has_layers
    with pytest.raises(ValueError, match="layer_mask"):
        holder.any(a, b, layer_mask=1)


def test_questions_refuse_options_that_mean_nothing_to_them(holder, a, b):
    shafts = sc.Shafts.between(a, b)
    wrong = [(verb, "limit") for verb in ("cull", "any", "classify", "count_classified", "list_classified", "first_contact")]
    wrong += [(verb, "limit") for verb in ("occluded", "find_occluder")]
    wrong += [(verb, "only") for verb in ("occluded", "find_occluder", "list_occluders")]
    wrong += [(verb, "triangle_test") for verb in ("first_contact", "occluded", "find_occluder", "list_occluders")]
    for verb, option in wrong:
        with pytest.raises(TypeError, match=verb):
            getattr(holder, verb)(shafts, **{option: "exact" if option == "triangle_test" else 1})
    for verb in ("cull", "any", "classify", "count", "count_classified", "list", "list_classified"):
        getattr(holder, verb)(shafts, triangle_test="exact")
        with pytest.raises(ValueError, match="^triangle_test"):
            getattr(holder, verb)(shafts, triangle_test="vertices")


def test_many_shafts_asked_in_chunks_have_the_answers_of_rows(million):
    boxes = million[:2000]
    tree, shafts = sc.BoxTree(boxes), sc.Shafts.between(million[:20000], million[20000:40000])
    lists = tree.list(shafts)
    counts = tree.count(shafts)
    np.testing.assert_array_equal(np.diff(lists.offsets), counts)
    random = np.random.default_rng(7)
    each, masks = random.integers(0, 2000, (20000, 3)), random.integers(0, 32, 20000)
    each[:, 0] = lists.indices[np.minimum(lists.offsets[:-1], len(lists.indices) - 1)]
    tree.set_layers(layers_of(2000))
    some = tree.count(shafts, exclude_each=each, layer_mask=masks)
    fewer = tree.list(shafts, exclude_each=each, layer_mask=masks)
    np.testing.assert_array_equal(np.diff(fewer.offsets), some)
    for i in (0, 15, 16, 17, 63, 64, 1039, 1040, 4159, 4160, 19999):
        np.testing.assert_array_equal(lists[i], tree.list(shafts[i]))
        assert counts[i] == tree.count(shafts[i])
        mine = dict(exclude=each[i], layer_mask=masks[i])
        np.testing.assert_array_equal(fewer[i], tree.list(shafts[i], **mine))
        assert some[i] == tree.count(shafts[i], **mine)


def test_trees_follow_their_bounds(boxes, a, b):
    shafts = sc.Shafts.between(a, b)
    moved = boxes + np.float32(0.5)
    tree = sc.BoxTree(boxes)
    tree.update(moved)
    np.testing.assert_array_equal(tree.cull(shafts), sc.BoxStream(moved).cull(shafts))
    tree.update(boxes[:3], indices=[5, 7, 9])
    assert tree.needs_refit
    with pytest.raises(sc.NeedsRefit):
        tree.count(shafts)
    assert issubclass(sc.NeedsRefit, RuntimeError)
    tree.refit()
    moved[[5, 7, 9]] = boxes[:3]
    np.testing.assert_array_equal(tree.cull(shafts), sc.BoxStream(moved).cull(shafts))
    assert tree.sah_ratio() > 0
    np.testing.assert_array_equal(tree.box, np.hstack([moved[:, :3].min(0), moved[:, 3:].max(0)]))
    tree.rebuild()
    order = tree.order
    assert sorted(order) == list(range(len(boxes)))
    tree.reorder()
    np.testing.assert_array_equal(tree.order, np.arange(len(boxes)))
    np.testing.assert_array_equal(tree.cull(shafts), sc.BoxStream(moved[order]).cull(shafts))
    assert len(tree) == len(boxes) and tree.memory_bytes > 28 * len(boxes)


def test_streams_follow_their_bounds(boxes, a, b):
    stream = sc.BoxStream(boxes)
    stream.update(boxes[:10] + np.float32(1), first=20)
    changed = boxes.copy()
    changed[20:30] = boxes[:10] + np.float32(1)
    np.testing.assert_array_equal(stream.cull(a, b), sc.BoxTree(changed).cull(a, b))
    stream.set_layers(layers_of(len(boxes)))
    stream.update(boxes)
    wanted = sc.BoxTree(boxes).cull(a, b) & ((layers_of(len(boxes)) & 6) != 0)
    np.testing.assert_array_equal(stream.cull(a, b, layer_mask=6), wanted)
    assert stream.memory_bytes >= 24 * len(boxes) and len(stream) == len(boxes)


def test_nothing_and_no_shafts_are_fine(boxes, a):
    none = np.empty((0, 6), dtype=np.float32)
    for make in HOLDERS.values():
        empty = make(none)
        assert len(empty) == 0 and empty.count(a, a).sum() == 0 and empty.cull(a, a).shape == (len(a), 0)
        assert empty.first_contact(a[0], a[0]) == (-1, np.inf)
        empty.set_layers([])
        assert empty.count(a, a, layer_mask=1, only=[], exclude=[], exclude_mask=np.zeros(0, bool)).sum() == 0
        holder = make(boxes)
        lists = holder.list(none, none)
        assert list(lists.offsets) == [0] and len(lists.indices) == len(lists) == 0
        holder.set_layers(layers_of(len(boxes)))
        assert len(holder.list(none, none, exclude_each=np.empty((0, 2), int), layer_mask=[])) == 0
        assert holder.cull(none, none).shape == (0, len(boxes)) and len(holder.first_contact(none, none)[0]) == 0
