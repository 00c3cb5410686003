// SPDX-License-Identifier: MIT
/// What faces away from groups and patches of the ladder.

#include "visibility/ladder_parts.hpp"
#include "visibility/lanes.hpp"

namespace shaftcull::kernel {
/// The planes of a lane of a side whose patches have corners, and planes.
FacingPlanes Ladder::Side::facing_planes_of(unsigned lane) const noexcept {
  return are_patches ? facing_planes(corners(lane).all()) : set.tree.turned_groups()[first + lane].planes;
}

/// The largest component of a corner of a lane along a direction, or more.
double Ladder::Side::farthest(unsigned lane, const Double3& direction) const noexcept {
  if (are_patches) return farthest_of(corners(lane).all(), direction);
  if (!has_boxes_only(lane)) return set.tree.turned_groups()[first + lane].box.farthest(direction);
  double sum = 0;
  for (unsigned k = 0; k != 3; ++k) sum += std::max(direction[k] * box[k][lane], direction[k] * box[k + 3][lane]);
  return sum;
}

/// Whether all patches of a lane lie on or behind all planes, of a lane of a side whose patches have corners. It may
/// say no.
bool Ladder::Side::is_behind(unsigned lane, const FacingPlanes& planes_of_other, const Side& other,
                             unsigned other_lane) const noexcept {
  float a[6];
  float b[6];
  copy_box(lane, a);
  other.copy_box(other_lane, b);
  return are_behind(planes_of_other, farthest(lane, planes_of_other.mean), reach_of(a, b), double{other.set.coordinate},
                    double{other.set.tolerance});
}

/// Whether all patches of a lane lie in all planes of a group of a side whose patches have corners. It may say no.
bool Ladder::Side::is_in_planes(unsigned lane, const Side& other, unsigned other_lane) const noexcept {
  const FacingPlanes& of_group = other.set.tree.turned_groups()[other.first + other_lane].planes;
  return of_group.are_alike() && is_behind(lane, of_group, other, other_lane) &&
         is_behind(lane, of_group.reversed(), other, other_lane);
}

/// Patches of a side that lie on or behind the plane of a patch of another one.
std::uint64_t Ladder::Side::patches_behind(const PlaneRow& plane, std::uint64_t asked,
                                           const SiblingKernels& kernels) const noexcept {
  const std::uint64_t boxes = asked & ~not_boxes;
  const std::uint64_t behind = boxes == 0 ? 0 : boxes & kernels.behind_plane(plane, box, count);
  if (boxes == asked) return behind;
  const CornersOfLanes of(*this);
  return behind | kernels.corners_behind_plane(plane, of.stream, of.corners, count, asked & not_boxes);
}

/// Patches of a side on or behind whose planes, in `planes_of`, a patch of another one lies.
std::uint64_t Ladder::Side::with_patch_behind(const PlaneStreams& planes_of, const Side& other, unsigned lane,
                                              std::uint64_t asked, const SiblingKernels& kernels) const noexcept {
  if (other.has_boxes_only(lane)) {
    float faces[6];
    other.copy_box(lane, faces);
    return asked & kernels.behind_planes(planes_of, count, faces, asked);
  }
  const PatchCorners points = other.corners(lane);
  return kernels.points_behind_planes(planes_of, count, points.all().data(), points.all().size(), asked);
}

/// Lanes of `asked` of which no patch and no patch of a lane of another side see each other, since one of the two lies
/// on or behind the plane of the other, or in it if that is seen from both sides. Of groups, not all of these. Of
/// patches, sets faced_.
std::uint64_t Ladder::facing_away(const Side& lanes, const Side& one, unsigned lane, std::uint64_t asked) {
  std::uint64_t away = 0;
  if (lanes.has_planes() || one.has_planes()) away = on_or_behind_planes(lanes, one, lane, asked);
  if (lanes.has_both_sides() || one.has_both_sides()) away |= in_one_plane(lanes, one, lane, asked & ~away);
  return away;
}

/// Lanes of `asked` that lie in the plane of a lane of another side, or in whose planes that lies, of planes that are
/// seen from both sides.
std::uint64_t Ladder::in_one_plane(const Side& lanes, const Side& one, unsigned lane, std::uint64_t asked) {
  std::uint64_t in = 0;
  if (lanes.are_patches && one.are_patches) {
    faced_ = {};
    if (one.has_both_sides()) {
      faced_.front_of_row = lanes.patches_behind(one.reversed_plane(lane), asked, job_.kernels);
      faced_.back_of_row = lanes.patches_behind(one.plane(lane), asked, job_.kernels);
    }
    if (lanes.has_both_sides()) {
      faced_.front_of_column = lanes.with_patch_behind(lanes.reversed_planes, one, lane, asked, job_.kernels);
      faced_.back_of_column = lanes.with_patch_behind(lanes.planes, one, lane, asked, job_.kernels);
    }
    return (faced_.front_of_row & faced_.back_of_row) | (faced_.front_of_column & faced_.back_of_column);
  }
  for_each_lane(asked, [&](unsigned other) {
    if ((one.has_both_sides() && !one.are_patches && lanes.is_in_planes(other, one, lane)) ||
        (lanes.has_both_sides() && !lanes.are_patches && one.is_in_planes(lane, lanes, other))) {
      in |= bit(other);
    }
  });
  return in;
}

/// Likewise on or behind planes that are seen from one side.
std::uint64_t Ladder::on_or_behind_planes(const Side& lanes, const Side& one, unsigned lane,
                                          std::uint64_t asked) const {
  const SiblingKernels& kernels = job_.kernels;
  const bool one_has_boxes = one.has_boxes_only(lane);
  float faces[6];
  one.copy_box(lane, faces);
  if (lanes.are_patches && one.are_patches && !(lanes.are_boxes() && one_has_boxes)) {
    std::uint64_t away = lanes.has_planes() ? lanes.with_patch_behind(lanes.planes, one, lane, asked, kernels) : 0;
    if (one.has_planes()) away |= lanes.patches_behind(one.plane(lane), asked & ~away, kernels);
    return away;
  }
  std::uint64_t away = lanes.with_behind(faces, asked, kernels) | lanes.behind_plane_of(one, lane, kernels);
  for_each_lane(asked & ~away & (one_has_boxes ? lanes.not_boxes : ~std::uint64_t{0}), [&](unsigned other) {
    if ((lanes.has_planes() && !lanes.has_boxes_only(other) &&
         one.is_behind(lane, lanes.facing_planes_of(other), lanes, other)) ||
        (one.has_planes() && !one_has_boxes && lanes.is_behind(other, one.facing_planes_of(lane), one, lane))) {
      away |= bit(other);
    }
  });
  return asked & away;
}

}  // namespace shaftcull::kernel
