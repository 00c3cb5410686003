// SPDX-License-Identifier: MIT
/// Where a set of patches is best cut in two.
///
/// It is where the sum of both halves' surface × spread of normals × number of patches is least, as trees of rays are
/// cut by surface alone (Goldsmith and Salmon, "Automatic Creation of Object Hierarchies for Ray Tracing", 1987):
/// patches that face alike turn away from others together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "simd/baseline_four_floats.hpp"
#include "support/exact_floats.hpp"

namespace shaftcull::kernel {

/// A box in six dimensions, three of space and three of normals. Its lo is stored with the opposite sign, so that two
/// boxes are joined by maxima alone.
struct PatchExtent {
  FourFloats least;      ///< −lo x, y, z; −least normal x
  FourFloats largest;    ///< hi x, y, z; largest normal x
  FourFloats normal_yz;  ///< largest normal y, z; −least normal y, z

  /// Of nothing: it changes no extent that it is joined with.
  static PatchExtent none() noexcept;
  void join(const PatchExtent& other) noexcept {
    least = maximum(least, other.least);
    largest = maximum(largest, other.largest);
    normal_yz = maximum(normal_yz, other.normal_yz);
  }
};

/// A patch on its way to its group.
struct PatchItem {
  PatchExtent extent;
  std::uint32_t index;
};

/// Of a box that faces along a normal of any length. One of length 0 is taken as it is.
PatchExtent extent_of(const Box& box, const double (&normal)[3]) noexcept;
PatchExtent extent_of(std::span<const PatchItem> items) noexcept;

/// What it costs to have a group: how much there is that it is compared with. Costs can be compared with those by the
/// same measure.
class PatchCosts {
 public:
  /// By the measure of what all of `around` is.
  explicit PatchCosts(const PatchExtent& around) noexcept;

  /// Of four groups, per patch. Of none it is no number, also times 0.
  [[nodiscard]] FourFloats of(const PatchExtent (&extent)[4]) const noexcept;

 private:
  FourFloats half_scale_;
};

/// Cuts sets of patches in two.
class PatchHalving {
 public:
  /// Sets have at most `most_items`. Without planes, normals are all alike.
  PatchHalving(std::size_t most_items, bool has_planes);

  /// Halves items where it costs least. Returns how many are in the first half: never none or all. O(n).
  std::size_t halve(std::span<PatchItem> items, const PatchCosts& costs);

 private:
  std::size_t keys_;
  std::vector<PatchItem> second_half_;
};

}  // namespace shaftcull::kernel
