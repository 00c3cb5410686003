/// One float as a vector of width 1, with the interface of Lanes: the scalar path, on any processor.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shaftcull::kernel {

struct ScalarLanes {
  using Vector = float;
  using Mask = bool;
  static constexpr unsigned width = 1;

  static Vector load(const float* p) noexcept { return *p; }
  static Vector gather(const float* p, const std::uint16_t* index) noexcept { return p[*index]; }
  static void load_fours(const float* const (&at)[1], Vector (&columns)[4]) noexcept {
    for (unsigned c = 0; c < 4; ++c) columns[c] = at[0][c];
  }
  static void store(float* p, Vector a) noexcept { *p = a; }

  /// As kernel::Part.
  class Part {
   public:
    explicit Part(int count) noexcept : is_there_(count > 0) {}
    [[nodiscard]] Vector load(const float* p) const noexcept { return is_there_ ? *p : 0.0F; }
    [[nodiscard]] Vector choose(Vector a, Vector b) const noexcept { return is_there_ ? a : b; }

   private:
    bool is_there_;
  };
  class Packing {
   public:
    explicit Packing(std::uint64_t /*lanes*/) noexcept {}
    void store(float* p, Vector a) const noexcept { *p = a; }
    void store(float* /*p*/, Vector /*a*/, std::size_t /*count*/) const noexcept {}
  };
  static Vector all(float a) noexcept { return a; }
  static Vector add(Vector a, Vector b) noexcept { return a + b; }
  static Vector subtract(Vector a, Vector b) noexcept { return a - b; }
  static Vector multiply(Vector a, Vector b) noexcept { return a * b; }
  static Vector divide(Vector a, Vector b) noexcept { return a / b; }
  static Vector square_root(Vector a) noexcept { return __builtin_sqrtf(a); }
  static Vector minimum(Vector a, Vector b) noexcept { return a < b ? a : b; }
  static Vector maximum(Vector a, Vector b) noexcept { return a > b ? a : b; }
  static float smallest(Vector a) noexcept { return a; }
  static float largest(Vector a) noexcept { return a; }
  static Vector magnitude(Vector a) noexcept { return __builtin_fabsf(a); }
  static Mask less(Vector a, Vector b) noexcept { return a < b; }
  static Mask less_equal(Vector a, Vector b) noexcept { return a <= b; }
  static Vector choose(Mask mask, Vector a, Vector b) noexcept { return mask ? a : b; }
  static Mask both(Mask a, Mask b) noexcept { return a && b; }
  static Mask either(Mask a, Mask b) noexcept { return a || b; }
  static Vector multiply_add(Vector a, Vector b, Vector c) noexcept { return a * b + c; }
  static Vector flip_sign(Vector a, Vector b) noexcept { return __builtin_signbitf(b) ? -a : a; }
  static Vector either_negative(Vector a, Vector b) noexcept { return b < 0 ? b : a; }
  static std::uint64_t signs(const Vector (&of)[4]) noexcept {
    std::uint64_t signs = 0;
    for (unsigned v = 4; v-- != 0;)
      signs = 2 * signs + (of[v] < 0 ? 1U : 0U);  // g++ 12 miscompiles shifts by v under UBSan
    return signs;
  }

  /// As in Lanes.
  class Verdicts {
   public:
    explicit Verdicts(Vector limit) noexcept : limit_(limit) {}
    std::uint64_t read(const Vector (&of)[4]) noexcept {
      for (const Vector a : of) undecided_ |= (a >= 0) & (a <= limit_);
      return signs(of);
    }
    [[nodiscard]] bool any_undecided() const noexcept { return undecided_; }

   private:
    Vector limit_;
    bool undecided_ = false;
  };
  struct Row {
    float of[8];
  };
  static void transpose(const Vector (&columns)[8], Row (&rows)[1]) noexcept {
    for (unsigned c = 0; c < 8; ++c) rows[0].of[c] = columns[c];
  }
  static Row permuted(const Row& row, const std::uint32_t (&order)[8]) noexcept {
    Row permuted;
    for (unsigned i = 0; i < 8; ++i) permuted.of[i] = row.of[order[i]];
    return permuted;
  }
  static void store_row(const Row& row, void* out) noexcept { __builtin_memcpy(out, row.of, sizeof row.of); }
  static unsigned row_signs(const Row& row) noexcept {
    unsigned signs = 0;
    for (unsigned i = 0; i < 8; ++i) signs |= (__builtin_signbitf(row.of[i]) != 0 ? 1U : 0U) << i;
    return signs;
  }
  static Vector maximum_of_bits(Vector a, Vector b) noexcept {
    return __builtin_bit_cast(std::uint32_t, a) > __builtin_bit_cast(std::uint32_t, b) ? a : b;
  }
  static std::uint64_t bits(Mask mask) noexcept { return mask; }
};

}  // namespace shaftcull::kernel
