// SPDX-License-Identifier: MIT
#include "module.hpp"
#include "trees.hpp"

namespace shaftcull::python {

void add_box_trees(py::module_& module) {
  py::class_<TreeOf<Box>, HolderOf<Box>> tree(module, "BoxTree", R"(
A tree over a copy of boxes, sorted by space: for boxes that many shafts ask about. Answers equal those of a BoxStream.

boxes: float32 (n, 6), (n, 2, 3), a tuple (lo, hi) of (n, 3), or a tuple of six (n,). BadBound, with the index, for NaN
    or lo > hi. At most 2**32 - 1 boxes; 28 bytes each.

Many threads may ask at once. A change, such as update(), must be alone: RuntimeError otherwise.)");
  add_tree<Box>(tree, "BoxTree", "boxes");
}

}  // namespace shaftcull::python
