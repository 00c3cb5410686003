// SPDX-License-Identifier: MIT
/// Flat convex polygons in doubles.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "shaftcull/bounds.hpp"
#include "support/double3.hpp"

namespace shaftcull::kernel {

/// Corners run counterclockwise as seen from the front. There may be none.
class Polygon {
 public:
  /// Most corners of a polygon that is given. Each plane that cuts it adds one.
  static constexpr std::size_t most_given = 8;

  Polygon() noexcept = default;
  /// Of 3 to most_given corners, moved and then scaled.
  Polygon(std::span<const Vec3> corners, const Double3& origin, double scale) noexcept;

  [[nodiscard]] std::span<const Double3> corners() const noexcept { return {corner_.data(), count_}; }
  /// Twice the area long, to the front.
  [[nodiscard]] Double3 normal() const noexcept;
  /// What is in front of the plane through `other`. Nothing of what only touches it.
  [[nodiscard]] Polygon in_front_of(const Polygon& other) const noexcept;
  [[nodiscard]] Polygon moved(const Double3& origin, double scale) const noexcept;

 private:
  std::array<Double3, most_given + 1> corner_{};
  std::size_t count_ = 0;
};

}  // namespace shaftcull::kernel
