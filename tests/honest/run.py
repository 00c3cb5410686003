#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What `shaftcull sees` proves of meshes as they come, against rays.

  run.py PROGRAM [MESH …] [--pairs N] [--rays N] [--seed S] [--file FILE --patches SIZE]

For each mesh of meshes.py, or a mesh file of yours: draws pairs that are answered, a third of each answer, and traces rays between
them with NumPy (rays.py). None may contradict the answer:

  occluded      no ray arrives
  clear         all rays arrive
  facing_away   no point of one patch is in front of the other while a point of the other is in front of it

Counted apart is what touches: rays within `margin` of edges and planes, which is four times the rounding of coordinates or the
tolerance that the program reports (unclear); pairs of whose rays none has its ends in front of both patches (grazing); and rays
within a body, where its surface hides nothing (in a body). Ends with 1 if an answer is contradicted, and prints the first
such pairs; with 77, "skipped", without NumPy.
"""
import argparse
import collections
import json
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # here, beside the sources

try:
    import numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

import meshes
import rays

CLEAR, OCCLUDED, FACING_AWAY = 1, 2, 3
names = {CLEAR: "clear", OCCLUDED: "occluded", FACING_AWAY: "facing_away"}
most_patches = 12000  # so that answers fit into a matrix


def sees(program, path, size, folder):
    """Its report and the arrays of its file."""
    out = f"{folder}/sights.npz"
    command = [program, "sees", path, "--patches", str(size), "--format", "json", "--out", out]
    report = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout)
    return report, numpy.load(out)


def answers(sights):
    """A matrix of answers; 0 for undecided pairs and on the diagonal."""
    order = sights["order"]
    matrix = numpy.zeros((len(order), len(order)), numpy.uint8)
    for first_a, count_a, first_b, count_b, sight in sights["blocks"]:
        a, b = order[first_a : first_a + count_a], order[first_b : first_b + count_b]
        matrix[numpy.ix_(a, b)] = matrix[numpy.ix_(b, a)] = sight
    numpy.fill_diagonal(matrix, 0)
    return matrix


def drawn(matrix, answer, count, source):
    """Pairs with an answer, each of them with the same chance."""
    all_pairs = numpy.flatnonzero(numpy.triu(matrix == answer))
    some = source.choice(all_pairs, min(count, len(all_pairs)), replace=False)
    return numpy.unravel_index(numpy.sort(some), matrix.shape)


class Check:
    def __init__(self, program, path, size, seed):
        with tempfile.TemporaryDirectory() as folder:
            # Without patches to split, these are the triangles as the program read them.
            self.triangles = sees(program, path, 1e30, folder)[1]["patch_corners"]
            self.report, sights = sees(program, path, size, folder)
            self.patches = sights["patch_corners"]
            if len(self.patches) > most_patches:
                sys.exit(f"{path}: {len(self.patches)} patches are too many; give a larger --patches")
            self.matrix = answers(sights)
        step = float(numpy.spacing(numpy.float32(numpy.abs(self.triangles).max())))
        self.margin = 4 * max(step, self.report["tolerance"])
        self.stops = rays.Triangles(self.triangles, self.margin)
        self.bodies = rays.Triangles(rays.bodies(self.triangles), self.margin)
        self.source = numpy.random.default_rng(seed)

    def run(self, answer, count, ray_count):
        """Counts of what was seen, and pairs that contradict the answer."""
        i, j = drawn(self.matrix, answer, count, self.source)
        seen, wrong = collections.Counter(pairs=len(i)), []
        for first in range(0, len(i), 4096):
            a, b = self.patches[i[first : first + 4096]], self.patches[j[first : first + 4096]]
            p, q = (rays.points_in(x, ray_count, self.source) for x in (a, b))
            leaves = rays.in_front(a, q, self.margin) & rays.in_front(b, p, self.margin)
            seen["rays"] += leaves.size
            seen["facing"] += int(leaves.sum())
            seen["grazing"] += int((~leaves.any(1)).sum())
            if answer == FACING_AWAY:
                bad = rays.in_front(a, q, self.margin).any(1) & rays.in_front(b, p, self.margin).any(1)
            else:
                outcome = rays.outcomes(a, b, p, q, self.stops)
                seen["unclear"] += int((leaves & (outcome == rays.UNCLEAR)).sum())
                bad = leaves & (outcome == (rays.FREE if answer == OCCLUDED else rays.STOPPED))
                if answer == OCCLUDED:  # all of a free ray is within a body if its middle is
                    of, ray = numpy.nonzero(bad)
                    within = rays.surrounded((p[of, ray] + q[of, ray]) / 2, self.bodies, self.source)
                    seen["within"] += int(within.sum())
                    bad[of[within], ray[within]] = False
                bad = bad.any(1)
            wrong += [(int(i[first + k]), int(j[first + k])) for k in numpy.flatnonzero(bad)]
        seen["wrong"] = len(wrong)
        return seen, wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("meshes", nargs="*", metavar="MESH", help=", ".join(meshes.makers))
    parser.add_argument("--pairs", type=int, default=100000, help="pairs of each mesh (default: %(default)s)")
    parser.add_argument("--rays", type=int, default=64, help="rays of each pair (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--file", help="a mesh file in place of meshes made here")
    parser.add_argument("--patches", type=float, help="with --file: the length of edges of patches")
    choice = parser.parse_args()
    if set(choice.meshes) - set(meshes.makers) or (choice.file and not choice.patches):
        parser.error(f"meshes are {', '.join(meshes.makers)}; --file needs --patches")
    print(f"seed {choice.seed}; a ray is unclear within the margin of an edge or of a patch's plane", flush=True)
    print(f"{'mesh':14}{'answer':13}{'pairs':>8}{'rays':>10}{'facing':>10}{'grazing':>9}{'unclear':>9}{'in a body':>11}{'wrong':>7}  margin")
    wrong_pairs = 0
    with tempfile.TemporaryDirectory() as folder:
        for name in [choice.file] if choice.file else choice.meshes or meshes.makers:
            path, size = (name, choice.patches) if choice.file else (meshes.write(folder, name, choice.seed), meshes.sizes[name])
            check = Check(choice.program, path, size, choice.seed)
            for answer in names:
                seen, wrong = check.run(answer, choice.pairs // 3 + 1, choice.rays)
                wrong_pairs += len(wrong)
                if answer == FACING_AWAY:
                    seen["grazing"] = 0  # all of them are
                columns = (("pairs", 8), ("rays", 10), ("facing", 10), ("grazing", 9), ("unclear", 9), ("within", 11), ("wrong", 7))
                numbers = "".join(f"{seen[column]:{width}}" for column, width in columns)
                print(f"{name[-13:]:14}{names[answer]:13}{numbers}  {check.margin:.1e}", flush=True)
                for i, j in wrong[:3]:
                    print(f"  patches {i} and {j}: {check.patches[[i, j]].tolist()}")
    return 1 if wrong_pairs else 0


if __name__ == "__main__":
    sys.exit(main())
