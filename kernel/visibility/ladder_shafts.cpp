// SPDX-License-Identifier: MIT
/// The ladder's shafts, from a group or patch to those of the other side, and which occluders concern them.
#include <span>

#include "exact/polygon.hpp"
#include "visibility/ladder_parts.hpp"
#include "visibility/lanes.hpp"

namespace shaftcull::kernel {
namespace {

using BetweenHulls = bool(std::span<const Vec3>, std::span<const Vec3>, std::span<const Vec3>) noexcept;

/// Occluders with more points are looked up rather than tested again.
constexpr std::size_t few_points = 64;

}  // namespace

/// Forms shafts from a box of one side to all of another.
void Ladder::form(const Side& fixed, unsigned lane, const Side& lanes, std::uint64_t asked) {
  form(fixed, lane, lanes.box, lanes.inward, lanes.count, asked);
  siblings_.are_groups = !fixed.are_patches || !lanes.are_patches;
}

/// Likewise to boxes of patches.
void Ladder::form(const Side& fixed, unsigned lane, const float* const* boxes, const float* const* inward,
                  unsigned count, std::uint64_t asked) {
  fixed.copy_box(lane, fixed_);
  fixed.copy_inward(lane, fixed_inward_);
  job_.kernels.form(fixed_, boxes, count, asked, siblings_);
  siblings_.fixed_inward = fixed_inward_;
  siblings_.other_inward = inward;
  siblings_.contact = job_.contact;
  siblings_.are_groups = !fixed.are_patches;
  siblings_.solids_around_ends = job_.solids_around_ends;
}

/// Likewise, with lo and hi of groups exchanged, as may_block() wants them.
void Ladder::form_exchanged(const Side& fixed, unsigned lane, const Side& lanes, std::uint64_t asked) {
  const float* other[6];
  for (unsigned f = 0; f != 6; ++f) {
    exchanged_[f] = fixed.box[fixed.are_patches ? f : (f + 3) % 6][lane];
    other[f] = lanes.box[lanes.are_patches ? f : (f + 3) % 6];
  }
  job_.kernels.form(exchanged_, other, lanes.count, asked, siblings_);
}

/// Lanes of `asked` on or behind all of whose planes an occluder lies.
std::uint64_t Ladder::behind(const Side& lanes, std::uint32_t occluder, std::uint64_t asked) {
  if (!lanes.has_planes() || asked == 0) return 0;
  std::uint64_t behind = asked & lanes.with_behind(job_.occluders.boxes[occluder].face, asked, job_.kernels);
  const std::span<const Vec3> points = job_.occluders.points_of(occluder);
  if (!lanes.are_patches || points.empty() || behind == asked) return behind;
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
    const std::uint64_t of_box = lanes.with_behind(job_.occluders.boxes[occluder].face, all, job_.kernels);
    known = {&lanes.set.tree, lanes.first, occluder, of_box | points_behind(all & ~of_box)};
  }
  return asked & (behind | known.lanes);
}

/// Siblings of `asked` that a polygon of a list blocks; may_block[i], unless null, are those that polygon i may.
std::uint64_t Ladder::occluded_by_polygons(const std::uint32_t* polygons, std::size_t count,
                                           const std::uint64_t* may_block, std::uint64_t asked) const {
  std::uint64_t occluded = 0;
  const BoxCorners fixed(fixed_);
  for (std::size_t i = 0; i != count && (asked & ~occluded) != 0; ++i) {
    const std::uint64_t may = asked & ~occluded & (may_block == nullptr ? ~std::uint64_t{0} : may_block[i]);
    std::uint64_t met = 0;
    job_.kernels.keep(siblings_, job_.occluders.boxes.data(), &polygons[i], 1, nullptr, may, &met);
    for_each_lane(met, [&](unsigned lane) {
      float other[6];
      for (unsigned f = 0; f != 6; ++f) other[f] = siblings_.other[f][lane];
      // The relative interior of a patch may lie in the surface of its group.
      const auto& blocks = siblings_.are_groups ? polygon_blocks_closed : static_cast<BetweenHulls&>(polygon_blocks);
      if (blocks(fixed.get(), BoxCorners(other).get(), job_.occluders.points_of(polygons[i]))) occluded |= bit(lane);
    });
  }
  return occluded;
}

}  // namespace shaftcull::kernel
