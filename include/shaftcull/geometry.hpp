// SPDX-License-Identifier: MIT
/// Small helpers that make boxes and planes. Results are exact or err to the safe side, whatever floating-point mode
/// the caller runs in. No helper allocates; all are safe to call from many threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// The smallest box around all points; the empty box if there are none. Throws BadBound for the first point with a NaN,
/// and InvalidArgument for a null span that is not empty. O(points.size()).
[[nodiscard]] SHAFTCULL_EXPORT Box box_around(std::span<const Vec3> points);

/// The smallest box around both boxes. The empty box adds nothing. Coordinates must not be NaN.
[[nodiscard]] SHAFTCULL_EXPORT Box joined(const Box& a, const Box& b) noexcept;

/// The box moved by a vector: the smallest box of floats that contains the exact result, so lo is rounded down and hi
/// up. The empty box stays empty. Throws InvalidArgument if `by` is not finite. Coordinates must not be NaN. A face
/// that would pass the largest float becomes infinite; no shaft takes such a box.
///
/// swept() (volumes.hpp) makes the volume that a moving box sweeps over, and rounds nothing.
[[nodiscard]] SHAFTCULL_EXPORT Box translated(const Box& box, const Vec3& by);

/// The box with every face moved out by a distance, rounded outwards as in translated(). The empty box stays empty.
/// Throws InvalidArgument if `by` is negative or not finite. Coordinates must not be NaN.
[[nodiscard]] SHAFTCULL_EXPORT Box inflated(const Box& box, float by);

/// The range of depths in clip space that is in view.
enum class ClipDepth : std::uint8_t {
  zero_to_one,       ///< 0 ≤ z ≤ w: Direct3D, Vulkan, Metal, and reversed depth
  minus_one_to_one,  ///< −w ≤ z ≤ w: OpenGL
};

/// The planes of a view frustum, up to six: left, right, bottom, top, near and far. Planes that cut nothing off, such
/// as the far plane of an infinite projection, are left out.
struct ViewPlanes {
  std::array<Plane, 6> plane;  ///< the first `count` are valid
  std::size_t count;           ///< number of planes

  /// For loops over the planes, and spans of them.
  [[nodiscard]] const Plane* begin() const noexcept { return plane.data(); }
  [[nodiscard]] const Plane* end() const noexcept { return plane.data() + count; }
};

/// The planes of a view-projection matrix, normals outwards, ready to cut shafts with: compile(a, b, planes). Normals
/// are not of unit length. These planes restrict a shaft to the view; frustum() (hull.hpp) makes the view itself, as
/// one exact volume.
///
/// The matrix has 4 rows of 4 floats, row after row, and maps column vectors. Point p of the world is at
/// matrix · (p, 1) = (x, y, z, w) in clip space, and in view if −w ≤ x ≤ w, −w ≤ y ≤ w and z is in the range of
/// `depth`. Transpose a matrix that is stored column by column (glm) or that maps row vectors (DirectXMath). If such a
/// matrix is not transposed, its last column has the unit length that its last row should have, and this call and
/// frustum() throw InvalidArgument.
///
/// Each coefficient is the sum or difference of two coefficients of the matrix, rounded to the nearest float. Throws
/// InvalidArgument if the matrix is not finite, if a coefficient overflows, if a plane leaves nothing in view, or if
/// `depth` is not an enumerator.
///
/// G. Gribb and K. Hartmann, "Fast Extraction of Viewing Frustum Planes from the World-View-Projection Matrix", 2001.
[[nodiscard]] SHAFTCULL_EXPORT ViewPlanes view_planes(std::span<const float, 16> matrix, ClipDepth depth);

}  // namespace shaftcull
