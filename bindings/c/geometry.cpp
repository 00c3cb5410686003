// SPDX-License-Identifier: MIT
/// Helpers for boxes and planes, and solid boxes.
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "arguments.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::Box;
using shaftcull::ViewPlanes;

extern "C" {

shaftcull_status shaftcull_box_around(const float* points, uint64_t count, shaftcull_box* box) {
  return guarded([&] {
    shaftcull_box& out = given(box, "box");
    out = converted<shaftcull_box>(shaftcull::box_around(as_vectors(points, count, "points")));
  });
}

shaftcull_status shaftcull_translated(const shaftcull_box* box, const float by[3], float inflated_by,
                                      shaftcull_box* moved) {
  return guarded([&] {
    shaftcull_box& out = given(moved, "moved");
    Box result = as_box(box, "box");
    if (by != nullptr) result = shaftcull::translated(result, as_vector(by, "by"));
    if (inflated_by != 0) result = shaftcull::inflated(result, inflated_by);
    out = converted<shaftcull_box>(result);
  });
}

shaftcull_status shaftcull_view_planes(const float matrix[16], shaftcull_clip_depth depth, shaftcull_plane planes[6],
                                       uint64_t* count) {
  return guarded([&] {
    (void)given(matrix, "matrix");
    (void)given(planes, "planes");
    uint64_t& out = given(count, "count");
    const ViewPlanes view = shaftcull::view_planes(std::span<const float, 16>(matrix, 16), as_depth(depth));
    std::transform(view.begin(), view.end(), planes, converted<shaftcull_plane, shaftcull::Plane>);
    out = view.count;
  });
}

shaftcull_status shaftcull_merged_boxes(const shaftcull_box* boxes, uint64_t count, shaftcull_box* merged,
                                        uint64_t room, uint64_t* merged_count) {
  return guarded([&] {
    const std::span<shaftcull_box> out = as_span(merged, room, "merged");
    uint64_t& number = given(merged_count, "merged_count");
    const std::vector<Box> found = shaftcull::merged_boxes(copied<Box>(boxes, count, "boxes"));
    const std::size_t written = std::min(found.size(), out.size());
    std::transform(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(written), out.begin(),
                   [](const Box& box) { return converted<shaftcull_box>(box); });
    number = found.size();
  });
}

shaftcull_status shaftcull_inscribed_box(const float* corners, uint64_t count, shaftcull_box* box) {
  return guarded([&] {
    shaftcull_box& out = given(box, "box");
    out = converted<shaftcull_box>(shaftcull::inscribed_box(as_vectors(corners, count, "corners")));
  });
}

shaftcull_status shaftcull_view_factor(const float* from, uint64_t from_count, const float* to, uint64_t to_count,
                                       double* factor) {
  return guarded([&] {
    double& out = given(factor, "factor");
    out = shaftcull::view_factor(as_vectors(from, from_count, "from"), as_vectors(to, to_count, "to"));
  });
}

}  // extern "C"
