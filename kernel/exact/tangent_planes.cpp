// SPDX-License-Identifier: MIT
#include "exact/tangent_planes.hpp"

#include <algorithm>
#include <cmath>

#include "exact/patch_plane.hpp"

namespace shaftcull::kernel {
TangentPlanes::Tangent::Tangent(const Vec3& p, const Vec3& q, const Vec3& r) noexcept : p_(p), q_(q), r_(r) {
  for (unsigned k = 0; k != 3; ++k) {
    const unsigned i = (k + 1) % 3;
    const unsigned j = (k + 2) % 3;
    const double left = (double{q[i]} - p[i]) * (double{r[j]} - p[j]);
    const double right = (double{q[j]} - p[j]) * (double{r[i]} - p[i]);
    normal_[k] = left - right;
    magnitude_[k] = std::fabs(left) + std::fabs(right);
  }
}

int TangentPlanes::Tangent::side(const Vec3& x, float tolerance) const noexcept {
  double sum = 0;
  double magnitude = 0;
  for (unsigned k = 0; k != 3; ++k) {
    const double along = double{x[k]} - p_[k];
    sum += normal_[k] * along - double{tolerance} * std::fabs(normal_[k]);
    magnitude += magnitude_[k] * (std::fabs(along) + double{tolerance});
  }
  // As height_sign() has it: a term rounds fewer than 12 times.
  if (std::fabs(sum) > 24 * 0x1p-53 * magnitude) return sum > 0 ? 1 : -1;
  return height_sign(p_, q_, r_, x, tolerance);
}

void TangentPlanes::find(const Patch& a, const Patch& b) {
  planes_.clear();
  add_through_edges(a, b);
  add_through_edges(b, a);
}

void TangentPlanes::add_through_edges(const Patch& edges, const Patch& other) {
  const std::size_t corners = edges.corners.size();
  for (std::size_t i = 0; i + 1 < corners; ++i) {
    for (std::size_t j = i + 1; j != corners; ++j) {
      const bool is_edge = edges.is_box || j == i + 1 || (i == 0 && j + 1 == corners);
      if (!is_edge || edges.corners[i] == edges.corners[j]) continue;
      for (const Vec3& third : other.corners) add(edges.corners[i], edges.corners[j], third, edges, other);
    }
  }
}

void TangentPlanes::add(const Vec3& p, const Vec3& q, const Vec3& r, const Patch& one, const Patch& other) {
  const Tangent plane(p, q, r);
  int front = 0;
  for (const std::span<const Vec3> corners : {one.corners, other.corners}) {
    for (const Vec3& corner : corners) {
      if (corner == p || corner == q || corner == r) continue;
      const int side = plane.side(corner, 0);
      if (side != 0 && side == -front) return;
      if (side != 0) front = side;
    }
  }
  if (front == 0) return;
  planes_.push_back(front > 0 ? plane : Tangent(p, r, q));
}

bool TangentPlanes::separate(std::span<const Vec3> points, Contact contact, float tolerance) const noexcept {
  const int most = contact == Contact::open ? 0 : -1;
  return std::any_of(planes_.begin(), planes_.end(), [&](const Tangent& plane) {
    return std::all_of(points.begin(), points.end(), [&](const Vec3& x) { return plane.side(x, tolerance) <= most; });
  });
}

}  // namespace shaftcull::kernel
