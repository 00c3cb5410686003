// SPDX-License-Identifier: MIT
/// Pairs of patches with corners: the shaft between two polygons is narrower than the one between the boxes around
/// them.
#include "visibility/ladder_parts.hpp"
#include "visibility/lanes.hpp"

namespace shaftcull::kernel {

/// Of a row of pairs, in which the boxes around patches keep candidates: drops those that lie behind a plane that
/// touches both patches. Returns the lanes in which some are left. If nobody wants candidates, one of them is enough.
std::uint64_t Ladder::drop_separate(const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes,
                                    Selection& candidates) {
  const PatchCorners a = rows.corners(row);
  std::uint64_t left = 0;
  for_each_lane(lanes, [&](unsigned lane) {
    if (rows.is_box(row) && columns.is_box(lane)) {
      left |= bit(lane);
      return;
    }
    const PatchCorners b = columns.corners(lane);
    tangents_.find({a.all(), !rows.has_corners()}, {b.all(), !columns.has_corners()});
    for (std::size_t i = 0; i != candidates.count; ++i) {
      if ((candidates.kept[i] & bit(lane)) == 0) continue;
      const std::uint32_t occluder = candidates.list[i];
      std::span<const Vec3> points = job_.occluders.points_of(occluder);
      PatchCorners of_box;
      if (points.empty()) {
        const float(&box)[8] = job_.occluders.boxes[occluder].face;
        of_box = corners_of_box({{box[0], box[1], box[2]}, {box[3], box[4], box[5]}});
        points = of_box.all();
      }
      if (tangents_.separate(points, job_.contact, job_.a.tolerance)) {
        candidates.kept[i] &= ~bit(lane);
        continue;
      }
      left |= bit(lane);
      if (!job_.wants_candidates) return;
    }
  });
  return left;
}

}  // namespace shaftcull::kernel
