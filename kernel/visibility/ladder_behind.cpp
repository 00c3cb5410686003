// SPDX-License-Identifier: MIT
/// Which occluders lie behind planes of groups and patches of the ladder.
#include <algorithm>
#include <span>

#include "visibility/ladder_parts.hpp"
#include "visibility/lanes.hpp"

namespace shaftcull::kernel {
namespace {

/// Occluders with more points are looked up rather than tested again, and only by patches.
constexpr std::size_t few_points = 64;

}  // namespace

/// Whether points in a box lie on or behind planes of a lane. It may say no.
bool Ladder::Side::has_behind(unsigned lane, const FacingPlanes& planes_of_lane, std::span<const Vec3> points,
                              const BoxRow& around) const noexcept {
  float a[6];
  float b[6];
  copy_box(lane, a);
  std::copy_n(around.face, 6, b);
  return are_behind(planes_of_lane, farthest_of(points, planes_of_lane.mean), reach_of(a, b), double{set.coordinate},
                    double{set.tolerance});
}

/// Lanes of `asked` on or behind all of whose planes an occluder lies.
std::uint64_t Ladder::behind(const Side& lanes, std::uint32_t occluder, std::uint64_t asked) {
  if (!lanes.has_planes() || asked == 0) return 0;
  const float(&box)[8] = job_.occluders.boxes[occluder].face;
  std::uint64_t behind = asked & lanes.with_behind(box, asked, job_.kernels);
  std::span<const Vec3> points = job_.occluders.points_of(occluder);
  PatchCorners of_box;
  if (points.empty() && lanes.not_boxes != 0) {
    of_box = corners_of_box({{box[0], box[1], box[2]}, {box[3], box[4], box[5]}});
    points = of_box.all();
  }
  if (points.empty() || behind == asked) return behind;
  if (!lanes.are_patches) {
    if (points.size() > few_points) return behind;
    for_each_lane(asked & ~behind & lanes.not_boxes, [&](unsigned lane) {
      if (lanes.has_behind(lane, lanes.facing_planes_of(lane), points, job_.occluders.boxes[occluder])) {
        behind |= bit(lane);
      }
    });
    return behind;
  }
  // The box may stick out where the points do not.
  if (points.size() <= few_points) {
    return behind |
           job_.kernels.points_behind_planes(lanes.planes, lanes.count, points.data(), points.size(), asked & ~behind);
  }
  return asked & (behind | all_behind(lanes, {occluder, false}, points, false));
}

/// Patches of a side on or behind whose planes all points lie, or behind these planes reversed. The same ones are asked
/// for again and again, and some need exact arithmetic: what was found is kept.
std::uint64_t Ladder::all_behind(const Side& lanes, const PointsOf& of, std::span<const Vec3> points,
                                 bool is_reversed) {
  constexpr std::size_t kept = std::size_t{1} << 16;
  if (points_behind_.empty()) points_behind_.resize(kept);
  const std::uint32_t which = (of.is_part ? 2U : 0U) + (is_reversed ? 1U : 0U);
  const std::uint32_t mixed = lanes.first * 0x9e3779b1U ^ of.number * 0x85ebca6bU ^ which * 0xc2b2ae35U;
  PointsBehind& known = points_behind_[mixed >> 16U];
  if (known.tree != &lanes.set.tree || known.first != lanes.first || known.of != of ||
      known.is_reversed != is_reversed) {
    known = {&lanes.set.tree, lanes.first, of, is_reversed,
             job_.kernels.points_behind_planes(is_reversed ? lanes.reversed_planes : lanes.planes, lanes.count,
                                               points.data(), points.size(), first_lanes(lanes.count))};
  }
  return known.lanes;
}

/// Points of an occluder, or the corners of the box that it is.
std::span<const Vec3> Ladder::points_or_corners(std::uint32_t occluder, PatchCorners& of_box) const noexcept {
  const std::span<const Vec3> points = job_.occluders.points_of(occluder);
  if (!points.empty()) return points;
  const float(&box)[8] = job_.occluders.boxes[occluder].face;
  of_box = corners_of_box({{box[0], box[1], box[2]}, {box[3], box[4], box[5]}});
  return of_box.all();
}

/// Clears the lanes on or behind whose planes candidates lie, of planes that are seen from both sides and face all of a
/// group. Returns those in which some are left.
std::uint64_t Ladder::drop_behind_faced(const Level& level, const Side& lanes, const Side& group,
                                        std::vector<std::uint64_t>& kept) {
  std::uint64_t left = any_of(kept.data(), kept.size());
  std::uint64_t front = 0;
  std::uint64_t back = 0;
  if (lanes.are_patches) {
    float faces[6];
    group.copy_box(0, faces);
    front = job_.kernels.behind_planes(lanes.reversed_planes, lanes.count, faces, left);
    back = job_.kernels.behind_planes(lanes.planes, lanes.count, faces, left);
  } else {
    for_each_lane(left, [&](unsigned lane) {
      const FacingPlanes planes = lanes.facing_planes_of(lane);
      if (!planes.are_alike()) return;
      if (group.is_behind(0, planes.reversed(), lanes, lane)) front |= bit(lane);
      if (group.is_behind(0, planes, lanes, lane)) back |= bit(lane);
    });
  }
  const auto behind_of = [&](std::uint32_t occluder, std::uint64_t asked) {
    PatchCorners of_box;
    const std::span<const Vec3> points = points_or_corners(occluder, of_box);
    if (lanes.are_patches) return behind_faced(lanes, {occluder, false}, points, asked & front, asked & back);
    std::uint64_t behind = 0;
    if (points.size() > few_points) return behind;
    for_each_lane(asked, [&](unsigned lane) {
      const FacingPlanes planes = lanes.facing_planes_of(lane);
      const FacingPlanes faced = (front & bit(lane)) != 0 ? planes : planes.reversed();
      if (lanes.has_behind(lane, faced, points, job_.occluders.boxes[occluder])) behind |= bit(lane);
    });
    return behind;
  };
  left = 0;
  for (std::size_t i = 0; i != kept.size(); ++i) {
    const std::uint64_t asked = kept[i] & (front | back);
    if (asked != 0) kept[i] &= ~behind_of(level.lists.candidates[i], asked);
    left |= kept[i];
  }
  return left;
}

/// Patches of a side on or behind whose planes points lie: of those whose front is seen, and of those whose back is.
std::uint64_t Ladder::behind_faced(const Side& lanes, const PointsOf& of, std::span<const Vec3> points,
                                   std::uint64_t front, std::uint64_t back) {
  std::uint64_t behind = 0;
  if (front != 0) behind = front & all_behind(lanes, of, points, false);
  if (back != 0) behind |= back & all_behind(lanes, of, points, true);
  return behind;
}

/// Of a row of pairs, whose faced_ is at hand: lanes of `asked` with a patch that is seen from both sides, and points
/// on or behind its plane, which faces the other patch.
std::uint64_t Ladder::behind_faced(const Side& rows, unsigned row, const Side& columns, const PointsOf& of,
                                   std::span<const Vec3> points, std::uint64_t asked) {
  std::uint64_t behind = 0;
  if (rows.has_both_sides()) {
    const std::uint64_t front = asked & faced_.front_of_row;
    const std::uint64_t back = asked & faced_.back_of_row;
    const auto is_behind = [&](bool is_front) {
      return behind_faced(rows, of, points, is_front ? bit(row) : 0, is_front ? 0 : bit(row)) != 0;
    };
    if (front != 0 && is_behind(true)) behind |= front;
    if (back != 0 && is_behind(false)) behind |= back;
  }
  if (columns.has_both_sides()) {
    const std::uint64_t left = asked & ~behind;
    behind |= behind_faced(columns, of, points, left & faced_.front_of_column, left & faced_.back_of_column);
  }
  return behind;
}

/// Likewise of a row's candidates: lanes in which they lie there are not asked about them.
void Ladder::drop_behind_faced(const Side& rows, unsigned row, const Side& columns, Selection& candidates) {
  if (!rows.has_both_sides() && !columns.has_both_sides()) return;
  for (std::size_t i = 0; i != candidates.count; ++i) {
    PatchCorners of_box;
    const std::uint32_t occluder = candidates.list[i];
    const std::span<const Vec3> points = points_or_corners(occluder, of_box);
    candidates.may[i] &= ~behind_faced(rows, row, columns, {occluder, false}, points, candidates.may[i]);
  }
}

}  // namespace shaftcull::kernel
