# SPDX-License-Identifier: MIT
"""openfoam_test.py SCRIPT PROGRAM: the recipe for OpenFOAM, in a room of 2 x 1 x 1, against the closed form."""
import math
import os
import re
import subprocess
import sys
import tempfile

try:
    import numpy  # noqa: F401
    import scipy.sparse  # noqa: F401
except ImportError:
    print("skipped: there is no NumPy or SciPy")
    sys.exit(77)

script, program = map(os.path.abspath, sys.argv[1:])
points = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1, 2)]


def at(*corners):
    return "4(" + " ".join(str(points.index(corner)) for corner in corners) + ")"


def face(x, y, z, u, v):
    """A unit square from a corner on, whose normal is u x v."""
    p = (x, y, z)
    q = tuple(a + b for a, b in zip(p, u))
    r = tuple(a + b for a, b in zip(q, v))
    return at(p, q, r, tuple(a + b for a, b in zip(p, v)))


X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)
# Faces that face outwards, in patches; and the clusters of their coarse faces.
patches = {
    "inside": ([at((1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1))], None),
    "floor": ([face(x, 0, 0, Y, X) for x in (0, 1)], "2{0}"),
    "ceiling": ([face(x, 0, 1, X, Y) for x in (0, 1)], "2(1 0)"),
    "opening": ([face(0, 0, 0, Z, Y)], "1(0)"),  # no viewFactorWall
    "end": ([face(2, 0, 0, Y, Z)], "1{0}"),
    "sides": ([face(x, 0, 0, X, Z) for x in (0, 1)] + [face(x, 1, 0, Z, X) for x in (0, 1)], "4(0 0 1 1)"),
}
coarse = ["floor", "ceiling", "ceiling", "end", "side", "side"]


def write(name, *lines):
    with open(f"constant/{name}", "w", encoding="ascii") as file:
        file.write("FoamFile\n{\n    version 2.0;\n    format ascii;\n}\n// * * //\n" + "\n".join(lines) + "\n")


def write_case():
    os.makedirs("constant/polyMesh")
    write("polyMesh/points", f"{len(points)}\n(", *(f"({x} {y} {z})" for x, y, z in points), ")")
    faces = [face for faces, _ in patches.values() for face in faces]
    write("polyMesh/faces", f"{len(faces)}\n(", *faces, ")")
    start = 1
    entries = []
    for name, (faces, clusters) in patches.items():
        if clusters is None:
            continue
        groups = "wall" if name == "opening" else "wall viewFactorWall"
        entries.append(f"    {name}\n    {{\n        type wall;\n        inGroups {groups.count(' ') + 1}({groups});\n"
                       f"        nFaces {len(faces)};\n        startFace {start};\n    }}")
        start += len(faces)
    write("polyMesh/boundary", f"{len(entries)}\n(", *entries, ")")
    write("finalAgglom", f"{len(entries)}\n(", *(clusters for _, clusters in patches.values() if clusters), ")")


def lists_in(name, kind):
    with open(f"constant/{name}", encoding="ascii") as file:
        body = file.read().split("}", 1)[1]
    assert int(body.split("(", 1)[0]) == len(coarse), body
    rows = [[kind(number) for number in items.split()] for _, items in re.findall(r"(\d+)\(([^()]*)\)", body)]
    assert all(int(count) == len(items.split()) for count, items in re.findall(r"(\d+)\(([^()]*)\)", body))
    return rows


def opposite(a, b):
    """From one rectangle of a x b to another at distance 1."""
    p, q = math.sqrt(1 + a * a), math.sqrt(1 + b * b)
    return 2 / (math.pi * a * b) * (math.log(p * q / math.sqrt(1 + a * a + b * b)) + a * q * math.atan(a / q) +
                                    b * p * math.atan(b / p) - a * math.atan(a) - b * math.atan(b))


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    write_case()
    os.mkdir("bin")
    os.symlink(program, "bin/shaftcull")
    subprocess.run([sys.executable, script, "constant"], check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, "PATH": f"{folder}/bin:{os.environ['PATH']}"})
    values, columns = lists_in("F", float), lists_in("globalFaceFaces", int)
    factors = [dict(zip(row, row_values)) for row, row_values in zip(columns, values)]
    with open("constant/mapDist", encoding="ascii") as file:
        assert file.read().split("}", 1)[1].split() == "6 1(6(0 1 2 3 4 5) ) 1(6(0 1 2 3 4 5) ) 0 0 0() 0()".split()
    os.chdir("/")

areas = {"floor": 2, "ceiling": 1, "end": 1, "side": 2}
near = lambda p, q: abs(p - q) < 1e-6  # noqa: E731
for i, row in enumerate(factors):
    assert set(row) <= set(range(6)) and i not in row, row
    for j, factor in row.items():
        assert near(areas[coarse[i]] * factor, areas[coarse[j]] * factors[j][i]), (i, j)
whole = opposite(2, 1)
assert near(factors[0][1] + factors[0][2], whole), factors[0]
assert near(factors[4][5], whole) and near(factors[5][4], whole), factors
# The cluster of the second face of the ceiling, which is above x = 1 to 2, comes second: it is nearer to the end.
assert factors[2][3] > 2 * factors[1][3], factors
# What is missing to 1 goes through the opening, which is at distance 2 from the end.
assert near(sum(factors[3].values()), 1 - opposite(0.5, 0.5)), factors
