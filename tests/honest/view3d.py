#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The errors and the time of `shaftcull factors` and of View3D (G. Walton, NISTIR 6925, 2002), on the same facets.

  view3d.py PROGRAM VIEW3D MESH        of a mesh file whose facets have three or four corners
  view3d.py PROGRAM VIEW3D --city N    of N × N blocks of houses: 15 by 15 m every 30 m, 9 to 24 m high, and the ground,
                                       in quadrilaterals of 7.5 m (N = 4: 644 facets; 8: 2,516)

Both are compared with `shaftcull factors --error 1e-9 --rays 65536`; the row `other rays` says how well these rays know
the factors. VIEW3D is the program; its sources are on the web.
"""
import json
import math
import os
import random
import subprocess
import sys
import tempfile

import numpy
import scipy.sparse


def quads(origin, along, up, lengths):
    """Corners of a rectangle cut into pieces of at most 7.5 m."""
    counts = [math.ceil(length / 7.5) for length in lengths]
    step = [numpy.multiply(way, length / n) for way, length, n in zip((along, up), lengths, counts)]
    for i in range(counts[0]):
        for j in range(counts[1]):
            yield [origin + a * step[0] + b * step[1] for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))]


def write_city(n, path):
    chance = random.Random(7)
    x, y, z = numpy.eye(3)
    facets = []
    for i in range(n):
        for j in range(n):
            at, h = numpy.array([30 * i + 10, 30 * j + 10, 0]), chance.choice([9, 12, 18, 24])
            for corner, way in ((at, x), (at + 15 * x, y), (at + 15 * (x + y), -x), (at + 15 * y, -y)):
                facets += quads(corner, way, z, (15, h))
            facets += quads(at + h * z, x, y, (15, 15))
    for i in range(2 * n + 1):
        for j in range(2 * n + 1):
            if not (i % 2 and j % 2):
                facets += quads(numpy.array([15 * i - 5, 15 * j - 5, 0]), x, y, (15, 15))
    with open(path, "w", encoding="ascii") as file:
        file.write("o city\n")
        for facet in facets:
            file.writelines("v {:g} {:g} {:g}\n".format(*corner) for corner in facet)
            file.write("f -4 -3 -2 -1\n")


def of_program(program, mesh, out, *options):
    command = [program, "factors", mesh, "--threads", "1", "--format", "json", "--out", out, *options]
    report = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    return scipy.sparse.load_npz(out).toarray(), report["seconds"]


def of_view3d(view3d, arrays, folder):
    first, corners = arrays["first_corner"], arrays["patch_corners"]
    with open(f"{folder}/scene.vs3", "w", encoding="ascii") as file:
        file.write("T scene\nC encl=0 list=0 eps=1.e-4\nF 3\n")
        for i, corner in enumerate(corners):
            file.write("V {} {:.9g} {:.9g} {:.9g}\n".format(i + 1, *corner))
        for i, (begin, end) in enumerate(zip(first, first[1:])):
            numbers = [*range(begin + 1, end + 1), 0][:4]  # 0: no fourth corner
            if not 3 <= end - begin <= 4:
                sys.exit(f"view3d.py: patch {i} has {end - begin} corners; View3D takes three or four")
            file.write(f"S {i + 1} {' '.join(map(str, numbers))} 0 0 0.9 f{i + 1}\n")
    before = sum(os.times()[2:4])
    subprocess.run([view3d, "scene.vs3", "factors.txt"], cwd=folder, check=True, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    seconds = sum(os.times()[2:4]) - before  # of children
    with open(f"{folder}/factors.txt", encoding="ascii") as file:
        lines = file.read().splitlines()
    count = len(first) - 1
    return numpy.array([line.split() for line in lines[2 : 2 + count]], float), seconds


def main():
    program, view3d, mesh = sys.argv[1:4]
    with tempfile.TemporaryDirectory() as folder:
        if mesh == "--city":
            mesh = f"{folder}/city.obj"
            write_city(int(sys.argv[4]), mesh)
        exact = ["--error", "1e-9", "--rays", "65536"]
        right, _ = of_program(program, mesh, f"{folder}/right.npz", *exact)
        rows = {"other rays": of_program(program, mesh, f"{folder}/other.npz", *exact, "--seed", "2"),
                "shaftcull": of_program(program, mesh, f"{folder}/factors.npz")}
        rows["View3D"] = of_view3d(view3d, numpy.load(f"{folder}/factors.npz"), folder)
        print(f"{len(right)} facets; errors of factors, and of the sums of a facet's factors\n")
        print(f"{'':12}{'seconds':>9}{'largest':>10}{'rms':>10}{'of a sum':>10}{'rms':>10}{'mean':>10}")
        for name, (factors, seconds) in rows.items():
            off = factors - right
            some, sums = off[(factors > 0) | (right > 0)], off.sum(1)
            print(f"{name:12}{seconds:9.2f}{abs(some).max():10.1e}{(some ** 2).mean() ** 0.5:10.1e}{abs(sums).max():10.1e}"
                  f"{(sums ** 2).mean() ** 0.5:10.1e}{sums.mean():10.1e}")


main()
