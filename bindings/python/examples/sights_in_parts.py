"""What sees what, by several processes: patches in parts that lie together, and for each two parts one call.

    mpirun -n 4 python3 sights_in_parts.py

Of patches among themselves each pair comes once: a part is asked with itself, and with the parts behind it."""

import numpy as np
import shaftcull


def scene(count=2_000):
    """Houses, trees, and patches at the height of eyes."""
    random = np.random.default_rng(7)
    lo = np.hstack([random.integers(0, 400, (count, 2)) / 4, np.full((count, 1), 0.5)])
    patches = np.hstack([lo, lo + (0.25, 0.25, 0.25)]).astype(np.float32)
    at = np.stack(np.meshgrid(*[np.arange(2, 100, 5)] * 2), axis=-1).reshape(-1, 2)
    walls = np.hstack([at, 0 * at[:, :1], at + (3, 1), 3 + 0 * at[:, :1]]).astype(np.float32)
    trees = random.integers(0, 100, (200, 3)) * (1, 1, 0)
    return patches, dict(occluders=np.hstack([trees, trees + 1]).astype(np.float32), solids=walls)


def tasks(patches, parts):
    """Indices of two groups of patches for each call; None for the group with itself."""
    order = np.array_split(shaftcull.Patches(patches).order, parts)
    return [(a, None if i == j else b) for i, a in enumerate(order) for j, b in enumerate(order[i:], i)]


def answers(patches, between, task):
    """Undecided pairs by the indices of all patches, the candidates of each, and how many pairs there are of each kind."""
    a, b = task
    found = shaftcull.visibility(patches[a], None if b is None else patches[b], occluders=between)
    pairs = np.stack([a[found.undecided[:, 0]], (a if b is None else b)[found.undecided[:, 1]]], axis=1)
    return pairs, found.candidates, np.array(list(found.counts.values()))


def main():
    from mpi4py import MPI

    world = MPI.COMM_WORLD
    patches, between = scene()
    between = shaftcull.Occluders(between["occluders"], solids=between["solids"])
    mine = tasks(patches, parts=8)[world.rank :: world.size]
    parts = world.gather([answers(patches, between, task) for task in mine])
    if world.rank == 0:
        counts = sum(part[2] for share in parts for part in share)
        print("%d undecided, %d clear, %d occluded, %d facing away" % tuple(counts))
    return parts


if __name__ == "__main__":
    main()
