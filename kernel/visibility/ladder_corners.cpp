// SPDX-License-Identifier: MIT
/// Pairs of patches with corners: the shaft between two polygons is narrower than the one between the boxes around
/// them.
#include <algorithm>
#include <array>
#include <span>

#include "exact/blocking.hpp"
#include "exact/patch_plane.hpp"
#include "exact/polygon.hpp"
#include "support/compiler.hpp"
#include "visibility/ladder_parts.hpp"
#include "visibility/lanes.hpp"
#include "visibility/patch_edges.hpp"
#include "visibility/solid_bounds.hpp"

namespace shaftcull::kernel {
namespace {

/// So many lanes or more are worth forming planes for all of them.
constexpr int many_lanes = 8;

}  // namespace

/// Whether the box of a lane reaches into a solid; if that is flat, whether it touches it.
bool Ladder::Side::reaches_into(unsigned lane, const float (&solid)[6]) const noexcept {
  const bool is_flat = solid[0] == solid[3] || solid[1] == solid[4] || solid[2] == solid[5];
  for (unsigned k = 0; k != 3; ++k) {
    const float lo = box[k][lane];
    const float hi = box[k + 3][lane];
    if (is_flat ? solid[k] > hi || lo > solid[k + 3] : solid[k] >= hi || lo >= solid[k + 3]) return false;
  }
  return true;
}

/// Of a row of pairs that no occluder hides with all of their boxes: those that one hides between their corners. The
/// shafts at hand are those between the boxes, and afterwards they are again.
std::uint64_t Ladder::block_corners(const Side& rows, unsigned row, const Side& columns, Selection& solids,
                                    Selection& polygons, std::uint64_t asked) {
  const SiblingKernels& kernels = job_.kernels;
  const PatchCorners a = rows.corners(row);
  std::uint64_t occluded = 0;
  kernels.keep(siblings_, job_.occluders.polygons.data(), polygons.list.data(), polygons.count, polygons.may.data(),
               asked, polygons.kept.data());
  const float tolerance = job_.a.tolerance;
  const Side::CornersOfLanes corners(columns);
  for (std::size_t i = 0; i != polygons.count; ++i) {
    const std::uint64_t may = polygons.kept[i] & ~occluded;
    if (may == 0) continue;
    const std::span<const Vec3> polygon = job_.occluders.polygon(polygons.list[i]);
    const std::span<const Vec3> back = job_.occluders.back_polygon(polygons.list[i]);
    const BehindCone behind =
        behind_polygon(polygons.list[i], a.all(), EndPoints::of_relative_interior, may,
                       [&](std::span<const ConePlane> planes, std::uint64_t lanes) {
                         return kernels.corners_behind_cone(planes.data(), planes.size(), corners.stream,
                                                            corners.corners, columns.count, lanes);
                       });
    if (behind.possible == 0 || (tolerance > 0 && lie_in_plane(a.all(), polygon, tolerance))) continue;
    for_each_lane(behind.possible, [&](unsigned lane) {
      const PatchCorners b = columns.corners(lane);
      if ((behind.certain & bit(lane)) == 0 &&
          !(polygon_blocks(a.all(), b.all(), polygon) && (back.empty() || polygon_blocks(a.all(), b.all(), back)))) {
        return;
      }
      if (tolerance == 0 || !lie_in_plane(b.all(), polygon, tolerance)) occluded |= bit(lane);
    });
  }
  const std::uint64_t left = asked & ~occluded;
  if (solids.count == 0 || left == 0) return occluded;
  form_exchanged(rows, row, columns, left);
  kernels.may_block(siblings_, job_.solids.data(), solids.list.data(), solids.count, solids.may.data(), left,
                    solids.kept.data());
  const std::size_t hulls = hulls_in(solids.list.data(), solids.count);
  for (std::size_t i = 0; i != hulls; ++i) {
    occluded |= occluded_by_hull(solids.list[i], rows, row, columns, solids.kept[i] & ~occluded);
  }
  for (std::size_t i = hulls; i != solids.count; ++i) {
    const float(&row_of)[8] = job_.solids[solids.list[i]].face;
    const float solid[6] = {row_of[0], row_of[1], row_of[2], row_of[3], row_of[4], row_of[5]};
    if (!job_.solids_around_ends && rows.reaches_into(row, solid)) continue;
    std::uint64_t may = may_meet(job_.solids[solids.list[i]], a.all(), columns, solids.kept[i] & ~occluded);
    if (!job_.solids_around_ends) {
      for_each_lane(may, [&](unsigned lane) {
        if (columns.reaches_into(lane, solid)) may &= ~bit(lane);
      });
    }
    const bool is_flat = solid[0] == solid[3] || solid[1] == solid[4] || solid[2] == solid[5];
    if (!is_flat && popcount_anywhere(may) >= many_lanes) {
      occluded |= corners_behind_cone(solids.list[i], rows, row, columns, may);
      continue;
    }
    for_each_lane(may, [&](unsigned lane) {
      if (box_blocks(a.all(), columns.corners(lane).all(), solid)) occluded |= bit(lane);
    });
  }
  form(rows, row, columns, asked & ~occluded);
  return occluded;
}

/// Lanes of `asked` with no corner from which a segment to a corner of a patch certainly misses a solid box.
std::uint64_t Ladder::may_meet(const BoxRow& solid, std::span<const Vec3> fixed, const Side& columns,
                               std::uint64_t asked) const {
  if (asked == 0) return 0;
  constexpr double any_radius = 0x1p30;
  const Side::CornersOfLanes corners(columns);
  return job_.kernels.may_meet_solid(solid_bounds(solid, any_radius, job_.a.coordinate), fixed.data(),
                                     static_cast<unsigned>(fixed.size()), corners.stream, corners.corners,
                                     columns.count, asked);
}

/// Whether an occluder reaches into the shaft between two patches at hand, which its box and the boxes around its
/// triangles reach into: those whose lanes are from `first` on have the lane.
bool Ladder::reaches_between(unsigned lane, std::uint32_t occluder, std::size_t first, const PatchCorners& a,
                             const PatchCorners& b) {
  const OccluderData& occluders = job_.occluders;
  const auto is_separate = [&](std::span<const Vec3> points, const TurnedBox* around) {
    return tangents_.separate({points, around}, job_.contact, job_.a.tolerance);
  };
  if (occluders.points_of(occluder).empty()) {
    PatchCorners of_box;
    return !is_separate(points_or_corners(occluder, of_box), nullptr);
  }
  const std::span<const Vec3> points = occluders.points_of(occluder);
  const std::size_t parts = occluders.parts_of(occluder);
  if (parts == 0) return !is_separate(points, &job_.turned_occluders[occluder]);
  // Most triangles have both patches on one side: that is quick to see.
  parts_left_.clear();
  for (std::size_t part = 0; part != parts; ++part) {
    if ((part_lanes_[first + part] & bit(lane)) == 0) continue;
    const std::size_t number = occluders.first_triangle[occluder] + part;
    if (!are_on_one_side(a.all(), b.all(), occluders.triangle_vertices[number], job_.contact, job_.a.tolerance)) {
      parts_left_.push_back(number);
    }
  }
  constexpr std::size_t few = 4;
  if (parts_left_.size() > few && is_separate(points, &job_.turned_occluders[occluder])) return false;
  return std::any_of(parts_left_.begin(), parts_left_.end(),
                     [&](std::size_t part) { return !is_separate(occluders.triangle_vertices[part], nullptr); });
}

/// Of a row of pairs, decides in lanes which candidates reach in, as far as floats can: clears what does not, in
/// `candidates.kept` and part_lanes_, and returns the lanes in which something does. Writes sure_lanes_.
std::uint64_t Ladder::reach_in_lanes(const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes,
                                     Selection& candidates) {
  const OccluderData& occluders = job_.occluders;
  sure_lanes_.assign(candidates.count, 0);
  points_between_.clear();
  box_corners_.resize(std::max(box_corners_.size(), candidates.count));
  std::size_t part = 0;
  for (std::size_t i = 0; i != candidates.count; ++i) {
    const std::uint32_t occluder = candidates.list[i];
    const std::uint64_t asked = candidates.kept[i] & lanes;
    const auto number = job_.wants_candidates ? static_cast<std::uint32_t>(i) : 0;
    const std::size_t parts = occluders.parts_of(occluder);
    for (std::size_t p = 0; p != parts; ++p) {
      const std::array<Vec3, 3>& triangle = occluders.triangle_vertices[occluders.first_triangle[occluder] + p];
      const std::uint64_t asked_of_part = asked & part_lanes_[part + p];
      if (asked_of_part != 0) points_between_.push_back({triangle.data(), 3, number, true, asked_of_part, 0, 0});
    }
    if (parts == 0 && asked != 0 && occluders.points_of(occluder).size() <= most_points_in_lanes) {
      const std::span<const Vec3> points = points_or_corners(occluder, box_corners_[i]);
      points_between_.push_back({points.data(), static_cast<std::uint32_t>(points.size()), number, false, asked, 0, 0});
    }
    part += parts;
  }
  if (points_between_.empty()) return 0;
  const PatchCorners fixed = rows.corners(row);
  const Side::CornersOfLanes corners(columns);
  const PatchEdges fixed_edges = rows.set.tree.has_corners()
                                     ? PatchEdges::of_polygon(static_cast<unsigned>(fixed.all().size()))
                                     : PatchEdges::of_box(fixed.all());
  const PatchEdges edges =
      columns.set.tree.has_corners() ? PatchEdges::of_polygon(corners.corners) : PatchEdges::of_any_box();
  const CornersOfPairs pairs{fixed.all().data(), static_cast<unsigned>(fixed.all().size()),
                             fixed_edges.data(), fixed_edges.size(),
                             corners.stream,     corners.corners,
                             edges.data(),       edges.size(),
                             columns.count};
  job_.kernels.reach_between(pairs, job_.a.tolerance, points_between_.data(), points_between_.size(), *reach_space_);
  std::uint64_t reached = 0;
  std::size_t next = 0;
  part = 0;
  for (std::size_t i = 0; i != candidates.count; ++i) {
    const std::uint32_t occluder = candidates.list[i];
    const std::uint64_t asked = candidates.kept[i] & lanes;
    const std::size_t parts = occluders.parts_of(occluder);
    std::uint64_t left = 0;
    std::uint64_t sure = 0;
    for (std::size_t p = 0; p != parts; ++p) {
      std::uint64_t& of_part = part_lanes_[part + p];
      if ((asked & of_part) == 0) continue;
      of_part &= ~points_between_[next].separate;
      left |= of_part & asked;
      sure |= points_between_[next++].reaching;
    }
    if (parts == 0 && asked != 0) {
      left = asked;
      if (occluders.points_of(occluder).size() <= most_points_in_lanes) {
        left &= ~points_between_[next].separate;
        sure |= points_between_[next++].reaching;
      }
    }
    candidates.kept[i] &= ~asked | left | sure;
    sure_lanes_[i] = sure;
    reached |= sure;
    part += parts;
  }
  return reached;
}

/// Of a row of pairs, in which the boxes around patches keep candidates: drops those that lie behind a plane that
/// touches both patches. Returns the lanes in which some are left. If nobody wants candidates, one of them is enough.
std::uint64_t Ladder::drop_separate(const Side& rows, unsigned row, const Side& columns, std::uint64_t lanes,
                                    Selection& candidates) {
  const PatchCorners a = rows.corners(row);
  const std::uint64_t reached = reach_in_lanes(rows, row, columns, lanes, candidates);
  std::uint64_t left = job_.wants_candidates ? 0 : reached;
  for_each_lane(lanes & ~left, [&](unsigned lane) {
    const PatchCorners b = columns.corners(lane);
    tangents_.begin({a.all(), !rows.set.tree.has_corners()}, {b.all(), !columns.set.tree.has_corners()});
    std::size_t part = 0;
    for (std::size_t i = 0; i != candidates.count; part += job_.occluders.parts_of(candidates.list[i]), ++i) {
      if ((candidates.kept[i] & bit(lane)) == 0) continue;
      if ((sure_lanes_[i] & bit(lane)) != 0) {
        left |= bit(lane);
        continue;
      }
      if (!reaches_between(lane, candidates.list[i], part, a, b)) {
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
