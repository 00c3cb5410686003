// SPDX-License-Identifier: MIT
#include "visibility/own_planes.hpp"

#include <algorithm>
#include <cstddef>

#include "support/exact_floats.hpp"

namespace shaftcull::kernel {

void OwnPlanes::add(std::span<const Vec3> patch, std::span<const Vec3> other) noexcept {
  for (std::size_t i = 2; i < patch.size(); ++i) {
    const PlaneOfPoints plane(patch[0], patch[i - 1], patch[i]);
    int front = 0;
    const auto turns = [&](const Vec3& corner) {
      const int side = plane.side(corner, 0);
      if (front == 0) front = side;
      return side != 0 && side != front;
    };
    if (std::any_of(other.begin(), other.end(), turns) || std::any_of(patch.begin(), patch.end(), turns)) continue;
    if (front == 0) continue;  // a triangle without area, or all in one plane
    plane_[count_++] = front > 0 ? plane : PlaneOfPoints(patch[0], patch[i], patch[i - 1]);
  }
}

bool OwnPlanes::separate(std::span<const Vec3> points, Contact contact, float tolerance) const noexcept {
  const int most = contact == Contact::open ? 0 : -1;
  const std::span<const PlaneOfPoints> planes = std::span(plane_).first(count_);
  return std::any_of(planes.begin(), planes.end(), [&](const PlaneOfPoints& plane) {
    return std::all_of(points.begin(), points.end(),
                       [&](const Vec3& point) { return plane.side(point, tolerance) <= most; });
  });
}

}  // namespace shaftcull::kernel
