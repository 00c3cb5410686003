// SPDX-License-Identifier: MIT
#include "exact/patch_plane.hpp"

#include <algorithm>
#include <cmath>

#include "exact/expansion.hpp"
#include "exact/orientation.hpp"
#include "exact/plane_of_points.hpp"

namespace shaftcull::kernel {
namespace {

/// n · w − tolerance |n|₁ as an expansion, n = u × v.
int exact_side(const Steps& u, const Steps& v, const Steps& w, double tolerance) noexcept {
  Expansion<288> sum;
  for (unsigned k = 0; k != 3; ++k) {
    const unsigned i = (k + 1) % 3;
    const unsigned j = (k + 2) % 3;
    const auto n = determinant<Expansion<2>>(u.of[i], u.of[j], v.of[i], v.of[j]);
    const auto along = n * w.of[k].in<Expansion<2>>();
    const auto allowed = n * (n.sign() < 0 ? tolerance : -tolerance);
    for (std::size_t t = 0; t != along.size(); ++t) sum.grow(along[t]);
    for (std::size_t t = 0; t != allowed.size(); ++t) sum.grow(allowed[t]);
  }
  return sum.sign();
}

/// The sign of n · w − tolerance |n|₁.
int side(const Steps& u, const Steps& v, const Steps& w, double tolerance) noexcept {
  double sum = 0;
  double magnitude = 0;
  for (unsigned k = 0; k != 3; ++k) {
    const unsigned i = (k + 1) % 3;
    const unsigned j = (k + 2) % 3;
    const double left = u.of[i].rounded() * v.of[j].rounded();
    const double right = u.of[j].rounded() * v.of[i].rounded();
    const double n = left - right;
    const double along = w.of[k].rounded();
    sum += n * along - tolerance * std::fabs(n);
    magnitude += (std::fabs(left) + std::fabs(right)) * (std::fabs(along) + tolerance);
  }
  // A term rounds for four differences, two products, their difference, two more products, a difference and three sums:
  // fewer than 12 units of its magnitude.
  if (std::fabs(sum) > 24 * 0x1p-53 * magnitude) return sum > 0 ? 1 : -1;
  if (tolerance != 0) return exact_side(u, v, w, tolerance);
  constexpr double origin[3] = {0, 0, 0};
  return SpannedPlane(origin, u.of, v.of).sign_along(w.of);
}

}  // namespace

int height_sign(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& x, float tolerance) noexcept {
  return side(Steps(p, q), Steps(p, r), Steps(p, x), double{tolerance});
}

namespace {

/// Whether `is_found(lies_in)` for the plane of one of a polygon's triangles with an area. `lies_in(x)` is whether x
/// lies in that plane, within the tolerance.
template <class IsFound>
bool any_plane(std::span<const Vec3> polygon, float tolerance, const IsFound& is_found) noexcept {
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Vec3& p = polygon[0];
    const Vec3& q = polygon[i - 1];
    const Vec3& r = polygon[i];
    const auto lies_in = [&](const Vec3& x) {
      return height_sign(p, q, r, x, tolerance) <= 0 && height_sign(p, r, q, x, tolerance) <= 0;
    };
    if (!are_on_one_line(p, q, r) && is_found(lies_in)) return true;
  }
  return false;
}

}  // namespace

bool lie_in_plane(std::span<const Vec3> points, std::span<const Vec3> polygon, float tolerance) noexcept {
  return any_plane(polygon, tolerance,
                   [&](const auto& lies_in) { return std::all_of(points.begin(), points.end(), lies_in); });
}

bool keep_off_planes(std::span<const Vec3> points, std::span<const Vec3> polygon, float tolerance) noexcept {
  return !any_plane(polygon, tolerance,
                    [&](const auto& lies_in) { return std::any_of(points.begin(), points.end(), lies_in); });
}

bool are_on_one_side(std::span<const Vec3> a, std::span<const Vec3> b, const std::array<Vec3, 3>& triangle,
                     Contact contact, float tolerance) noexcept {
  const PlaneOfPoints up(triangle[0], triangle[1], triangle[2]);
  const PlaneOfPoints down(triangle[0], triangle[2], triangle[1]);
  const auto are_in_front = [&](const PlaneOfPoints& plane, const PlaneOfPoints& reverse) {
    bool is_any_off = false;
    for (const std::span<const Vec3> end : {a, b}) {
      for (const Vec3& x : end) {
        const int beyond = reverse.side(x, tolerance);
        if (contact == Contact::open ? beyond > 0 : beyond >= 0) return false;
        is_any_off = is_any_off || plane.side(x, tolerance) > 0;
      }
    }
    return is_any_off;
  };
  return are_in_front(up, down) || are_in_front(down, up);
}

bool is_behind_patch(std::span<const Vec3> corners, float tolerance, const Vec3& point) noexcept {
  bool has_plane = false;
  const Steps to_point(corners[0], point);
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Steps u(corners[0], corners[i - 1]);
    const Steps v(corners[0], corners[i]);
    const int where = side(u, v, to_point, double{tolerance});
    if (where > 0) return false;
    has_plane = has_plane || where < 0 || !are_on_one_line(corners[0], corners[i - 1], corners[i]);
  }
  return has_plane;
}

bool ExactPlanes::is_behind(unsigned lane, const float (&point)[3]) const noexcept {
  if (corner != nullptr) {
    std::array<Vec3, most_patch_corners> corner_of;
    for (unsigned c = 0; c != corners; ++c) {
      for (unsigned k = 0; k != 3; ++k) corner_of[c][k] = corner[3 * c + k][first + lane];
    }
    if (are_reversed) std::reverse(corner_of.data() + 1, corner_of.data() + corners);
    return is_behind_patch({corner_of.data(), corners}, tolerance, {point[0], point[1], point[2]});
  }
  // Products of two floats are exact in doubles.
  Expansion<7> sum(-double{offset[lane]});
  for (unsigned k = 0; k != 3; ++k) {
    sum.grow(double{normal[k][lane]} * point[k]);
    sum.grow(-std::fabs(double{normal[k][lane]}) * tolerance);
  }
  return sum.sign() <= 0;
}

bool ExactPlanes::is_box_behind(unsigned lane, const float (&box)[6]) const noexcept {
  float point[3];
  if (corner == nullptr) {  // the corner that is farthest in front
    for (unsigned k = 0; k != 3; ++k) point[k] = normal[k][lane] > 0 ? box[k + 3] : box[k];
    return is_behind(lane, point);
  }
  for (unsigned c = 0; c != 8; ++c) {
    for (unsigned k = 0; k != 3; ++k) point[k] = box[(c >> k & 1U) != 0 ? k + 3 : k];
    if (!is_behind(lane, point)) return false;
  }
  return true;
}

PatchNormals::PatchNormals(std::span<const Vec3> corners) noexcept {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Steps u(corners[0], corners[i - 1]);
    const Steps v(corners[0], corners[i]);
    constexpr double origin[3] = {0, 0, 0};
    const SpannedPlane plane(origin, u.of, v.of);
    std::array<double, 3>& normal = normal_[count_];
    double square = 0;
    for (unsigned k = 0; k != 3; ++k) {
      normal[k] = plane.normal(k);
      square += normal[k] * normal[k];
    }
    if (square == 0) continue;  // every component is 0: none underflows when squared
    for (double& n : normal) n /= std::sqrt(square);
    ++count_;
  }
}

}  // namespace shaftcull::kernel
