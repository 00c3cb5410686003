// SPDX-License-Identifier: MIT
/// Boxes, spheres and planes: the basic values of the library.
#pragma once

#include <array>

#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// A point or a vector: x, y, z.
using Vec3 = std::array<float, 3>;

/// An axis-aligned box: all p with lo ≤ p ≤ hi on every axis (closed, so touching boxes meet). Infinite extents are
/// legal. The *empty* box has lo = +∞ and hi = −∞ on all axes, and meets nothing.
struct Box {
  Vec3 lo;  ///< the least coordinates
  Vec3 hi;  ///< the greatest coordinates
  friend bool operator==(const Box&, const Box&) = default;
};

/// A ball: all p with |p − centre| ≤ radius. A radius of 0 is a point.
struct Sphere {
  Vec3 centre;   ///< its centre point
  float radius;  ///< 0 or more
  friend bool operator==(const Sphere&, const Sphere&) = default;
};

/// A half-space: all p with normal·p ≤ offset. The normal need not have unit length.
struct Plane {
  Vec3 normal;   ///< points out of the half-space
  float offset;  ///< the value of normal·p on the plane
  friend bool operator==(const Plane&, const Plane&) = default;
};

}  // namespace shaftcull
