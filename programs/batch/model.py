#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How long a job of `shaftcull batch` takes on 1 to 1,024 nodes, and what limits it.

    shaftcull batch … --log log        on one machine, with some of the shafts
    model.py log.* --blocks 152588 --input 12e9 --output 80e9

The log has the time of each block, of the tree, and of writing. The work of a larger job is drawn from these times, with
a seed, and dealt on demand: whoever is free takes the next block. What one machine cannot measure is given: how fast
the file system and a node's link are, and how long a block takes to be dealt.
"""
import argparse
import csv
import heapq
import random


def read_logs(paths):
    """Seconds by what was done, over all ranks."""
    times = {}
    for path in paths:
        with open(path, encoding="ascii", newline="") as file:
            for row in csv.DictReader(file):
                times.setdefault(row["what"], []).append((int(row["share"]), int(row["block"]), float(row["seconds"])))
    return times


def overlapped(times, one, other):
    """Seconds of each block, by share and block, of two steps of which one goes on during the other of the next block:
    those of the slower."""
    seconds = {}
    for what in (one, other):
        for share, block, taken in times.get(what, []):
            seconds[share, block] = max(seconds.get((share, block), 0), taken)
    return [seconds[key] for key in sorted(seconds)]


def blocks_of(times):
    """Seconds of each block: answering it, while the one before is stored."""
    return overlapped(times, "answer", "store")


def deal(blocks, ranks, latency=0.0, service=0.0):
    """Deals blocks to whoever is free. Returns when the last is done, and when each rank was. A block takes `latency` to
    be taken, and the counter `service` for each, one after the other."""
    free = [0.0] * ranks
    counter = 0.0
    for seconds in blocks:
        now = heapq.heappop(free)
        counter = max(counter, now) + service
        heapq.heappush(free, counter + latency + seconds)
    return max(free), sorted(free)


def drawn(blocks, count, seed):
    """So many blocks: those of the log, again and again, in random order."""
    source = random.Random(seed)
    return [source.choice(blocks) for _ in range(count)]


def predict(times, nodes, given):
    """The parts of a job's time on so many nodes, in seconds."""
    ranks = nodes * given.ranks
    blocks = drawn(blocks_of(times), given.blocks, given.seed)
    bandwidth = min(given.file_system, nodes * given.link)
    even = sum(blocks) / ranks
    alone, _ = deal(blocks, ranks)
    dealt, _ = deal(blocks, ranks, given.latency * 1e-6, given.service * 1e-6)
    trees = [taken for _, _, taken in times.get("tree", [])]
    writes = overlapped(times, "read", "write")
    # Answers are stored, read again, and written.
    output = max(3 * given.output / bandwidth, sum(writes) / max(len(writes), 1) * given.blocks / ranks)
    return {
        "work": even,
        "tail": alone - even,
        "dealing": dealt - alone,
        "input": nodes * given.input / bandwidth,
        "tree": max(trees, default=0.0),
        "output": output,
    }


def table(times, given):
    lines = ["nodes    ranks   seconds  efficiency    work    tail  dealing   input    tree  output  limited by"]
    first = None
    nodes = 1
    while nodes <= given.nodes:
        parts = predict(times, nodes, given)
        total = sum(parts.values())
        first = first or total
        limit = max(parts, key=parts.get)
        numbers = "".join(f"{parts[part]:{width}.2f}" for part, width in
                          (("work", 10), ("tail", 8), ("dealing", 9), ("input", 8), ("tree", 8), ("output", 8)))
        lines.append(f"{nodes:5}{nodes * given.ranks:9}{total:10.1f}{first / total / nodes:11.0%}{numbers}  {limit}")
        nodes *= 2
    return lines


def tail(times, given, ranks=64, seeds=20):
    """How much longer than its even share the last rank works, over some orders of blocks."""
    blocks = blocks_of(times)
    ratios = []
    for seed in range(seeds):
        some = drawn(blocks, given.blocks, seed)
        last, _ = deal(some, ranks, given.latency * 1e-6, given.service * 1e-6)
        ratios.append(last / (sum(some) / ranks) - 1)
    ratios.sort()
    return f"{given.blocks} blocks on {ranks} ranks: the last one ends {ratios[seeds // 2]:.2%} after an even share, at most {ratios[-1]:.2%} in {seeds} orders"


def arguments(words=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("logs", nargs="+", metavar="LOG", help="files that --log wrote")
    parser.add_argument("--blocks", type=int, help="of the job (default: as many as the log has)")
    parser.add_argument("--ranks", type=int, default=1, help="of a node (default: 1)")
    parser.add_argument("--nodes", type=int, default=1024, help="up to so many (default: 1024)")
    parser.add_argument("--input", type=float, default=0, help="bytes that each node reads")
    parser.add_argument("--output", type=float, default=0, help="bytes of all answers")
    parser.add_argument("--file-system", type=float, default=20e9, help="bytes a second of all nodes (default: 20e9)")
    parser.add_argument("--link", type=float, default=2.5e9, help="bytes a second of a node (default: 2.5e9)")
    parser.add_argument("--latency", type=float, default=5, help="microseconds until a block is taken (default: 5)")
    parser.add_argument("--service", type=float, default=1, help="microseconds of the counter for each (default: 1)")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args(words)
    times = read_logs(given.logs)
    if not blocks_of(times):
        parser.error("the logs have no block")
    given.blocks = given.blocks or len(blocks_of(times))
    return times, given


if __name__ == "__main__":
    TIMES, GIVEN = arguments()
    print("\n".join(table(TIMES, GIVEN)))
    print(tail(TIMES, GIVEN))
