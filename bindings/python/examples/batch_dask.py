"""What `shaftcull batch --answer list` does, by dask: which boxes of a file each shaft of a file keeps, as CSR.

    python3 batch_dask.py bounds.npy shafts.npy lists.npz

With a client of dask.distributed the workers may be on other machines, which all read the same files."""

import functools
import sys

import dask
import numpy as np
import shaftcull


@functools.cache  # one tree a worker
def tree_of(bounds):
    return shaftcull.BoxTree(np.load(bounds))


def lists(bounds, shafts, first, end):
    rows = np.load(shafts, mmap_mode="r")[first:end]
    found = tree_of(bounds).list(shaftcull.Shafts.between(rows[:, :6], rows[:, 6:]))
    row, index = found.pairs().T
    return found.offsets, index[np.lexsort((index, row))]  # a tree lists them in its own order


def main(bounds, shafts, out, block=16_384):
    count = len(np.load(shafts, mmap_mode="r"))
    blocks = [dask.delayed(lists)(bounds, shafts, i, min(count, i + block)) for i in range(0, count, block)]
    parts = dask.compute(*blocks)  # in the order of blocks, whoever does them
    sizes = np.concatenate([np.diff(offsets) for offsets, _ in parts])
    offsets = np.concatenate([[0], np.cumsum(sizes, dtype=np.uint64)]).astype(np.uint64)
    np.savez(out, offsets=offsets, indices=np.concatenate([indices for _, indices in parts]))


if __name__ == "__main__":
    main(*sys.argv[1:])
