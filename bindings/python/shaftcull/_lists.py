# SPDX-License-Identifier: MIT
import operator

import numpy as np


class IndexLists:
    """Lists of indices, one for each of n shafts: the result of list() and its like for many shafts.

    lists[i]: uint32 (k,), the list of shaft i, a view of `indices`. i is an integer, which may count from the end;
        IndexError for one that names nothing. len() is n, and iterating gives the lists in order.
    offsets: int64 (n + 1,): list i is indices[offsets[i]:offsets[i + 1]].
    indices: uint32, all lists one behind the other.
    times: float32, a time for each of `indices`; None, unless list() was called with times=True.

    They can be pickled, and made of arrays that were saved: IndexLists(offsets, indices, times).
    """

    __module__ = "shaftcull"
    __slots__ = ("offsets", "indices", "times")

    def __init__(self, offsets, indices, times=None):
        self.offsets = offsets
        self.indices = indices
        self.times = times

    def __len__(self):
        return len(self.offsets) - 1

    def __getitem__(self, shaft):
        at = operator.index(shaft)
        if not -len(self) <= at < len(self):
            raise IndexError(f"index {at} is out of range for lists of {len(self)} shafts")
        at %= len(self)
        return self.indices[self.offsets[at] : self.offsets[at + 1]]

    def __iter__(self):
        return map(self.__getitem__, range(len(self)))

    def pairs(self):
        """All lists as pairs of a shaft and a bound, in order: uint32 (len(indices), 2). A copy."""
        shafts = np.arange(len(self), dtype=np.uint32)
        return np.column_stack([np.repeat(shafts, np.diff(self.offsets)), self.indices])

    def __repr__(self):
        times = "" if self.times is None else ", with times"
        return f"<shaftcull.IndexLists of {len(self)} shafts, {len(self.indices)} indices{times}>"
