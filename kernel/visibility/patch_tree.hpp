// SPDX-License-Identifier: MIT
/// Patches in a tree whose groups are small, and face alike.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "exact/patch_plane.hpp"
#include "kernels/siblings/siblings.hpp"
#include "shaftcull/bounds.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/visibility.hpp"
#include "visibility/made_once.hpp"
#include "visibility/ray_shapes.hpp"
#include "visibility/sight_planes.hpp"
#include "visibility/turned_groups.hpp"

namespace shaftcull::kernel {

class RadiatingPatches;

/// Boxes with planes in separate streams, padded so that a word can be read from any of them on: patches, or groups.
class PatchStreams {
 public:
  PatchStreams() noexcept = default;
  /// `count` of them, to be written. Of patches, normals have one bound only.
  PatchStreams(std::size_t count, bool has_planes, bool are_groups);

  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] bool has_planes() const noexcept { return has_planes_; }
  /// Streams 0 to 5 are the box, 6 to 8 the least normal, 9 to 11 the largest one, 12 the least offset.
  [[nodiscard]] float* stream(std::size_t s) noexcept { return row(s); }
  [[nodiscard]] const float* stream(std::size_t s) const noexcept { return row(s); }

 private:
  [[nodiscard]] float* row(std::size_t s) const noexcept {
    // Patches have no second bound of the normal.
    const std::size_t own = are_groups_ || s < 9 ? s : s - 3;
    return memory_.get() + own * stride_;
  }

  struct Free {
    void operator()(float* memory) const noexcept;
  };
  std::unique_ptr<float[], Free> memory_;
  std::size_t count_ = 0;
  std::size_t stride_ = 0;
  bool has_planes_ = false;
  bool are_groups_ = false;
};

/// The corners of a patch.
class PatchCorners {
 public:
  void add(const Vec3& corner) noexcept { at_[count_++] = corner; }
  [[nodiscard]] std::span<const Vec3> all() const noexcept { return {at_.data(), count_}; }
  /// The other way round the patch, from the same corner on.
  [[nodiscard]] PatchCorners reversed() const noexcept {
    PatchCorners corners = *this;
    std::reverse(corners.at_.data() + 1, corners.at_.data() + count_);
    return corners;
  }

 private:
  std::array<Vec3, most_patch_corners> at_;
  unsigned count_ = 0;
};

/// Corners of patches in separate streams, padded likewise. Each patch has as many: those with fewer repeat their last
/// corner.
class CornerStreams {
 public:
  CornerStreams() noexcept = default;
  CornerStreams(std::size_t patches, unsigned corners);

  /// How many each patch has; 0 if the patches are boxes.
  [[nodiscard]] unsigned corners() const noexcept { return static_cast<unsigned>(streams_.size() / 3); }
  /// Stream 3 c + k has coordinate k of corner c.
  [[nodiscard]] const float* const* streams() const noexcept { return streams_.data(); }
  void set(std::size_t patch, std::span<const Vec3> corners) noexcept;
  /// Without those that are repeated.
  [[nodiscard]] PatchCorners of(std::size_t patch) const noexcept;

 private:
  std::vector<float> memory_;
  std::vector<float*> streams_;
};

/// A group of patches. Its children are groups side by side, or patches.
struct PatchGroup {
  std::uint32_t first;        ///< its patches, side by side in the order of the tree
  std::uint32_t count;        ///< how many
  std::uint32_t first_child;  ///< a group; of a group of patches, `first`
  std::uint8_t children;      ///< how many: 2 to most_children, or `count`, 1 to most_patches
  bool has_patches;           ///< whether its children are patches
};

/// The tree. Group 0 has all patches; there is none if there are no patches.
class PatchTree {
 public:
  /// Most groups in a group, and most patches.
  static constexpr std::size_t most_children = 8;
  static constexpr std::size_t most_patches = most_siblings;

  PatchTree() = default;
  /// Boxes are finite with lo ≤ hi, planes finite with normals that are not zero, and there are none or as many.
  PatchTree(const BoxView& boxes, std::span<const Plane> planes);
  /// Corners are finite, 3 to most_patch_corners of each patch: those of patch i are from first_corner[i] on.
  PatchTree(std::span<const Vec3> corners, std::span<const std::size_t> first_corner, PatchSides sides);

  [[nodiscard]] std::span<const std::uint32_t> order() const noexcept { return order_; }
  [[nodiscard]] const std::vector<PatchGroup>& groups() const noexcept { return groups_; }
  [[nodiscard]] const PatchStreams& patch_streams() const noexcept { return patch_streams_; }
  [[nodiscard]] const PatchStreams& group_streams() const noexcept { return group_streams_; }
  /// Of each group's box, a coordinate on the inner side of face f, or that of the face if the relative interior of a
  /// patch lies in it: as OpenBox has it (exact/blocking.hpp). Padded as streams are.
  [[nodiscard]] const float* group_inward(std::size_t f) const noexcept { return group_inward_[f].data(); }
  /// Whether patches have planes, and are seen from one side of them.
  [[nodiscard]] bool has_planes() const noexcept { return patch_streams_.has_planes() && !has_both_sides_; }
  /// Whether patches have planes, and are seen from both sides of them. Then corners run so that planes that are nearly
  /// parallel face alike.
  [[nodiscard]] bool has_both_sides() const noexcept { return has_both_sides_; }
  /// Whether patches have corners. Then the planes in streams, if there are any, are near those of the corners.
  [[nodiscard]] bool has_corners() const noexcept { return corner_streams_.corners() != 0; }
  [[nodiscard]] const CornerStreams& corner_streams() const noexcept { return corner_streams_; }
  /// Of the patch at a position of the order: its corners, or the different ones of its box.
  [[nodiscard]] PatchCorners corners_of(std::size_t position) const noexcept;
  /// Of at most 64 patches from a position on: bits of those that are not the boxes around them.
  [[nodiscard]] std::uint64_t not_boxes(std::size_t position, unsigned count) const noexcept;
  /// Of at most 64 groups: bits of those that have such a patch.
  [[nodiscard]] std::uint64_t groups_of_others(std::size_t group, unsigned count) const noexcept;
  /// Of each group, if patches have corners.
  [[nodiscard]] const std::vector<TurnedGroup>& turned_groups() const noexcept { return turned_groups_; }
  /// The largest magnitude of a coordinate of a box.
  [[nodiscard]] float largest_coordinate() const noexcept { return largest_coordinate_; }
  /// The patches as rays meet them, made when they are first asked for. Throws as outline_of().
  [[nodiscard]] std::shared_ptr<const RayPatches> ray_patches() const;
  /// The patches as they radiate (radiation/), made when they are first asked for. Null if there are no patches.
  [[nodiscard]] const MadeOnce<RadiatingPatches>* radiating_patches() const noexcept {
    return radiating_patches_.get();
  }
  /// The planes of a job (sight_set()), which make() makes unless they were those of the last job.
  template <class Make>
  [[nodiscard]] std::shared_ptr<const SightPlanes> sight_planes(const SightKey& key, const Make& make) const {
    return sight_planes_ ? sight_planes_->of(key, make) : std::make_shared<const SightPlanes>(make());
  }

 private:
  std::vector<std::uint32_t> order_;
  std::vector<PatchGroup> groups_;
  PatchStreams patch_streams_;
  PatchStreams group_streams_;
  std::array<std::vector<float>, 6> group_inward_;
  CornerStreams corner_streams_;
  std::vector<std::uint64_t> not_boxes_;         ///< a bit for each patch; none if all are boxes
  std::vector<std::uint64_t> groups_of_others_;  ///< likewise for each group
  std::vector<TurnedGroup> turned_groups_;
  float largest_coordinate_ = 0;
  bool has_both_sides_ = false;
  std::shared_ptr<MadeOnce<RayPatches>> ray_patches_;                ///< null if there are no patches
  std::shared_ptr<MadeOnce<RadiatingPatches>> radiating_patches_;    ///< likewise
  std::shared_ptr<MadeForKey<SightKey, SightPlanes>> sight_planes_;  ///< null if there are no patches
};

/// The corners of a box that differ.
[[nodiscard]] PatchCorners corners_of_box(const Box& box) noexcept;
/// Whether corners are those of the box around them, in any order, with or without others.
[[nodiscard]] bool are_corners_of_box(std::span<const Vec3> corners, const Box& box) noexcept;

}  // namespace shaftcull::kernel
