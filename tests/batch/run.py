#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""`shaftcull batch` from outside: against NumPy, on ranks, killed and started again, with input that cannot be used.

  run.py CASE PROGRAM MPIRUN     CASE: model, numpy, doubles, ranks, killed, errors, trees, memory, or one of sees.py; MPIRUN: empty where
                                 there is none

Ends with 77, "skipped", where NumPy, h5py or what a case needs is missing.
"""
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # here, beside the sources

try:
    import h5py
    import numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

from factors import factors_cases
from launched import can_launch, content, kill_one, launch, program, stored_blocks
from sees import sees_cases
from sun import sun_cases

script = os.path.abspath(sys.argv[0])
case = sys.argv[1]


def batch(ranks, *options, **more):
    command = [*launch(ranks), program, "batch", "--threads", "2", *map(str, options)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False, **more)


def run(ranks, *options):
    done = batch(ranks, *options)
    assert done.returncode == 0, (done.args, done.returncode, done.stderr)
    return done


def boxes(source, count, space, size):
    """Corners at whole numbers, so that much touches."""
    low = source.integers(0, space, (count, 3))
    return numpy.concatenate([low, low + source.integers(0, size + 1, (count, 3))], 1).astype("f4")


def scene(seed, shafts, bounds):
    source = numpy.random.default_rng(seed)
    numpy.save("bounds.npy", boxes(source, bounds, 40, 2))
    numpy.save("shafts.npy", numpy.concatenate([boxes(source, shafts, 30, 6), boxes(source, shafts, 30, 6)], 1))
    return ["--bounds", "bounds.npy", "--shafts", "shafts.npy", "--out", "out.h5"]


def times(shaft, low, high):
    """When the box that moves from one end to the other begins and ceases to touch each of these boxes; the first is
    later than the second if it never does. Exact: quotients of small integers are told apart by doubles."""
    begin, end = numpy.zeros(len(low)), numpy.ones(len(low))
    for axis in range(3):
        for sign, edge, other in ((1, 0, high), (-1, 3, low)):
            # sign * (start + t * way - other) <= 0
            start = sign * (float(shaft[edge + axis]) - other[:, axis].astype(float))
            way = sign * (float(shaft[6 + edge + axis]) - float(shaft[edge + axis]))
            if way == 0:
                begin[start > 0] = 2
            elif way > 0:
                end = numpy.minimum(end, -start / way)
            else:
                begin = numpy.maximum(begin, -start / way)
    return begin, end


def rounded_down(time):
    near = numpy.float32(time)
    return numpy.nextafter(near, numpy.float32(-1)) if float(near) > time else near


def against_numpy():
    """Counts, lists, classes and first contacts, worked out here from the definitions."""
    options = scene(3, 200, 1000)
    with h5py.File("in.h5", "w") as file:
        file.create_dataset("scene/bounds", data=numpy.load("bounds.npy"), chunks=(100, 6), compression="gzip")
        file["shafts"] = numpy.load("shafts.npy")
    low, high = numpy.load("bounds.npy")[:, :3], numpy.load("bounds.npy")[:, 3:]
    kept, inside, first = [], [], []
    for shaft in numpy.load("shafts.npy"):
        begin, end = times(shaft, low, high)
        found = numpy.flatnonzero(begin <= end)
        kept.append(found)
        within = numpy.ones(len(low), bool)
        for corner in range(8):
            point = numpy.where([corner >> axis & 1 for axis in range(3)], high, low)
            begin_point, end_point = times(shaft, point, point)
            within &= begin_point <= end_point
        inside.append(numpy.flatnonzero(within))
        best = min(((begin[i], i) for i in found), default=(numpy.inf, -1))
        first.append((best[1], rounded_down(best[0])))
    offsets = numpy.cumsum([0, *map(len, kept)])
    assert offsets[-1] > 1000 and sum(map(len, inside)) > 100

    for source in (options, ["--bounds", "in.h5:/scene/bounds", "--shafts", "in.h5:/shafts", "--out", "out.h5"]):
        run(0, *source)
        with h5py.File("out.h5") as file:
            assert file["counts"].dtype == "u8" and (file["counts"][:] == numpy.diff(offsets)).all()
            assert file.attrs["answer"] == b"count" and file.attrs["number_of_bounds"] == 1000
        run(0, *source, "--answer", "list", "--block", 7)
        with h5py.File("out.h5") as file:
            assert file["indices"].chunks and (file["offsets"][:] == offsets).all()
            assert (file["indices"][:] == numpy.concatenate(kept)).all()
            assert (file["indices"][offsets[5]:offsets[6]] == kept[5]).all()
        run(0, *source, "--answer", "classify")
        with h5py.File("out.h5") as file:
            assert (file["inside/indices"][:] == numpy.concatenate(inside)).all()
            assert (file["inside/offsets"][:] == numpy.cumsum([0, *map(len, inside)])).all()
            overlap = [numpy.setdiff1d(all_of, some) for all_of, some in zip(kept, inside)]
            assert (file["overlap/indices"][:] == numpy.concatenate(overlap)).all()
            assert (file["overlap/offsets"][:] == numpy.cumsum([0, *map(len, overlap)])).all()
        run(0, *source, "--answer", "first")
        with h5py.File("out.h5") as file:
            assert (file["index"][:] == [index for index, _ in first]).all()
            assert (file["time"][:] == [time for _, time in first]).all()
    assert os.listdir() and not os.path.exists("out.h5.parts")


def of_doubles():
    """Arrays of float64 answer as those of float32 that NumPy makes of them: relative to an origin, and rounded outwards."""
    def answers(*options, answer="list"):
        run(0, *options, "--out", "doubles.h5", "--answer", answer)
        with h5py.File("doubles.h5") as file:
            return {name: file[name][:].tolist() for name in ("offsets", "indices", "occluded") if name in file}

    def outwards(boxes):
        nearest = boxes.astype("f4")
        down = numpy.where(nearest > boxes, numpy.nextafter(nearest, numpy.float32(-numpy.inf)), nearest)
        up = numpy.where(nearest < boxes, numpy.nextafter(nearest, numpy.float32(numpy.inf)), nearest)
        lo = numpy.arange(boxes.shape[1]) % 6 < 3
        return numpy.where(lo, down, up), numpy.where(lo, up, down)

    # Whole numbers in map coordinates are what they are relative to a point there.
    scene(12, 300, 2000)
    near, ends = numpy.load("bounds.npy"), numpy.load("shafts.npy")
    at = numpy.array([4512345.0, 587654.0, 100.0])
    numpy.save("far_bounds.npy", near.astype("f8") + numpy.tile(at, 2))
    numpy.save("far_shafts.npy", ends.astype("f8") + numpy.tile(at, 4))
    with h5py.File("far.h5", "w") as file:
        file.create_dataset("bounds", data=numpy.load("far_bounds.npy"), chunks=(100, 6), compression="gzip")
        file.create_dataset("shafts", data=numpy.load("far_shafts.npy"), chunks=(100, 12))
    right = answers("--bounds", "bounds.npy", "--shafts", "shafts.npy")
    assert right["offsets"][-1] > 5000
    here = ["--origin", "4512345,587654,100"]
    assert answers("--bounds", "far_bounds.npy", "--shafts", "far_shafts.npy", *here) == right
    assert answers("--bounds", "far.h5:/bounds", "--shafts", "far.h5:/shafts", *here) == right
    assert answers("--bounds", "far_bounds.npy", "--shafts", "far_shafts.npy", "--memory", "1", *here) == right
    assert answers("--bounds", "bounds.npy", "--shafts", "shafts.npy", *here) == right  # float32 stays
    with h5py.File("doubles.h5") as file:
        assert file.attrs["origin"] == b"4512345,587654,100"
    # Between floats, which have steps of half a unit there, more touches.
    numpy.save("off_bounds.npy", numpy.load("far_bounds.npy") + 0.3)
    numpy.save("off_shafts.npy", numpy.load("far_shafts.npy") + 0.3)
    off = ["--bounds", "off_bounds.npy", "--shafts", "off_shafts.npy"]
    assert right["offsets"][-1] <= answers(*off, *here)["offsets"][-1] < answers(*off)["offsets"][-1]

    # Other numbers are rounded outwards, and solids inwards.
    source = numpy.random.default_rng(13)
    for name in "bounds", "shafts":
        given = numpy.load(f"{name}.npy").astype("f8")
        given += numpy.where(numpy.arange(given.shape[1]) % 6 < 3, -1, 1) * source.random(given.shape) / 3
        numpy.save(f"double_{name}.npy", given)
        larger, smaller = outwards(given)
        assert (larger != smaller).all()
        numpy.save(f"larger_{name}.npy", larger)
        numpy.save(f"smaller_{name}.npy", smaller)
    doubles = ["--bounds", "double_bounds.npy", "--shafts", "double_shafts.npy"]
    assert answers(*doubles) == answers("--bounds", "larger_bounds.npy", "--shafts", "larger_shafts.npy")
    hidden = answers(*doubles, answer="occluded")
    assert hidden == answers("--bounds", "smaller_bounds.npy", "--shafts", "larger_shafts.npy", answer="occluded")
    assert 0 < sum(hidden["occluded"]) < 300
    pairs = source.integers(0, 2000, (300, 2))
    numpy.save("pairs.npy", pairs)
    of_pairs = ["--shafts", "pairs.npy", "--bounds"]
    assert (answers(*of_pairs, "bounds.npy", "--boxes", "double_bounds.npy") ==
            answers(*of_pairs, "bounds.npy", "--boxes", "larger_bounds.npy"))

    # Spheres contain the given ones; vertices are the nearest floats.
    spheres = numpy.concatenate([at + source.integers(0, 40, (2000, 3)), source.integers(0, 3, (2000, 1))], 1)
    numpy.save("far_spheres.npy", spheres)
    numpy.save("spheres.npy", (spheres - [*at, 0]).astype("f4"))
    assert (answers("--bounds", "far_spheres.npy", "--shafts", "far_shafts.npy", *here) ==
            answers("--bounds", "spheres.npy", "--shafts", "shafts.npy"))
    triangles = at[[0, 1, 2] * 3] + source.random((2000, 9)) * 40
    numpy.save("far_triangles.npy", triangles)
    numpy.save("triangles.npy", (triangles - numpy.tile(at, 3)).astype("f4"))
    assert (answers("--bounds", "far_triangles.npy", "--shafts", "far_shafts.npy", *here) ==
            answers("--bounds", "triangles.npy", "--shafts", "shafts.npy"))


def on_ranks():
    """The file of 1, 2, 3 and 5 ranks is that of one process, in shares too."""
    options = scene(4, 600, 20_000)
    for answer in ("count", "list", "classify", "first", "occluded"):
        ask = [*options, "--answer", answer, "--block", 50]
        run(0, *ask)
        whole = content("out.h5")
        run(0, *ask, "--memory", 1)
        assert content("out.h5") == whole, (answer, "in shares")
        for ranks in (1, 2, 3, 5) if answer in ("list", "first") else (3,):
            for more in ([], ["--memory", 1]):
                os.remove("out.h5")
                done = run(ranks, *ask, *more, "--progress", "json")
                assert content("out.h5") == whole, (answer, ranks, more)
                assert f"{ranks} rank" in done.stdout and len(done.stdout.splitlines()) == 2, done.stdout
                lines = [json.loads(line) for line in done.stderr.splitlines() if line.startswith("{")]
                ends = [line for line in lines if line["blocks_done"] == line["blocks"]]
                phases = ["deal", "sort", "compute", "write"] if more else ["compute", "write"]
                assert [line["phase"] for line in ends] == phases, done.stderr
        assert not os.path.exists("out.h5.parts")


def killed():
    """A job that is killed again and again, at random points, ends with the file of an undisturbed run."""
    seed = random.randrange(1 << 30)
    print("seed", seed, flush=True)
    chance = random.Random(seed)
    options = [*scene(5, 3000, 15_000), "--answer", "list", "--progress", "none"]
    small = ["--block", "10"]
    run(0, *options, *small)
    whole = content("out.h5")
    for ranks, more in ((0, small), (3, small), (2, ["--memory", "1", "--block", "20"])):
        if ranks and not can_launch():
            continue
        os.remove("out.h5")
        command = [*launch(ranks), program, "batch", "--threads", "1", *options, *more]
        hits = 0
        for part in (0.02, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9):
            with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as running:
                blocks = int(300 * part * chance.uniform(0.7, 1))
                hits += kill_one(running, chance, lambda least=blocks: stored_blocks("out.h5.parts") >= least)
            if os.path.exists("out.h5") and not os.path.exists("out.h5.parts"):
                break
        done = run(ranks, *options, *more)
        assert content("out.h5") == whole, (seed, ranks, more)
        assert not os.path.exists("out.h5.parts")
        print(f"{ranks} ranks, {more}: {hits} killed; {done.stdout.splitlines()[1]}")
        assert hits > 0, "none was killed in time"

    # No room: a run that cannot write tells so, and goes on when it can.
    os.remove("out.h5")

    def little_room():
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    failed = batch(0, *options, *small, preexec_fn=little_room)
    assert failed.returncode == 1 and failed.stderr.count("\n") == 1, failed
    assert "out.h5.parts/" in failed.stderr and "cannot be written" in failed.stderr, failed.stderr
    assert not os.path.exists("out.h5") and os.path.exists("out.h5.parts")
    assert "blocks from an earlier run: " in run(0, *options, *small).stdout
    assert content("out.h5") == whole

    # A signal, as of a time limit: what is finished stays, and the code says so.
    os.remove("out.h5")
    with subprocess.Popen([program, "batch", *options, *small], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                          text=True) as running:
        while running.poll() is None and stored_blocks("out.h5.parts") == 0:
            pass
        running.send_signal(signal.SIGTERM)
        said = running.communicate()[1]
    if running.returncode != 0:
        assert running.returncode == 128 + signal.SIGTERM, running.returncode
        assert said.count("\n") == 1 and "run the same command again" in said, said
    run(0, *options, *small)
    assert content("out.h5") == whole


def steps(log, ranks, what):
    """How often ranks did a step."""
    return sum(line.startswith(what + ",") for rank in range(ranks) for line in open(f"{log}.{rank}", encoding="ascii"))


def damage(path):
    """Changes the last bit of a file."""
    all_bytes = bytearray(content(path))
    all_bytes[-1] ^= 1
    with open(path, "wb") as file:
        file.write(all_bytes)


def trees():
    """A tree of all bounds is built once a machine; bounds are dealt, and trees of shares built, once a job."""
    options = [*scene(8, 3000, 20_000), "--answer", "list", "--progress", "none", "--block", 10]
    shares = [*options, "--memory", 1]
    run(0, *options, "--log", "one")
    whole = content("out.h5")
    assert steps("one", 1, "tree") == 1
    count = int(run(0, *shares, "--log", "one").stdout.split(" shares")[0].split()[-1])
    assert count > 1 and steps("one", 1, "tree") == steps("one", 1, "deal") == count and content("out.h5") == whole

    def answered():
        return any(blocks for share, _, blocks in os.walk("out.h5.parts") if share.startswith("out.h5.parts/share-"))

    # They are there when the job goes on, and one that was damaged is noticed.
    while True:
        os.remove("out.h5")
        with subprocess.Popen([program, "batch", "--threads", "1", *map(str, shares)], stdout=subprocess.DEVNULL) as running:
            while running.poll() is None and not answered():
                pass
            running.kill()
        if not os.path.exists("out.h5"):
            break
    trees_there = [f"out.h5.parts/trees/share-0000/block-{share:09}" for share in range(count)]
    assert all(os.path.exists(tree) for tree in trees_there)
    damage(trees_there[-1])
    failed = batch(0, *shares, "--log", "again")
    assert failed.returncode == 1 and failed.stderr.count("\n") == 1, failed
    assert f"block-{count - 1:09}: is damaged; run the same command again" in failed.stderr, failed
    assert steps("again", 1, "tree") == 0

    # So is what was dealt: here the tree that is missing cannot be stored at first.
    os.mkdir(trees_there[-1])
    failed = batch(0, *shares, "--log", "again")
    assert failed.returncode == 1 and f"block-{count - 1:09}" in failed.stderr, failed
    assert steps("again", 1, "deal") == count and steps("again", 1, "tree") == 1
    for tree in trees_there[:-1]:
        os.remove(tree)
    os.rmdir(trees_there[-1])
    damage("out.h5.parts/bounds/share-0000/block-000000001")
    failed = batch(0, *shares, "--log", "again")
    assert failed.returncode == 1 and failed.stderr.count("\n") == 1, failed
    assert "bounds/share-0000/block-000000001: is damaged; run the same command again" in failed.stderr, failed
    assert steps("again", 1, "deal") == 0
    run(0, *shares, "--log", "again")
    assert steps("again", 1, "deal") == 1 and content("out.h5") == whole

    if not can_launch():
        return
    run(3, *options, "--log", "ranks")
    room = os.statvfs("/dev/shm").f_bavail * os.statvfs("/dev/shm").f_frsize if os.path.exists("/dev/shm") else 1 << 40
    assert content("out.h5") == whole
    if room > 100 << 20:  # else each has its own
        assert steps("ranks", 3, "tree") == 1
    run(3, *shares, "--log", "ranks")
    assert steps("ranks", 3, "tree") == steps("ranks", 3, "deal") == count and content("out.h5") == whole


def memory():
    """Bounds that are four times as large as what a process may write to (ulimit -d; files that are mapped are not
    written to) are asked in shares."""
    limit = 100 << 20
    source = numpy.random.default_rng(9)
    low = source.uniform(0, 100, (4 * limit // 24, 3)).astype("f4")
    numpy.save("bounds.npy", numpy.concatenate([low, low + numpy.float32(0.01)], 1))
    del low
    ends = [source.uniform(0, 100, (300, 3)).astype("f4") for _ in range(2)]
    numpy.save("shafts.npy", numpy.concatenate([part for end in ends for part in (end, end + numpy.float32(0.5))], 1))
    options = ["--bounds", "bounds.npy", "--shafts", "shafts.npy", "--out", "out.h5", "--answer", "list", "--progress",
               "none", "--threads", "2"]

    def limited(*more):
        return subprocess.run([program, "batch", *options, *more], capture_output=True, text=True, timeout=500, check=False,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_DATA, (limit, limit)))
    done = limited("--memory", "48")
    assert done.returncode == 0 and " shares" in done.stdout, done
    in_shares = content("out.h5")
    failed = limited()
    assert failed.returncode == 1 and failed.stderr.count("\n") == 1 and "out of memory; set a limit with --memory" in failed.stderr, failed
    shutil.rmtree("out.h5.parts")
    run(0, *options[:-2])
    assert content("out.h5") == in_shares


def errors():
    """What cannot be used is refused in one line of one rank, and all end."""
    options = scene(6, 500, 500)
    wrong = numpy.load("shafts.npy")
    wrong[321, 3] = wrong[321, 0] - 1
    numpy.save("wrong.npy", wrong)
    numpy.save("halves.npy", numpy.load("bounds.npy").astype("f2"))
    numpy.save("far.npy", numpy.ones((5, 9)))
    numpy.save("pairs.npy", numpy.array([[0, 1], [2, 500]]))
    with open("torn.npy", "wb") as file:
        file.write(content("bounds.npy")[:-1])
    out = ["--out", "out.h5"]
    scenes = {
        "--memory 0: ": ["--memory", "0", "--bounds", "bounds.npy", "--shafts", "shafts.npy", *out],
        "--isa": ["--isa", "sse9", "--bounds", "bounds.npy", "--shafts", "shafts.npy", *out],
        "no bounds are given; add --bounds": ["--shafts", "shafts.npy", *out],
        "no shafts are given; add --shafts": ["--bounds", "bounds.npy", *out],
        "no output file is given; add --out": ["--bounds", "bounds.npy", "--shafts", "shafts.npy"],
        "none.npy: cannot be read: No such file": ["--bounds", "none.npy", "--shafts", "shafts.npy", *out],
        "torn.npy: is cut short": ["--bounds", "torn.npy", "--shafts", "shafts.npy", *out],
        "halves.npy: holds numbers of NumPy's type <f2": ["--bounds", "halves.npy", "--shafts", "shafts.npy", *out],
        "far.npy: is (5, 9) of float64; only shafts of two boxes may be": [
            "--bounds", "bounds.npy", "--shafts", "far.npy", "--kinds", "swept", *out],
        "--origin 0,nan,0: y is nan; give finite numbers": [
            "--bounds", "bounds.npy", "--shafts", "shafts.npy", "--origin", "0,nan,0", *out],
        "shafts.npy: is (500, 12) of float32; bounds are rows": ["--bounds", "shafts.npy", "--shafts", "shafts.npy", *out],
        "bounds.npy: is (500, 6) of float32; shafts": ["--bounds", "bounds.npy", "--shafts", "bounds.npy", *out],
        "wrong.npy: row 321: ": ["--bounds", "bounds.npy", "--shafts", "wrong.npy", *out, "--block", "20"],
        "pairs.npy: row 1: position 500 is out of range for the 500 boxes": [
            "--bounds", "bounds.npy", "--boxes", "bounds.npy", "--shafts", "pairs.npy", *out],
        "--answer occluded: only boxes can block": [
            "--bounds", "spheres.npy", "--shafts", "shafts.npy", "--answer", "occluded", *out],
        "folder: cannot be written: it is a directory": [
            "--bounds", "bounds.npy", "--shafts", "shafts.npy", "--out", "folder"],
        "file/no/folder.h5.parts: cannot be made": [
            "--bounds", "bounds.npy", "--shafts", "shafts.npy", "--out", "file/no/folder.h5"],
    }
    os.mkdir("folder")
    with open("file", "w", encoding="ascii") as file:
        file.write("a file where a folder would be")
    numpy.save("spheres.npy", numpy.ones((9, 4), "f4"))
    for message, arguments in scenes.items():
        for ranks in (0, 3) if can_launch() else (0,):
            shutil.rmtree("out.h5.parts", ignore_errors=True)
            refused = batch(ranks, *arguments, "--progress", "none")
            own = [line for line in refused.stderr.splitlines() if line.startswith("shaftcull: ")]
            assert refused.returncode == 2, (arguments, ranks, refused)
            assert len(own) == 1, (arguments, ranks, refused.stderr)
            assert message in own[0], (message, own[0])
            assert not os.path.exists("out.h5"), arguments

    # The unfinished job stays as it is when others are refused.
    shutil.rmtree("out.h5.parts", ignore_errors=True)
    numpy.save("shafts.npy", wrong)
    assert batch(0, *options, "--block", "20").returncode == 2
    before = stored_blocks("out.h5.parts")
    assert before > 0
    numpy.save("shafts.npy", wrong[:-1])
    for ranks in (0, 2) if can_launch() else (0,):
        refused = batch(ranks, *options, "--block", "20", "--progress", "none")
        assert refused.returncode == 2 and refused.stderr.count("unfinished job with other input: shafts was") == 1, refused
        assert stored_blocks("out.h5.parts") == before

    if not can_launch():
        return
    # Ranks that do not belong together, and one that cannot start.
    shutil.rmtree("out.h5.parts")
    numpy.save("shafts.npy", numpy.load("shafts.npy")[:100])
    words = launch(1)
    mixed = subprocess.run([*words, program, "batch", *options, ":", *words[1:], program, "batch", *options, "--block", "9"],
                           capture_output=True, text=True, timeout=60, check=False)
    assert mixed.returncode == 2, mixed
    assert mixed.stderr.count("shaftcull: rank 1: was started with other options than rank 0") == 1, mixed.stderr
    missing = subprocess.run([*words, program, "batch", *options, ":", *words[1:], "./none"], capture_output=True, text=True,
                             timeout=60, check=False)
    assert missing.returncode != 0 and not os.path.exists("out.h5"), missing


def model():
    """What model.py says of logs, and of dealing worked out by hand."""
    sys.path.insert(0, os.path.join(os.path.dirname(script), "../../programs/batch"))
    import model as tool

    assert tool.deal([1.0] * 8, 4) == (2.0, [2.0] * 4)
    assert tool.deal([4.0, 1.0, 1.0, 1.0, 1.0], 2) == (4.0, [4.0, 4.0])
    assert tool.deal([1.0, 1.0, 4.0], 2) == (5.0, [1.0, 5.0])
    # The counter gives out one at a time; a rank waits for its answer, too.
    assert tool.deal([1.0] * 3, 3, latency=0.5, service=0.25) == (2.25, [1.75, 2.0, 2.25])

    steps = {"answer": [(0, 0, 3.0), (0, 1, 1.0)], "store": [(0, 1, 2.0), (0, 0, 1.0)]}
    assert tool.blocks_of(steps) == [3.0, 2.0]

    options = scene(5, 1000, 3000)
    run(0, *options, "--answer", "list", "--block", 40, "--log", "log")
    times, given = tool.arguments(["log.0"])
    assert given.blocks == 25 and sorted(times) == ["answer", "read", "store", "tree", "write"]
    assert [len(times[what]) for what in sorted(times)] == [25, 25, 25, 1, 25]
    blocks = tool.blocks_of(times)
    assert len(blocks) == 25 and min(blocks) > 0
    one, many = tool.predict(times, 1, given), tool.predict(times, 5, given)
    assert abs(one["work"] / many["work"] - 5) < 1e-9 and one["tail"] < 1e-9 <= many["tail"]
    # 1000 bytes for each of 4 nodes, by a file system that is as fast as two links.
    times, small = tool.arguments(["log.0", "--input", "1000", "--link", "100", "--file-system", "200", "--blocks", "7"])
    assert tool.predict(times, 4, small)["input"] == 20
    lines = tool.table(times, given)
    assert [int(line.split()[0]) for line in lines[1:]] == [2 ** i for i in range(11)]
    assert lines[1].split()[3] == "100%" and "25 blocks on 64 ranks" in tool.tail(times, given)
    # As the docs start it.
    printed = subprocess.run([tool.__file__, "log.0"], stdout=subprocess.PIPE, text=True, check=True).stdout
    assert printed.splitlines()[: len(lines)] == lines, printed
    refused = batch(0, *options, "--log", "none/log")
    assert refused.returncode == 2 and "none/log.0: cannot be made" in refused.stderr, refused
    if not can_launch():
        return
    run(3, *options, "--answer", "list", "--block", 40, "--log", "of_ranks")
    times, given = tool.arguments([f"of_ranks.{rank}" for rank in range(3)])
    assert given.blocks == 25 and len(times["answer"]) == 25


cases = {"model": model, "numpy": against_numpy, "doubles": of_doubles, "ranks": on_ranks, "killed": killed, "errors": errors,
         "trees": trees, "memory": memory, **sees_cases, **factors_cases, **sun_cases}
if case in ("ranks", *sees_cases, *factors_cases, *sun_cases) and not can_launch():
    print("skipped: no mpirun that starts ranks")
    sys.exit(77)
# In memory, where that is: nothing here depends on a disk, and other tests may keep it busy.
with tempfile.TemporaryDirectory(dir="/dev/shm" if os.access("/dev/shm", os.W_OK) else None) as work:
    os.chdir(work)
    cases[case]()
    os.chdir("/")
