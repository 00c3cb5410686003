// SPDX-License-Identifier: MIT
#include "visibility/cone_planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/orientation.hpp"

namespace shaftcull::kernel {
namespace {

/// A normal in doubles, and the sum of the errors of its components.
struct NearNormal {
  double component[3];
  double error;
};

NearNormal normal_of(const HullCone::Plane& plane) noexcept {
  NearNormal normal{{0, 0, 0}, 0};
  if (plane.face != nullptr) {
    for (unsigned k = 0; k != 3; ++k) {
      normal.component[k] = plane.face->normal(k);
      normal.error += 0x1p-28 * std::fabs(normal.component[k]);
    }
    return normal;
  }
  const auto u = [&](unsigned k) { return double{plane.q[k]} - double{plane.p[k]}; };
  const auto v = [&](unsigned k) { return double{plane.r[k]} - double{plane.p[k]}; };
  for (unsigned k = 0; k != 3; ++k) {
    const double left = u((k + 1) % 3) * v((k + 2) % 3);
    const double right = u((k + 2) % 3) * v((k + 1) % 3);
    normal.component[k] = left - right;
    normal.error += 8 * 0x1p-53 * (std::fabs(left) + std::fabs(right));
  }
  return normal;
}

}  // namespace

/// For points with coordinates of at most `coordinate`. Let n be the normal, scaled to a largest component of 1. Each
/// component rounds, three products and three sums round, and so does the offset: each by 2⁻²⁴ of what is at most
/// |n|·|p| + |offset| in sum. Underflow adds less than 2⁻¹⁴⁰. Across an axis nothing rounds but the last difference,
/// which has the right sign: there a corner in the plane is certain.
ConePlane plane_in_lanes(const HullCone::Plane& plane, EndPoints counting, float tolerance, float coordinate) noexcept {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  constexpr float never = std::numeric_limits<float>::quiet_NaN();
  NearNormal normal = normal_of(plane);
  ConePlane in_lanes{};
  in_lanes.possible = {infinite, infinite};
  in_lanes.certain = {never, never};
  const double largest =
      std::max({std::fabs(normal.component[0]), std::fabs(normal.component[1]), std::fabs(normal.component[2])});
  if (largest == 0) return in_lanes;
  bool is_across_axis = false;
  for (unsigned k = 0; k != 3; ++k) {
    const bool is_across = plane.p[k] == plane.q[k] && plane.p[k] == plane.r[k];
    is_across_axis = is_across_axis || (is_across && largest > normal.error);
  }
  double offset = 0;
  double length = 0;
  for (unsigned k = 0; k != 3; ++k) {
    const double component = normal.component[k] / largest;  // 1 or −1 of the largest one
    offset += component * double{plane.p[k]};
    length += std::fabs(component);
    in_lanes.normal[k] = static_cast<float>(component);
  }
  const double farthest = double{coordinate} + double{tolerance};
  const double error = (10 * 0x1p-24 * length + 2 * normal.error / largest) * farthest + 0x1p-120;
  if (!(length * farthest < 0x1p120) || !(error < 0x1p120)) return in_lanes;
  in_lanes.offset = static_cast<float>(offset);
  // All corners are on the plane or behind it, and some are behind it: by more than the tolerance if it is a face. If
  // all points count, all are. If this end is not in the plane, the other one may be.
  constexpr float below = -std::numeric_limits<float>::denorm_min();
  const double thickness = plane.face != nullptr ? double{tolerance} * length : 0;
  const bool is_sharp = is_across_axis && thickness == 0;
  const float on = is_across_axis ? 0.0F : static_cast<float>(error);
  const float maybe_off = is_sharp ? below : static_cast<float>(error - thickness);
  const float off = is_sharp ? below : -static_cast<float>(error + thickness);
  if (counting == EndPoints::all) {
    in_lanes.possible.highest = maybe_off;
    in_lanes.certain = {off, off};
    return in_lanes;
  }
  in_lanes.possible.highest = on;
  in_lanes.certain.highest = -on;
  if (plane.takes_in_end) in_lanes.possible.lowest = maybe_off;
  in_lanes.certain.lowest = plane.takes_in_end ? off : infinite;
  return in_lanes;
}

ConePlane plane_in_lanes(const NearPlane& face, float coordinate) noexcept {
  const std::array<Vec3, 3>& points = face.points();
  return plane_in_lanes({points[0], points[1], points[2], &face, true}, EndPoints::of_relative_interior, 0, coordinate);
}

}  // namespace shaftcull::kernel
