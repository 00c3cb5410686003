// SPDX-License-Identifier: MIT
/// The set `scalar`: one float at a time, on any processor. It has no 16-bit integers, by which it would not gain.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "simd/operations.hpp"
#include "simd/portable.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel::scalar {

struct Set;
using EightFloats = PortableEightFloats<Set>;

struct Floats {
  using Vector = float;
  using Mask = bool;
  using EightFloats = scalar::EightFloats;
  static constexpr unsigned width = 1;

  static Vector load(const float* p) noexcept { return *p; }
  static void store(float* p, Vector a) noexcept { *p = a; }
  static Vector gather(const float* p, const std::uint16_t* index) noexcept { return p[*index]; }
  static void load_columns(const void* const (&rows)[1], Vector (&columns)[4]) noexcept {
    std::memcpy(columns, rows[0], sizeof columns);
  }
  static void transpose(const Vector (&columns)[8], EightFloats::Vector (&transposed)[1]) noexcept {
    for (unsigned c = 0; c < 8; ++c) transposed[0].of[c] = columns[c];
  }

  class FirstLanes {
   public:
    explicit FirstLanes(int count) noexcept : is_there_(count > 0) {}
    [[nodiscard]] Vector load(const float* p) const noexcept { return is_there_ ? *p : 0.0F; }
    [[nodiscard]] Vector choose(Vector a, Vector b) const noexcept { return is_there_ ? a : b; }

   private:
    bool is_there_;
  };
  class Compressor {
   public:
    explicit Compressor(std::uint64_t /*bits*/) noexcept {}
    void store(float* p, Vector a) const noexcept { *p = a; }
    void store(std::uint32_t* p, const std::uint32_t* from) const noexcept { *p = *from; }
    void store(float* /*p*/, Vector /*a*/, std::size_t /*count*/) const noexcept {}  // of fewer than one
  };

  static Vector all(float a) noexcept { return a; }
  static Vector add(Vector a, Vector b) noexcept { return a + b; }
  static Vector subtract(Vector a, Vector b) noexcept { return a - b; }
  static Vector multiply(Vector a, Vector b) noexcept { return a * b; }
  static Vector divide(Vector a, Vector b) noexcept { return a / b; }
  static Vector square_root(Vector a) noexcept { return sqrtf(a); }
  static Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return a * b + c; }
  static Vector minimum(Vector a, Vector b) noexcept { return a < b ? a : b; }
  static Vector maximum(Vector a, Vector b) noexcept { return a > b ? a : b; }
  static Vector minimum_of_computed(Vector a, Vector b) noexcept { return minimum(a, b); }
  static Vector maximum_of_computed(Vector a, Vector b) noexcept { return maximum(a, b); }
  static Vector maximum_of_bits(Vector a, Vector b) noexcept {
    return __builtin_bit_cast(std::uint32_t, a) > __builtin_bit_cast(std::uint32_t, b) ? a : b;
  }
  static Vector magnitude(Vector a) noexcept { return fabsf(a); }
  static Vector floor(Vector a) noexcept { return floorf(a); }
  static Vector flip_sign(Vector a, Vector b) noexcept {
    return __builtin_bit_cast(std::uint32_t, b) >> 31U != 0 ? -a : a;
  }
  static float smallest(Vector a) noexcept { return a; }
  static float largest(Vector a) noexcept { return a; }

  static Mask less(Vector a, Vector b) noexcept { return a < b; }
  static Mask less_equal(Vector a, Vector b) noexcept { return a <= b; }
  static Mask both(Mask a, Mask b) noexcept { return a && b; }
  static Mask either(Mask a, Mask b) noexcept { return a || b; }
  static Vector choose(Mask mask, Vector a, Vector b) noexcept { return mask ? a : b; }
  static std::uint64_t bits(Mask mask) noexcept { return mask; }
  static unsigned lowest_bit(std::uint64_t word) noexcept {
    return static_cast<unsigned>(trailing_zeros(word | std::uint64_t{1} << 63));
  }

  static Vector either_negative(Vector a, Vector b) noexcept { return b < 0 ? b : a; }
  static std::uint64_t signs(const Vector (&of)[4]) noexcept {
    std::uint64_t signs = 0;
    for (unsigned v = 4; v-- != 0;)
      signs = 2 * signs + (of[v] < 0 ? 1U : 0U);  // g++ 12 miscompiles shifts by v under UBSan
    return signs;
  }

  class SignCollector {
   public:
    explicit SignCollector(Vector limit) noexcept : limit_(limit) {}
    std::uint64_t collect(const Vector (&of)[4]) noexcept {
      for (const Vector a : of) undecided_ |= (a >= 0) & (a <= limit_);
      return signs(of);
    }
    [[nodiscard]] bool any_undecided() const noexcept { return undecided_; }

   private:
    Vector limit_;
    bool undecided_ = false;
  };
};

static_assert(FloatOperations<Floats>);

}  // namespace shaftcull::kernel::scalar
