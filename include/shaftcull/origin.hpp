// SPDX-License-Identifier: MIT
/// Large worlds: bounds in doubles are converted to floats relative to an origin. Floats are fine near the origin and
/// coarse far from it; answers stay right everywhere. Where a comment states that one object contains another, it does
/// so exactly, in any floating-point mode of the caller. No call allocates; all are safe to call from many threads.
#pragma once

#include <array>
#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// A point or a vector of a world in doubles: x, y, z.
using WorldVec3 = std::array<double, 3>;

/// A box of a world in doubles. As for Box, infinite extents are legal, and so is the empty box.
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

/// The point of a world to which coordinates are relative. The shaft between two boxes from around() contains the shaft
/// between the true boxes, and each bound from around() contains the true bound. So a bound that is outside is outside
/// in the world, too. For *inside* and *occluded* to be certain, too, make boxes that contain or hide others with
/// within(), and everything else with around(). Coordinates that are floats relative to the origin already do not
/// change.
///
/// All objects of one query need the same origin. Bounds keep their floats as long as the origin does not move. Move
/// the origin by whole cells that are a few kilometres wide.
class SHAFTCULL_EXPORT Origin {
 public:
  /// The origin of the world.
  constexpr Origin() noexcept = default;

  /// Throws InvalidArgument for a coordinate that is not finite.
  explicit SHAFTCULL_EXPORT Origin(const WorldVec3& at);

  /// A point near the middle of `world`, whose coordinates are multiples of a power of two that is 1/64 to 1/32 of the
  /// largest side. Throws InvalidArgument for a box that is not finite or has lo > hi.
  [[nodiscard]] static SHAFTCULL_EXPORT Origin for_world(const WorldBox& world);

  /// The point of the world where the origin is.
  [[nodiscard]] constexpr const WorldVec3& at() const noexcept { return at_; }

  /// The smallest box of floats that contains the given box. The empty box stays empty. Infinite coordinates stay
  /// infinite, and coordinates beyond the largest float become infinite where the box needs it. NaN stays NaN; calls
  /// that take the box refuse it.
  [[nodiscard]] SHAFTCULL_EXPORT Box around(const WorldBox& box) const noexcept;

  /// A sphere of floats that contains the given sphere. The centre is rounded to nearest; if this moves it, the radius
  /// grows by as much. A radius below 0 and NaN stay, and a centre beyond the largest float becomes infinite; calls
  /// that take the sphere refuse it.
  [[nodiscard]] SHAFTCULL_EXPORT Sphere around(const WorldSphere& sphere) const noexcept;

  /// A half-space of floats that contains each point of `box` that the given half-space contains. `box` is in
  /// coordinates of the world. The normal is rounded to nearest. If its coordinates are floats already, the result
  /// contains all points of the given half-space. Throws InvalidArgument for a plane or a box that is not finite, or is
  /// beyond the largest float.
  [[nodiscard]] SHAFTCULL_EXPORT Plane around(const WorldPlane& plane, const WorldBox& box) const;

  /// The largest box of floats within the given box, for solids and for boxes that are to contain others. The empty box
  /// if no box of floats is within the given box. NaN stays NaN.
  [[nodiscard]] SHAFTCULL_EXPORT Box within(const WorldBox& box) const noexcept;

  /// The float that is nearest to each coordinate: for points of hulls, vertices of triangles and corners of patches,
  /// which cannot be rounded outwards.
  [[nodiscard]] SHAFTCULL_EXPORT Vec3 nearest(const WorldVec3& point) const noexcept;

  /// The position of a point in the world, rounded to the nearest double.
  [[nodiscard]] SHAFTCULL_EXPORT WorldVec3 to_world(const Vec3& point) const noexcept;

  /// The same for many objects: writes the result of object i to to[i]. Throws InvalidArgument, and writes nothing, if
  /// the spans have different sizes. O(n), on the calling thread.
  SHAFTCULL_EXPORT void around(std::span<const WorldBox> boxes, std::span<Box> to) const;
  SHAFTCULL_EXPORT void around(std::span<const WorldSphere> spheres, std::span<Sphere> to) const;  ///< the same
  SHAFTCULL_EXPORT void within(std::span<const WorldBox> boxes, std::span<Box> to) const;          ///< the same
  SHAFTCULL_EXPORT void nearest(std::span<const WorldVec3> points, std::span<Vec3> to) const;      ///< the same

  /// The same for many planes and one box. Also throws InvalidArgument, and writes nothing, for a plane that the call
  /// for one plane refuses; the message has its position.
  SHAFTCULL_EXPORT void around(std::span<const WorldPlane> planes, const WorldBox& box, std::span<Plane> to) const;

  friend bool operator==(const Origin&, const Origin&) = default;

 private:
  WorldVec3 at_ = {0, 0, 0};
};

}  // namespace shaftcull
