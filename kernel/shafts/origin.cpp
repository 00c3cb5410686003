// SPDX-License-Identifier: MIT
#include "shaftcull/origin.hpp"

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "exact/expansion.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/padding.hpp"
#include "support/text.hpp"

namespace shaftcull {
namespace {

using kernel::two_product;
using kernel::two_sum;
using kernel::TwoTerms;

constexpr float infinity = std::numeric_limits<float>::infinity();

/// The nearest float; infinite beyond the largest one.
float nearest_float(double x) noexcept {
  if (x > FLT_MAX) return infinity;
  if (x < -FLT_MAX) return -infinity;
  return static_cast<float>(x);
}

/// The next float above a finite one if `step`, or the float itself. Floats of one sign are in the order of their bits.
/// Without a branch, which processors would guess wrong half of the time.
float stepped_up(float x, bool step) noexcept {
  const auto bits = std::bit_cast<std::int32_t>(x);
  const auto above_zero = std::bit_cast<std::int32_t>(x + 0.0F);  // 0 for −0
  const std::int32_t next = above_zero + (above_zero < 0 ? -1 : 1);
  return std::bit_cast<float>(bits ^ ((bits ^ next) & -std::int32_t{step}));
}
float stepped_down(float x, bool step) noexcept { return -stepped_up(-x, step); }

/// The smallest float that is not below x − origin.
float rounded_up(double x, double origin) noexcept {
  const TwoTerms exact = two_sum(x, -origin);
  const float nearest = nearest_float(exact.sum);
  if (std::isinf(nearest)) return nearest > 0 || std::isinf(x) ? nearest : -FLT_MAX;
  const bool is_below = (nearest < exact.sum) | ((nearest == exact.sum) & (exact.error > 0));
  return stepped_up(nearest, is_below);
}

/// The largest float that is not above x − origin.
float rounded_down(double x, double origin) noexcept {
  const TwoTerms exact = two_sum(x, -origin);
  const float nearest = nearest_float(exact.sum);
  if (std::isinf(nearest)) return nearest < 0 || std::isinf(x) ? nearest : FLT_MAX;
  const bool is_above = (nearest > exact.sum) | ((nearest == exact.sum) & (exact.error < 0));
  return stepped_down(nearest, is_above);
}

Box smallest_around(const WorldBox& box, const WorldVec3& origin) noexcept {
  Box result;
  for (std::size_t k = 0; k != 3; ++k) {
    result.lo[k] = rounded_down(box.lo[k], origin[k]);
    result.hi[k] = rounded_up(box.hi[k], origin[k]);
  }
  return result;
}

Box largest_within(const WorldBox& box, const WorldVec3& origin) noexcept {
  Box result;
  bool is_empty = false;
  for (std::size_t k = 0; k != 3; ++k) {
    if (!(box.lo[k] <= box.hi[k])) return smallest_around(box, origin);  // empty or wrong, and stays so
    result.lo[k] = rounded_up(box.lo[k], origin[k]);
    result.hi[k] = rounded_down(box.hi[k], origin[k]);
    is_empty |= result.lo[k] > result.hi[k];
  }
  return is_empty ? kernel::empty_box : result;
}

/// A distance that a vector is no longer than, and hardly shorter.
double length_at_most(const WorldVec3& v) noexcept {
  constexpr double rounding = 1 + 8 * DBL_EPSILON;  // more than sums, squares and the root can be wrong
  constexpr double least = 1e-120;                  // whose square is far from where doubles get coarse
  const double sum = std::fabs(v[0]) + std::fabs(v[1]) + std::fabs(v[2]);
  if (!(sum > least && sum < 1 / least)) return sum * rounding;
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) * rounding;
}

Sphere sphere_around(const WorldSphere& sphere, const WorldVec3& origin) noexcept {
  Sphere result;
  WorldVec3 moved;
  for (std::size_t k = 0; k != 3; ++k) {
    const TwoTerms exact = two_sum(sphere.centre[k], -origin[k]);
    result.centre[k] = nearest_float(exact.sum);
    moved[k] = (result.centre[k] - exact.sum) - exact.error;
  }
  double radius = sphere.radius;
  if (radius < 0) {
    result.radius = rounded_down(radius, 0);
    return result;
  }
  if (moved != WorldVec3{0, 0, 0}) radius = (radius + length_at_most(moved)) * (1 + 2 * DBL_EPSILON);
  result.radius = rounded_up(radius, 0);
  return result;
}

/// The float nearest to x − origin. A difference that is no double lies between two, and the odd one of these is taken:
/// it is never in the middle of two floats, so rounding it is rounding the difference.
///
/// S. Boldo and G. Melquiond, "Emulation of FMA and Correctly Rounded Sums: Proved Algorithms Using Rounding to Odd",
/// IEEE Transactions on Computers 57(4), 2008.
float nearest_difference(double x, double origin) noexcept {
  constexpr double most = std::numeric_limits<double>::infinity();
  const TwoTerms exact = two_sum(x, -origin);
  const bool is_even = std::bit_cast<std::uint64_t>(exact.sum) % 2 == 0;
  if (exact.error == 0 || !is_even) return nearest_float(exact.sum);
  return nearest_float(std::nextafter(exact.sum, exact.error > 0 ? most : -most));
}

Vec3 nearest_point(const WorldVec3& point, const WorldVec3& origin) noexcept {
  Vec3 result;
  for (std::size_t k = 0; k != 3; ++k) result[k] = nearest_difference(point[k], origin[k]);
  return result;
}

bool is_finite(const WorldVec3& v) noexcept {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

void require_usable(const char* call, const WorldBox& box) {
  const bool is_usable = is_finite(box.lo) && is_finite(box.hi) && box.lo[0] <= box.hi[0] && box.lo[1] <= box.hi[1] &&
                         box.lo[2] <= box.hi[2];
  if (!is_usable) kernel::fail(InvalidArgument(std::string(call) + ": the box is not finite with lo <= hi"));
}

/// A half-space of floats, or why there is none.
struct FoundPlane {
  Plane plane;
  const char* fault = nullptr;
};

/// With q = p − at, normal·p ≤ offset is normal·q ≤ offset − normal·at. The rounded normal differs from the given one
/// by `turned`, whose product with q is greatest in a corner of the box.
FoundPlane plane_around(const WorldPlane& plane, const WorldBox& box, const WorldVec3& at) noexcept {
  constexpr FoundPlane too_far{{}, "is farther away than the largest float"};
  if (!is_finite(plane.normal) || !std::isfinite(plane.offset)) return {{}, "is not finite"};
  Plane result;
  kernel::Expansion<10> offset(plane.offset);
  double more = 0;
  double rounding = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    result.normal[k] = nearest_float(plane.normal[k]);
    if (std::isinf(result.normal[k])) return {{}, "has a normal beyond the largest float"};
    const TwoTerms product = two_product(plane.normal[k], -at[k]);
    offset.grow(product.error);
    offset.grow(product.sum);
    const bool is_tiny = std::fabs(product.sum) < 0x1p-900;  // where products are not exact
    if (is_tiny && plane.normal[k] != 0 && at[k] != 0) rounding += 0x1p-1000;
    const double turned = result.normal[k] - plane.normal[k];
    if (turned == 0) continue;
    const double most = std::fmax(turned * (box.lo[k] - at[k]), turned * (box.hi[k] - at[k]));
    more += most;
    rounding += std::fabs(most) * (8 * DBL_EPSILON) + 0x1p-1000;
  }
  offset.grow(more);
  offset.grow(rounding);
  double sum = 0;
  for (std::size_t i = 0; i != offset.size(); ++i) sum += offset[i];
  if (!(std::fabs(sum) <= FLT_MAX)) return too_far;
  result.offset = nearest_float(sum);
  offset.grow(-result.offset);
  result.offset = stepped_up(result.offset, offset.sign() > 0);
  if (std::isinf(result.offset)) return too_far;
  return {result};
}

/// The largest power of two that is not above a positive number.
double power_of_two_below(double x) noexcept {
  int exponent = 0;
  std::frexp(x, &exponent);
  return std::ldexp(1.0, exponent - 1);
}

template <class From, class To>
void require_as_many(std::span<const From> from, std::span<To> to, const char* what) {
  kernel::require_memory(what, from, what);
  kernel::require_memory("to", to, what);
  if (from.size() != to.size()) {
    kernel::fail(InvalidArgument("to has room for " + std::to_string(to.size()) + " " + what + ", and there are " +
                                 std::to_string(from.size())));
  }
}

template <class From, class To, class Convert>
void convert_all(std::span<const From> from, std::span<To> to, const char* what, Convert&& convert) {
  require_as_many(from, to, what);
  kernel::in_float_environment([&] {
    for (std::size_t i = 0; i != from.size(); ++i) to[i] = convert(from[i]);
  });
}

}  // namespace

Origin::Origin(const WorldVec3& at) : at_(at) {
  for (std::size_t k = 0; k != 3; ++k) {
    if (std::isfinite(at[k])) continue;
    const std::string value = kernel::text(static_cast<float>(at[k]));  // an infinity or NaN, which stays one
    kernel::fail(InvalidArgument(std::string("Origin: at.") + "xyz"[k] + " = " + value + " is not finite"));
  }
}

Origin Origin::for_world(const WorldBox& world) {
  return kernel::in_float_environment([&] {
    require_usable("Origin::for_world", world);
    double extent = 0;
    for (std::size_t k = 0; k != 3; ++k) extent = std::fmax(extent, world.hi[k] / 2 - world.lo[k] / 2);
    Origin origin;
    const double step = extent > 0 ? power_of_two_below(extent) / 16 : 0;
    for (std::size_t k = 0; k != 3; ++k) {
      const double middle = world.lo[k] / 2 + world.hi[k] / 2;
      const double steps = step > 0 ? middle / step : 0;
      origin.at_[k] = std::fabs(steps) > 0 && std::fabs(steps) < 0x1p52 ? std::floor(steps + 0.5) * step : middle;
    }
    return origin;
  });
}

Box Origin::around(const WorldBox& box) const noexcept {
  return kernel::in_float_environment([&] { return smallest_around(box, at_); });
}

Sphere Origin::around(const WorldSphere& sphere) const noexcept {
  return kernel::in_float_environment([&] { return sphere_around(sphere, at_); });
}

Plane Origin::around(const WorldPlane& plane, const WorldBox& box) const {
  return kernel::in_float_environment([&] {
    require_usable("Origin::around", box);
    const FoundPlane found = plane_around(plane, box, at_);
    if (found.fault != nullptr) kernel::fail(InvalidArgument(std::string("Origin::around: the plane ") + found.fault));
    return found.plane;
  });
}

Box Origin::within(const WorldBox& box) const noexcept {
  return kernel::in_float_environment([&] { return largest_within(box, at_); });
}

Vec3 Origin::nearest(const WorldVec3& point) const noexcept {
  return kernel::in_float_environment([&] { return nearest_point(point, at_); });
}

WorldVec3 Origin::to_world(const Vec3& point) const noexcept {
  return kernel::in_float_environment([&] {
    return WorldVec3{at_[0] + point[0], at_[1] + point[1], at_[2] + point[2]};
  });
}

void Origin::around(std::span<const WorldBox> boxes, std::span<Box> to) const {
  convert_all(boxes, to, "boxes", [&](const WorldBox& box) { return smallest_around(box, at_); });
}

void Origin::around(std::span<const WorldSphere> spheres, std::span<Sphere> to) const {
  convert_all(spheres, to, "spheres", [&](const WorldSphere& sphere) { return sphere_around(sphere, at_); });
}

void Origin::around(std::span<const WorldPlane> planes, const WorldBox& box, std::span<Plane> to) const {
  require_as_many(planes, to, "planes");
  kernel::in_float_environment([&] {
    require_usable("Origin::around", box);
    for (std::size_t i = 0; i != planes.size(); ++i) {
      const char* const fault = plane_around(planes[i], box, at_).fault;
      if (fault != nullptr) kernel::fail(InvalidArgument("Origin::around: plane " + std::to_string(i) + " " + fault));
    }
    for (std::size_t i = 0; i != planes.size(); ++i) to[i] = plane_around(planes[i], box, at_).plane;
  });
}

void Origin::within(std::span<const WorldBox> boxes, std::span<Box> to) const {
  convert_all(boxes, to, "boxes", [&](const WorldBox& box) { return largest_within(box, at_); });
}

void Origin::nearest(std::span<const WorldVec3> points, std::span<Vec3> to) const {
  convert_all(points, to, "points", [&](const WorldVec3& point) { return nearest_point(point, at_); });
}

}  // namespace shaftcull
