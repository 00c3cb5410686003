# SPDX-License-Identifier: MIT
"""What sees what, against a definition in fractions and the package's own questions of single pairs."""

import itertools
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time
from fractions import Fraction as F

import numpy as np
import oracle
import pytest
import shaftcull as sc
from conftest import some_boxes

KINDS = ("undecided", "clear", "occluded", "facing_away")
EXAMPLES = pathlib.Path(__file__).parents[1] / "examples"


def test_corners_make_patches():
    leaning = np.array([[[0, 0, 0], [1, 0, 1], [1, 1, 1]], [[0, 0, 0], [1, 1, 1], [0, 1, 0]]], np.float32)  # one square
    assert sc.count_visibility(leaning)["facing_away"] == 1
    assert sc.count_visibility(sc.Patches(leaning))["facing_away"] == 1
    low = np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]], np.float32)
    above = [np.array([[0, 0, 0.125], [0, 1, 0.125], [1, 1, 0.125], [1, 0, 0.125]], np.float32)]
    assert sc.count_visibility(low, above)["clear"] == 1
    assert sc.count_visibility(low, above, tolerance=0.125)["facing_away"] == 1
    of_both = sc.Patches(leaning, sides="both")
    assert sc.Patches(leaning).has_planes and not of_both.has_planes
    assert sc.count_visibility(of_both)["facing_away"] == 1
    assert sc.count_visibility(of_both, above)["clear"] == 2
    with pytest.raises(ValueError, match="sides is 'back'; it must be 'front' or 'both'"):
        sc.Patches(leaning, sides="back")
    with pytest.raises(ValueError, match="sides is 'both', but boxes are Patches already"):
        sc.Patches(sc.Patches(leaning), sides="both")
    with pytest.raises(ValueError, match="planes are given, but sides is 'both'"):
        sc.Patches([[0, 0, 0, 1, 1, 1]], planes=[0, 0, 1, 0], sides="both")
    with pytest.raises(ValueError, match="planes are given, but patches are corners"):
        sc.count_visibility(low, planes=[0, 0, 1, 0])
    with pytest.raises(ValueError, match="3 to 8"):
        sc.Patches([np.zeros((2, 3), np.float32)])


def corners(box):
    return [[F(float(box[i + 3 * (c >> i & 1)])) for i in range(3)] for c in range(8)]


def is_behind(box, plane):
    """Whether all of a box lies on or behind a plane."""
    n = oracle.exact(plane)
    return all(sum(x * y for x, y in zip(n, p)) <= n[3] for p in corners(box))


def reaches_in(a, b, plane_a, plane_b, occluder, contact):
    """Whether an occluder's box reaches into the shaft of a pair."""
    if any(plane is not None and is_behind(occluder, plane) for plane in (plane_a, plane_b)):
        return False
    if contact == "closed":
        return oracle.kept(oracle.between(a, b), occluder)
    return bool(sc.BoxTree(occluder[None]).any(sc.Shafts.between(a, b, contact="open")))


def expectation(a, b, plane_a, plane_b, occluders, hiding, contact="open"):
    """What may be said of a pair, and its candidates. hiding: boxes, and those that are one together."""
    candidates = [i for i, box in enumerate(occluders) if reaches_in(a, b, plane_a, plane_b, box, contact)]
    true = set()
    if any(p is not None and is_behind(x, p) for x, p in ((b, plane_a), (a, plane_b))):
        true.add("facing_away")
    if len(hiding) and sc.BoxTree(hiding).occluded(sc.Shafts.between(a, b)):
        true.add("occluded")
    return (true or {"undecided" if candidates else "clear"}), candidates


def check(found, a, b, planes_a, planes_b, occluders, hiding, contact="open"):
    """Every pair is what the definition says, and in one place only."""
    said = {}
    for kind in KINDS:
        for i, j in found.pairs(kind):
            assert (i, j) not in said
            said[i, j] = kind
    one_set = b is None
    others, planes_b = (a, planes_a) if one_set else (b, planes_b)
    every = itertools.combinations(range(len(a)), 2) if one_set else np.ndindex(len(a), len(others))
    number = 0
    for i, j in every:
        if (i, j) not in said:
            assert one_set
            i, j = j, i
        allowed, wanted = expectation(
            a[i], others[j], planes_a if planes_a is None else planes_a[i], planes_b if planes_b is None else planes_b[j],
            occluders, hiding, contact,
        )  # fmt: skip
        assert said[i, j] in allowed, (i, j, allowed)
        number += 1
        if said[i, j] == "undecided":
            at = np.flatnonzero((found.undecided == (i, j)).all(1))
            assert len(at) == 1
            assert list(found.candidates[at[0]]) == wanted
    assert len(said) == number == sum(found.counts.values())
    assert {kind: found.counts[kind] for kind in KINDS} == {kind: list(said.values()).count(kind) for kind in KINDS}
    return found.counts


def planes_of(seed, count):
    random = np.random.default_rng(seed)
    planes = random.integers(-2, 3, (count, 4)).astype(np.float32)
    planes[(planes[:, :3] == 0).all(1), 0] = 1
    planes[:, 3] *= 2
    return planes


def test_pairs_are_what_the_definition_says():
    total = dict.fromkeys(KINDS, 0)
    for seed, contact, with_planes in itertools.product((1, 2), ("open", "closed"), (False, True)):
        a, b = some_boxes(seed, 14, 12), some_boxes(seed + 10, 12, 12)
        may, solid = some_boxes(seed + 20, 3, 10), some_boxes(seed + 30, 5, 8)
        solid[:, 3:] += 3
        planes_a, planes_b = (planes_of(seed, 14), planes_of(seed + 5, 12)) if with_planes else (None, None)
        hiding = sc.merged_boxes(solid)
        occluders = np.vstack([may, solid])
        options = dict(occluders=may, solids=solid, contact=contact)
        found = sc.visibility(a, b, planes=planes_a, planes_b=planes_b, **options)
        counts = check(found, a, b, planes_a, planes_b, occluders, np.vstack([hiding, solid]), contact)
        assert sc.count_visibility(a, b, planes=planes_a, planes_b=planes_b, **options) == counts
        for kind in KINDS:
            total[kind] += counts[kind]
        found = sc.visibility(a, planes=planes_a, **options)
        counts = check(found, a, None, planes_a, None, occluders, np.vstack([hiding, solid]), contact)
        assert sum(counts.values()) == 14 * 13 // 2
        assert sc.count_visibility(a, planes=planes_a, **options) == counts
    assert min(total.values()) > 20, total


def test_blocks_orders_and_bits_are_of_the_same_pairs():
    a, b = some_boxes(1, 70), some_boxes(2, 65)
    found = sc.visibility(a, b, planes=planes_of(1, 70), occluders=some_boxes(3, 4), solids=some_boxes(4, 6))
    assert found.blocks.shape == (len(found.sights), 4) and found.blocks.dtype == np.uint32
    assert not found.blocks.flags.writeable and not found.undecided.flags.writeable
    assert set(np.unique(found.sights)) <= {1, 2, 3} and found.sights.dtype == np.uint8
    seen = np.zeros((70, 65), dtype=int)
    bits = {kind: np.zeros((70, 65), dtype=bool) for kind in KINDS}
    for (first_a, count_a, first_b, count_b), sight in zip(found.blocks, found.sights):
        block = np.ix_(found.order_a[first_a : first_a + count_a], found.order_b[first_b : first_b + count_b])
        seen[block] += 1
        bits[KINDS[sight]][block] = True
    seen[tuple(found.undecided.T)] += 1
    bits["undecided"][tuple(found.undecided.T)] = True
    assert (seen == 1).all()
    for kind in KINDS:
        np.testing.assert_array_equal(found.bits(kind), bits[kind])
        words = found.bits(kind, packed=True)
        assert words.shape == (70, 2) and words.dtype == np.uint64
        unpacked = np.unpackbits(words.view(np.uint8), axis=1, bitorder="little")[:, :65]
        np.testing.assert_array_equal(unpacked, bits[kind])
    one = sc.visibility(a, occluders=some_boxes(3, 4))
    both = sum(one.bits(kind).astype(int) for kind in KINDS)
    np.testing.assert_array_equal(both, 1 - np.eye(70, dtype=int))
    np.testing.assert_array_equal(one.bits("clear"), one.bits("clear").T)


def test_answers_outlive_what_they_are_of():
    found = sc.visibility(some_boxes(1, 70), occluders=some_boxes(3, 9))
    pairs, wanted = found.undecided, found.undecided.copy()
    candidates = found.candidates
    wanted_candidates = candidates.pairs()
    del found
    sc.visibility(some_boxes(5, 70), occluders=some_boxes(6, 9))
    np.testing.assert_array_equal(pairs, wanted)
    np.testing.assert_array_equal(candidates.pairs(), wanted_candidates)
    assert len(pairs) > 100


def test_occluders_of_all_sorts():
    """A pair of patches, and each sort of occluder between them in turn."""
    ends = np.array([[0, 0, 0, 0, 1, 1], [10, 0, 0, 10, 1, 1]], dtype=np.float32)
    box = np.array([5, -9, -9, 6, 9, 9], dtype=np.float32)
    square = np.array([[5, -9, -9], [5, 9, -9], [5, 9, 9], [5, -9, 9]], dtype=np.float32)
    turned = np.array([[5, -40, -40], [9, -40, -40], [5, 40, -40], [9, 40, -40],
                       [4, -40, 40], [8, -40, 40], [4, 40, 40], [8, 40, 40]], dtype=np.float32)  # fmt: skip
    triangle = square[:3]

    def said(**occluders):
        counts = sc.count_visibility(ends, **occluders)
        return [kind for kind in KINDS if counts[kind]][0]

    assert said() == "clear"
    assert said(occluders=box) == "undecided"
    assert said(solids=box) == said(solids=[box]) == "occluded"
    assert said(solids=[box], solids_around_ends=False) == "occluded"
    around = np.array([-1, -1, -1, 1, 2, 2], dtype=np.float32)
    assert said(solids=[around]) == "occluded" and said(solids=[around], solids_around_ends=False) != "occluded"
    assert said(polygons=[square]) == said(polygons=square[None]) == "occluded"
    assert said(hulls=[turned]) == said(hulls=turned[None]) == "occluded"
    assert said(triangles=triangle[None]) == "undecided"
    assert said(triangles=square, faces=[[0, 1, 2], [0, 2, 3]]) == "undecided"
    found = sc.Occluders(triangles=square, faces=[[0, 1, 2], [0, 2, 3]], find_solids=True)
    assert found.found == {"hulls": 0, "polygons": 1, "inner_boxes": 0} and len(found) == 1
    assert said(occluders=found) == "occluded"
    building = np.array([[4, 4, 0], [6, 4, 0], [6, 6, 0], [4, 6, 0], [4, 4, 3], [6, 4, 3], [6, 6, 3], [4, 6, 3]], np.float32)
    walls = [[i, (i + 1) % 4, (i + 1) % 4 + 4, i + 4] for i in range(4)] + [[4, 5, 6, 7]]
    building = dict(triangles=building, faces=[half for a, b, c, d in walls for half in ([a, b, c], [a, c, d])])
    for find_solids, bodies in [
        (True, 0),
        (sc.Patches(np.array([0, 0, 0, 9, 9, 0], np.float32)), 1),
        (sc.Patches(np.array([0, 0, -1, 9, 9, 9], np.float32)), 0),
        (sc.Patches(np.empty((0, 6), np.float32)), 0),
    ]:
        occluders = sc.Occluders(**building, find_solids=find_solids)
        assert occluders.found["hulls"] == bodies
        # A body that is an upright box stands for its triangles, unless groups are given.
        assert len(occluders) == 1 and len(occluders.triangles(0)) == (0 if bodies else 10)
        grouped = sc.Occluders(**building, groups=[0, 10], find_solids=find_solids)
        assert grouped.found == occluders.found and len(grouped.triangles(0)) == 10
    with pytest.raises(TypeError):
        sc.Occluders(**building, find_solids="yes")
    assert said(planes=[1, 0, 0, 20]) == "facing_away"
    assert said(planes=[[1, 0, 0, 0], [-1, 0, 0, -10]]) == "clear"
    touching = np.array([0, 1, 0, 10, 2, 1], dtype=np.float32)
    assert said(occluders=touching) == "clear" and said(occluders=touching, contact="closed") == "undecided"

    five = np.repeat(triangle[None], 5, axis=0)
    solid = dict(solids=[box, box], hulls=[turned], polygons=[square])
    occluders = sc.Occluders(box, **solid, triangles=five, groups=[0, 2, 5])
    assert occluders.found == {}
    assert len(occluders) == 7
    assert occluders.first == {"boxes": 0, "solids": 1, "hulls": 3, "polygons": 4, "triangles": 5}
    np.testing.assert_array_equal(occluders.box(2), box)
    np.testing.assert_array_equal(occluders.box(4), [5, -9, -9, 5, 9, 9])
    assert list(occluders.triangles(6)) == [2, 3, 4] and len(occluders.triangles(0)) == 0
    found = sc.visibility(ends, occluders=occluders)
    assert found.counts["occluded"] == 1 and len(found.occluders) == 7
    assert "Occluders, 7 of them" in repr(occluders) and "1 pairs, 0 undecided" in repr(found)
    without = sc.visibility(ends, occluders=box, candidates=False)
    assert without.candidates is None and len(without.undecided) == 1


def test_patches_are_kept_for_several_calls():
    boxes, planes = some_boxes(1, 50), planes_of(1, 50)
    patches = sc.Patches(boxes, planes)
    assert len(patches) == 50 and patches.has_planes and not sc.Patches(boxes).has_planes
    assert sorted(patches.order) == list(range(50)) and "50 of them" in repr(patches)
    solids = some_boxes(2, 6)
    assert sc.count_visibility(patches, solids=solids) == sc.count_visibility(boxes, planes=planes, solids=solids)
    assert sum(sc.count_visibility(patches, boxes, solids=solids).values()) == 2500
    np.testing.assert_array_equal(sc.visibility(patches, solids=solids).order_a, patches.order)
    none = np.zeros((0, 6), dtype=np.float32)
    found = sc.visibility(none, boxes)
    assert sum(found.counts.values()) == 0 and found.blocks.shape == (0, 4) and found.bits("clear").shape == (0, 50)


@pytest.mark.parametrize(
    "arguments, error, words",
    [
        (dict(patches=np.zeros((3, 6))), TypeError, "patches.*float64"),
        (dict(patches=[0] * 6, occluders=np.zeros((3, 6))), TypeError, "occluders.*float64"),
        (dict(patches=[0] * 6, polygons=np.zeros((1, 4, 3))), TypeError, "polygons.*float64"),
        (dict(patches=[[1, 0, 0, 0, 1, 1]]), sc.BadBound, "patches: patch 0 has lo > hi: lo.x = 1 is above hi.x = 0$"),
        (dict(patches=[[0] * 6, [1, 0, 0, 0, 1, 1]]), sc.BadBound, "patches: box 1: lo.x = 1.*lo must be at most hi$"),
        (dict(patches=[0] * 6, solids=[[0] * 6, [1, 0, 0, 0, 1, 1]]), sc.BadBound, "solids: box 1: .*most hi$"),
        (dict(patches=[0] * 6, planes=[0, 0, 0, 1]), sc.BadBound, "normal"),
        (dict(patches=[[0] * 6] * 3, planes=[[1, 0, 0, 1]] * 2), ValueError, r"planes.*\(3, 4\)"),
        (dict(patches=[0] * 6, planes_b=[1, 0, 0, 1]), ValueError, "no patches_b"),
        (dict(patches=[0] * 6, contact="half"), ValueError, "half"),
        (dict(patches=[0] * 6, memory=1000), ValueError, "1 MB"),
        (dict(patches=[0] * 6, faces=[[0, 1, 2]]), ValueError, "triangles"),
        (dict(patches=[0] * 6, hulls=[[[0, 0, 0]] * 3]), ValueError, "hulls"),
        (dict(patches=[0] * 6, polygons=[[[0, 0, 0]] * 2]), ValueError, "polygons"),
        (dict(patches=[0] * 6, triangles=np.zeros((2, 9), np.float32), groups=[0, 3]), IndexError, "groups"),
        (dict(patches=[0] * 6, occluders=sc.Occluders(), solids=[0] * 6), ValueError, "already"),
        (dict(patches=sc.Patches([0] * 6), planes=[1, 0, 0, 0]), ValueError, "already"),
    ],
)
def test_wrong_input_is_refused(arguments, error, words):
    with pytest.raises(error, match=f"(?s){words}"):
        sc.visibility(**arguments)
    with pytest.raises(error, match=f"(?s){words}"):
        sc.count_visibility(**arguments)


def test_wrong_questions_are_refused():
    found = sc.visibility([[0] * 6] * 3)
    for ask in (found.pairs, found.bits):
        with pytest.raises(ValueError, match="'dark'"):
            ask("dark")
    for ask in (sc.Occluders().box, sc.Occluders().triangles):
        with pytest.raises(IndexError):
            ask(0)
    with pytest.raises(TypeError, match="float64"):
        sc.merged_boxes(np.zeros((2, 6)))
    with pytest.raises(ValueError, match="4"):
        sc.inscribed_box([[0, 0, 0]] * 3)


def test_solid_boxes_are_merged_and_inscribed():
    pieces = np.array([[i, 0, 0, i + 1, 1, 3] for i in range(9)], dtype=np.float32)
    np.testing.assert_array_equal(sc.merged_boxes(pieces), [[0, 0, 0, 9, 1, 3]])
    corners = np.array(list(itertools.product((0, 4), repeat=3)), dtype=np.float32)
    np.testing.assert_array_equal(sc.inscribed_box(corners), [0, 0, 0, 4, 4, 4])


def test_view_factors_of_a_cube():
    floor = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=np.float32)
    ceiling = floor[::-1] + np.float32([0, 0, 1])
    wall = np.array([[0, 0, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1]], dtype=np.float32)
    assert sc.view_factor(floor, ceiling) == pytest.approx(0.199824895698, abs=1e-12)
    assert sc.view_factor(floor, wall) == pytest.approx(0.200043776075, abs=1e-12)
    assert sc.view_factor(floor, floor) == 0
    with pytest.raises(ValueError, match="2 corners"):
        sc.view_factor(floor[:2], wall)
    with pytest.raises(ValueError, match="no area"):
        sc.view_factor(floor[[0, 0, 1]], wall)


def crowd(count=3000):
    """So many patches in so much clutter that a call takes long."""
    random = np.random.default_rng(4)
    lo = random.random((count, 3), dtype=np.float32) * 20
    boxes = random.random((4000, 3), dtype=np.float32) * 20
    return np.hstack([lo, lo + 0.25]), np.hstack([boxes, boxes + 0.25])


def test_progress_is_told_and_may_end_the_call():
    patches, occluders = crowd()
    told = []
    tell = lambda *at: told.append((at, threading.get_ident()))
    counts = sc.count_visibility(patches, occluders=occluders, progress=tell)
    assert told[-1][0] == (sum(counts.values()),) * 2 == (3000 * 2999 // 2,) * 2
    assert all(done <= total for (done, total), _ in told) and {thread for _, thread in told} == {threading.get_ident()}

    def enough(done, total):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        sc.visibility(patches, occluders=occluders, progress=enough)


def test_other_threads_go_on():
    patches, occluders = crowd()
    counted, done = 0, threading.Event()
    worker = threading.Thread(target=lambda: (sc.count_visibility(patches, occluders=occluders), done.set()))
    worker.start()
    while not done.is_set():
        counted += 1
        time.sleep(0.001)
    worker.join()
    assert counted > 3


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_ctrl_c_ends_a_call():
    patches, occluders = crowd(12_000)
    # Once the call has begun: it tells of progress first.
    sent = []

    def interrupt(done, total):
        if not sent:
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        sc.count_visibility(patches, occluders=occluders, progress=interrupt)
    assert time.monotonic() - sent[0] < 10


def test_parts_have_the_answers_of_the_whole():
    """The example's parts, put together, are the pairs of one call, with the same candidates."""
    sys.path.insert(0, str(EXAMPLES))
    import sights_in_parts as parts

    patches, between = parts.scene(400)
    whole = sc.visibility(patches, **between)
    occluders = sc.Occluders(between["occluders"], solids=between["solids"])
    check_parts(whole, [parts.answers(sc.Patches(patches), occluders, part, 5) for part in range(5)])
    with pytest.raises(ValueError, match="part is 5; of 5 parts, it is 0 to 4"):
        sc.count_visibility(patches, part=5, parts=5)


def check_parts(whole, answers):
    def by_pair(pairs, candidates):
        return {tuple(sorted(pair)): list(found) for pair, found in zip(pairs.tolist(), candidates)}

    merged = {}
    for pairs, candidates, _ in answers:
        part = by_pair(pairs, candidates)
        assert len(part) == len(pairs) and not merged.keys() & part.keys()
        merged |= part
    wanted = by_pair(whole.undecided, whole.candidates)
    assert merged == wanted and len(wanted) > 100
    # Patches have no planes, so one thing is true of each pair.
    np.testing.assert_array_equal(sum(counts for *_, counts in answers), list(whole.counts.values()))
    assert min(whole.counts[kind] for kind in ("clear", "occluded")) > 100


def test_two_processes_of_mpi_have_the_answers_of_one(tmp_path):
    pytest.importorskip("mpi4py", reason="no mpi4py (Debian: python3-mpi4py)")
    program = tmp_path / "shards.py"
    program.write_text(f"""
import sys

sys.path[:0] = [{str(EXAMPLES)!r}, {str(pathlib.Path(__file__).parent)!r}]
import sights_in_parts as parts
from mpi4py import MPI

assert MPI.COMM_WORLD.size == 2
shares = parts.main()
if MPI.COMM_WORLD.rank == 0:
    import shaftcull
    from test_visibility import check_parts

    patches, between = parts.scene()
    assert len(shares) == 2 and min(len(share) for share in shares) > 10
    check_parts(shaftcull.visibility(patches, **between), [answers for share in shares for answers in share])
    print("the same")
""")
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    mpirun = ["mpirun", "--oversubscribe", "-n", "2"]
    try:
        done = subprocess.run(
            [*mpirun, sys.executable, program], capture_output=True, text=True, timeout=300, env=environment
        )
    except FileNotFoundError:
        pytest.skip("no mpirun (Debian: openmpi-bin)")
    assert done.returncode == 0, done.stderr
    assert done.stdout.endswith("the same\n") and " undecided, " in done.stdout


def inward_box(lo, hi, inwards, n=1):
    """The sides of a box, each cut into n x n: corners (6 n n, 4, 3)."""
    quads = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for far in (False, True):
            for i, j in itertools.product(range(n), repeat=2):
                quad = np.empty((4, 3), np.float32)
                for corner, (p, q) in enumerate(((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))):
                    quad[corner, axis] = (hi if far else lo)[axis]
                    quad[corner, u] = lo[u] + (hi[u] - lo[u]) * p / n
                    quad[corner, v] = lo[v] + (hi[v] - lo[v]) * q / n
                quads.append(quad[::-1] if far == inwards else quad)
    return np.array(quads)


def triangles_of(quads):
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def test_view_factors_of_all_pairs():
    room = np.concatenate([inward_box((0, 0, 0), (4, 4, 4), True, 2), inward_box((1, 1, 1), (2, 2, 2), False)])
    factors = sc.view_factors(room, triangles=triangles_of(room))
    n = len(room)
    assert factors.shape == (n, n)
    assert factors.indptr.shape == (n + 1,) and factors.indptr[-1] == len(factors.data) == len(factors.indices)
    assert sum(factors.counts.values()) == n * (n - 1) // 2 and factors.counts["undecided"] > 0
    assert factors.area == pytest.approx([4.0] * 24 + [1.0] * 6)
    assert factors.row_sum == pytest.approx(np.ones(n), abs=5e-3)
    assert np.all(np.abs(factors.row_sum - 1) <= 6 * factors.error + 1e-6)
    assert not factors.left_out.any()
    dense = np.zeros((n, n))
    for i in range(n):
        row = slice(factors.indptr[i], factors.indptr[i + 1])
        assert np.all(np.diff(factors.indices[row]) > 0)
        dense[i, factors.indices[row]] = factors.data[row]
    assert dense.sum(1) == pytest.approx(factors.row_sum)
    exchanged = dense * factors.area[:, None]
    assert exchanged == pytest.approx(exchanged.T)
    assert "30 patches" in repr(factors)
    again = sc.view_factors(sc.Patches(room), occluders=sc.Occluders(triangles=triangles_of(room), find_solids=True))
    assert np.array_equal(again.data, factors.data)
    fewer = sc.view_factors(room, triangles=triangles_of(room), least=0.01, rays=64, error=1e-3, seed=5, memory=1 << 20)
    assert len(fewer.data) < len(factors.data) and fewer.left_out.any()
    some = [sc.view_factors(room, triangles=triangles_of(room), part=part, parts=2) for part in range(2)]
    joined = np.zeros((n, n))
    for part in some:
        joined[np.repeat(np.arange(n), np.diff(part.indptr)), part.indices] += part.data
    assert (joined == dense).all()
    assert sum(part.row_sum for part in some) == pytest.approx(factors.row_sum, abs=1e-15)
    closed = sc.view_factors(room, triangles=triangles_of(room), close_rows=True)
    assert closed.row_sum == pytest.approx(np.ones(n), abs=1e-11)
    with pytest.raises(ValueError, match="rows cannot be closed: "):
        sc.view_factors(room[:6], close_rows=True)
    scipy = pytest.importorskip("scipy.sparse")
    matrix = scipy.csr_array((factors.data, factors.indices, factors.indptr), factors.shape)
    assert matrix.has_canonical_format and (matrix.toarray() == dense).all()


def test_view_factors_say_what_they_refuse():
    cube = inward_box((0, 0, 0), (1, 1, 1), True)
    with pytest.raises(ValueError, match="rays is 0"):
        sc.view_factors(cube, rays=0)
    with pytest.raises(ValueError, match="seen from both sides"):
        sc.view_factors(sc.Patches(cube, sides="both"))
    with pytest.raises(ValueError, match="no planes"):
        sc.view_factors([[0, 0, 0, 1, 1, 0]])
    flat = sc.view_factors([[0, 0, 0, 1, 1, 0], [0, 0, 1, 1, 1, 1]], planes=[[0, 0, 1, 0], [0, 0, -1, -1]])
    assert flat.data == pytest.approx([0.1998249, 0.1998249])

    def stop(done, total):
        raise KeyError("stop")

    with pytest.raises(KeyError, match="stop"):
        sc.view_factors(cube, progress=stop)


def test_progress_is_told_of_pairs_only_where_there_are_any():
    shares = []
    sc.view_factors(np.zeros((0, 4, 3), np.float32), progress=lambda done, total: shares.append(done / total))
    assert shares == []
    sc.view_factors(inward_box((0, 0, 0), (1, 1, 1), True), progress=lambda done, total: shares.append(done / total))
    assert shares[-1] == 1


def test_fractions_of_undecided_pairs():
    floor = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], np.float32)
    ceiling = floor[::-1] + np.float32([0, 0, 2])
    half = np.array([[[-1, -1, 1], [0.5, -1, 1], [0.5, 2, 1], [-1, 2, 1]]], np.float32)
    found = sc.visibility([floor], [ceiling], polygons=half)
    assert found.undecided.tolist() == [[0, 0]]
    assert found.fractions(rays=4096) == pytest.approx([0.5], abs=0.01)
    assert found.fractions().dtype == np.float32
    assert np.array_equal(found.fractions(seed=3), found.fractions(seed=3))
    with pytest.raises(ValueError, match="rays is 0"):
        found.fractions(rays=0)
    with pytest.raises(ValueError, match="candidates=True"):
        sc.visibility([floor], [ceiling], polygons=half, candidates=False).fractions()


def test_lit_fractions():
    floor = np.array([[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]], np.float32)
    wall = np.array([[[-1, -1, 1], [0.5, -1, 1], [0.5, 2, 1]], [[-1, -1, 1], [0.5, 2, 1], [-1, 2, 1]]], np.float32)
    to_sun = np.array([[0, 0, 1], [-0.25, 0, 1], [1, 0, 1], [0, 0, -1]], np.float32)
    lit = sc.lit_fractions(floor, to_sun, triangles=wall, rays=4096)
    assert lit.dtype == np.float32 and lit.shape == (1, 4)
    assert lit[0] == pytest.approx([0.5, 0.25, 1, 0], abs=0.01)
    assert (lit @ [1, 2, 3, 4])[0] == pytest.approx(4, abs=0.05)
    assert np.array_equal(sc.lit_fractions(floor, to_sun), [[1, 1, 1, 0]])
    assert np.array_equal(sc.lit_fractions(sc.Patches(floor, sides="both"), to_sun), np.ones((1, 4)))
    plate = [[-1, -1, 1, 0.5, 2, 1]]
    by_box = sc.lit_fractions([[0, 0, 0, 1, 1, 0]], to_sun, planes=[[0, 0, 1, 0]], occluders=plate, rays=4096)
    assert by_box[0] == pytest.approx([0.5, 0.25, 1, 0], abs=0.01)
    again = sc.lit_fractions(floor, to_sun, occluders=sc.Occluders(triangles=wall), rays=4096)
    assert np.array_equal(again, lit)
    assert not np.array_equal(sc.lit_fractions(floor, to_sun, triangles=wall, rays=4096, seed=2), lit)
    rough = sc.lit_fractions(floor, to_sun, triangles=wall, rays=65536, error=0.05, tolerance=1e-3)
    assert rough[0] == pytest.approx([0.5, 0.25, 1, 0], abs=0.2)
    assert sc.lit_fractions(floor, np.zeros((0, 3), np.float32)).shape == (1, 0)
    assert sc.lit_fractions(np.zeros((0, 4, 3), np.float32), to_sun).shape == (0, 4)
    with pytest.raises(ValueError, match=r"directions\[1\] is \(0, 0, 0\)"):
        sc.lit_fractions(floor, [[0, 0, 1], [0, 0, 0]])
    with pytest.raises(ValueError, match="rays is 0"):
        sc.lit_fractions(floor, to_sun, rays=0)
    with pytest.raises((TypeError, ValueError), match="directions"):
        sc.lit_fractions(floor, [[0, 1]])
    with pytest.raises(ValueError, match="patch"):
        sc.lit_fractions([[0, 0, 0, 1, 1, 1]], to_sun)
