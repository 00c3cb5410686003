// SPDX-License-Identifier: MIT
/// Exact answers for single boxes: whether a box blocks segments, where floats cannot tell.
#pragma once

#include <cstddef>
#include <span>

#include "compiled/shaft_data.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// The ends of a hull that was formed between two.
[[nodiscard]] inline std::span<const Vec3> first_end(const HullData& hull) noexcept {
  return {hull.corner, hull.first_corners};
}
[[nodiscard]] inline std::span<const Vec3> second_end(const HullData& hull) noexcept {
  return {hull.corner + hull.first_corners, std::size_t{hull.corners} - hull.first_corners};
}

/// Whether the box with the corners of `bound` (order of a BoxView's streams) blocks boxes a and b of the shaft, or the
/// ends of a hull, as shaftcull/occluded.hpp says. It starts again from the floats that the user gave. A box that is
/// empty or has a NaN blocks nothing; an infinite one is an unbounded box.
[[nodiscard]] bool box_blocks(const ShaftData& shaft, const float (&bound)[6]) noexcept;

/// A box with some of its faces left out: the union of the relative interiors of some parts of it. Face f is left out
/// iff `inward[f]`, a coordinate of the box on the axis of the face, differs from `face[f]`. For the relative interior
/// of one box, `inward` has the opposite faces.
struct OpenBox {
  float face[6];
  float inward[6];
};

/// Whether the box with the faces of `bound` meets all segments between `a` and `b`, as box_blocks() does. All faces of
/// `a` and `b` are finite.
[[nodiscard]] bool box_blocks(const OpenBox& a, const OpenBox& b, const float (&bound)[6]) noexcept;

/// The same for the relative interiors of the convex hulls of two sets of finite points. Each has at least one point.
[[nodiscard]] bool box_blocks(std::span<const Vec3> a, std::span<const Vec3> b, const float (&bound)[6]) noexcept;

}  // namespace shaftcull::kernel
