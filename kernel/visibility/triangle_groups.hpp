// SPDX-License-Identifier: MIT
/// Triangles in groups that are small, and face alike.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shaftcull/triangles.hpp"

namespace shaftcull::kernel {

/// Groups of triangles: group g has triangles order[first[g] … first[g + 1]).
struct TriangleGroups {
  std::vector<std::uint32_t> order;
  std::vector<std::size_t> first;
};

/// Groups of at most 32 triangles. Triangles are cut in two where the halves are small and face alike, as patches are
/// (patch_halving.hpp): so a group seldom goes round a corner, where the box around it would fill the room. Triangles
/// are finite. O(n log n).
[[nodiscard]] TriangleGroups triangle_groups(const TriangleView& triangles);

}  // namespace shaftcull::kernel
