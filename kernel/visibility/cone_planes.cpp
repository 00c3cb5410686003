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
/// |n|·|p| + |offset| in sum. Underflow adds less than 2⁻¹⁴⁰.
ConePlane plane_in_lanes(const HullCone::Plane& plane, float tolerance, float coordinate) noexcept {
  NearNormal normal = normal_of(plane);
  ConePlane in_lanes{};
  in_lanes.in_front = std::numeric_limits<float>::infinity();
  in_lanes.behind = std::numeric_limits<float>::infinity();
  in_lanes.in_plane = std::numeric_limits<float>::infinity();
  const double largest =
      std::max({std::fabs(normal.component[0]), std::fabs(normal.component[1]), std::fabs(normal.component[2])});
  if (largest == 0) return in_lanes;
  const double scale = 1 / largest;
  double offset = 0;
  double length = 0;
  for (unsigned k = 0; k != 3; ++k) {
    const double component = normal.component[k] * scale;
    offset += component * double{plane.p[k]};
    length += std::fabs(component);
    in_lanes.normal[k] = static_cast<float>(component);
  }
  const double farthest = double{coordinate} + double{tolerance};
  const double error = (10 * 0x1p-24 * length + 2 * scale * normal.error) * farthest + 0x1p-120;
  if (!(length * farthest < 0x1p120) || !(error < 0x1p120)) return in_lanes;
  in_lanes.offset = static_cast<float>(offset);
  in_lanes.in_front = static_cast<float>(error);
  const double thickness = plane.face != nullptr ? double{tolerance} * length : 0;
  in_lanes.behind = static_cast<float>(error + thickness);
  if (plane.face != nullptr) in_lanes.in_plane = static_cast<float>(error - thickness);
  return in_lanes;
}

ConePlane plane_in_lanes(const NearPlane& face, float coordinate) noexcept {
  const std::array<Vec3, 3>& points = face.points();
  return plane_in_lanes({points[0], points[1], points[2], &face, true}, 0, coordinate);
}

}  // namespace shaftcull::kernel
