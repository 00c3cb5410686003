// SPDX-License-Identifier: MIT
/// Patches that radiate, for view factors of many pairs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "radiation/flat_polygon.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// A polygon with what is needed of it again and again. Coordinates are the user's.
struct RadiatingPatch {
  explicit RadiatingPatch(std::span<const Vec3> corners) noexcept;

  Polygon outline;
  Double3 centre;
  double radius;   ///< of a ball around the centre
  Double3 normal;  ///< of length 1, to the front; 0 if there is no area
  double area;
};

/// Four points of a polygon, from its centre, and their weights.
struct FourNodes {
  double at[3][4];
  double weight[4];
};

/// How exact an integral over two areas is: off by so much of itself at most.
enum class Accuracy : std::uint8_t { six_digits, eight_digits };

/// The integral of cos θ₁ cos θ₂ / (π r²) over both patches: A₁ F₁₂. The order of the two does not matter to the bit.
[[nodiscard]] double exchange_between(const RadiatingPatch& a, const RadiatingPatch& b, Accuracy accuracy) noexcept;

/// The same for each two of some patches, of which points are worked out once.
class RadiatingPatches {
 public:
  /// None yet; with memory for so many of four corners.
  explicit RadiatingPatches(std::size_t count);
  void add(std::span<const Vec3> corners);

  [[nodiscard]] std::span<const RadiatingPatch> all() const noexcept { return patches_; }
  [[nodiscard]] const RadiatingPatch& operator[](std::size_t i) const noexcept { return patches_[i]; }
  [[nodiscard]] double exchange_between(std::size_t a, std::size_t b) const noexcept;

 private:
  static constexpr unsigned most_kept_order = 3;

  [[nodiscard]] std::span<const FourNodes> kept_nodes(std::size_t i, unsigned order) const noexcept;

  std::vector<RadiatingPatch> patches_;
  /// Of each patch, by two or three nodes along a side.
  std::vector<FourNodes> nodes_[most_kept_order - 1];
  std::vector<std::size_t> end_[most_kept_order - 1];
};

}  // namespace shaftcull::kernel
