// SPDX-License-Identifier: MIT
/// The operations that kernels are written with: what an instruction set must provide.
///
/// A set is a header in this folder and a namespace, shaftcull::kernel::<set>, with
///
///     Floats         vectors of floats, one bound or pair of boxes a lane      FloatOperations
///     EightFloats    eight floats of one thing: a box, a shaft's constraints   EightFloatOperations
///     Integers16     vectors of 16-bit integers, for tests on a grid           Integer16Operations, if the set has
///     them
///
/// A kernel is a template on Floats, which names the other two. portable.hpp has every operation on floats in plain
/// C++: a new set starts from it and replaces what its processor does better. tests/simd checks every operation of
/// every set.
///
/// What holds of all of them:
/// - Arithmetic is IEEE 754 single precision, rounded to nearest, ties to even. Each operation rounds once;
///   multiply_add() alone may round twice. Nothing is reassociated.
/// - Comparisons are false where an operand is NaN. −0 equals 0. Denormals count.
/// - An operation never branches on what lanes hold, and no lane's result depends on another lane.
/// - Memory need not be aligned, unless it says so. Nothing is read or written but what is named.
/// - Functions are static, noexcept and inline, with internal state nowhere.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>

namespace shaftcull::kernel {

/// Eight floats of one thing: faces of a box, constraints or planes of a shaft. One shaft is formed with them, and
/// where they are one register, single boxes are tested with them.
template <class E>
concept EightFloatOperations = requires(typename E::Vector a, typename E::Mask mask, typename E::Order order,
                                        const float* from, const void* row, void* to, const float* const* stream,
                                        std::size_t i, const std::uint32_t (&lanes)[8], float x, unsigned count) {
  /// Whether the eight are one register: only then tests of single boxes gain by them.
  requires std::same_as<decltype(E::in_one_register), const bool>;

  { E::all(x) } -> std::same_as<typename E::Vector>;
  { E::load(row) } -> std::same_as<typename E::Vector>;  // 32 bytes of any object: eight floats
  /// Six floats, and x in lanes 6 and 7.
  { E::load_six(from, x) } -> std::same_as<typename E::Vector>;
  /// The six floats of a box; the last two once more in lanes 6 and 7.
  { E::load_faces(row) } -> std::same_as<typename E::Vector>;
  { E::store(to, a) } -> std::same_as<void>;  // onto 32 bytes of any object
  { E::first_in_all(a) } -> std::same_as<typename E::Vector>;
  { E::first(a) } -> std::same_as<float>;
  /// The first float in even lanes, the second in odd ones.
  { E::pair_in_all(x, x) } -> std::same_as<typename E::Vector>;
  /// stream[s][i] in lane s of the first six; stream[3][i] once more in lane 6, and stream[0][i] in lane 7.
  { E::gather(stream, i) } -> std::same_as<typename E::Vector>;
  /// The larger one in lane 6, the smaller one in lane 7; anything elsewhere. Not for NaN.
  { E::sorted_last_two(x, x) } -> std::same_as<typename E::Vector>;

  // Of a mask only the signs of lanes count: negative lanes are meant, −0 and NaN by their sign bits. So a vector
  // of floats is a mask, too.
  { E::first(count) } -> std::same_as<typename E::Mask>;              // lanes 0 … count − 1
  { E::first_and_seventh(count) } -> std::same_as<typename E::Mask>;  // likewise, count ≤ 6, and lane 6
  { E::less_equal(a, a) } -> std::same_as<typename E::Mask>;
  { E::both(mask, mask) } -> std::same_as<typename E::Mask>;
  { E::both(mask, a) } -> std::same_as<typename E::Mask>;
  { E::signs(a) } -> std::same_as<unsigned>;  // bit i is the sign bit of lane i
  { E::choose(mask, a, a) } -> std::same_as<typename E::Vector>;

  { E::with_seventh(a, a) } -> std::same_as<typename E::Vector>;   // the first, with lane 6 of the second
  { E::with_last_two(a, a) } -> std::same_as<typename E::Vector>;  // the first, with lanes 6 and 7 of the second
  /// Lane i of the result is lane lanes[i] < 8 of a; an order is made of eight bytes of any object.
  { E::order(row) } -> std::same_as<typename E::Order>;
  { E::permuted(a, order) } -> std::same_as<typename E::Vector>;
  { E::permuted(a, lanes) } -> std::same_as<typename E::Vector>;

  { E::add(a, a) } -> std::same_as<typename E::Vector>;
  { E::subtract(a, a) } -> std::same_as<typename E::Vector>;
  { E::multiply(a, a) } -> std::same_as<typename E::Vector>;
  { E::divide(a, a) } -> std::same_as<typename E::Vector>;
  { E::multiply_add(a, a, a) } -> std::same_as<typename E::Vector>;  // as of Floats
  { E::maximum(a, a) } -> std::same_as<typename E::Vector>;          // likewise
  { E::magnitude(a) } -> std::same_as<typename E::Vector>;           // the sign bit is cleared
  { E::minus_magnitude(a) } -> std::same_as<typename E::Vector>;     // the sign bit is set
  { E::negate_hi(a) } -> std::same_as<typename E::Vector>;           // lanes 3 to 5 are negated
  { E::negate_unless(mask, a) } -> std::same_as<typename E::Vector>;
  { E::infinite_if_nan(a) } -> std::same_as<typename E::Vector>;  // +∞ in place of NaN
  /// The smaller of the bit patterns, as unsigned integers: negative floats are above all others.
  { E::minimum_of_bits(a, a) } -> std::same_as<typename E::Vector>;
  /// The smallest lane of the first + the smallest lane of the second. Not for NaN.
  { E::sum_of_smallest(a, a) } -> std::same_as<float>;
  /// The largest lane of each. Where a lane is NaN, that one is anything.
  { E::largest_of_three(a, a, a).of[2] } -> std::convertible_to<float>;
  /// Whether no lo face of load_faces() is above the hi face of its axis, and none is NaN.
  { E::is_ordered(a) } -> std::same_as<bool>;
};

/// Vectors of `width` floats.
template <class F>
concept FloatOperations = EightFloatOperations<typename F::EightFloats> &&
    requires(typename F::Vector a, typename F::Mask mask, const float* from, float* to, const std::uint16_t* index,
             const std::uint32_t* integers, std::uint32_t* packed, const void* const (&rows)[F::width],
             typename F::Vector (&four)[4], const typename F::Vector (&eight)[8],
             typename F::EightFloats::Vector (&transposed)[F::width], float x, std::uint64_t bits, std::size_t count,
             int lanes, typename F::SignCollector& collector) {
  /// 1, 4, 8 or 16: a divisor of 64.
  requires std::same_as<decltype(F::width), const unsigned> && 64 % F::width == 0;

  { F::load(from) } -> std::same_as<typename F::Vector>;
  { F::store(to, a) } -> std::same_as<void>;
  /// from[index[i]] in lane i.
  { F::gather(from, index) } -> std::same_as<typename F::Vector>;
  /// Reads four floats, 16 bytes of any object, at each of `rows`: lane i of four[c] is float c at rows[i].
  { F::load_columns(rows, four) } -> std::same_as<void>;
  /// Lane i of the eight vectors becomes transposed[i].
  { F::transpose(eight, transposed) } -> std::same_as<void>;

  /// The first `lanes` lanes: none if that is negative, all if it is `width` or more. load(p) reads p[i] for those
  /// lanes alone, and gives 0 in the others; choose(a, b) gives b in the others.
  { typename F::FirstLanes(lanes).load(from) } -> std::same_as<typename F::Vector>;
  { typename F::FirstLanes(lanes).choose(a, a) } -> std::same_as<typename F::Vector>;

  /// The lanes whose bits are set, side by side and in order. store(p, a) writes a whole vector: them, and anything
  /// behind them. store(p, a, n) writes the first n < width of them and nothing else. store(p, q) does with the
  /// integers at q, `width` of them, what store(p, load(q)) does with floats.
  { typename F::Compressor(bits).store(to, a) } -> std::same_as<void>;
  { typename F::Compressor(bits).store(to, a, count) } -> std::same_as<void>;
  { typename F::Compressor(bits).store(packed, integers) } -> std::same_as<void>;

  { F::all(x) } -> std::same_as<typename F::Vector>;
  { F::add(a, a) } -> std::same_as<typename F::Vector>;
  { F::subtract(a, a) } -> std::same_as<typename F::Vector>;
  { F::multiply(a, a) } -> std::same_as<typename F::Vector>;
  { F::divide(a, a) } -> std::same_as<typename F::Vector>;
  { F::square_root(a) } -> std::same_as<typename F::Vector>;
  /// The first times the second, plus the third: rounded once or twice. Error margins allow for both.
  { F::multiply_add(a, a, a) } -> std::same_as<typename F::Vector>;
  /// a < b ? a : b, and a > b ? a : b: the second operand if either is NaN or both are equal. So a NaN in the first
  /// one is passed over.
  { F::minimum(a, a) } -> std::same_as<typename F::Vector>;
  { F::maximum(a, a) } -> std::same_as<typename F::Vector>;
  /// As minimum() and maximum(), but of zeros either. The first is a number, or a NaN that arithmetic has made and so
  /// is no signalling one; the second is a number. Some processors have an instruction for these alone.
  { F::minimum_of_computed(a, a) } -> std::same_as<typename F::Vector>;
  { F::maximum_of_computed(a, a) } -> std::same_as<typename F::Vector>;
  /// The larger of the bit patterns, as unsigned integers: negative floats are above all others.
  { F::maximum_of_bits(a, a) } -> std::same_as<typename F::Vector>;
  { F::magnitude(a) } -> std::same_as<typename F::Vector>;  // the sign bit is cleared
  { F::floor(a) } -> std::same_as<typename F::Vector>;      // of numbers; of −0 and what rounds to it, either zero
  /// The first, negated where the sign bit of the second is set. The second is ±0.
  { F::flip_sign(a, a) } -> std::same_as<typename F::Vector>;
  /// The smallest and the largest lane. Not for NaN; of zeros, either.
  { F::smallest(a) } -> std::same_as<float>;
  { F::largest(a) } -> std::same_as<float>;

  { F::less(a, a) } -> std::same_as<typename F::Mask>;
  { F::less_equal(a, a) } -> std::same_as<typename F::Mask>;
  { F::both(mask, mask) } -> std::same_as<typename F::Mask>;
  { F::either(mask, mask) } -> std::same_as<typename F::Mask>;
  { F::choose(mask, a, a) } -> std::same_as<typename F::Vector>;
  /// Bit i is lane i; bits from `width` on are 0.
  { F::bits(mask) } -> std::same_as<std::uint64_t>;
  /// Position of the lowest bit that is set; 63 or 64 if none is.
  { F::lowest_bit(bits) } -> std::same_as<unsigned>;

  /// A vector that is negative exactly where the first is negative or the second is below 0. The first is neither −0
  /// nor NaN; of the second, neither counts as below 0.
  { F::either_negative(a, a) } -> std::same_as<typename F::Vector>;
  /// Bit i says whether lane i of four vectors side by side is negative. No lane is −0 or NaN.
  { F::signs(four) } -> std::same_as<std::uint64_t>;
  /// Reads outcomes from signs: a negative float is a yes, one above the limit a no, and one from 0 to the limit
  /// undecided. collect() gives the yeses of four vectors side by side, as signs() does, and any_undecided() says
  /// whether any lane of any of those vectors was undecided. The limit is positive; no lane is −0 or NaN.
  { typename F::SignCollector(a).collect(four) } -> std::same_as<std::uint64_t>;
  { collector.any_undecided() } -> std::same_as<bool>;
};

/// Vectors of 16-bit integers, 2 · Floats::width wide, in words of 64. A set that lacks them tests on no grid. In which
/// order a word's integers lie in memory is the set's own affair: store_rounded() and outcomes() know it.
template <class I>
concept Integer16Operations = requires(typename I::Vector a, std::int16_t x, const std::int16_t* from, std::int16_t* to,
                                       const typename I::Floats::Vector (&floats)[64 / I::Floats::width],
                                       const typename I::Vector (&word)[I::vectors]) {
  requires I::width == 2 * I::Floats::width&& I::vectors == 64 / I::width;

  /// How many shafts, and tests, it takes for a grid to be quicker than floats (docs/measurements.md).
  requires I::fewest_shafts_on_grid >
  0 && I::fewest_tests_on_grid > 0;

  { I::load(from) } -> std::same_as<typename I::Vector>;  // aligned to the vector's size
  { I::all(x) } -> std::same_as<typename I::Vector>;
  { I::add(a, a) } -> std::same_as<typename I::Vector>;       // what does not fit wraps around
  { I::subtract(a, a) } -> std::same_as<typename I::Vector>;  // likewise
  { I::minimum(a, a) } -> std::same_as<typename I::Vector>;
  { I::maximum(a, a) } -> std::same_as<typename I::Vector>;
  /// The difference, or the nearest to it that fits.
  { I::subtract_saturated(a, a) } -> std::same_as<typename I::Vector>;
  /// The product / 2¹⁵, rounded to nearest, ties upwards. Not for −2¹⁵ times itself.
  { I::multiply(a, a) } -> std::same_as<typename I::Vector>;
  /// Writes a word of floats, none above 2¹⁵ − 1, as their nearest integers, ties to even. Those below `least`, which
  /// is the same in all lanes, become `least`, and so does NaN. `to` is aligned to 64 bytes.
  { I::store_rounded(to, floats, a) } -> std::same_as<void>;
  /// Of a word, in the order in which it was before store_rounded(): a negative integer is a yes, one above a limit a
  /// no, and one in between undecided. The limit, at most 126, is in every byte. `undecided` holds all undecided
  /// lanes, and maybe others, but none if there is none.
  { I::outcomes(word, a).yes } -> std::convertible_to<std::uint64_t>;
  { I::outcomes(word, a).undecided } -> std::convertible_to<std::uint64_t>;
};

/// A word of 16-bit integers, read by outcomes().
struct Outcomes {
  std::uint64_t yes;
  std::uint64_t undecided;
};

}  // namespace shaftcull::kernel
