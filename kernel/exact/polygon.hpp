// SPDX-License-Identifier: MIT
/// Exact answers for polygons: whether one hides one end of segments from the other.
#pragma once

#include <cstddef>
#include <span>

#include "compiled/shaft_data.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// Whether the polygon blocks boxes a and b of the shaft, or the ends of a hull, as shaftcull/occluded.hpp says. At
/// least three points, all finite.
[[nodiscard]] bool polygon_blocks(const ShaftData& shaft, std::span<const Vec3> polygon) noexcept;

/// The same for the relative interiors of the convex hulls of two sets of finite points. Each has at least one point.
[[nodiscard]] bool polygon_blocks(std::span<const Vec3> a, std::span<const Vec3> b,
                                  std::span<const Vec3> polygon) noexcept;

/// The same for all points of the two hulls.
[[nodiscard]] bool polygon_blocks_closed(std::span<const Vec3> a, std::span<const Vec3> b,
                                         std::span<const Vec3> polygon) noexcept;

/// The distinct corners of a box with these six faces, one to eight.
class BoxCorners {
 public:
  explicit BoxCorners(const float (&face)[6]) noexcept;
  [[nodiscard]] std::span<const Vec3> get() const noexcept { return {corner_, count_}; }

 private:
  Vec3 corner_[8];
  std::size_t count_ = 0;
};

}  // namespace shaftcull::kernel
