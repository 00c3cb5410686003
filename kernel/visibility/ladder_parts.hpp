// SPDX-License-Identifier: MIT
/// What the ladder's walk keeps of groups and patches, and of the product at hand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "visibility/cone_planes.hpp"
#include "visibility/ladder.hpp"

namespace shaftcull::kernel {

/// Groups or patches side by side, at most 64: children of a group, or a group alone.
struct Ladder::Side {
  const SightSet& set;
  bool are_patches;
  unsigned count;
  std::uint32_t first;  ///< a group, or a position in the order of patches
  /// Lanes that are not the boxes around them; of groups, lanes with such a patch.
  std::uint64_t not_boxes;
  const float* box[6];
  const float* inward[6];  ///< as Siblings has it
  PlaneStreams planes{};
  PlaneStreams reversed_planes{};  ///< of patches that are seen from both sides

  Side(const SightSet& of, std::uint32_t from, unsigned size, bool patches)
      : set(of),
        are_patches(patches),
        count(size),
        first(from),
        not_boxes(patches ? of.tree.not_boxes(from, size) : of.tree.groups_of_others(from, size)) {
    const PatchStreams& streams = patches ? of.tree.patch_streams() : of.tree.group_streams();
    for (unsigned s = 0; s != 6; ++s) {
      box[s] = streams.stream(s) + from;
      inward[s] = (patches ? streams.stream((s + 3) % 6) : of.tree.group_inward(s)) + from;
    }
    if (!streams.has_planes()) return;
    for (unsigned k = 0; k != 3; ++k) {
      planes.least_normal[k] = streams.stream(6 + k) + from;
      planes.largest_normal[k] = streams.stream(9 + k) + from;
    }
    const PlaneLimits& limits = patches ? of.planes->patches : of.planes->groups;
    planes.least_offset = limits.offset.data() + from;
    planes.error = limits.error.data() + from;
    if (!patches) return;
    for (unsigned k = 0; k != 3; ++k) planes.exact.normal[k] = planes.least_normal[k];
    planes.exact.offset = streams.stream(12) + from;
    planes.exact.tolerance = of.tolerance;
    if (!of.tree.has_corners()) return;
    planes.exact.corner = of.tree.corner_streams().streams();
    planes.exact.corners = of.tree.corner_streams().corners();
    planes.exact.first = from;
    if (!of.tree.has_both_sides()) return;
    reversed_planes = planes;
    for (unsigned k = 0; k != 3; ++k) {
      reversed_planes.least_normal[k] = reversed_planes.largest_normal[k] = of.planes->reversed.normal[k].data() + from;
    }
    reversed_planes.least_offset = of.planes->reversed.limits.offset.data() + from;
    reversed_planes.error = of.planes->reversed.limits.error.data() + from;
    reversed_planes.exact.are_reversed = true;
  }
  /// Streams of the corners of all lanes: stream 3 c + k has coordinate k of corner c. A box has eight.
  struct CornersOfLanes {
    const float* stream[3 * most_patch_corners];
    unsigned corners;

    explicit CornersOfLanes(const Side& side) noexcept
        : corners(side.set.tree.has_corners() ? side.set.tree.corner_streams().corners() : most_patch_corners) {
      const bool has_corners = side.set.tree.has_corners();
      for (unsigned s = 0; s != 3 * corners; ++s) {
        const unsigned k = s % 3;
        stream[s] = has_corners ? side.set.tree.corner_streams().streams()[s] + side.first
                                : side.box[(s / 3 >> k & 1U) != 0 ? k + 3 : k];
      }
    }
  };
  static Side alone(const SightSet& set, std::uint32_t group) { return {set, group, 1, false}; }
  static Side children(const SightSet& set, std::uint32_t group) {
    const PatchGroup& parent = set.tree.groups()[group];
    return {set, parent.first_child, parent.children, parent.has_patches};
  }

  /// Whether patches have planes, and are seen from one side of them.
  [[nodiscard]] bool has_planes() const noexcept { return set.tree.has_planes(); }
  /// Whether they are seen from both sides.
  [[nodiscard]] bool has_both_sides() const noexcept { return set.tree.has_both_sides(); }
  /// Whether lanes are boxes rather than something in them.
  [[nodiscard]] bool are_boxes() const noexcept { return are_patches && not_boxes == 0; }
  /// Whether a patch is the box around it, or all patches of a group are.
  [[nodiscard]] bool has_boxes_only(unsigned lane) const noexcept { return (not_boxes >> lane & 1U) == 0; }
  /// The corners of a patch.
  [[nodiscard]] PatchCorners corners(unsigned lane) const noexcept { return set.tree.corners_of(first + lane); }
  static PlaneRow plane_of(const PlaneStreams& from, unsigned lane) noexcept {
    PlaneRow row{};
    for (unsigned k = 0; k != 3; ++k) {
      row.least_normal[k] = from.least_normal[k][lane];
      row.largest_normal[k] = from.largest_normal[k][lane];
    }
    row.least_offset = from.least_offset[lane];
    row.error = from.error[lane];
    row.exact = from.exact;
    row.lane = lane;
    return row;
  }
  [[nodiscard]] PlaneRow plane(unsigned lane) const noexcept { return plane_of(planes, lane); }
  /// That of a patch that is seen from both sides, facing the other way.
  [[nodiscard]] PlaneRow reversed_plane(unsigned lane) const noexcept { return plane_of(reversed_planes, lane); }
  /// The box of a lane, six faces.
  void copy_box(unsigned lane, float (&to)[6]) const noexcept {
    for (unsigned s = 0; s != 6; ++s) to[s] = box[s][lane];
  }
  /// Which faces of it are left out, as Siblings has it.
  void copy_inward(unsigned lane, float (&to)[6]) const noexcept {
    for (unsigned s = 0; s != 6; ++s) to[s] = inward[s][lane];
  }
  /// The patches of lanes side by side.
  [[nodiscard]] PatchRun run(unsigned lane, unsigned lanes) const noexcept {
    if (are_patches) return {first + lane, lanes};
    const std::vector<PatchGroup>& groups = set.tree.groups();
    const PatchGroup& last = groups[first + lane + lanes - 1];
    const std::uint32_t begin = groups[first + lane].first;
    return {begin, last.first + last.count - begin};
  }
  /// Lanes whose boxes lie on or behind all planes of a lane of another side. Of patches that are not boxes, it may say
  /// no.
  [[nodiscard]] std::uint64_t behind_plane_of(const Side& other, unsigned lane, const SiblingKernels& kernels) const {
    if (!other.has_planes()) return 0;
    const bool is_patch = other.are_patches && other.has_boxes_only(lane);
    return (is_patch ? kernels.behind_plane : kernels.behind_group)(other.plane(lane), box, count);
  }
  /// Lanes on or behind all of whose planes a box lies, likewise. Those that are not asked may be anything.
  [[nodiscard]] std::uint64_t with_behind(const float* faces, std::uint64_t asked,
                                          const SiblingKernels& kernels) const {
    if (!has_planes()) return 0;
    return (are_boxes() ? kernels.behind_planes : kernels.behind_groups)(planes, count, faces, asked);
  }
  [[nodiscard]] bool reaches_into(unsigned lane, const float (&solid)[6]) const noexcept;
  [[nodiscard]] FacingPlanes facing_planes_of(unsigned lane) const noexcept;
  [[nodiscard]] bool is_behind(unsigned lane, const FacingPlanes& planes_of_other, const Side& other,
                               unsigned other_lane) const noexcept;
  [[nodiscard]] bool has_behind(unsigned lane, const FacingPlanes& planes_of_lane, std::span<const Vec3> points,
                                const BoxRow& around) const noexcept;
  [[nodiscard]] bool is_in_planes(unsigned lane, const Side& other, unsigned other_lane) const noexcept;
  [[nodiscard]] std::uint64_t patches_behind(const PlaneRow& plane, std::uint64_t asked,
                                             const SiblingKernels& kernels) const noexcept;
  [[nodiscard]] std::uint64_t with_patch_behind(const PlaneStreams& planes_of, const Side& other, unsigned lane,
                                                std::uint64_t asked, const SiblingKernels& kernels) const noexcept;

 private:
  [[nodiscard]] double farthest(unsigned lane, const Double3& direction) const noexcept;
};

/// Of a row of pairs: the occluders of a list that it may have to do with, with which of its lanes, and what is found.
/// Only the first `count` mean anything.
struct Ladder::Selection {
  std::size_t count = 0;
  std::vector<std::uint32_t> list;
  std::vector<std::uint64_t> may;
  std::vector<std::uint64_t> kept;
};

/// What is known of a product, and scratch.
struct Ladder::Level {
  SightLists lists;
  // Lanes of rows and columns whose shafts with all of the other side keep each of the lists.
  std::vector<std::uint64_t> row_candidates;
  std::vector<std::uint64_t> row_solids;
  std::vector<std::uint64_t> row_polygons;
  std::vector<std::uint64_t> column_candidates;
  std::vector<std::uint64_t> column_solids;
  std::vector<std::uint64_t> column_polygons;
  Selection candidates_of_row;
  Selection solids_of_row;
  Selection polygons_of_row;
};

/// Lanes of `asked` that a polygon hides from an end, as far as planes in lanes say; behind(planes, lanes) are those
/// behind some planes.
template <class Behind>
BehindCone Ladder::behind_polygon(std::uint32_t polygon, std::span<const Vec3> fixed, EndPoints counting,
                                  std::uint64_t asked, const Behind& behind) {
  const OccluderData& occluders = job_.occluders;
  if (!polygon_cone_.begin(occluders.polygon(polygon), occluders.back_polygon(polygon),
                           occluders.polygon_is_flat[polygon] != 0, fixed, counting)) {
    return {0, 0};
  }
  polygon_planes_.clear();
  for (const HullCone::Plane& plane : polygon_cone_.planes()) {
    polygon_planes_.push_back(plane_in_lanes(plane, counting, 0, job_.a.coordinate));
  }
  const BehindCone lanes = behind(std::span<const ConePlane>(polygon_planes_), asked);
  return polygon_cone_.is_sufficient() ? lanes : BehindCone{lanes.possible, 0};
}

}  // namespace shaftcull::kernel
