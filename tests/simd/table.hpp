// SPDX-License-Identifier: MIT
/// The operations of an instruction set as functions on arrays. The tests are compiled once, for any processor, and
/// call these, which are compiled for each set with its flags (set.cpp).
#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/operations.hpp"

namespace shaftcull::simd_test {

/// Vectors of floats are `width` floats in memory; masks are made by comparing, and are read as bits.
struct FloatTable {
  using Unary = void(const float* a, float* out) noexcept;
  using Binary = void(const float* a, const float* b, float* out) noexcept;
  using Ternary = void(const float* a, const float* b, const float* c, float* out) noexcept;
  using Comparison = std::uint64_t(const float* a, const float* b) noexcept;

  unsigned width;
  Unary* load_and_store;
  Unary* square_root;
  Unary* magnitude;
  Unary* floor;
  Binary* add;
  Binary* subtract;
  Binary* multiply;
  Binary* divide;
  Binary* minimum;
  Binary* maximum;
  Binary* minimum_of_computed;
  Binary* maximum_of_computed;
  Binary* maximum_of_bits;
  Binary* flip_sign;
  Binary* either_negative;
  Ternary* multiply_add;
  void (*all)(float a, float* out) noexcept;
  float (*smallest)(const float* a) noexcept;
  float (*largest)(const float* a) noexcept;
  Comparison* less;
  Comparison* less_equal;
  /// Of a < b and c < d.
  std::uint64_t (*both)(const float* a, const float* b, const float* c, const float* d) noexcept;
  std::uint64_t (*either)(const float* a, const float* b, const float* c, const float* d) noexcept;
  /// c where a < b, else d.
  void (*choose)(const float* a, const float* b, const float* c, const float* d, float* out) noexcept;
  unsigned (*lowest_bit)(std::uint64_t word) noexcept;
  void (*gather)(const float* from, const std::uint16_t* index, float* out) noexcept;
  /// `width` rows of four floats to four columns of `width`.
  void (*load_columns)(const float* rows, float* columns) noexcept;
  /// Eight columns of `width` floats to `width` rows of eight.
  void (*transpose)(const float* columns, float* rows) noexcept;
  void (*load_first)(int count, const float* from, float* out) noexcept;
  void (*choose_first)(int count, const float* a, const float* b, float* out) noexcept;
  void (*compress)(std::uint64_t bits, const float* a, float* out) noexcept;
  void (*compress_some)(std::uint64_t bits, const float* a, std::size_t count, float* out) noexcept;
  void (*compress_integers)(std::uint64_t bits, const std::uint32_t* a, std::uint32_t* out) noexcept;
  std::uint64_t (*signs)(const float* four) noexcept;
  /// Collects two times four vectors; says whether any lane was undecided.
  bool (*collect)(float limit, const float* eight, std::uint64_t* yes) noexcept;
};

struct EightFloatTable {
  using Unary = void(const float* a, float* out) noexcept;
  using Binary = void(const float* a, const float* b, float* out) noexcept;

  void (*all)(float a, float* out) noexcept;
  Unary* load_and_store;
  Unary* load_faces;
  void (*load_six)(const float* from, float rest, float* out) noexcept;
  Unary* first_in_all;
  float (*first)(const float* a) noexcept;
  void (*pair_in_all)(float even, float odd, float* out) noexcept;
  void (*gather)(const float* const* stream, std::size_t i, float* out) noexcept;
  void (*sorted_last_two)(float a, float b, float* out) noexcept;
  unsigned (*first_lanes)(unsigned count) noexcept;
  unsigned (*first_and_seventh)(unsigned count) noexcept;
  unsigned (*less_equal)(const float* a, const float* b) noexcept;
  unsigned (*both)(const float* a, const float* b) noexcept;
  unsigned (*signs)(const float* a) noexcept;
  void (*choose)(const float* mask, const float* a, const float* b, float* out) noexcept;
  Binary* with_seventh;
  Binary* with_last_two;
  void (*permuted_by_order)(const float* a, const std::uint8_t* from, float* out) noexcept;
  void (*permuted)(const float* a, const std::uint32_t (&from)[8], float* out) noexcept;
  Binary* add;
  Binary* subtract;
  Binary* multiply;
  Binary* divide;
  Binary* maximum;
  Binary* minimum_of_bits;
  Binary* negate_unless;
  void (*multiply_add)(const float* a, const float* b, const float* c, float* out) noexcept;
  Unary* magnitude;
  Unary* minus_magnitude;
  Unary* negate_hi;
  Unary* infinite_if_nan;
  float (*sum_of_smallest)(const float* a, const float* b) noexcept;
  void (*largest_of_three)(const float* a, const float* b, const float* c, float* out) noexcept;
  bool (*is_ordered)(const float* box) noexcept;
};

/// Vectors are `width` integers in memory, aligned to 64 bytes. Sets without them have null pointers.
struct Integer16Table {
  using Binary = void(const std::int16_t* a, const std::int16_t* b, std::int16_t* out) noexcept;

  unsigned width;
  void (*all)(std::int16_t a, std::int16_t* out) noexcept;
  Binary* add;
  Binary* subtract;
  Binary* minimum;
  Binary* maximum;
  Binary* subtract_saturated;
  Binary* multiply;
  /// store_rounded() of a word, whose integers outcomes() then reads. `out` gets them as they lie in memory.
  kernel::Outcomes (*round_and_read)(const float* word, std::int16_t least, std::uint8_t limit,
                                     std::int16_t* out) noexcept;
};

struct Table {
  FloatTable floats;
  EightFloatTable eight;
  Integer16Table integers;
};

}  // namespace shaftcull::simd_test
