// SPDX-License-Identifier: MIT
/// Groups of triangles, looked at triangle by triangle: the box around a group that goes round corners, as all walls of
/// a room do, reaches into shafts that none of its triangles reach into.
#include <array>

#include "visibility/ladder_parts.hpp"
#include "visibility/lanes.hpp"

namespace shaftcull::kernel {

/// Of a row of pairs, in which the boxes around groups keep candidates: drops groups none of whose triangles reaches
/// in, by the box around it, in front of both patches. Returns the lanes in which candidates are left.
std::uint64_t Ladder::look_at_triangles(const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes,
                                        Selection& candidates) {
  const SiblingKernels& kernels = job_.kernels;
  const OccluderData& occluders = job_.occluders;
  const bool needs_all = rows.has_corners() || columns.has_corners();
  std::uint64_t left = 0;
  part_lanes_.clear();
  for (std::size_t i = 0; i != candidates.count; ++i) {
    const std::uint64_t asked = candidates.kept[i] & lanes;
    const std::size_t first = occluders.first_part[candidates.list[i]];
    const std::size_t parts = occluders.parts_of(candidates.list[i]);
    std::uint64_t reached = parts == 0 ? asked : 0;
    for (std::size_t part = first; part != first + parts; ++part) {
      const std::uint64_t open = needs_all ? asked : asked & ~reached;
      std::uint64_t kept = 0;
      if (open != 0) {
        const auto number = static_cast<std::uint32_t>(part);
        kernels.keep(siblings_, occluders.parts.data(), &number, 1, nullptr, open, &kept);
      }
      if (kept != 0) {
        const std::array<Vec3, 3>& vertices = occluders.part_vertices[part];
        const auto behind = [&](const Side& side, std::uint64_t of) {
          return side.has_planes() ? kernels.points_behind_planes(side.planes, side.count, vertices.data(), 3, of) : 0;
        };
        kept = behind(rows, bit(row)) != 0 ? 0 : kept & ~behind(columns, kept);
      }
      reached |= kept;
      if (needs_all) part_lanes_.push_back(kept);
    }
    candidates.kept[i] = reached;
    left |= reached;
  }
  return left;
}

}  // namespace shaftcull::kernel
