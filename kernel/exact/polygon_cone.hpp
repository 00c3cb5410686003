// SPDX-License-Identifier: MIT
/// What a convex polygon hides from one end of segments: as HullCone of a hull (docs/exactness.md, "Polygons").
///
/// It lies behind the polygon, and behind the planes through an edge of the polygon and the corner of the end that is
/// farthest around it. A polygon that is bent is the triangles that its first corner forms with its edges; a plate
/// hides what both of its polygons do.
#pragma once

#include <span>
#include <vector>

#include "exact/hull_cone.hpp"
#include "exact/near_plane.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// Whether all points are in one plane, exactly.
[[nodiscard]] bool is_flat(std::span<const Vec3> points) noexcept;

class PolygonCone {
 public:
  /// Turns to a polygon, the back polygon of a plate or none, and an end, the hull of finite points. Returns false if
  /// the polygon hides nothing from it. Memory is kept from one to the next.
  bool begin(std::span<const Vec3> polygon, std::span<const Vec3> back, bool is_flat, std::span<const Vec3> end,
             EndPoints counting);

  /// Planes behind which all lies that is hidden; valid until the next call.
  [[nodiscard]] std::span<const HullCone::Plane> planes() const noexcept { return planes_; }
  /// Whether all that lies behind them is hidden. Else they say what is not hidden alone.
  [[nodiscard]] bool is_sufficient() const noexcept { return is_sufficient_; }

 private:
  bool begin_flat(std::span<const Vec3> polygon, bool is_flat, std::span<const Vec3> end, EndPoints counting);
  bool add_bent(std::span<const Vec3> polygon, std::span<const Vec3> end);
  void add_edge(const Vec3& from, const Vec3& to, std::span<const Vec3> end);

  std::vector<HullCone::Plane> planes_;
  std::vector<NearPlane> face_;  ///< one, or those of triangles; planes_ refer to them
  bool is_sufficient_ = false;
};

}  // namespace shaftcull::kernel
