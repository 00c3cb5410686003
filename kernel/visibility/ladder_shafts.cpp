// SPDX-License-Identifier: MIT
/// The ladder's shafts, from a group or patch to those of the other side, and which occluders concern them.
#include <span>

#include "exact/patch_plane.hpp"
#include "exact/polygon.hpp"
#include "visibility/ladder_parts.hpp"
#include "visibility/lanes.hpp"

namespace shaftcull::kernel {
namespace {

using BetweenHulls = bool(std::span<const Vec3>, std::span<const Vec3>, std::span<const Vec3>) noexcept;

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
  fixed_end_.tree = &fixed.set.tree;
  fixed_end_.at = fixed.first + lane;
  fixed_end_.kind = fixed.are_patches ? ConeEnd::Kind::box_of_patch : ConeEnd::Kind::box_of_group;
  job_.kernels.form(fixed_, boxes, count, asked, siblings_);
  siblings_.fixed_inward = fixed_inward_;
  siblings_.other_inward = inward;
  siblings_.contact = job_.contact;
  siblings_.are_groups = !fixed.are_patches;
  siblings_.solids_around_ends = job_.solids_around_ends;
}

/// Likewise, with lo and hi exchanged of a side that has something other than boxes, as may_block() wants them.
void Ladder::form_exchanged(const Side& fixed, unsigned lane, const Side& lanes, std::uint64_t asked) {
  const float* other[6];
  for (unsigned f = 0; f != 6; ++f) {
    exchanged_[f] = fixed.box[fixed.are_patches && fixed.has_boxes_only(lane) ? f : (f + 3) % 6][lane];
    other[f] = lanes.box[lanes.are_boxes() ? f : (f + 3) % 6];
  }
  job_.kernels.form(exchanged_, other, lanes.count, asked, siblings_);
}

/// Siblings of `asked` of which a segment does not leave one side of a polygon across an axis, or none leaves its
/// plane; `around` is the box around it. Of a polygon that is aslant, none.
std::uint64_t Ladder::on_one_side_of(const BoxRow& around, std::uint64_t asked) const {
  const float(&face)[8] = around.face;
  const unsigned axis = face[0] == face[3] ? 0 : face[1] == face[4] ? 1 : 2;
  const float at = face[axis];
  if (at != face[axis + 3]) return 0;
  if (fixed_[axis] == at && fixed_[axis + 3] == at) return asked;
  const auto reaching = [&](bool forwards) {
    const float sign = forwards ? 1.0F : -1.0F;
    PlaneRow plane{};
    plane.least_normal[axis] = plane.largest_normal[axis] = sign;
    plane.least_offset = sign * at;
    return ~job_.kernels.behind_group(plane, siblings_.other, siblings_.count);
  };
  const std::uint64_t above = reaching(true);
  const std::uint64_t below = reaching(false);
  return asked & ((fixed_[axis + 3] > at ? above : 0) | (fixed_[axis] < at ? below : 0) | ~(above | below));
}

/// Siblings of `asked` that a polygon of a list blocks; may_block[i], unless null, are those that polygon i may. If the
/// siblings are boxes rather than something in them, it answers for them exactly.
std::uint64_t Ladder::occluded_by_polygons(const std::uint32_t* polygons, std::size_t count,
                                           const std::uint64_t* may_block, std::uint64_t asked, bool are_boxes) {
  std::uint64_t occluded = 0;
  const BoxCorners fixed(fixed_);
  for (std::size_t i = 0; i != count && (asked & ~occluded) != 0; ++i) {
    const std::uint64_t may = asked & ~occluded & (may_block == nullptr ? ~std::uint64_t{0} : may_block[i]);
    std::uint64_t met = 0;  // where the box around it may block: else there is a segment past it, and past the polygon
    job_.kernels.may_block(siblings_, job_.occluders.polygons.data(), &polygons[i], 1, nullptr, may, &met);
    if (met != 0) met &= ~on_one_side_of(job_.occluders.polygons[polygons[i]], met);
    if (met == 0) continue;
    // The relative interior of a patch may lie in the surface of its group.
    const EndPoints counting = siblings_.are_groups ? EndPoints::all : EndPoints::of_relative_interior;
    const BehindCone behind = behind_polygon(
        polygons[i], fixed.get(), counting, met, [&](std::span<const ConePlane> planes, std::uint64_t lanes) {
          return job_.kernels.boxes_behind_cone(planes.data(), planes.size(), siblings_.other, siblings_.count, lanes);
        });
    if (behind.possible == 0) continue;
    const std::span<const Vec3> polygon = job_.occluders.polygon(polygons[i]);
    const std::span<const Vec3> back = job_.occluders.back_polygon(polygons[i]);
    const float tolerance = job_.a.tolerance;
    // A patch of the polygon's own wall may be a little behind it.
    const auto may_lie_in_plane = [&](const BoxCorners& end) {
      if (tolerance == 0) return false;
      return are_boxes ? lie_in_plane(end.get(), polygon, tolerance) : !keep_off_planes(end.get(), polygon, tolerance);
    };
    if (may_lie_in_plane(fixed)) continue;
    const auto& blocks = siblings_.are_groups ? polygon_blocks_closed : static_cast<BetweenHulls&>(polygon_blocks);
    for_each_lane(behind.possible, [&](unsigned lane) {
      float other[6];
      for (unsigned f = 0; f != 6; ++f) other[f] = siblings_.other[f][lane];
      const BoxCorners of_other(other);
      if ((behind.certain & bit(lane)) == 0 && !(blocks(fixed.get(), of_other.get(), polygon) &&
                                                 (back.empty() || blocks(fixed.get(), of_other.get(), back)))) {
        return;
      }
      if (!may_lie_in_plane(of_other)) occluded |= bit(lane);
    });
  }
  return occluded;
}

}  // namespace shaftcull::kernel
