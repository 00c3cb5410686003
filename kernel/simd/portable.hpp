// SPDX-License-Identifier: MIT
/// Every operation of operations.hpp on floats in plain C++: what a new instruction set starts from.
///
/// A set derives from these classes and replaces the operations that its processor has instructions for. `Set` is a
/// type of the set's namespace: functions are the set's own, since it is compiled with flags of its own
/// (kernel/kernels/README.md).
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "simd/operations.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// EightFloatOperations on an array. Compilers make vectors of these loops where they can.
template <class Set>
struct PortableEightFloats {
  struct Vector {
    float of[8];
  };
  using Mask = Vector;
  struct Order {
    std::uint8_t from[8];
  };
  struct Three {
    float of[3];
  };
  static constexpr bool in_one_register = false;

  static Vector all(float a) noexcept {
    return each([&](unsigned) { return a; });
  }
  static Vector load(const void* from) noexcept {
    Vector a;
    std::memcpy(a.of, from, sizeof a.of);
    return a;
  }
  static Vector load_six(const float* from, float rest) noexcept {
    return {{from[0], from[1], from[2], from[3], from[4], from[5], rest, rest}};
  }
  static Vector load_faces(const void* box) noexcept {
    Vector faces;
    std::memcpy(faces.of, box, 6 * sizeof(float));
    faces.of[6] = faces.of[4];
    faces.of[7] = faces.of[5];
    return faces;
  }
  static void store(void* to, const Vector& a) noexcept { std::memcpy(to, a.of, sizeof a.of); }
  static Vector first_in_all(const Vector& a) noexcept {
    return each([&](unsigned) { return a.of[0]; });
  }
  static float first(const Vector& a) noexcept { return a.of[0]; }
  static Vector pair_in_all(float even, float odd) noexcept { return {{even, odd, even, odd, even, odd, even, odd}}; }
  static Vector gather(const float* const* stream, std::size_t i) noexcept {
    return {{stream[0][i], stream[1][i], stream[2][i], stream[3][i], stream[4][i], stream[5][i], stream[3][i],
             stream[0][i]}};
  }
  static Vector sorted_last_two(float a, float b) noexcept {
    Vector sorted = all(0.0F);
    sorted.of[6] = a > b ? a : b;
    sorted.of[7] = a < b ? a : b;
    return sorted;
  }

  static Mask first(unsigned count) noexcept {
    return each([&](unsigned i) { return i < count ? -1.0F : 0.0F; });
  }
  static Mask first_and_seventh(unsigned count) noexcept {
    return each([&](unsigned i) { return i < count || i == 6 ? -1.0F : 0.0F; });
  }
  static Mask less_equal(const Vector& a, const Vector& b) noexcept {
    return each([&](unsigned i) { return a.of[i] <= b.of[i] ? -1.0F : 0.0F; });
  }
  static Mask both(const Mask& a, const Mask& b) noexcept {
    return each([&](unsigned i) { return is_negative(a.of[i]) && is_negative(b.of[i]) ? -1.0F : 0.0F; });
  }
  static unsigned signs(const Vector& a) noexcept {
    unsigned signs = 0;
    for (unsigned i = 0; i < 8; ++i) signs |= (bits(a.of[i]) >> 31U) << i;
    return signs;
  }
  static Vector choose(const Mask& mask, const Vector& a, const Vector& b) noexcept {
    return each([&](unsigned i) { return is_negative(mask.of[i]) ? a.of[i] : b.of[i]; });
  }

  static Vector with_seventh(const Vector& a, const Vector& b) noexcept {
    return each([&](unsigned i) { return i == 6 ? b.of[i] : a.of[i]; });
  }
  static Vector with_last_two(const Vector& a, const Vector& b) noexcept {
    return {{a.of[0], a.of[1], a.of[2], a.of[3], a.of[4], a.of[5], b.of[6], b.of[7]}};
  }
  static Order order(const void* from) noexcept {
    Order order;
    std::memcpy(order.from, from, sizeof order.from);
    return order;
  }
  static Vector permuted(const Vector& a, const Order& order) noexcept {
    return each([&](unsigned i) { return a.of[order.from[i]]; });
  }
  static Vector permuted(const Vector& a, const std::uint32_t (&from)[8]) noexcept {
    return each([&](unsigned i) { return a.of[from[i]]; });
  }

  static Vector add(const Vector& a, const Vector& b) noexcept {
    return each([&](unsigned i) { return a.of[i] + b.of[i]; });
  }
  static Vector subtract(const Vector& a, const Vector& b) noexcept {
    return each([&](unsigned i) { return a.of[i] - b.of[i]; });
  }
  static Vector multiply(const Vector& a, const Vector& b) noexcept {
    return each([&](unsigned i) { return a.of[i] * b.of[i]; });
  }
  static Vector divide(const Vector& a, const Vector& b) noexcept {
    return each([&](unsigned i) { return a.of[i] / b.of[i]; });
  }
  static Vector multiply_add(const Vector& a, const Vector& b, const Vector& c) noexcept {
    return each([&](unsigned i) { return a.of[i] * b.of[i] + c.of[i]; });
  }
  static Vector maximum(const Vector& a, const Vector& b) noexcept {
    return each([&](unsigned i) { return a.of[i] > b.of[i] ? a.of[i] : b.of[i]; });
  }
  static Vector magnitude(const Vector& a) noexcept {
    return each([&](unsigned i) { return fabsf(a.of[i]); });
  }
  static Vector minus_magnitude(const Vector& a) noexcept {
    return each([&](unsigned i) { return -fabsf(a.of[i]); });
  }
  static Vector negate_hi(const Vector& a) noexcept {
    return {{a.of[0], a.of[1], a.of[2], -a.of[3], -a.of[4], -a.of[5], a.of[6], a.of[7]}};
  }
  static Vector negate_unless(const Mask& mask, const Vector& a) noexcept {
    return each([&](unsigned i) { return is_negative(mask.of[i]) ? a.of[i] : -a.of[i]; });
  }
  static Vector infinite_if_nan(const Vector& a) noexcept {
    return each([&](unsigned i) { return a.of[i] == a.of[i] ? a.of[i] : INFINITY; });
  }
  static Vector minimum_of_bits(const Vector& a, const Vector& b) noexcept {
    return each([&](unsigned i) { return bits(a.of[i]) < bits(b.of[i]) ? a.of[i] : b.of[i]; });
  }
  static float sum_of_smallest(const Vector& a, const Vector& b) noexcept {
    const auto smaller = [](float x, float y) { return x < y ? x : y; };
    return folded(a, smaller) + folded(b, smaller);
  }
  static Three largest_of_three(const Vector& a, const Vector& b, const Vector& c) noexcept {
    const auto larger = [](float x, float y) { return x > y ? x : y; };
    return {{folded(a, larger), folded(b, larger), folded(c, larger)}};
  }
  static bool is_ordered(const Vector& faces) noexcept {
    return (faces.of[0] <= faces.of[3]) & (faces.of[1] <= faces.of[4]) & (faces.of[2] <= faces.of[5]);
  }

 private:
  static std::uint32_t bits(float a) noexcept { return __builtin_bit_cast(std::uint32_t, a); }
  static bool is_negative(float a) noexcept { return bits(a) >> 31U != 0; }
  template <class Lane>
  static Vector each(Lane lane) noexcept {
    Vector all;
    for (unsigned i = 0; i < 8; ++i) all.of[i] = lane(i);
    return all;
  }
  /// All lanes put together by one(x, y): halves, then pairs. In a row each would wait for the one before.
  template <class One>
  static float folded(const Vector& a, One one) noexcept {
    const float four[4] = {one(a.of[0], a.of[4]), one(a.of[1], a.of[5]), one(a.of[2], a.of[6]), one(a.of[3], a.of[7])};
    return one(one(four[0], four[2]), one(four[1], four[3]));
  }
};

/// FloatOperations on vectors of the compiler, of 4 or 8 floats.
template <class Set, unsigned lanes>
struct PortableFloats {
  static_assert(lanes == 4 || lanes == 8, "signs of four vectors are collected in the lanes of one");

  static constexpr unsigned width = lanes;
  using Vector = typename CompilerVector<float, width>::Type;
  using Mask = typename CompilerVector<std::int32_t, width>::Type;  // −1 or 0 in each lane
  using EightFloats = PortableEightFloats<Set>;

  static Vector load(const float* p) noexcept {
    Vector a;
    std::memcpy(&a, p, sizeof a);
    return a;
  }
  static void store(float* p, Vector a) noexcept { std::memcpy(p, &a, sizeof a); }
  static Vector gather(const float* p, const std::uint16_t* index) noexcept {
    Vector a{};
    for (unsigned i = 0; i < width; ++i) a[i] = p[index[i]];
    return a;
  }
  static void load_columns(const void* const (&rows)[width], Vector (&columns)[4]) noexcept {
    float row[width][4];
    for (unsigned i = 0; i < width; ++i) std::memcpy(row[i], rows[i], sizeof row[i]);
    for (unsigned c = 0; c < 4; ++c) {
      Vector column{};
      for (unsigned i = 0; i < width; ++i) column[i] = row[i][c];
      columns[c] = column;
    }
  }
  static void transpose(const Vector (&columns)[8], typename EightFloats::Vector (&transposed)[width]) noexcept {
    float column[8][width];
    for (unsigned c = 0; c < 8; ++c) store(column[c], columns[c]);
    for (unsigned i = 0; i < width; ++i) {
      for (unsigned c = 0; c < 8; ++c) transposed[i].of[c] = column[c][i];
    }
  }

  class FirstLanes {
   public:
    explicit FirstLanes(int count) noexcept : count_(count) {}

    [[nodiscard]] Vector load(const float* p) const noexcept {
      if (count_ >= static_cast<int>(width)) return PortableFloats::load(p);
      float lane[width] = {};
      for (int i = 0; i < count_; ++i) lane[i] = p[i];
      return PortableFloats::load(lane);
    }
    [[nodiscard]] Vector choose(Vector a, Vector b) const noexcept {
      return PortableFloats::choose(numbers() < Mask{} + count_, a, b);
    }

   private:
    int count_;
  };

  class Compressor {
   public:
    explicit Compressor(std::uint64_t bits) noexcept : bits_(bits) {}

    // Floats as integers, since they may be anything.
    void store(float* p, Vector a) const noexcept {
      std::uint32_t lane[width];
      std::memcpy(lane, &a, sizeof lane);
      for (unsigned i = 0; i < width; ++i) {
        std::memcpy(p, &lane[i], sizeof lane[i]);
        p += bits_ >> i & 1U;
      }
    }
    void store(std::uint32_t* p, const std::uint32_t* from) const noexcept {
      for (unsigned i = 0; i < width; ++i) {
        *p = from[i];
        p += bits_ >> i & 1U;
      }
    }
    void store(float* p, Vector a, std::size_t count) const noexcept {
      std::uint32_t lane[width];
      std::memcpy(lane, &a, sizeof lane);
      for (unsigned i = 0; i < width; ++i) {
        if ((bits_ >> i & 1U) == 0 || count == 0) continue;
        std::memcpy(p++, &lane[i], sizeof lane[i]);
        --count;
      }
    }

   private:
    std::uint64_t bits_;
  };

  static Vector all(float a) noexcept { return a - Vector{}; }  // not plus, which would make 0 of −0
  static Vector add(Vector a, Vector b) noexcept { return a + b; }
  static Vector subtract(Vector a, Vector b) noexcept { return a - b; }
  static Vector multiply(Vector a, Vector b) noexcept { return a * b; }
  static Vector divide(Vector a, Vector b) noexcept { return a / b; }
  static Vector square_root(Vector a) noexcept {
    for (unsigned i = 0; i < width; ++i) a[i] = sqrtf(a[i]);
    return a;
  }
  static Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return a * b + c; }
  static Vector minimum(Vector a, Vector b) noexcept { return a < b ? a : b; }
  static Vector maximum(Vector a, Vector b) noexcept { return a > b ? a : b; }
  static Vector minimum_of_computed(Vector a, Vector b) noexcept { return minimum(a, b); }
  static Vector maximum_of_computed(Vector a, Vector b) noexcept { return maximum(a, b); }
  static Vector maximum_of_bits(Vector a, Vector b) noexcept {
    using Unsigned = typename CompilerVector<std::uint32_t, width>::Type;
    return choose(__builtin_bit_cast(Unsigned, a) > __builtin_bit_cast(Unsigned, b), a, b);
  }
  static Vector magnitude(Vector a) noexcept { return floats(integers(a) & 0x7fffffff); }
  static Vector floor(Vector a) noexcept {
    // Numbers from 2²³ on are integers. Others are cut off, and one less where that is above them.
    const Mask has_fraction = magnitude(a) < all(0x1p23F);
    const Vector small = choose(has_fraction, a, Vector{});
    const Vector cut = converted<Vector>(converted<Mask>(small));
    return choose(has_fraction, cut - choose(small < cut, all(1.0F), Vector{}), a);
  }
  static Vector flip_sign(Vector a, Vector b) noexcept { return floats(integers(a) ^ integers(b)); }
  static float smallest(Vector a) noexcept {
    return folded(a, [](float x, float y) { return x < y ? x : y; });
  }
  static float largest(Vector a) noexcept {
    return folded(a, [](float x, float y) { return x > y ? x : y; });
  }

  static Mask less(Vector a, Vector b) noexcept { return a < b; }
  static Mask less_equal(Vector a, Vector b) noexcept { return a <= b; }
  static Mask both(Mask a, Mask b) noexcept { return a & b; }
  static Mask either(Mask a, Mask b) noexcept { return a | b; }
  static Vector choose(Mask mask, Vector a, Vector b) noexcept {
    return floats((integers(a) & mask) | (integers(b) & ~mask));
  }
  static std::uint64_t bits(Mask mask) noexcept { return joined(mask & bit_of_lane()); }
  static unsigned lowest_bit(std::uint64_t word) noexcept {
    return static_cast<unsigned>(trailing_zeros(word | std::uint64_t{1} << 63));
  }

  static Vector either_negative(Vector a, Vector b) noexcept { return choose(b < Vector{}, b, a); }
  static std::uint64_t signs(const Vector (&of)[4]) noexcept {
    Mask signs{};
    for (unsigned v = 0; v < 4; ++v) signs |= (integers(of[v]) < 0) & (bit_of_lane() << static_cast<int>(v * width));
    return joined(signs);
  }

  class SignCollector {
   public:
    explicit SignCollector(Vector limit) noexcept : limit_(integers(limit)) {}

    std::uint64_t collect(const Vector (&of)[4]) noexcept {
      for (const Vector& a : of) undecided_ |= (integers(a) >= 0) & (integers(a) <= limit_);
      return signs(of);
    }
    [[nodiscard]] bool any_undecided() const noexcept { return bits(undecided_) != 0; }

   private:
    Mask limit_;  // floats that are not negative compare as their bit patterns do
    Mask undecided_{};
  };

 private:
  static Mask integers(Vector a) noexcept { return __builtin_bit_cast(Mask, a); }
  static Vector floats(Mask a) noexcept { return __builtin_bit_cast(Vector, a); }
  static Mask numbers() noexcept {  // 0, 1, 2, …
    Mask lane{};
    for (unsigned i = 0; i < width; ++i) lane[i] = static_cast<std::int32_t>(i);
    return lane;
  }
  static Mask bit_of_lane() noexcept { return (Mask{} + 1) << numbers(); }
  /// All lanes of a vector, put together by a bitwise or.
  static std::uint64_t joined(Mask a) noexcept {
    std::uint64_t pair[width / 2];
    std::memcpy(pair, &a, sizeof pair);
    for (unsigned i = 1; i < width / 2; ++i) pair[0] |= pair[i];
    return (pair[0] | pair[0] >> 32U) & 0xffffffff;
  }
  /// All lanes put together by one(x, y).
  template <class One>
  static float folded(Vector a, One one) noexcept {
    float lane[width];
    store(lane, a);
    for (unsigned half = width / 2; half != 0; half /= 2) {
      for (unsigned i = 0; i < half; ++i) lane[i] = one(lane[i], lane[i + half]);
    }
    return lane[0];
  }
};

}  // namespace shaftcull::kernel
