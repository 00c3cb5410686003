# SPDX-License-Identifier: MIT
"""`shaftcull sees` on ranks: files are those of one process, bit for bit, whatever happens on the way."""
import json
import os
import random
import signal
import stat
import subprocess

from launched import content, kill_one, launch, own_lines, program, stored_blocks, take_files

npz = ["--out", "seen.npz"]
both = [*npz, "--candidates", "--svg", "seen.svg", "--ply", "seen.ply"]
scene = ["--rooms", "4", "--patches", "0.6", "--solid", "wall*", "table*"]  # 21 parts
parts = 21


def sees(ranks, *more, words=scene, **around):
    command = [*launch(ranks), program, "sees", "--threads", "2", *words, *map(str, more)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False, **around)


def found_by(ranks, *more, **others):
    done = sees(ranks, *more, "--format", "json", **others)
    assert done.returncode == 0, done
    return json.loads(done.stdout)


def on_ranks():
    """Files for NumPy, and pictures."""
    for more, several in (([], (2,)), (["--rays", 3], (1, 2, 3, 5))):
        report = found_by(0, *both, *more)
        whole = take_files()
        assert set(whole) == {"seen.npz", "seen.svg", "seen.ply"}
        for ranks in several:
            done = sees(ranks, *both, *more, "--format", "json")
            assert done.returncode == 0, done
            found = json.loads(done.stdout)
            assert take_files() == whole, (ranks, more)
            assert found["pairs"] == report["pairs"] and found["ranks"] == ranks, found
            assert not os.listdir()
            ends = [line.split()[:5] for line in done.stderr.splitlines() if line.startswith(("compute: ", "write: "))]
            assert [words[0] for words in ends if words[1] == words[3]] == ["compute:", "write:"], done.stderr
    assert found_by(3)["pairs"] == found_by(0)["pairs"]
    assert found_by(3, "--objects")["object_pairs"] == found_by(0, "--objects")["object_pairs"]
    found_by(2, "--svg", "seen.svg", "--rays", 3)
    assert take_files() == {"seen.svg": whole["seen.svg"]}

    # A link stays, and the file that it leads to is replaced.
    os.mkdir("elsewhere")
    with open("elsewhere/file", "w", encoding="ascii") as file:
        file.write("old")
    os.chmod("elsewhere/file", 0o640)
    os.symlink("elsewhere/file", "seen.npz")
    found_by(2, *npz, "--candidates", "--rays", 3)
    assert os.path.islink("seen.npz") and content("elsewhere/file") == whole["seen.npz"]
    assert stat.S_IMODE(os.stat("elsewhere/file").st_mode) == 0o640
    assert sorted(os.listdir()) == ["elsewhere", "seen.npz"]
    assert os.listdir("elsewhere") == ["file"]
    os.remove("seen.npz")

    found_by(0, *npz, "--rays", 3)
    without_candidates = take_files()
    assert len(without_candidates["seen.npz"]) < len(whole["seen.npz"])
    found_by(2, *npz, "--rays", 3)
    assert take_files() == without_candidates


def refused():
    """What cannot be used is told once, and nothing is left."""
    refusals = {
        "--out -: ranks keep finished results beside this file": ["--out", "-"],
        "seen.txt: unknown kind of file": ["--out", "seen.txt"],
        "a CSV file has no candidates": ["--out", "seen.csv", "--candidates"],
        "none/seen.svg: cannot be written: No such file": ["--out", "seen.npz", "--svg", "none/seen.svg"],
        "--solid 'none': there is no object of that name in 4 rooms": ["--solid", "none"],
    }
    for message, more in refusals.items():
        done = sees(3, *more)
        assert done.returncode == 2 and len(own_lines(done)) == 1 and message in own_lines(done)[0], done
        assert not os.listdir(), message
    words = launch(1)
    mixed = subprocess.run(
        [*words, program, "sees", *scene, *both, ":", *words[1:], program, "sees", *scene, *both, "--seed", "2"],
        capture_output=True, text=True, timeout=60, check=False)
    assert mixed.returncode == 2, mixed
    assert mixed.stderr.count("shaftcull: rank 1: 4 rooms has other patches than on rank 0") == 1, mixed.stderr


def csv():
    """Lines of text, whose lengths differ."""
    small = ["--rooms", "3", "--patches", "0.75", "--solid", "wall*", "table*", "--out", "seen.csv"]  # 5 parts
    for more, several in ([["--rays", "12"], (1, 2, 3, 5)], [[], (2,)]):
        found_by(0, *more, words=small)
        whole = take_files()
        for ranks in several:
            found_by(ranks, *more, words=small)
            assert take_files() == whole, (ranks, more)
            assert not os.listdir()


def turned():
    """Patches that are not across an axis, by their corners, up to the tolerance of the whole scene."""
    os.mkdir("scene")
    with open("scene/crates.obj", "w", encoding="ascii") as file:
        for i in range(24):
            x, y, size = 3.0 * (i % 6), 3.0 * (i // 6), 1 + 0.05 * i
            file.write(f"o crate{i}\n")
            for along, across, z in [(i & 1, i >> 1 & 1, i >> 2) for i in range(8)]:
                u, v = x + size * along, y + size * across
                file.write(f"v {0.8 * u - 0.6 * v:.9g} {0.6 * u + 0.8 * v:.9g} {size * z:.9g}\n")
            file.write("f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3\n")
    crates = ["scene/crates.obj", "--patches", "0.5"]
    report = found_by(0, *both, words=crates)
    assert report["tolerance"] > 0 and report["pairs"]["clear"] > 0 and report["pairs"]["occluded"] > 0, report
    whole = take_files()
    for ranks in (1, 3):
        assert found_by(ranks, *both, words=crates)["pairs"] == report["pairs"]
        assert take_files() == whole, ranks


def is_written():
    """Whether ranks write the file."""
    try:
        return os.stat("seen.npz.parts/result").st_size > 0
    except FileNotFoundError:
        return False


def killed(whole):
    """Killed at random points, at last while the file was written, and started again on any number of ranks."""
    seed = random.randrange(1 << 30)
    print("seed", seed, flush=True)
    chance = random.Random(seed)
    when = [lambda least=blocks: stored_blocks("seen.npz.parts") >= least for blocks in (0, 1, 2, 4)]
    hits = 0
    for is_time in [*when, is_written]:
        command = [*launch(chance.choice((1, 2, 3))), program, "sees", "--threads", "1", *scene, *both, "--rays", "3"]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as running:
            hits += kill_one(running, chance, is_time)
        if os.path.exists("seen.npz") and not os.path.exists("seen.npz.parts"):
            break
    for name in os.listdir():
        if name.startswith(".shaftcull-"):  # a picture that rank 0 had begun when it was killed
            os.remove(name)
    before = stored_blocks("seen.npz.parts")
    done = sees(2, *both, "--rays", 3)
    assert done.returncode == 0 and (before == 0 or " from an earlier run)" in done.stderr), (before, done)
    assert take_files() == whole, seed
    assert not os.listdir()
    assert hits > 0, "none was killed in time"


def limited(ranks, megabytes):
    """The words that start ranks whose files cannot be larger."""
    return [*launch(ranks), "sh", "-c", f"trap '' XFSZ; ulimit -f {megabytes * 2048}; exec \"$@\"", "sh"]


def without_room(whole):
    """A disk that is full when the file is written, which is larger than the parts, and then no longer."""
    command = [program, "sees", "--threads", "1", *scene, *both, "--rays", "3"]
    full = "seen.npz.parts/result: cannot be written: File too large"
    megabytes = len(whole["seen.npz"]) * 9 // 10 >> 20  # blocks are smaller
    for ranks in (1, 3):
        done = subprocess.run([*limited(ranks, megabytes), *command], capture_output=True, text=True, timeout=120, check=False)
        assert done.returncode == 1 and len(own_lines(done)) == 1 and full in own_lines(done)[0], done
        assert os.listdir() == ["seen.npz.parts"]
        assert stored_blocks("seen.npz.parts") == parts and not os.path.exists("seen.npz.parts/result")
    # Now rank 0 could write all, but it does not: others have their part of it.
    mixed = subprocess.run([*launch(1), *command, ":", *limited(2, 16)[1:], *command], capture_output=True, text=True,
                           timeout=120, check=False)
    assert mixed.returncode == 1 and len(own_lines(mixed)) == 1 and full in own_lines(mixed)[0], mixed
    assert os.listdir() == ["seen.npz.parts"]
    # As a rank leaves it that was killed on the way: longer than what it will be, too.
    with open("seen.npz.parts/result", "wb") as file:
        file.write(b"x" * (len(whole["seen.npz"]) + 1000))
    done = sees(2, *both, "--rays", 3)
    assert done.returncode == 0 and f"compute: {parts} of {parts} parts (" in done.stderr, done
    assert take_files() == whole
    assert not os.listdir()


def asked_to_end(whole):
    """SIGTERM while the file is written: what is finished stays, and the code says so."""
    command = [*launch(2), program, "sees", "--threads", "1", *scene, *both, "--rays", "3"]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as running:
        kill_one(running, random.Random(1), is_written, signal.SIGTERM)
    if running.returncode != 0:
        assert running.returncode == 128 + signal.SIGTERM, running.returncode
        assert os.listdir() == ["seen.npz.parts"] and stored_blocks("seen.npz.parts") == parts
        assert not is_written()
        assert sees(3, *both, "--rays", 3).returncode == 0
    assert take_files() == whole
    assert not os.listdir()


def ended():
    found_by(0, *both, "--rays", 3)
    whole = take_files()
    killed(whole)
    without_room(whole)
    asked_to_end(whole)


sees_cases = {"sees": on_ranks, "sees_refused": refused, "sees_csv": csv, "sees_turned": turned, "sees_ended": ended}
