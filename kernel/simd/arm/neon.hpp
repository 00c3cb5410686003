// SPDX-License-Identifier: MIT
/// The set `neon`: vectors of 4 floats and of 8 integers, on 64-bit ARM in little-endian order.
#pragma once

#include <arm_neon.h>

#include <cstddef>
#include <cstdint>

#include "simd/left_packing.hpp"
#include "simd/operations.hpp"
#include "simd/portable.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel::neon {

struct Set;

struct EightFloats : PortableEightFloats<Set> {
  static unsigned signs(const Vector& a) noexcept {
    const uint32x4_t first = vreinterpretq_u32_f32(vld1q_f32(a.of));
    const uint32x4_t last = vreinterpretq_u32_f32(vld1q_f32(a.of + 4));
    const uint32x4_t both = vandq_u32(vsriq_n_u32(last, first, 4), vdupq_n_u32(0x88000000));
    const int32x4_t down = {-27, -26, -25, -24};  // lane i to bits i and i + 4
    return vaddvq_u32(vshlq_u32(both, down));
  }
};

struct Integers16;

struct Floats {
  using Vector = float32x4_t;
  using Mask = uint32x4_t;
  using EightFloats = neon::EightFloats;
  using Integers16 = neon::Integers16;
  static constexpr unsigned width = 4;

  static Vector load(const float* p) noexcept { return vld1q_f32(p); }
  static void store(float* p, Vector a) noexcept { vst1q_f32(p, a); }
  static Vector gather(const float* p, const std::uint16_t* index) noexcept {
    Vector a = vdupq_n_f32(p[index[0]]);
    a = vld1q_lane_f32(p + index[1], a, 1);
    a = vld1q_lane_f32(p + index[2], a, 2);
    return vld1q_lane_f32(p + index[3], a, 3);
  }
  static void load_columns(const void* const (&rows)[4], Vector (&columns)[4]) noexcept {
    Vector row[4];
    for (unsigned i = 0; i < 4; ++i) row[i] = load(static_cast<const float*>(rows[i]));
    transpose(row, columns);
  }
  static void transpose(const Vector (&columns)[8], EightFloats::Vector (&transposed)[4]) noexcept {
    for (unsigned c = 0; c < 8; c += 4) {
      const Vector four[4] = {columns[c], columns[c + 1], columns[c + 2], columns[c + 3]};
      Vector row[4];
      transpose(four, row);
      for (unsigned i = 0; i < 4; ++i) store(transposed[i].of + c, row[i]);
    }
  }

  class FirstLanes {
   public:
    explicit FirstLanes(int count) noexcept : count_(count) {}

    [[nodiscard]] Vector load(const float* p) const noexcept {
      const Vector none = vdupq_n_f32(0);
      if (count_ >= 4) return vld1q_f32(p);
      if (count_ <= 0) return none;
      if (count_ == 1) return vld1q_lane_f32(p, none, 0);
      const Vector two = vcombine_f32(vld1_f32(p), vget_low_f32(none));
      return count_ == 2 ? two : vld1q_lane_f32(p + 2, two, 2);
    }
    [[nodiscard]] Vector choose(Vector a, Vector b) const noexcept {
      const int32x4_t lane = {0, 1, 2, 3};
      return vbslq_f32(vcgtq_s32(vdupq_n_s32(count_), lane), a, b);
    }

   private:
    int count_;
  };

  class Compressor {
   public:
    // In parentheses: to clang the function is a macro, and the comma would end its argument.
    explicit Compressor(std::uint64_t bits) noexcept : from_(vld1q_u8((left_packing<4, 4>.part[bits]))) {}

    void store(float* p, Vector a) const noexcept { Floats::store(p, packed(a)); }
    void store(std::uint32_t* p, const std::uint32_t* from) const noexcept {
      vst1q_u32(p, vreinterpretq_u32_u8(vqtbl1q_u8(vreinterpretq_u8_u32(vld1q_u32(from)), from_)));
    }
    void store(float* p, Vector a, std::size_t count) const noexcept {
      float lane[4];
      Floats::store(lane, packed(a));
      for (std::size_t i = 0; i < count; ++i) p[i] = lane[i];
    }

   private:
    [[nodiscard]] Vector packed(Vector a) const noexcept {
      return vreinterpretq_f32_u8(vqtbl1q_u8(vreinterpretq_u8_f32(a), from_));
    }

    uint8x16_t from_;
  };

  static Vector all(float a) noexcept { return vdupq_n_f32(a); }
  static Vector add(Vector a, Vector b) noexcept { return vaddq_f32(a, b); }
  static Vector subtract(Vector a, Vector b) noexcept { return vsubq_f32(a, b); }
  static Vector multiply(Vector a, Vector b) noexcept { return vmulq_f32(a, b); }
  static Vector divide(Vector a, Vector b) noexcept { return vdivq_f32(a, b); }
  static Vector square_root(Vector a) noexcept { return vsqrtq_f32(a); }
  static Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return vfmaq_f32(c, a, b); }
  // Not vminq_f32(), which hands on any NaN, nor vminnmq_f32(), which passes over one in the second place and orders
  // zeros by their signs, and hands on a signalling NaN.
  static Vector minimum(Vector a, Vector b) noexcept { return vbslq_f32(vcltq_f32(a, b), a, b); }
  static Vector maximum(Vector a, Vector b) noexcept { return vbslq_f32(vcgtq_f32(a, b), a, b); }
  static Vector minimum_of_computed(Vector a, Vector b) noexcept { return vminnmq_f32(a, b); }
  static Vector maximum_of_computed(Vector a, Vector b) noexcept { return vmaxnmq_f32(a, b); }
  static Vector maximum_of_bits(Vector a, Vector b) noexcept {
    return vreinterpretq_f32_u32(vmaxq_u32(bits_of(a), bits_of(b)));
  }
  static Vector magnitude(Vector a) noexcept { return vabsq_f32(a); }
  static Vector floor(Vector a) noexcept { return vrndmq_f32(a); }
  static Vector flip_sign(Vector a, Vector b) noexcept {
    return vreinterpretq_f32_u32(veorq_u32(bits_of(a), bits_of(b)));
  }
  static float smallest(Vector a) noexcept { return vminvq_f32(a); }
  static float largest(Vector a) noexcept { return vmaxvq_f32(a); }

  static Mask less(Vector a, Vector b) noexcept { return vcltq_f32(a, b); }
  static Mask less_equal(Vector a, Vector b) noexcept { return vcleq_f32(a, b); }
  static Mask both(Mask a, Mask b) noexcept { return vandq_u32(a, b); }
  static Mask either(Mask a, Mask b) noexcept { return vorrq_u32(a, b); }
  static Vector choose(Mask mask, Vector a, Vector b) noexcept { return vbslq_f32(mask, a, b); }
  static std::uint64_t bits(Mask mask) noexcept {
    const uint32x4_t bit = {1, 2, 4, 8};
    return vaddvq_u32(vandq_u32(mask, bit));
  }
  static unsigned lowest_bit(std::uint64_t word) noexcept {
    return static_cast<unsigned>(trailing_zeros(word | std::uint64_t{1} << 63));
  }

  static Vector either_negative(Vector a, Vector b) noexcept { return vbslq_f32(vcltzq_f32(b), b, a); }
  /// Each lane gets the four signs that it has in the vectors, four bits apart. Lanes are then moved by a bit each and
  /// added up.
  static std::uint64_t signs(const Vector (&of)[4]) noexcept {
    const uint32x4_t high = vsriq_n_u32(bits_of(of[3]), bits_of(of[2]), 4);
    const uint32x4_t low = vsriq_n_u32(bits_of(of[1]), bits_of(of[0]), 4);
    const uint32x4_t four = vandq_u32(vsriq_n_u32(high, low, 8), vdupq_n_u32(0x88880000));
    const int32x4_t down = {-19, -18, -17, -16};
    return vaddvq_u32(vshlq_u32(four, down));
  }

  /// As unsigned integers, negative floats are above all others. So the smallest says whether any was undecided.
  class SignCollector {
   public:
    explicit SignCollector(Vector limit) noexcept : limit_(bits_of(limit)) {}

    std::uint64_t collect(const Vector (&of)[4]) noexcept {
      const uint32x4_t first = vminq_u32(bits_of(of[0]), bits_of(of[1]));
      const uint32x4_t last = vminq_u32(bits_of(of[2]), bits_of(of[3]));
      smallest_ = vminq_u32(smallest_, vminq_u32(first, last));
      return signs(of);
    }
    [[nodiscard]] bool any_undecided() const noexcept { return vmaxvq_u32(vcleq_u32(smallest_, limit_)) != 0; }

   private:
    uint32x4_t limit_;
    uint32x4_t smallest_ = vdupq_n_u32(0xffffffff);
  };

 private:
  static uint32x4_t bits_of(Vector a) noexcept { return vreinterpretq_u32_f32(a); }
  /// Rows become columns: in pairs of lanes, then in halves.
  static void transpose(const Vector (&row)[4], Vector (&column)[4]) noexcept {
    const auto pairs = [](Vector a) { return vreinterpretq_f64_f32(a); };
    const float64x2_t even[2] = {pairs(vtrn1q_f32(row[0], row[1])), pairs(vtrn1q_f32(row[2], row[3]))};
    const float64x2_t odd[2] = {pairs(vtrn2q_f32(row[0], row[1])), pairs(vtrn2q_f32(row[2], row[3]))};
    column[0] = vreinterpretq_f32_f64(vtrn1q_f64(even[0], even[1]));
    column[1] = vreinterpretq_f32_f64(vtrn1q_f64(odd[0], odd[1]));
    column[2] = vreinterpretq_f32_f64(vtrn2q_f64(even[0], even[1]));
    column[3] = vreinterpretq_f32_f64(vtrn2q_f64(odd[0], odd[1]));
  }
};

/// A word's integers lie in memory in another order: integer 8 · i + v of the word is in lane i of vector v. So the
/// signs of eight vectors, side by side in each lane, are the word's bits in their order.
struct Integers16 {
  using Floats = neon::Floats;
  using Vector = int16x8_t;
  static constexpr unsigned width = 8;
  static constexpr unsigned vectors = 8;
  static constexpr std::size_t fewest_shafts_on_grid = 5;
  static constexpr std::size_t fewest_tests_on_grid = 6144;

  static Vector load(const std::int16_t* p) noexcept { return vld1q_s16(p); }
  static Vector all(std::int16_t a) noexcept { return vdupq_n_s16(a); }
  static Vector add(Vector a, Vector b) noexcept { return vaddq_s16(a, b); }
  static Vector subtract(Vector a, Vector b) noexcept { return vsubq_s16(a, b); }
  static Vector minimum(Vector a, Vector b) noexcept { return vminq_s16(a, b); }
  static Vector maximum(Vector a, Vector b) noexcept { return vmaxq_s16(a, b); }
  static Vector subtract_saturated(Vector a, Vector b) noexcept { return vqsubq_s16(a, b); }
  static Vector multiply(Vector a, Vector b) noexcept { return vqrdmulhq_s16(a, b); }

  /// Converted, NaN would be 0: so they become `least` as floats.
  static void store_rounded(std::int16_t* out, const Floats::Vector (&of)[16], Vector least) noexcept {
    const float32x4_t least_floats = vcvtq_f32_s32(vmovl_s16(vget_low_s16(least)));
    const auto rounded = [&](float32x4_t a) { return vcvtnq_s32_f32(Floats::maximum(a, least_floats)); };
    int16x8_t row[8];
    for (unsigned i = 0; i < 8; ++i) {
      row[i] = vqmovn_high_s32(vqmovn_s32(rounded(of[2 * i])), rounded(of[2 * i + 1]));
    }
    // Eight rows become columns: in pairs, in fours, in halves.
    int32x4_t pair[8];
    for (unsigned i = 0; i < 8; i += 2) {
      pair[i] = vreinterpretq_s32_s16(vtrn1q_s16(row[i], row[i + 1]));
      pair[i + 1] = vreinterpretq_s32_s16(vtrn2q_s16(row[i], row[i + 1]));
    }
    int64x2_t four[8];
    for (unsigned i = 0; i < 8; i += 4) {
      for (unsigned k = 0; k < 2; ++k) {
        four[i + k] = vreinterpretq_s64_s32(vtrn1q_s32(pair[i + k], pair[i + k + 2]));
        four[i + k + 2] = vreinterpretq_s64_s32(vtrn2q_s32(pair[i + k], pair[i + k + 2]));
      }
    }
    for (unsigned i = 0; i < 4; ++i) {
      vst1q_s16(out + 8 * i, vreinterpretq_s16_s64(vtrn1q_s64(four[i], four[i + 4])));
      vst1q_s16(out + 8 * (i + 4), vreinterpretq_s16_s64(vtrn2q_s64(four[i], four[i + 4])));
    }
  }

  /// As unsigned integers, negative ones are above all others. So the smallest of each lane says whether any of its
  /// eight was undecided.
  static Outcomes outcomes(const Vector (&of)[8], Vector limit) noexcept {
    const auto bits_of = [&](unsigned v) { return vreinterpretq_u16_s16(of[v]); };
    const auto as_word = [](uint8x8_t a) { return vget_lane_u64(vreinterpret_u64_u8(a), 0); };

    uint16x8_t sign[4];
    uint16x8_t smallest[4];
    for (unsigned v = 0; v < 4; ++v) {
      sign[v] = vsriq_n_u16(bits_of(2 * v + 1), bits_of(2 * v), 1);
      smallest[v] = vminq_u16(bits_of(2 * v), bits_of(2 * v + 1));
    }
    const uint16x8_t low = vsriq_n_u16(sign[1], sign[0], 2);
    const uint16x8_t high = vsriq_n_u16(sign[3], sign[2], 2);
    const uint16x8_t least = vminq_u16(vminq_u16(smallest[0], smallest[1]), vminq_u16(smallest[2], smallest[3]));
    const uint16x8_t limits = vshrq_n_u16(vreinterpretq_u16_s16(limit), 8);
    return {.yes = as_word(vshrn_n_u16(vsriq_n_u16(high, low, 4), 8)),
            .undecided = as_word(vmovn_u16(vcleq_u16(least, limits)))};
  }
};

static_assert(FloatOperations<Floats> && Integer16Operations<Integers16>);

}  // namespace shaftcull::kernel::neon
