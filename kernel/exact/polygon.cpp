// SPDX-License-Identifier: MIT
#include "exact/polygon.hpp"

#include <cmath>
#include <cstddef>

#include "exact/expansion.hpp"

namespace shaftcull::kernel {
namespace {

/// A difference of doubles, rounded.
struct Rounded {
  static double difference(double a, double b) noexcept { return a - b; }
};
/// The magnitude of one.
struct Magnitude {
  static double difference(double a, double b) noexcept { return std::fabs(a - b); }
};

/// (b − a) · ((p − a) × (q − a)) in the arithmetic of `Number`, Rounded or Expansion<2>.
template <class Number>
auto orientation_in(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) noexcept {
  const auto along = [&](std::size_t k) { return Number::difference(b[k], a[k]); };
  const auto cross = [&](std::size_t i, std::size_t j) {
    return Number::difference(p[i], a[i]) * Number::difference(q[j], a[j]) -
           Number::difference(p[j], a[j]) * Number::difference(q[i], a[i]);
  };
  return cross(1, 2) * along(0) + cross(2, 0) * along(1) + cross(0, 1) * along(2);
}

/// The same with every term's magnitude.
double magnitude(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) noexcept {
  const auto from_a = [&](const Vec3& x, std::size_t k) { return Magnitude::difference(x[k], a[k]); };
  double sum = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    sum += from_a(b, k) * (from_a(p, i) * from_a(q, j) + from_a(p, j) * from_a(q, i));
  }
  return sum;
}

/// The sign of (b − a) · ((p − a) × (q − a)), exactly: on which side of the line from a to b the edge from p to q
/// passes, or on which side of the plane of b, p and q the point a is.
int orientation(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) noexcept {
  // Each of three factors is a rounded difference; two products, a difference and two sums round as well: fewer than 8
  // roundings a term. Products of three differences of floats neither over- nor underflow.
  constexpr double margin = 16 * 0x1p-53;
  const double value = orientation_in<Rounded>(a, b, p, q);
  if (std::fabs(value) > margin * magnitude(a, b, p, q)) return value > 0 ? 1 : -1;
  return orientation_in<Expansion<2>>(a, b, p, q).sign();
}

Vec3 corner(const float (&box)[6], unsigned which) noexcept {
  Vec3 point{};
  for (unsigned k = 0; k != 3; ++k) point[k] = box[(which >> k & 1U) != 0 ? k + 3 : k];
  return point;
}

/// The sign that the orientations of all corners of a box have, or 0 if they differ or are 0.
template <class Orientation>
int common_sign(const float (&box)[6], const Orientation& of) noexcept {
  const int first = of(corner(box, 0));
  for (unsigned c = 1; c != 8 && first != 0; ++c) {
    if (of(corner(box, c)) != first) return 0;
  }
  return first;
}

/// Whether the ends are strictly on different sides of the plane of three points; also if these are on one line.
bool passes_plane(const ShaftData& shaft, const Vec3& p, const Vec3& q, const Vec3& r) noexcept {
  const auto cross = [&](std::size_t i, std::size_t j) {
    return (Expansion<2>::difference(q[i], p[i]) * Expansion<2>::difference(r[j], p[j]) -
            Expansion<2>::difference(q[j], p[j]) * Expansion<2>::difference(r[i], p[i]))
        .sign();
  };
  if (cross(0, 1) == 0 && cross(1, 2) == 0 && cross(2, 0) == 0) return true;
  const auto side = [&](const Vec3& end) { return orientation(p, end, q, r); };
  const int of_a = common_sign(shaft.a, side);
  return of_a != 0 && common_sign(shaft.b, side) == -of_a;
}

}  // namespace

bool polygon_blocks(const ShaftData& shaft, std::span<const Vec3> polygon) noexcept {
  const std::size_t points = polygon.size();
  int turn = 0;
  for (std::size_t i = 0; i != points; ++i) {
    const Vec3& p = polygon[i];
    const Vec3& q = polygon[i + 1 == points ? 0 : i + 1];
    if (p == q) continue;
    const int side = common_sign(shaft.a, [&](const Vec3& a) {
      return common_sign(shaft.b, [&](const Vec3& b) { return orientation(a, b, p, q); });
    });
    if (side == 0 || side == -turn) return false;
    turn = side;
  }
  if (turn == 0) return false;
  for (std::size_t i = 2; i != points; ++i) {
    if (!passes_plane(shaft, polygon[0], polygon[i - 1], polygon[i])) return false;
  }
  return true;
}

}  // namespace shaftcull::kernel
