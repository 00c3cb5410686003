"""What sees what, by several processes: each answers some parts of all pairs.

    mpirun -n 4 python3 sights_in_parts.py"""

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


def answers(patches, between, part, parts):
    """Undecided pairs, the candidates of each, and how many pairs there are of each kind."""
    found = shaftcull.visibility(patches, occluders=between, part=part, parts=parts)
    return found.undecided, found.candidates, np.array(list(found.counts.values()))


def main(parts=64):
    from mpi4py import MPI

    world = MPI.COMM_WORLD
    patches, between = scene()
    patches = shaftcull.Patches(patches)
    between = shaftcull.Occluders(between["occluders"], solids=between["solids"])
    mine = range(world.rank, parts, world.size)
    found = world.gather([answers(patches, between, part, parts) for part in mine])
    if world.rank == 0:
        counts = sum(part[2] for share in found for part in share)
        print("%d undecided, %d clear, %d occluded, %d facing away" % tuple(counts))
    return found


if __name__ == "__main__":
    main()
