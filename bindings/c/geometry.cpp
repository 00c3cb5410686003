// SPDX-License-Identifier: MIT
#include <algorithm>
#include <span>

#include "arguments.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::Box;
using shaftcull::ViewPlanes;

extern "C" {

uint64_t shaftcull_bit_words(uint64_t bounds) { return bounds / 64 + (bounds % 64 != 0); }

shaftcull_status shaftcull_box_around(const float* points, uint64_t count, shaftcull_box* box) {
  return guarded([&] {
    shaftcull_box& out = given(box, "box");
    out = converted<shaftcull_box>(shaftcull::box_around(as_vectors(points, count, "points")));
  });
}

shaftcull_status shaftcull_joined(const shaftcull_box* a, const shaftcull_box* b, shaftcull_box* box) {
  return guarded([&] {
    shaftcull_box& out = given(box, "box");
    out = converted<shaftcull_box>(shaftcull::joined(as_box(a, "a"), as_box(b, "b")));
  });
}

shaftcull_status shaftcull_translated(const shaftcull_box* box, const float by[3], shaftcull_box* moved) {
  return guarded([&] {
    shaftcull_box& out = given(moved, "moved");
    out = converted<shaftcull_box>(shaftcull::translated(as_box(box, "box"), as_vector(by, "by")));
  });
}

shaftcull_status shaftcull_inflated(const shaftcull_box* box, float by, shaftcull_box* inflated) {
  return guarded([&] {
    shaftcull_box& out = given(inflated, "inflated");
    out = converted<shaftcull_box>(shaftcull::inflated(as_box(box, "box"), by));
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

}  // extern "C"
