// SPDX-License-Identifier: MIT
// Joining planes, for JavaScript: the C interface has no shafts with planes.
#include <algorithm>
#include <cstdint>
#include <cstring>

#include "shaftcull/paper.hpp"

namespace {

shaftcull::Box box_at(const float* floats) {
  shaftcull::Box box;
  std::memcpy(&box, floats, sizeof box);
  return box;
}

}  // namespace

// The planes that join two boxes of 6 floats: 4 floats each into `planes`, which has room for 8 of them. Returns how
// many there are. The boxes are those of a shaft, so they can be joined.
extern "C" [[clang::export_name("joining_planes")]] std::uint32_t joining_planes(const float* a, const float* b,
                                                                                 float* planes) {
  static_assert(shaftcull::max_joining_planes == 8);
  const shaftcull::Shaft shaft(box_at(a), box_at(b));
  for (const shaftcull::JoiningPlane& joining : shaft.joining_planes()) {
    planes = std::copy_n(joining.plane.normal.begin(), 3, planes);
    *planes++ = joining.plane.offset;
  }
  return static_cast<std::uint32_t>(shaft.joining_planes().size());
}
