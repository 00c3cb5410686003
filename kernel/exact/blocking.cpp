// SPDX-License-Identifier: MIT
#include "exact/blocking.hpp"

#include <algorithm>
#include <cmath>

#include "exact/edge.hpp"

namespace shaftcull::kernel {
namespace {

/// Whether both ends of every segment, and the box, lie in one plane across axis `k`: a plane that puts no constraint
/// on t.
bool share_a_plane(const ShaftData& shaft, const float (&bound)[6], unsigned k) noexcept {
  const float x = bound[k];
  return bound[k + 3] == x && shaft.a[k] == x && shaft.a[k + 3] == x && shaft.b[k] == x && shaft.b[k + 3] == x;
}

/// Whether every segment is strictly between the box's two faces on axis `k` somewhere on its way, or in the plane of
/// both. false for NaN.
bool reaches_across(const ShaftData& shaft, const float (&bound)[6], unsigned k) noexcept {
  return bound[k] <= bound[k + 3] && bound[k] < std::max(shaft.a[k], shaft.b[k]) &&
         bound[k + 3] > std::min(shaft.a[k + 3], shaft.b[k + 3]);
}

}  // namespace

bool box_blocks(const ShaftData& shaft, const float (&bound)[6]) noexcept {
  for (unsigned k = 0; k < 3; ++k) {
    if (!reaches_across(shaft, bound, k) && !share_a_plane(shaft, bound, k)) return false;
  }
  const auto is_flat = [&](unsigned face) { return bound[face % 3] == bound[face % 3 + 3]; };
  // lo(t) > bound.lo and hi(t) < bound.hi: red faces bound t from below, blue ones from above.
  const MovingFaces moving(shaft);
  const Faces faces(moving);
  for (unsigned r = 0; r < faces.reds; ++r) {
    const unsigned red = faces.red[r];
    if (!std::isfinite(bound[red])) continue;
    for (unsigned b = 0; b < faces.blues; ++b) {
      const unsigned blue = faces.blue[b];
      if (blue % 3 == red % 3 || !std::isfinite(bound[blue])) continue;
      const int later = Edge(moving, red, blue).side(bound[red], bound[blue]);
      if (later < 0 || (later == 0 && !(is_flat(red) && is_flat(blue)))) return false;
    }
  }
  return true;
}

}  // namespace shaftcull::kernel
