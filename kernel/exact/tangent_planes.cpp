// SPDX-License-Identifier: MIT
#include "exact/tangent_planes.hpp"

#include <algorithm>
#include <cmath>

#include "exact/patch_plane.hpp"
#include "support/exact_floats.hpp"

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

/// Whether a box lies behind for certain.
bool TangentPlanes::Tangent::is_behind(const TurnedBox& box, float tolerance) const noexcept {
  const Direction normal{normal_[0], normal_[1], normal_[2]};
  double farthest = box.farthest(normal);
  double size = 0;
  double magnitude = 0;
  for (unsigned k = 0; k != 3; ++k) {
    farthest -= normal_[k] * p_[k] + double{tolerance} * std::fabs(normal_[k]);
    magnitude += magnitude_[k];
    size = std::max(size, std::fabs(double{p_[k]}));
  }
  return farthest < -0x1p-38 * magnitude * (size + box.size + double{tolerance});
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
      for (std::size_t k = 0; k != other.corners.size(); ++k) add(edges.corners, i, j, other.corners, k);
    }
  }
}

/// Adds the plane through corners i and j of one patch and corner k of the other, if it touches both.
void TangentPlanes::add(std::span<const Vec3> one, std::size_t i, std::size_t j, std::span<const Vec3> other,
                        std::size_t k) {
  const Vec3& p = one[i];
  const Vec3& q = one[j];
  const Vec3& r = other[k];
  if (r == p || r == q) return;  // as between neighbours
  const Tangent plane(p, q, r);
  int front = 0;
  const auto turns = [&](const Vec3& corner) {
    const int side = plane.side(corner, 0);
    if (side == 0) return false;
    if (front == 0) front = side;
    return side != front;
  };
  for (std::size_t c = 0; c != one.size(); ++c) {
    if (c != i && c != j && turns(one[c])) return;
  }
  for (std::size_t c = 0; c != other.size(); ++c) {
    if (c != k && turns(other[c])) return;
  }
  if (front == 0) return;
  planes_.push_back(front > 0 ? plane : Tangent(p, r, q));
}

bool TangentPlanes::separate(const Points& points, Contact contact, float tolerance) const noexcept {
  const int most = contact == Contact::open ? 0 : -1;
  return std::any_of(planes_.begin(), planes_.end(), [&](const Tangent& plane) {
    if (points.around != nullptr && plane.is_behind(*points.around, tolerance)) return true;
    return std::all_of(points.all.begin(), points.all.end(),
                       [&](const Vec3& x) { return plane.side(x, tolerance) <= most; });
  });
}

}  // namespace shaftcull::kernel
