// SPDX-License-Identifier: MIT
/// The planes of a hull once more, side by side.
#pragma once

#include <limits>

#include "compiled/hull_data.hpp"

namespace shaftcull::kernel {

/// Writes the groups of a hull whose planes are known.
inline void write_plane_groups(HullData& hull) noexcept {
  using Group = HullData::PlaneGroup;
  const unsigned planes = hull.faces + hull.edges;
  for (unsigned p = 0; p % Group::planes != 0 || p < planes; ++p) {
    Group& group = hull.group[p / Group::planes];
    const unsigned lane = p % Group::planes;
    for (unsigned k = 0; k < 3; ++k) group.inward[k][lane] = 0;
    if (p >= planes) {
      group.offset[lane] = std::numeric_limits<float>::infinity();
      group.length[lane] = group.magnitude[lane] = 0;
      continue;
    }
    const HullData::Plane& plane = hull.plane[p];
    const bool is_face = p < hull.faces;
    const unsigned first_axis = is_face ? 0 : plane.axis + 1U;
    for (unsigned i = 0; i < (is_face ? 3U : 2U); ++i) group.inward[(first_axis + i) % 3][lane] = plane.inward[i];
    group.offset[lane] = plane.offset;
    group.length[lane] = plane.length;
    group.magnitude[lane] = plane.magnitude;
  }
}

}  // namespace shaftcull::kernel
