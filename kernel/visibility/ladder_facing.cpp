// SPDX-License-Identifier: MIT
/// What faces away from groups and patches of the ladder, and which occluders lie behind them.
#include <algorithm>
#include <cmath>
#include <span>

#include "visibility/ladder_parts.hpp"
#include "visibility/lanes.hpp"

namespace shaftcull::kernel {
namespace {

/// Occluders with more points are looked up rather than tested again, and only by patches.
constexpr std::size_t few_points = 64;

double farthest_of(std::span<const Vec3> points, const Direction& direction) noexcept {
  double farthest = component(direction, points.front());
  for (const Vec3& point : points.subspan(1)) farthest = std::max(farthest, component(direction, point));
  return farthest;
}

/// The length of the diagonal of the box around two boxes, or more.
double reach_of(const float (&a)[6], const float (&b)[6]) noexcept {
  double square = 0;
  for (unsigned k = 0; k != 3; ++k) {
    const double length = double{std::max(a[k + 3], b[k + 3])} - std::min(a[k], b[k]);
    square += length * length;
  }
  return std::sqrt(square) * (1 + 0x1p-40);
}

}  // namespace

/// The planes of a lane of a side whose patches have corners, and planes.
FacingPlanes Ladder::Side::facing_planes_of(unsigned lane) const noexcept {
  return are_patches ? facing_planes(corners(lane).all()) : set.tree.turned_groups()[first + lane].planes;
}

/// The largest component of a corner of a lane along a direction, or more.
double Ladder::Side::farthest(unsigned lane, const Direction& direction) const noexcept {
  if (are_patches) return farthest_of(corners(lane).all(), direction);
  if (!has_boxes_only(lane)) return set.tree.turned_groups()[first + lane].box.farthest(direction);
  double sum = 0;
  for (unsigned k = 0; k != 3; ++k) sum += std::max(direction[k] * box[k][lane], direction[k] * box[k + 3][lane]);
  return sum;
}

/// Whether all patches of a lane lie on or behind all planes of a lane of a side whose patches have corners. It may say
/// no.
bool Ladder::Side::is_behind(unsigned lane, const Side& other, unsigned other_lane) const noexcept {
  const FacingPlanes planes_of_other = other.facing_planes_of(other_lane);
  float a[6];
  float b[6];
  copy_box(lane, a);
  other.copy_box(other_lane, b);
  return are_behind(planes_of_other, farthest(lane, planes_of_other.mean), reach_of(a, b), double{other.set.coordinate},
                    double{other.set.tolerance});
}

/// Patches of a side that lie on or behind the planes of a patch of another one.
std::uint64_t Ladder::Side::patches_behind(const Side& other, unsigned lane, std::uint64_t asked,
                                           const SiblingKernels& kernels) const noexcept {
  const std::uint64_t boxes = asked & ~not_boxes;
  const std::uint64_t behind = boxes == 0 ? 0 : boxes & kernels.behind_plane(other.plane(lane), box, count);
  if (boxes == asked) return behind;
  const CornersOfLanes of(*this);
  return behind | kernels.corners_behind_plane(other.plane(lane), of.stream, of.corners, count, asked & not_boxes);
}

/// Lanes of `asked` of which no patch and no patch of a lane of another side see each other, since one of the two lies
/// on or behind the plane of the other. Of groups, not all of these.
std::uint64_t Ladder::facing_away(const Side& lanes, const Side& one, unsigned lane, std::uint64_t asked) const {
  const SiblingKernels& kernels = job_.kernels;
  if (!lanes.has_planes() && !one.has_planes()) return 0;
  const bool one_has_boxes = one.has_boxes_only(lane);
  float faces[6];
  one.copy_box(lane, faces);
  if (lanes.are_patches && one.are_patches && !(lanes.are_boxes() && one_has_boxes)) {
    std::uint64_t away = 0;
    if (lanes.has_planes() && one_has_boxes) {
      away = asked & kernels.behind_planes(lanes.planes, lanes.count, faces, asked);
    } else if (lanes.has_planes()) {
      const PatchCorners points = one.corners(lane);
      away = kernels.points_behind_planes(lanes.planes, lanes.count, points.all().data(), points.all().size(), asked);
    }
    if (one.has_planes()) away |= lanes.patches_behind(one, lane, asked & ~away, kernels);
    return away;
  }
  std::uint64_t away = lanes.with_behind(faces, asked, kernels) | lanes.behind_plane_of(one, lane, kernels);
  for_each_lane(asked & ~away & (one_has_boxes ? lanes.not_boxes : ~std::uint64_t{0}), [&](unsigned other) {
    if ((lanes.has_planes() && !lanes.has_boxes_only(other) && one.is_behind(lane, lanes, other)) ||
        (one.has_planes() && !one_has_boxes && lanes.is_behind(other, one, lane))) {
      away |= bit(other);
    }
  });
  return asked & away;
}

/// Lanes of `asked` with a patch that is seen from both sides, and behind whose plane points lie, on the other side
/// than both patches. A row of pairs begins with own_planes_.begin().
std::uint64_t Ladder::behind_own_planes(const Side& rows, unsigned row, const Side& columns,
                                        std::span<const Vec3> points, std::uint64_t asked) {
  const bool of_row = rows.has_both_sides();
  const bool of_columns = columns.has_both_sides();
  if (!of_row && !of_columns) return 0;
  std::uint64_t behind = 0;
  for_each_lane(asked, [&](unsigned lane) {
    const OwnPlanes& planes = own_planes_.of(lane, [&](OwnPlanes& make) {
      const PatchCorners a = rows.corners(row);
      const PatchCorners b = columns.corners(lane);
      if (of_row) make.add(a.all(), b.all());
      if (of_columns) make.add(b.all(), a.all());
    });
    if (planes.separate(points, job_.contact, job_.a.tolerance)) behind |= bit(lane);
  });
  return behind;
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
      const FacingPlanes planes = lanes.facing_planes_of(lane);
      float a[6];
      lanes.copy_box(lane, a);
      const float b[6] = {box[0], box[1], box[2], box[3], box[4], box[5]};
      if (are_behind(planes, farthest_of(points, planes.mean), reach_of(a, b), double{lanes.set.coordinate},
                     double{lanes.set.tolerance})) {
        behind |= bit(lane);
      }
    });
    return behind;
  }
  // The box may stick out where the points do not.
  const auto points_behind = [&](std::uint64_t of) {
    return job_.kernels.points_behind_planes(lanes.planes, lanes.count, points.data(), points.size(), of);
  };
  if (points.size() <= few_points) return behind | points_behind(asked & ~behind);
  // Many points, and the same groups again and again: what was found is kept.
  constexpr std::size_t kept = std::size_t{1} << 16;
  if (points_behind_.empty()) points_behind_.resize(kept);
  PointsBehind& known = points_behind_[(lanes.first * 0x9e3779b1U ^ occluder * 0x85ebca6bU) >> 16U];
  if (known.tree != &lanes.set.tree || known.first != lanes.first || known.occluder != occluder) {
    const std::uint64_t all = first_lanes(lanes.count);
    const std::uint64_t of_box_alone = all & lanes.with_behind(box, all, job_.kernels);
    known = {&lanes.set.tree, lanes.first, occluder, of_box_alone | points_behind(all & ~of_box_alone)};
  }
  return asked & (behind | known.lanes);
}

}  // namespace shaftcull::kernel
