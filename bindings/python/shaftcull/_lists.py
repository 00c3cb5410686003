# SPDX-License-Identifier: MIT
import operator

import numpy as np


class IndexLists:
    """Lists of indices, one per shaft: the result of list() and similar calls for n shafts.

    lists[i]: uint32 (k,), the list of shaft i, a view of `indices`. i is an integer, which may count from the end;
        IndexError if it is out of range. len() is n, and iterating gives the lists in order.
    offsets: int64 (n + 1,): list i is indices[offsets[i]:offsets[i + 1]].
    indices: uint32, all lists, one after another.
    times: float32, one time per index; None unless list() was called with times=True.

    IndexLists can be pickled, and made from saved arrays: IndexLists(offsets, indices, times).
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
