# SPDX-License-Identifier: MIT
"""`shaftcull sun` in parts: files are those of any number of ranks, bit for bit, also after an interruption."""
import os
import subprocess

from launched import interrupt_after, launch, own_lines, program, stored_blocks, take_files

day = ["--latitude", "48", "--day", "06-21"]
parts = 8  # of 64 positions


def write_yard():
    """A floor of 32 by 32 and 16 pillars, which cast shadows on it; long enough a run to be kept in parts."""
    os.makedirs("scene", exist_ok=True)
    with open("scene/yard.obj", "w", encoding="ascii") as file:
        file.write("v 0 0 0\nv 32 0 0\nv 32 32 0\nv 0 32 0\nf 1 2 3 4\n")
        for pillar in range(16):
            x, y = 8 * (pillar % 4) + 3, 8 * (pillar // 4) + 3
            for i in range(8):
                file.write(f"v {x + (i & 1)} {y + (i >> 1 & 1)} {3 * (i >> 2)}\n")
            first = 5 + 8 * pillar
            for face in ((4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
                file.write("f " + " ".join(str(first + corner) for corner in face) + "\n")
    return ["scene/yard.obj", "--patches", "0.5", "--rays", "256", *day]


def sun(ranks, *words):
    command = [*launch(ranks), program, "sun", "--threads", "2", *words]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)


def found(ranks, *words):
    done = sun(ranks, *words)
    assert done.returncode == 0, done
    return done


def on_ranks():
    scene = write_yard()
    for files in (["--out", "sun.npz"], ["--svg", "sun.svg", "--ply", "sun.ply"]):
        alone = found(0, *scene, *files)
        assert f"compute: {parts} of {parts} parts" in alone.stderr, alone
        whole = take_files()
        for ranks in (1, 3):
            done = found(ranks, *scene, *files)
            assert take_files() == whole, (ranks, files)
            assert os.listdir() == ["scene"]
            assert done.stdout.splitlines()[:4] == alone.stdout.splitlines()[:4], (done, alone)
    # In one process that keeps nothing, hours are the same.
    drawn = found(0, *scene, "--svg", "-")
    assert drawn.stdout.encode() == whole["sun.svg"]

    for ranks, more, message in ((3, [], "several processes need --out, --svg or --ply with a FILE"),
                                 (3, ["--svg", "-"], "several processes need --out, --svg or --ply with a FILE"),
                                 (3, ["--out", "sun.csv"], "give a name that ends in .npz")):
        done = sun(ranks, *scene, *more)
        assert done.returncode == 2 and len(own_lines(done)) == 1 and message in own_lines(done)[0], done
        assert os.listdir() == ["scene"]


def ended():
    scene = [*write_yard(), "--svg", "sun.svg"]
    found(0, *scene)
    whole = take_files()
    said = interrupt_after(2, "sun.svg.parts", [program, "sun", *scene, "--threads", "1"])
    assert "sun: interrupted; " in said, said
    stored = stored_blocks("sun.svg.parts")
    assert 2 <= stored < parts

    for more, changed in ((["--seed", "2"], "--seed"), (["--every", "5"], "positions"), (["--flip"], "scene")):
        done = sun(0, *scene, *more)
        assert done.returncode == 2 and f"{changed} was" in own_lines(done)[0], done
    done = found(2, *scene)
    assert f"({stored} from an earlier run)" in done.stderr, done
    assert take_files() == whole and os.listdir() == ["scene"]


sun_cases = {"sun": on_ranks, "sun_ended": ended}
