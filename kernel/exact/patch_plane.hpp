// SPDX-License-Identifier: MIT
/// Exact answers for the planes of patches: planes that were given, or those of the patches' corners.
///
/// A patch with corners p0, p1, … has the planes of the triangles (p0, pi, pi+1) with an area. A point q lies on or
/// behind such a plane, within a tolerance, iff
///
///   n · (q − p0) ≤ tolerance (|nx| + |ny| + |nz|),   n = (pi − p0) × (pi+1 − p0).
///
/// The right-hand side is how far n · q can fall if each coordinate of q moves by the tolerance. A point lies behind a
/// patch iff it lies on or behind all planes of the patch. Nothing lies behind a patch without a plane.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"

namespace shaftcull::kernel {

inline constexpr unsigned most_patch_corners = 8;

/// Planes of patches side by side, as the user gave them, in streams that begin with the first patch.
struct ExactPlanes {
  const float* normal[3];      ///< of given planes
  const float* offset;         ///< likewise
  const float* const* corner;  ///< null if planes were given; stream 3 c + k has coordinate k of corner c
  std::size_t first;           ///< where the first patch is in streams of corners
  unsigned corners;            ///< of each patch: those with fewer repeat their last one
  float tolerance;
  bool are_reversed;  ///< whether patches with corners face the side from which these run clockwise

  /// Whether a point lies on or behind the planes of patch `lane`.
  [[nodiscard]] bool is_behind(unsigned lane, const float (&point)[3]) const noexcept;
  /// Whether all of a box does.
  [[nodiscard]] bool is_box_behind(unsigned lane, const float (&box)[6]) const noexcept;
};

/// Unit normals of the planes of a patch with corners. A component is off by 2⁻²⁸ of itself at most; 0 and ±1 are
/// right.
class PatchNormals {
 public:
  explicit PatchNormals(std::span<const Vec3> corners) noexcept;

  [[nodiscard]] std::span<const std::array<double, 3>> all() const noexcept { return {normal_.data(), count_}; }

 private:
  std::array<std::array<double, 3>, most_patch_corners - 2> normal_;
  unsigned count_ = 0;
};

/// The sign of n · (x − p) − tolerance (|nx| + |ny| + |nz|), n = (q − p) × (r − p).
[[nodiscard]] int height_sign(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& x, float tolerance) noexcept;

/// Whether all points lie in the plane of one of a polygon's triangles (p0, pi, pi+1), within the tolerance.
[[nodiscard]] bool lie_in_plane(std::span<const Vec3> points, std::span<const Vec3> polygon, float tolerance) noexcept;
/// Whether no point lies in any of these planes, within the tolerance.
[[nodiscard]] bool keep_off_planes(std::span<const Vec3> points, std::span<const Vec3> polygon,
                                   float tolerance) noexcept;

/// Whether two ends lie on one side of a triangle's plane, or reach beyond it by no more than the tolerance; with open
/// contact they may touch it, but not lie in it. Then the triangle does not reach between them.
[[nodiscard]] bool are_on_one_side(std::span<const Vec3> a, std::span<const Vec3> b,
                                   const std::array<Vec3, 3>& triangle, Contact contact, float tolerance) noexcept;

/// Whether a point lies on or behind the planes of a patch with corners.
[[nodiscard]] bool is_behind_patch(std::span<const Vec3> corners, float tolerance, const Vec3& point) noexcept;

}  // namespace shaftcull::kernel
