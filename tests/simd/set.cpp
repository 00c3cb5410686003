// SPDX-License-Identifier: MIT
// The operations of one instruction set: SHAFTCULL_SET is its namespace, SHAFTCULL_SET_HEADER its header. As in the
// library's units, every function is a template on the set, and nothing of the standard library is called
// (kernel/kernels/README.md).
#include SHAFTCULL_SET_HEADER

#include "simd/portable.hpp"
#include "simd/table.hpp"

namespace shaftcull::simd_test {
namespace {

template <class F, auto one>
void unary(const float* a, float* out) noexcept {
  F::store(out, one(F::load(a)));
}
template <class F, auto one>
void binary(const float* a, const float* b, float* out) noexcept {
  F::store(out, one(F::load(a), F::load(b)));
}

template <class F>
void store_columns(const typename F::Vector* from, unsigned count, float* out) noexcept {
  for (unsigned c = 0; c < count; ++c) F::store(out + c * F::width, from[c]);
}
template <class F, unsigned count>
void load_columns(const float* from, typename F::Vector (&to)[count]) noexcept {
  for (unsigned c = 0; c < count; ++c) to[c] = F::load(from + c * F::width);
}

template <class F>
constexpr FloatTable float_table() noexcept {
  using V = typename F::Vector;
  using E = typename F::EightFloats;
  return {
      .width = F::width,
      .load_and_store = unary<F, [](V a) { return a; }>,
      .square_root = unary<F, [](V a) { return F::square_root(a); }>,
      .magnitude = unary<F, [](V a) { return F::magnitude(a); }>,
      .floor = unary<F, [](V a) { return F::floor(a); }>,
      .add = binary<F, [](V a, V b) { return F::add(a, b); }>,
      .subtract = binary<F, [](V a, V b) { return F::subtract(a, b); }>,
      .multiply = binary<F, [](V a, V b) { return F::multiply(a, b); }>,
      .divide = binary<F, [](V a, V b) { return F::divide(a, b); }>,
      .minimum = binary<F, [](V a, V b) { return F::minimum(a, b); }>,
      .maximum = binary<F, [](V a, V b) { return F::maximum(a, b); }>,
      .minimum_of_computed = binary<F, [](V a, V b) { return F::minimum_of_computed(a, b); }>,
      .maximum_of_computed = binary<F, [](V a, V b) { return F::maximum_of_computed(a, b); }>,
      .maximum_of_bits = binary<F, [](V a, V b) { return F::maximum_of_bits(a, b); }>,
      .flip_sign = binary<F, [](V a, V b) { return F::flip_sign(a, b); }>,
      .either_negative = binary<F, [](V a, V b) { return F::either_negative(a, b); }>,
      .multiply_add = [](const float* a, const float* b, const float* c,
                         float* out) noexcept { F::store(out, F::multiply_add(F::load(a), F::load(b), F::load(c))); },
      .all = [](float a, float* out) noexcept { F::store(out, F::all(a)); },
      .smallest = [](const float* a) noexcept { return F::smallest(F::load(a)); },
      .largest = [](const float* a) noexcept { return F::largest(F::load(a)); },
      .less = [](const float* a, const float* b) noexcept { return F::bits(F::less(F::load(a), F::load(b))); },
      .less_equal = [](const float* a,
                       const float* b) noexcept { return F::bits(F::less_equal(F::load(a), F::load(b))); },
      .both =
          [](const float* a, const float* b, const float* c, const float* d) noexcept {
            return F::bits(F::both(F::less(F::load(a), F::load(b)), F::less(F::load(c), F::load(d))));
          },
      .either =
          [](const float* a, const float* b, const float* c, const float* d) noexcept {
            return F::bits(F::either(F::less(F::load(a), F::load(b)), F::less(F::load(c), F::load(d))));
          },
      .choose =
          [](const float* a, const float* b, const float* c, const float* d, float* out) noexcept {
            F::store(out, F::choose(F::less(F::load(a), F::load(b)), F::load(c), F::load(d)));
          },
      .lowest_bit = [](std::uint64_t word) noexcept { return F::lowest_bit(word); },
      .gather = [](const float* from, const std::uint16_t* index,
                   float* out) noexcept { F::store(out, F::gather(from, index)); },
      .load_columns =
          [](const float* rows, float* columns) noexcept {
            const void* at[F::width];
            for (unsigned i = 0; i < F::width; ++i) at[i] = rows + 4 * i;
            V column[4];
            F::load_columns(at, column);
            store_columns<F>(column, 4, columns);
          },
      .transpose =
          [](const float* columns, float* rows) noexcept {
            V column[8];
            load_columns<F>(columns, column);
            typename E::Vector row[F::width];
            F::transpose(column, row);
            for (unsigned i = 0; i < F::width; ++i) E::store(rows + 8 * i, row[i]);
          },
      .load_first = [](int count, const float* from,
                       float* out) noexcept { F::store(out, typename F::FirstLanes(count).load(from)); },
      .choose_first =
          [](int count, const float* a, const float* b, float* out) noexcept {
            F::store(out, typename F::FirstLanes(count).choose(F::load(a), F::load(b)));
          },
      .compress = [](std::uint64_t bits, const float* a,
                     float* out) noexcept { typename F::Compressor(bits).store(out, F::load(a)); },
      .compress_some = [](std::uint64_t bits, const float* a, std::size_t count,
                          float* out) noexcept { typename F::Compressor(bits).store(out, F::load(a), count); },
      .compress_integers = [](std::uint64_t bits, const std::uint32_t* a,
                              std::uint32_t* out) noexcept { typename F::Compressor(bits).store(out, a); },
      .signs =
          [](const float* four) noexcept {
            V vector[4];
            load_columns<F>(four, vector);
            return F::signs(vector);
          },
      .collect =
          [](float limit, const float* eight, std::uint64_t* yes) noexcept {
            typename F::SignCollector collector(F::all(limit));
            for (unsigned i = 0; i < 2; ++i) {
              V vector[4];
              load_columns<F>(eight + i * 4 * F::width, vector);
              yes[i] = collector.collect(vector);
            }
            return collector.any_undecided();
          },
  };
}

template <class E>
constexpr EightFloatTable eight_float_table() noexcept {
  using V = typename E::Vector;
  return {
      .all = [](float a, float* out) noexcept { E::store(out, E::all(a)); },
      .load_and_store = unary<E, [](V a) { return a; }>,
      .load_faces = [](const float* a, float* out) noexcept { E::store(out, E::load_faces(a)); },
      .load_six = [](const float* a, float rest, float* out) noexcept { E::store(out, E::load_six(a, rest)); },
      .first_in_all = unary<E, [](V a) { return E::first_in_all(a); }>,
      .first = [](const float* a) noexcept { return E::first(E::load(a)); },
      .pair_in_all = [](float even, float odd, float* out) noexcept { E::store(out, E::pair_in_all(even, odd)); },
      .gather = [](const float* const* stream, std::size_t i,
                   float* out) noexcept { E::store(out, E::gather(stream, i)); },
      .sorted_last_two = [](float a, float b, float* out) noexcept { E::store(out, E::sorted_last_two(a, b)); },
      .first_lanes = [](unsigned count) noexcept { return E::signs(E::first(count)); },
      .first_and_seventh = [](unsigned count) noexcept { return E::signs(E::first_and_seventh(count)); },
      .less_equal = [](const float* a,
                       const float* b) noexcept { return E::signs(E::less_equal(E::load(a), E::load(b))); },
      .both = [](const float* a, const float* b) noexcept { return E::signs(E::both(E::load(a), E::load(b))); },
      .signs = [](const float* a) noexcept { return E::signs(E::load(a)); },
      .choose = [](const float* mask, const float* a, const float* b,
                   float* out) noexcept { E::store(out, E::choose(E::load(mask), E::load(a), E::load(b))); },
      .with_seventh = binary<E, [](V a, V b) { return E::with_seventh(a, b); }>,
      .with_last_two = binary<E, [](V a, V b) { return E::with_last_two(a, b); }>,
      .permuted_by_order = [](const float* a, const std::uint8_t* from,
                              float* out) noexcept { E::store(out, E::permuted(E::load(a), E::order(from))); },
      .permuted = [](const float* a, const std::uint32_t(&from)[8],
                     float* out) noexcept { E::store(out, E::permuted(E::load(a), from)); },
      .add = binary<E, [](V a, V b) { return E::add(a, b); }>,
      .subtract = binary<E, [](V a, V b) { return E::subtract(a, b); }>,
      .multiply = binary<E, [](V a, V b) { return E::multiply(a, b); }>,
      .divide = binary<E, [](V a, V b) { return E::divide(a, b); }>,
      .maximum = binary<E, [](V a, V b) { return E::maximum(a, b); }>,
      .minimum_of_bits = binary<E, [](V a, V b) { return E::minimum_of_bits(a, b); }>,
      .negate_unless = binary<E, [](V mask, V a) { return E::negate_unless(mask, a); }>,
      .multiply_add = [](const float* a, const float* b, const float* c,
                         float* out) noexcept { E::store(out, E::multiply_add(E::load(a), E::load(b), E::load(c))); },
      .magnitude = unary<E, [](V a) { return E::magnitude(a); }>,
      .minus_magnitude = unary<E, [](V a) { return E::minus_magnitude(a); }>,
      .negate_hi = unary<E, [](V a) { return E::negate_hi(a); }>,
      .infinite_if_nan = unary<E, [](V a) { return E::infinite_if_nan(a); }>,
      .sum_of_smallest = [](const float* a,
                            const float* b) noexcept { return E::sum_of_smallest(E::load(a), E::load(b)); },
      .largest_of_three =
          [](const float* a, const float* b, const float* c, float* out) noexcept {
            const auto largest = E::largest_of_three(E::load(a), E::load(b), E::load(c));
            for (unsigned i = 0; i < 3; ++i) out[i] = largest.of[i];
          },
      .is_ordered = [](const float* box) noexcept { return E::is_ordered(E::load_faces(box)); },
  };
}

template <class I, auto one>
void binary16(const std::int16_t* a, const std::int16_t* b, std::int16_t* out) noexcept {
  const typename I::Vector result = one(I::load(a), I::load(b));
  __builtin_memcpy(out, &result, sizeof result);
}

template <class I>
constexpr Integer16Table integer16_table() noexcept {
  using V = typename I::Vector;
  using F = typename I::Floats;
  return {
      .width = I::width,
      .all =
          [](std::int16_t a, std::int16_t* out) noexcept {
            const V result = I::all(a);
            __builtin_memcpy(out, &result, sizeof result);
          },
      .add = binary16<I, [](V a, V b) { return I::add(a, b); }>,
      .subtract = binary16<I, [](V a, V b) { return I::subtract(a, b); }>,
      .minimum = binary16<I, [](V a, V b) { return I::minimum(a, b); }>,
      .maximum = binary16<I, [](V a, V b) { return I::maximum(a, b); }>,
      .subtract_saturated = binary16<I, [](V a, V b) { return I::subtract_saturated(a, b); }>,
      .multiply = binary16<I, [](V a, V b) { return I::multiply(a, b); }>,
      .round_and_read =
          [](const float* word, std::int16_t least, std::uint8_t limit, std::int16_t* out) noexcept {
            typename F::Vector floats[64 / F::width];
            load_columns<F>(word, floats);
            I::store_rounded(out, floats, I::all(least));
            V integers[I::vectors];
            for (unsigned v = 0; v < I::vectors; ++v) integers[v] = I::load(out + v * I::width);
            return I::outcomes(integers, I::all(static_cast<std::int16_t>(limit * 0x0101)));
          },
  };
}

template <class F>
constexpr Integer16Table integers_of() noexcept {
  if constexpr (requires { typename F::Integers16; }) {
    return integer16_table<typename F::Integers16>();
  } else {
    return {};
  }
}

}  // namespace

namespace SHAFTCULL_SET {

using Floats = kernel::SHAFTCULL_SET::Floats;

extern const Table table;
constinit const Table table = {float_table<Floats>(), eight_float_table<typename Floats::EightFloats>(),
                               integers_of<Floats>()};

}  // namespace SHAFTCULL_SET
}  // namespace shaftcull::simd_test
