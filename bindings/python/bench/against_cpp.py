# SPDX-License-Identifier: MIT
"""Times calls from Python against the same calls in C++, in turns, in one run: shaftcull_python_bench of the build.

    PYTHONPATH=build/release/python python3 bindings/python/bench/against_cpp.py build/release/bin/shaftcull-python-bench
"""

import argparse
import statistics
import subprocess
import tempfile
import time

import numpy as np
import shaftcull


def scene(boxes, shafts):
    random = np.random.default_rng(1)
    lo = random.random((boxes, 3), dtype=np.float32) * 100
    made = np.hstack([lo, lo + random.random((boxes, 3), dtype=np.float32)])
    return made, made[:shafts].copy(), made[shafts : 2 * shafts].copy()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="shaftcull-python-bench, which makes the calls in C++")
    parser.add_argument("--boxes", type=int, default=1_000_000)
    parser.add_argument("--shafts", type=int, default=1000)
    parser.add_argument("--rounds", type=int, default=15)
    given = parser.parse_args()
    boxes, a, b = scene(given.boxes, given.shafts)
    tree, stream = shaftcull.BoxTree(boxes), shaftcull.BoxStream(boxes)
    shafts = shaftcull.Shafts.between(a, b)
    calls = {
        "tree list": lambda: tree.list(shafts),
        "tree count": lambda: tree.count(shafts),
        "tree first_contact": lambda: tree.first_contact(shafts),
        "flat count": lambda: stream.count(shafts),
        "flat list": lambda: stream.list(shafts),
        "flat bits": lambda: stream.cull(shafts, packed=True),
    }
    with tempfile.NamedTemporaryFile() as file:
        for array in (boxes, a, b):
            file.write(array.tobytes())
        file.flush()
        command = [given.program, file.name, str(given.boxes), str(given.shafts)]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as cpp:
            for name, call in calls.items():
                times = {"python": [], "c++": []}
                for round_ in range(given.rounds + 1):
                    start = time.perf_counter()
                    call()
                    here = time.perf_counter() - start
                    print(name, file=cpp.stdin, flush=True)
                    there = float(cpp.stdout.readline())
                    if round_:  # the first one warms up
                        times["python"].append(here)
                        times["c++"].append(there)
                here, there = statistics.median(times["python"]), statistics.median(times["c++"])
                ratio = statistics.median(x / y for x, y in zip(times["python"], times["c++"]))
                print(f"{name:18} Python {here * 1e3:8.2f} ms   C++ {there * 1e3:8.2f} ms   ratio {ratio:.3f}")
            cpp.stdin.close()


if __name__ == "__main__":
    main()
