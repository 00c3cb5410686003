// SPDX-License-Identifier: MIT
/// The floats of a scene as integers, times one power of two.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "oracle/sight.hpp"

namespace shaftcull::oracle {

__extension__ using Wide = __int128;

/// x times 2^doublings, which is an integer.
template <class Number>
Number scaled(float x, int doublings) {
  const double integer = std::ldexp(double{x}, doublings);
  if constexpr (std::is_same_v<Number, mpz_class>) {
    return mpz_class(integer);
  } else {
    return static_cast<Wide>(integer);
  }
}

/// The binary digits that floats have.
struct Digits {
  int first = std::numeric_limits<int>::max();  ///< the lowest one that is set, 0 being that of 1
  int end = std::numeric_limits<int>::min();    ///< one above the highest

  void add(float x) {
    if (x == 0) return;
    int exponent = 0;
    auto mantissa = static_cast<std::uint32_t>(std::ldexp(std::fabs(std::frexp(x, &exponent)), 24));
    end = std::max(end, exponent);
    int lowest = exponent - 24;
    for (; mantissa % 2 == 0; mantissa /= 2) ++lowest;
    first = std::min(first, lowest);
  }
  void add(const Vec3& point) {
    for (const float x : point) add(x);
  }
  void add(const Box& box) {
    add(box.lo);
    add(box.hi);
  }
  void add(const Plane& plane) {
    add(plane.normal);
    add(plane.offset);
  }
};

inline Digits digits_of(const SightQuestion& question) {
  Digits digits;
  if (!question.a_planes.empty() || !question.b_planes.empty()) digits.add(1.0F);
  for (const auto* boxes : {&question.a, &question.b, &question.solids}) {
    for (const Box& box : *boxes) digits.add(box);
  }
  for (const auto* planes : {&question.a_planes, &question.b_planes}) {
    for (const Plane& plane : *planes) digits.add(plane);
  }
  for (const auto* patches : {&question.a_corners, &question.b_corners}) {
    for (const std::vector<Vec3>& corners : *patches) {
      for (const Vec3& corner : corners) digits.add(corner);
    }
  }
  digits.add(question.tolerance);
  for (const SightOccluder& occluder : question.occluders) {
    digits.add(occluder.box);
    for (const Vec3& corner : occluder.corners) digits.add(corner);
  }
  for (const auto* shapes : {&question.polygons, &question.backs, &question.hulls}) {
    for (const std::vector<Vec3>& corners : *shapes) {
      for (const Vec3& corner : corners) digits.add(corner);
    }
  }
  if (digits.first > digits.end) digits.add(1.0F);  // every number is 0
  return digits;
}

}  // namespace shaftcull::oracle
