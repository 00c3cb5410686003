// SPDX-License-Identifier: MIT
/// Large worlds: bounds in doubles, as floats relative to an origin. Near the origin floats are fine; far from it they
/// are coarse, and answers stay right. Results contain exactly what they promise to contain, whatever floating-point
/// mode the caller runs in. No call allocates; all are safe to call from many threads.
#pragma once

#include <array>
#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// A point or a vector of a world in doubles: x, y, z.
using WorldVec3 = std::array<double, 3>;

/// A box of a world in doubles, as Box is one of floats: infinite extents are legal, and so is the empty box.
struct WorldBox {
  WorldVec3 lo;  ///< the least coordinates
  WorldVec3 hi;  ///< the greatest coordinates
  friend bool operator==(const WorldBox&, const WorldBox&) = default;
};

/// A ball of a world in doubles.
struct WorldSphere {
  WorldVec3 centre;  ///< its centre point
  double radius;     ///< 0 or more
  friend bool operator==(const WorldSphere&, const WorldSphere&) = default;
};

/// A half-space of a world in doubles: all p with normal·p ≤ offset.
struct WorldPlane {
  WorldVec3 normal;  ///< points out of the half-space
  double offset;     ///< the value of normal·p on the plane
  friend bool operator==(const WorldPlane&, const WorldPlane&) = default;
};

/// A point of the world that coordinates are relative to. The shaft between two boxes from around() contains the shaft
/// between the true boxes, and each bound from around() contains the true bound. So a bound that is outside is outside
/// in the world, too. To keep *inside* and *occluded* certain, make what contains or hides by within(), and all else by
/// around(). Coordinates that are floats relative to the origin are kept as they are.
///
/// All objects of one query need the same origin. Bounds keep their floats as long as it stays; move it by whole cells,
/// some kilometres wide.
class Origin {
 public:
  /// The origin of the world.
  constexpr Origin() noexcept = default;

  /// Throws InvalidArgument for a coordinate that is not finite.
  explicit SHAFTCULL_EXPORT Origin(const WorldVec3& at);

  /// A point near the middle of `world`, whose coordinates are multiples of a power of two that is 1/64 to 1/32 of the
  /// largest side. Throws InvalidArgument for a box that is not finite with lo ≤ hi.
  [[nodiscard]] static SHAFTCULL_EXPORT Origin near(const WorldBox& world);

  /// Where it is.
  [[nodiscard]] constexpr const WorldVec3& at() const noexcept { return at_; }

  /// The smallest box of floats that contains the box. The empty box stays empty. Infinite coordinates stay, and those
  /// beyond the largest float become infinite where the box needs it. NaN stays: whoever takes the box refuses it.
  [[nodiscard]] SHAFTCULL_EXPORT Box around(const WorldBox& box) const noexcept;

  /// A sphere that contains the sphere: the centre is rounded to nearest, and the radius grows by as much as it moves,
  /// if it moves. A radius below 0 and NaN stay, and a centre beyond the largest float becomes infinite: whoever takes
  /// the sphere refuses it.
  [[nodiscard]] SHAFTCULL_EXPORT Sphere around(const WorldSphere& sphere) const noexcept;

  /// A half-space that contains each point of `box` that the given one contains; `box` is in coordinates of the world.
  /// The normal is rounded to nearest. If it is one of floats already, all points of the half-space are contained.
  /// Throws InvalidArgument for a plane or a box that is not finite, and for one beyond the largest float.
  [[nodiscard]] SHAFTCULL_EXPORT Plane around(const WorldPlane& plane, const WorldBox& box) const;

  /// The largest box of floats within the box, for solids and for what is to contain others; the empty box if there is
  /// none. NaN stays.
  [[nodiscard]] SHAFTCULL_EXPORT Box within(const WorldBox& box) const noexcept;

  /// The float that is nearest to each coordinate: for points of hulls, vertices of triangles and corners of patches,
  /// which nothing can round outwards.
  [[nodiscard]] SHAFTCULL_EXPORT Vec3 nearest(const WorldVec3& point) const noexcept;

  /// Where a point is in the world, rounded to the nearest double.
  [[nodiscard]] SHAFTCULL_EXPORT WorldVec3 to_world(const Vec3& point) const noexcept;

  /// The same for many, each in place i of `to`. Throws InvalidArgument if the spans have different sizes, and then
  /// writes nothing. O(n), on the caller's thread.
  SHAFTCULL_EXPORT void around(std::span<const WorldBox> boxes, std::span<Box> to) const;
  SHAFTCULL_EXPORT void around(std::span<const WorldSphere> spheres, std::span<Sphere> to) const;  ///< the same
  SHAFTCULL_EXPORT void within(std::span<const WorldBox> boxes, std::span<Box> to) const;          ///< the same
  SHAFTCULL_EXPORT void nearest(std::span<const WorldVec3> points, std::span<Vec3> to) const;      ///< the same

  friend bool operator==(const Origin&, const Origin&) = default;

 private:
  WorldVec3 at_ = {0, 0, 0};
};

}  // namespace shaftcull
