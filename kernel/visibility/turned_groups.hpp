// SPDX-License-Identifier: MIT
/// Groups of patches with corners, as boxes turned to the way that the patches face.
///
/// The box around a turned wall sticks out of the wall's plane. A box with one side along that plane does not, so a
/// wall is found to lie in its own plane, or behind another one, as a whole.
#pragma once

#include <span>
#include <vector>

#include "exact/patch_plane.hpp"
#include "exact/turned_box.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

class PatchTree;

/// The planes of patches: unit normals differ from `mean` by at most `spread` in length, and mean·p is at least `least`
/// and at most `largest` for a corner p of each patch that is in all of its planes. If a patch has no plane, `spread`
/// is infinite.
struct FacingPlanes {
  Double3 mean;
  double least;
  double largest;
  double spread;

  /// Whether normals are so near each other that all planes may have something behind them.
  [[nodiscard]] bool are_alike() const noexcept { return spread < 0.5; }
  /// The same planes, facing the other way.
  [[nodiscard]] FacingPlanes reversed() const noexcept {
    return {{-mean[0], -mean[1], -mean[2]}, -largest, -least, spread};
  }
};

/// A box around all corners of a group of patches, and the planes of the patches.
struct TurnedGroup {
  TurnedBox box;
  FacingPlanes planes;
};

/// The planes of one patch.
[[nodiscard]] FacingPlanes facing_planes(std::span<const Vec3> corners) noexcept;

/// The largest component of a point along a direction.
[[nodiscard]] double farthest_of(std::span<const Vec3> points, const Double3& direction) noexcept;
/// The length of the diagonal of the box around two boxes, or more.
[[nodiscard]] double reach_of(const float (&a)[6], const float (&b)[6]) noexcept;

/// One for each group of a tree whose patches have corners.
[[nodiscard]] std::vector<TurnedGroup> turned_groups(const PatchTree& tree);

/// Whether all points lie on or behind all planes, within the tolerance. It may say no. No point's component along
/// `planes.mean` is larger than `farthest`, none is farther than `reach` from a corner of the patches, and no
/// coordinate is larger than `coordinate`.
[[nodiscard]] bool are_behind(const FacingPlanes& planes, double farthest, double reach, double coordinate,
                              double tolerance) noexcept;

}  // namespace shaftcull::kernel
