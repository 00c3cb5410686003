# SPDX-License-Identifier: MIT
"""Dynamic trees: what they answer, by streams of the same bounds, and what they refuse."""

import threading

import numpy as np
import pytest
import shaftcull

INDEX = 0xFFFFFFFF


def some_boxes(random, count):
    lo = random.uniform(0, 10, (count, 3))
    return np.hstack([lo, lo + random.uniform(0.1, 1, (count, 3))]).astype(np.float32)


def some_spheres(random, count):
    return np.hstack([random.uniform(0, 10, (count, 3)), random.uniform(0.1, 1, (count, 1))]).astype(np.float32)


KINDS = [
    (shaftcull.DynamicBoxTree, shaftcull.BoxStream, some_boxes),
    (shaftcull.DynamicSphereTree, shaftcull.SphereStream, some_spheres),
]


@pytest.mark.parametrize("dynamic, stream, some", KINDS)
def test_answers_are_those_of_a_stream(dynamic, stream, some):
    random = np.random.default_rng(1)
    shafts = shaftcull.Shafts.between(some_boxes(random, 20), some_boxes(random, 20))
    tree = dynamic()
    alive = {}
    for frame in range(12):
        bounds = some(random, 300)
        for number, bound in zip(tree.insert(bounds), bounds):
            alive[int(number)] = bound
        leaving = random.permutation(list(alive))[:100]
        tree.erase(leaving)
        for number in leaving:
            del alive[int(number)]
        moving = random.permutation(list(alive))[:50]
        moved = some(random, 50)
        tree.move(moving, moved)
        alive.update(zip(map(int, moving), moved))
        shaken = random.permutation(list(alive))[:20]
        tree.move_by(shaken, np.float32(random.uniform(-1, 1, (20, 3))))
        alive.update(zip(map(int, shaken), tree.values(shaken)))
        assert tree.bound_count == len(alive)
        tree.commit()
        numbers = list(alive)
        indices = np.array([number & INDEX for number in numbers])
        wanted = stream(np.array(list(alive.values()))).cull(shafts)
        kept = tree.cull(shafts)
        assert np.array_equal(kept[:, indices], wanted)
        assert kept.sum() == wanted.sum()
        overlapping, inside = stream(np.array(list(alive.values()))).count_classified(shafts)
        assert np.array_equal(tree.count_classified(shafts), (overlapping, inside))
        assert np.array_equal(tree.count(shafts), wanted.sum(axis=1))
        lists = tree.list(shafts)
        for s in range(20):
            assert set(lists[s].tolist()) == set(indices[wanted[s]].tolist())
        assert np.array_equal(tree.ids_of(indices), numbers)


@pytest.mark.parametrize("dynamic, stream, some", KINDS)
def test_snapshots_stay_as_they_are(dynamic, stream, some):
    random = np.random.default_rng(2)
    bounds = some(random, 1000)
    tree = dynamic()
    ids = tree.insert(bounds)
    tree.commit()
    before = tree.snapshot()
    tree.erase(ids[:500])
    assert len(tree) == 1000 and tree.bound_count == 500
    tree.commit()
    shaft = shaftcull.Shafts.between([0, 0, 0, 1, 1, 1], [9, 9, 9, 10, 10, 10])
    assert np.array_equal(before.cull(shaft), stream(bounds).cull(shaft))
    assert before.bound_count == 1000 and tree.snapshot().bound_count == 500
    tree.rebuild()
    assert tree.upkeep["sorted_last"] == 500
    assert not tree.cull(shaft)[:500].any()
    assert np.array_equal(tree.cull(shaft)[500:], stream(bounds[500:]).cull(shaft))
    with pytest.raises(ValueError, match="a snapshot never changes"):
        before.set_layers(np.zeros(1000, dtype=int))


def test_layers_choose_what_is_asked():
    tree = shaftcull.DynamicBoxTree()
    everything = shaftcull.Shafts.between([-9, -9, -9, 9, 9, 9], [-9, -9, -9, 9, 9, 9])
    one = tree.insert([0, 0, 0, 1, 1, 1], layers=1)
    two = tree.insert([[0, 0, 0, 1, 1, 1]] * 2, layers=[2, 3])
    tree.commit()
    assert isinstance(one, int) and two.shape == (2,)
    assert tree.list(everything, layer_mask=1).tolist() == [0, 2]
    assert tree.list(everything, layer_mask=2).tolist() == [1, 2]
    tree.set_layers([4], indices=[0])
    tree.commit()
    assert tree.list(everything, layer_mask=4).tolist() == [0]
    tree.clear_layers()
    tree.commit()
    assert tree.list(everything, layer_mask=1 << 31).tolist() == [0, 1, 2]


def test_ids_are_of_one_bound_and_never_of_another():
    tree = shaftcull.DynamicBoxTree()
    first = tree.insert([0, 0, 0, 1, 1, 1])
    tree.erase(first)
    second = tree.insert([0, 0, 0, 2, 2, 2])
    assert second & INDEX == first & INDEX and second != first
    assert second in tree and first not in tree
    assert np.array_equal(tree.values(second), [0, 0, 0, 2, 2, 2])
    for refused in (
        lambda: tree.erase(first),
        lambda: tree.move(first, [0, 0, 0, 1, 1, 1]),
        lambda: tree.move_by(first, [1, 0, 0]),
        lambda: tree.values(first),
    ):
        with pytest.raises(ValueError, match="index 0 of generation 0, was erased"):
            refused()
    with pytest.raises(ValueError, match="occurs twice"):
        tree.erase([second, second])
    with pytest.raises(ValueError, match="is no id of this tree"):
        tree.erase(77)
    assert second in tree


def test_wrong_arguments_are_named():
    tree = shaftcull.DynamicBoxTree()
    number = tree.insert([0, 0, 0, 1, 1, 1])
    with pytest.raises(TypeError, match="ids must be integers"):
        tree.erase(0.5)
    with pytest.raises(TypeError, match="ids must be integers"):
        tree.erase("one")
    with pytest.raises(ValueError, match="ids"):
        tree.erase([[number]])
    with pytest.raises(shaftcull.BadBound):
        tree.insert([0, 0, 0, 1, -1, 1])
    with pytest.raises(ValueError, match=r"insert\(\) got 2 bounds and 3 layers"):
        tree.insert([[0, 0, 0, 1, 1, 1]] * 2, layers=[1, 2, 3])
    with pytest.raises(ValueError, match=r"move\(\) got 1 ids and 2 bounds"):
        tree.move([number], [[0, 0, 0, 1, 1, 1]] * 2)
    with pytest.raises(ValueError, match="sorted_per_change"):
        tree.set_sorted_per_change(-1)
    assert tree.bound_count == 1
    assert tree.insert(np.zeros((0, 6), np.float32)).size == 0
    tree.commit()
    assert tree.upkeep["blocks"] == 1 and tree.memory_bytes > 0
    assert tree.snapshot().box.tolist() == [0, 0, 0, 1, 1, 1]


def test_threads_read_snapshots_while_the_tree_changes():
    random = np.random.default_rng(3)
    tree = shaftcull.DynamicBoxTree()
    everything = shaftcull.Shafts.between([-1, -1, -1, 12, 12, 12], [-1, -1, -1, 12, 12, 12])
    ids = tree.insert(some_boxes(random, 5000))
    tree.commit()
    is_over = threading.Event()
    faults = []

    def read():
        while not is_over.is_set():
            now = tree.snapshot()
            if now.bound_count != 5000 or now.count_classified(everything)[1] != 5000:
                faults.append(now.bound_count)

    readers = [threading.Thread(target=read) for _ in range(2)]
    for reader in readers:
        reader.start()
    for _ in range(20):
        tree.erase(ids[:50])
        ids = np.concatenate([ids[50:], tree.insert(some_boxes(random, 50))])
        tree.commit()
    is_over.set()
    for reader in readers:
        reader.join()
    assert not faults
