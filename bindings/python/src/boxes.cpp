// SPDX-License-Identifier: MIT
#include "module.hpp"
#include "streams.hpp"

namespace shaftcull::python {

void add_box_streams(py::module_& module) {
  const auto in = [](const py::object& given, const std::string& name) { return boxes_in(given, name); };
  py::class_<Viewed<BoxView>, HolderOf<Box>> view(module, "BoxView", R"(
Boxes in arrays of the caller's, which are kept and never copied.

boxes: float32 whose columns are contiguous: (n, 6) in Fortran order, the transpose of (6, n); such (n, 2, 3); a tuple
    (lo, hi) of such (n, 3); or a tuple of six (n,).

Values are not checked, and may change between questions. A box with NaN is kept by every shaft.)");
  add_view<BoxView>(view, "BoxView", "boxes", "a transpose of (6, n), numpy.asfortranarray(boxes), or six arrays (n,)",
                    in);

  py::class_<Streamed<BoxStream>, HolderOf<Box>> stream(module, "BoxStream", R"(
A copy of boxes, checked, in separate aligned streams: 24 bytes per box.

boxes: float32 (n, 6), (n, 2, 3), a tuple (lo, hi) of (n, 3), or a tuple of six (n,). BadBound, with the index, for NaN
    or lo > hi; lo = infinity and hi = -infinity on all axes is the empty box.)");
  add_stream<BoxStream>(stream, "BoxStream", "boxes", in);
}

}  // namespace shaftcull::python
