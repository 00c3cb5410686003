// SPDX-License-Identifier: MIT
/// The planes that join edges of one box with the corresponding edges of the other.
#pragma once

#include "formation/rule.hpp"

namespace shaftcull::kernel {

/// The joining planes of JoinedEdges, in their order, a column for each number. A plane's normal has two components
/// other than zero, on the axes of its red and its blue face. Columns past the count of edges hold nothing of use.
struct JoinedPlanes {
  float red_normal[max_joining_planes];
  float blue_normal[max_joining_planes];
  float offset[max_joining_planes];
};

/// The joining planes of `edges` between boxes with faces at `a` and `b`: each through both boxes' edges, parallel to
/// them, with both boxes inside. Computed in double, rounded once.
///
/// Normals have unit length if `unit`; else their length is whatever saves a root and divisions. Only a unit plane
/// farther than the largest float from the origin is scaled down, so that its offset stays finite.
[[nodiscard]] JoinedPlanes join(const Faces6& a, const Faces6& b, const JoinedEdges& edges, bool unit) noexcept;

/// The same for a box with faces at `a` that move by `step`, a magnitude for each face.
[[nodiscard]] JoinedPlanes join(const Faces6& a, const std::array<double, face_count>& step, const JoinedEdges& edges,
                                bool unit) noexcept;

}  // namespace shaftcull::kernel
