// SPDX-License-Identifier: MIT
/// Helpers for boxes and planes, and solid boxes.
#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::Box;
using shaftcull::Origin;
using shaftcull::Plane;
using shaftcull::Sphere;
using shaftcull::Vec3;
using shaftcull::ViewPlanes;
using shaftcull::WorldBox;
using shaftcull::WorldPlane;
using shaftcull::WorldSphere;
using shaftcull::WorldVec3;

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

shaftcull_status shaftcull_relative(const double origin[3], shaftcull_rounding rounding, const double* from,
                                    uint64_t count, float* to) {
  return guarded([&] {
    (void)given(origin, "origin");
    const Origin there({origin[0], origin[1], origin[2]});
    // Records of doubles and of floats that have no gaps.
    const auto converted = [&]<class From, class To>(const From* first, To* result, auto convert) {
      const std::span<const From> in = as_span(first, count, "from");
      convert(in, as_span(result, count, "to"));
    };
    const auto* const boxes = reinterpret_cast<const WorldBox*>(from);
    switch (rounding) {
      case SHAFTCULL_BOXES_AROUND:
        converted(boxes, reinterpret_cast<Box*>(to), [&](auto in, auto out) { there.around(in, out); });
        break;
      case SHAFTCULL_BOXES_WITHIN:
        converted(boxes, reinterpret_cast<Box*>(to), [&](auto in, auto out) { there.within(in, out); });
        break;
      case SHAFTCULL_SPHERES_AROUND:
        converted(reinterpret_cast<const WorldSphere*>(from), reinterpret_cast<Sphere*>(to),
                  [&](auto in, auto out) { there.around(in, out); });
        break;
      case SHAFTCULL_NEAREST:
        converted(reinterpret_cast<const WorldVec3*>(from), reinterpret_cast<Vec3*>(to),
                  [&](auto in, auto out) { there.nearest(in, out); });
        break;
      case SHAFTCULL_PLANES_AROUND:
        if (count == 0) break;
        (void)given(from, "from");
        converted(reinterpret_cast<const WorldPlane*>(from + 6), reinterpret_cast<Plane*>(to),
                  [&](auto in, auto out) { there.around(in, *boxes, out); });
        break;
      default:
        refuse("rounding = " + std::to_string(rounding) +
               " is none of SHAFTCULL_BOXES_AROUND, SHAFTCULL_BOXES_WITHIN, SHAFTCULL_SPHERES_AROUND, "
               "SHAFTCULL_NEAREST and SHAFTCULL_PLANES_AROUND");
    }
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
