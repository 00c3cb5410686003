# SPDX-License-Identifier: MIT
"""`shaftcull factors` in parts: files are those of any number of ranks, bit for bit, whatever happens on the way."""
import json
import os
import random
import subprocess

from launched import interrupt_after, kill_one, launch, own_lines, program, stored_blocks, take_files

scene = ["--rooms", "4", "--patches", "0.3", "--rays", "16", "--error", "1"]
npz = ["--out", "factors.npz"]
parts = 50


def factors(ranks, *more, words=scene, **around):
    command = [*launch(ranks), program, "factors", "--threads", "2", *words, *map(str, more)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False, **around)


def report_of(ranks, *more, **others):
    done = factors(ranks, *more, "--format", "json", **others)
    assert done.returncode == 0, done
    report = json.loads(done.stdout)
    return {name: value for name, value in report.items() if name not in ("seconds", "memory", "threads", "ranks")}


def on_ranks():
    os.mkdir("scene")
    with open("scene/room.obj", "w", encoding="ascii") as file:
        for i in range(8):
            file.write(f"v {i & 1} {i >> 1 & 1} {i >> 2}\n")
        file.write("f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n")
    closed = ["scene/room.obj", "--patches", "0.04", "--close"]
    for words, several in (([*scene, "--svg", "sky.svg"], (1, 3)), ([*scene, "--min", "1e-5"], (2,)), (closed, (2,))):
        report = report_of(0, *npz, words=words)
        whole = take_files()
        for ranks in several:
            assert report_of(ranks, *npz, words=words) == report
            assert take_files() == whole, (ranks, words)
            assert os.listdir() == ["scene"]
    done = factors(2, *npz, "--format", "json")
    found = json.loads(done.stdout)
    assert found["ranks"] == 2 and found["threads"] == 4, found
    assert f"compute: {parts} of {parts} parts" in done.stderr, done
    take_files()

    # All at once, as where nothing is kept, factors are the same.
    listed = factors(0, "--out", "-")
    assert listed.returncode == 0, listed
    assert report_of(3, "--out", "list.csv")["factors"] == listed.stdout.count("\n") - 1
    assert take_files() == {"list.csv": listed.stdout.encode()}


def refused():
    refusals = {
        "several processes need --out, --svg or --ply with a FILE": [],
        "factors: several processes need --out, --svg": ["--out", "-"],
        "--out factors.txt: unknown kind of file": ["--out", "factors.txt"],
    }
    for message, more in refusals.items():
        done = factors(3, *more)
        assert done.returncode == 2 and len(own_lines(done)) == 1 and message in own_lines(done)[0], done
        assert not os.listdir(), message
    words = launch(1)
    for option, complaint in (["--seed", "has other patches"], ["--min", "was started with other options"]):
        mixed = subprocess.run(
            [*words, program, "factors", *scene, *npz, ":", *words[1:], program, "factors", *scene, *npz, option, "1e-3"
             if option == "--min" else "2"], capture_output=True, text=True, timeout=60, check=False)
        assert mixed.returncode == 2 and complaint in mixed.stderr, mixed
        assert not os.listdir()


def ended():
    report = report_of(0, *npz)
    whole = take_files()

    # Ctrl-C: what is finished stays, and is found again.
    interrupt_after(2, "factors.npz.parts", [program, "factors", *scene, *npz, "--threads", "1"])
    assert os.listdir() == ["factors.npz.parts"] and 2 <= stored_blocks("factors.npz.parts") < parts

    # Another question does not go on there.
    for more, changed in ((["--seed", "2"], "scene"), (["--min", "0.5"], "--min"), (["--no-solids"], "scene")):
        done = factors(0, *npz, *more)
        assert done.returncode == 2 and f"{changed} was" in own_lines(done)[0], done

    # A picture alone is kept in parts too.
    interrupt_after(2, "sky.svg.parts", [program, "factors", *scene, "--svg", "sky.svg", "--threads", "1"])
    done = factors(0, "--svg", "sky.svg")
    assert done.returncode == 0 and "from an earlier run" in done.stderr, done
    os.remove("sky.svg")

    # A folder that no job made stays as it is; and so does what somebody put into one.
    os.makedirs("other.npz.parts/of_mine")
    done = factors(0, "--out", "other.npz")
    assert done.returncode == 2 and "other.npz.parts holds of_mine, which is of no job" in own_lines(done)[0], done
    assert os.listdir("other.npz.parts") == ["of_mine"] and not os.path.exists("other.npz")
    os.removedirs("other.npz.parts/of_mine")
    with open("factors.npz.parts/notes", "w", encoding="ascii") as file:
        file.write("mine")
    done = factors(0, "--out", "nowhere/factors.npz")
    assert done.returncode == 2 and "nowhere/factors.npz.parts: cannot be made: No such file" in own_lines(done)[0], done

    # A block that is damaged is computed again, by any number of ranks.
    folder = "factors.npz.parts/share-0000"
    blocks = sorted(os.listdir(folder))
    with open(f"{folder}/{blocks[0]}", "r+b") as file:
        file.seek(-1, os.SEEK_END)
        last = file.read(1)
        file.seek(-1, os.SEEK_END)
        file.write(bytes([last[0] ^ 1]))
    done = factors(2, *npz)
    assert done.returncode == 0 and f"({len(blocks) - 1} from an earlier run)" in done.stderr, done
    assert take_files() == whole
    assert os.listdir() == ["factors.npz.parts"] and os.listdir("factors.npz.parts") == ["notes"]
    os.remove("factors.npz.parts/notes")
    os.rmdir("factors.npz.parts")

    # Ranks that are killed at random points.
    seed = random.randrange(1 << 30)
    print("seed", seed, flush=True)
    chance = random.Random(seed)
    for least in (0, 2, 5):
        command = [*launch(chance.choice((1, 2, 3))), program, "factors", "--threads", "1", *scene, *npz]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as running:
            kill_one(running, chance, lambda least=least: stored_blocks("factors.npz.parts") >= least)
    assert report_of(2, *npz) == report
    assert take_files() == whole, seed
    assert not os.listdir()


factors_cases = {"factors": on_ranks, "factors_refused": refused, "factors_ended": ended}
