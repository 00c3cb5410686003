// SPDX-License-Identifier: MIT
/// What the tests of operations share: the tables of all sets that are built, values worth trying, comparisons.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "instruction_sets.hpp"
#include "oracle/random.hpp"
#include "shaftcull/isa.hpp"
#include "simd/table.hpp"
#include "support/fail.hpp"

namespace shaftcull::simd_test {

#define SHAFTCULL_BUILT(set, features) \
  namespace set {                      \
  extern const Table table;            \
  }
#define SHAFTCULL_NOT_BUILT(set)
#include "dispatch/instruction_sets.inc"
#undef SHAFTCULL_BUILT
#undef SHAFTCULL_NOT_BUILT

inline const Table& table_of(Isa isa) {
  switch (isa) {
#define SHAFTCULL_BUILT(set, features) \
  case Isa::set:                       \
    return set::table;
#define SHAFTCULL_NOT_BUILT(set) case Isa::set:
#include "dispatch/instruction_sets.inc"
#undef SHAFTCULL_BUILT
#undef SHAFTCULL_NOT_BUILT
    break;
  }
  kernel::fail(std::logic_error("no operations of " + std::string(name(isa)) + " are built"));
}

inline constexpr float infinity = std::numeric_limits<float>::infinity();
inline constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// Numbers of every kind, of both signs, without NaN.
inline std::vector<float> numbers() {
  std::vector<float> numbers;
  for (const float x : {0.0F, 1.0F, 0x1p-149F, 0x1p-127F, 0x1p-126F, 0x1.fffffep127F, infinity, 0.5F, 0.75F, 1.5F, 2.5F,
                        0x1.fffffep-1F, 8388607.5F, 0x1p23F, 0x1p24F, 1e30F, 3.14159274F}) {
    numbers.push_back(x);
    numbers.push_back(-x);
  }
  return numbers;
}

/// Those, and NaN of both signs.
inline std::vector<float> values() {
  std::vector<float> values = numbers();
  values.push_back(not_a_number);
  values.push_back(-not_a_number);
  return values;
}

inline std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x); }
inline bool is_negative(float x) { return std::signbit(x); }

/// Whether two results of arithmetic are the same: a NaN is as good as another.
inline bool same(float a, float b) { return bits(a) == bits(b) || (std::isnan(a) && std::isnan(b)); }

/// a · b, of which no compiler makes a fused operation.
inline float product(float a, float b) {
  const volatile float product = a * b;
  return product;
}

/// a · b + c, rounded once: what std::fma() should be, and is not in mingw-w64's library. The product is exact in
/// doubles. If their sum is not, its last digit is made odd, by which the float next to it is the right one.
inline float fused(float a, float b, float c) {
  const double x = double{a} * double{b};
  const double y = c;
  const volatile double sum = x + y;
  const double s = sum;
  if (!std::isfinite(s) || s == 0) return static_cast<float>(s);
  const volatile double of_y = s - x;
  const volatile double of_x = s - of_y;
  const volatile double y_left = y - of_y;
  const volatile double x_left = x - of_x;
  const double left = x_left + y_left;
  const auto digits = std::bit_cast<std::uint64_t>(s);
  if (left == 0 || digits % 2 != 0) return static_cast<float>(s);
  const bool is_farther_from_zero = (left > 0) == (s > 0);
  return static_cast<float>(std::bit_cast<double>(is_farther_from_zero ? digits + 1 : digits - 1));
}

/// Runs check(a, b, c) with vectors of `width` floats, so that every pair of values, and many a triple, meets in some
/// lane.
template <class Check>
void for_vectors_of(const std::vector<float>& values, unsigned width, Check check) {
  std::vector<float> a(width);
  std::vector<float> b(width);
  std::vector<float> c(width);
  for (std::size_t shift = 0; shift != values.size(); ++shift) {
    for (std::size_t first = 0; first < values.size(); first += width) {
      for (std::size_t i = 0; i != width; ++i) {
        a[i] = values[(first + i) % values.size()];
        b[i] = values[(first + i + shift) % values.size()];
        c[i] = values[(first + i + 7 * shift + 3) % values.size()];
      }
      check(a.data(), b.data(), c.data());
    }
  }
}

}  // namespace shaftcull::simd_test
