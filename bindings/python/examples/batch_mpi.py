"""What `shaftcull batch --answer count` does, in Python: how many boxes of a file each shaft of a file keeps.

    mpirun -n 4 python3 batch_mpi.py bounds.npy shafts.npy counts.npy

Whoever is free takes the next block of shafts from a counter that all ranks share."""

import sys

import numpy as np
import shaftcull


def main(bounds, shafts, out, block=65_536):
    from mpi4py import MPI

    world = MPI.COMM_WORLD
    tree = shaftcull.BoxTree(np.load(bounds))
    rows = np.load(shafts, mmap_mode="r")
    dealt = MPI.Win.Allocate(8 if world.rank == 0 else 0, 8, comm=world)
    if world.rank == 0:
        np.frombuffer(dealt, np.int64)[0] = 0
        np.lib.format.open_memmap(out, "w+", np.int64, (len(rows),)).flush()
    world.Barrier()
    counts = np.lib.format.open_memmap(out, "r+")
    one, first = np.array([block], np.int64), np.empty(1, np.int64)
    dealt.Lock_all()
    while True:
        dealt.Fetch_and_op(one, first, 0)
        dealt.Flush(0)
        if first[0] >= len(rows):
            break
        mine = slice(first[0], first[0] + block)
        counts[mine] = tree.count(shaftcull.Shafts.between(rows[mine, :6], rows[mine, 6:]))
    dealt.Unlock_all()
    counts.flush()
    world.Barrier()
    dealt.Free()


if __name__ == "__main__":
    main(*sys.argv[1:])
