/// Slab coefficients of many shafts at once: one pair of boxes a lane.
///
/// Face f of box(u) is at p + u q, with p = a's face and q = b's face − p. A bound's coordinate x on that axis, at the
/// corner nearest to the shaft, bounds u by (x − p) / q: from above if only a touches that face of the shaft box (red),
/// from below if only b does (blue). Instead of u the kernels use the position t of face 0, the *leading* face: its own bound on t is x itself,
/// an operation less in six. The error margins are derived in docs/exactness.md.
#pragma once

#include <cstddef>
#include <cstdint>

#include "shaftcull/compiled.hpp"

namespace shaftcull::kernel {

/// What a compiled shaft says of the order of its constraints: those that bound t from above come first.
struct SlabOrder {
  std::uint32_t face[8];        ///< the last two stay where they are: what follows the faces in a row
  std::uint8_t near_stream[6];  ///< as CompiledShaft::slab_near and what follows it there
  std::uint8_t uppers;
  std::uint8_t form;
};

/// The stream that holds the corner of a bound nearest to face f of a shaft: the opposite face of the bound.
inline constexpr std::uint8_t near_stream[6] = {3, 4, 5, 0, 1, 2};

/// By the set of faces whose scale is negative (bit f for face f). A lo face bounds t from above if it moves as the leading face does, a hi face
/// if it moves against it; so the leading face itself is always the first.
inline constexpr auto slab_orders = [] {
  struct {
    SlabOrder by_negative[64];
  } orders{};
  for (unsigned negative = 0; negative < 64; ++negative) {
    SlabOrder& order = orders.by_negative[negative];
    unsigned next = 0;
    for (const bool upper : {true, false}) {
      for (unsigned f = 0; f < 6; ++f) {
        const bool moves_along = (negative >> f & 1) == 0;
        if ((moves_along == (f < 3)) != upper) continue;
        order.face[next] = f;
        order.near_stream[next++] = near_stream[f];
      }
      if (upper) order.uppers = static_cast<std::uint8_t>(next);
    }
    order.face[6] = 6;
    order.face[7] = 7;
    order.form = static_cast<std::uint8_t>(CompiledShaft::SlabForm::fused);
  }
  return orders;
}();

/// What compile_batch() says of every shaft, as the two floats that follow box b in a row of its columns.
struct BatchMark {
  std::uint8_t joining_count = CompiledShaft::planes_pending;
  std::uint8_t added_count = 0;
  bool answers[3] = {true, true, true};
  std::uint8_t padding[3] = {};
};
struct TwoFloats {
  float of[2];
};
inline constexpr TwoFloats batch_mark = __builtin_bit_cast(TwoFloats, BatchMark{});

// Rows of eight floats are written onto six and what follows them.
static_assert(offsetof(CompiledShaft, slab_margin) == offsetof(CompiledShaft, slab_scale) + 6 * sizeof(float));
static_assert(offsetof(CompiledShaft, reach) == offsetof(CompiledShaft, slab_scale) + 7 * sizeof(float));
static_assert(offsetof(CompiledShaft, slab_near) == offsetof(CompiledShaft, slab_shift) + 6 * sizeof(float));
static_assert(offsetof(CompiledShaft, b) == offsetof(CompiledShaft, a) + 6 * sizeof(float));
static_assert(offsetof(CompiledShaft, joining_count) == offsetof(CompiledShaft, b) + 6 * sizeof(float));
static_assert(offsetof(CompiledShaft, answers_outside) == offsetof(CompiledShaft, joining_count) + offsetof(BatchMark, answers));

/// Half the distance from 1 to the next float: what a rounding may be off by, relatively.
inline constexpr float float_unit = 0x1p-24F;

/// Coordinates above this could overflow in a difference, slopes below its inverse in a quotient: such
/// shafts get a margin that leaves every lane to the exact predicates.
inline constexpr float regular_limit = 0x1p125F;

/// Likewise for the fused form, where two slopes are divided by each other.
inline constexpr float fused_regular_limit = 0x1p60F;

/// The fused form is used while no position of the leading face and no shift is larger than this many times the way that the
/// leading face goes: above it the margin leaves too many lanes undecided, and the difference form, a third slower, is the better bargain.
inline constexpr float fused_limit = 4096.0F;

inline constexpr float margin_slack = 1.0F + 0x1p-10F;  // terms of second order, and the margin's own rounding
inline constexpr float fused_margin_per_position = 20 * float_unit * margin_slack;  // of the leading face, and of shifts
inline constexpr float fused_margin_per_way = 12 * float_unit * margin_slack;
inline constexpr float difference_margin = 16 * float_unit * margin_slack;

/// Whether every box is finite with lo ≤ hi and hi − lo does not overflow. Boxes of which that is not true deserve a second look.
template <class L>
bool all_fine(const float* const* box, std::size_t count) noexcept {
  auto largest = L::all(0.0F);  // as unsigned integers: negative floats, infinities and NaN are above all others
  float rest = 0.0F;
  for (unsigned k = 0; k < 3; ++k) {
    const float* lo = box[k];
    const float* hi = box[k + 3];
    std::size_t i = 0;
    for (; i + L::width <= count; i += L::width) {
      largest = L::maximum_of_bits(L::subtract(L::load(hi + i), L::load(lo + i)), largest);
    }
    for (; i < count; ++i) {
      const float extent = hi[i] - lo[i];
      if (!(extent >= 0 && extent <= __FLT_MAX__)) rest = -1.0F;
    }
  }
  const auto most = L::all(__FLT_MAX__);
  const std::uint64_t fine = L::bits(L::both(L::less_equal(L::all(0.0F), largest), L::less_equal(largest, most)));
  return rest == 0 && fine == (std::uint64_t{1} << L::width) - 1;
}

/// Whether every box is finite with lo ≤ hi.
template <class L>
bool all_finite(const float* const* box, std::size_t count) noexcept {
  if (all_fine<L>(box, count)) [[likely]] return true;
  for (unsigned k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < count; ++i) {
      if (!(box[k][i] <= box[k + 3][i] && box[k][i] >= -__FLT_MAX__ && box[k + 3][i] <= __FLT_MAX__)) return false;
    }
  }
  return true;
}

/// Slab coefficients of one shaft in difference form, for pairs that the fused form does not suit.
template <class L>
void write_difference_slab(const float (&p)[8], const float (&other)[8], CompiledShaft& out) noexcept {
  unsigned negative = 0;
  float inverse[6];
  bool regular = true;
  out.reach = 0;
  for (unsigned f = 0; f < 6; ++f) {
    const float slope = other[f] - p[f];
    const float size = __builtin_fabsf(slope);
    out.reach = __builtin_fmaxf(out.reach, __builtin_fmaxf(__builtin_fabsf(p[f]), __builtin_fabsf(other[f])));
    regular = regular && (size == 0 || size >= 1 / regular_limit);
    // A purple face bounds u from above, by +∞ (met) or −∞ (not met).
    inverse[f] = size == 0 ? (f < 3 ? __builtin_inff() : -__builtin_inff()) : 1.0F / slope;
    if (inverse[f] < 0) negative |= 1U << f;
  }
  regular = regular && out.reach <= regular_limit;
  const SlabOrder& order = slab_orders.by_negative[negative];
  for (unsigned i = 0; i < 6; ++i) {
    const unsigned f = order.face[i];
    out.slab_scale[i] = inverse[f];
    out.slab_shift[i] = p[f];
    out.slab_near[i] = near_stream[f];
  }
  out.slab_uppers = order.uppers;
  out.slab_form = regular ? CompiledShaft::SlabForm::difference : CompiledShaft::SlabForm::exact;
  out.slab_margin = regular ? difference_margin : __builtin_inff();
}

/// Compiles out[i] from boxes a[·][first + i] and b[·][first + i], for one vector of pairs; joining planes are
/// left pending.
template <class L>
void compile_slab_vector(const float* const* a, const float* const* b, std::size_t first, unsigned count,
                         CompiledShaft* out) noexcept {
  using Vector = typename L::Vector;
  constexpr unsigned width = L::width;
  const Vector zero = L::all(0.0F);
  Vector p[8];
  Vector other[8];
  Vector slope[6];
  Vector least_slope = L::all(__builtin_inff());
  for (unsigned f = 0; f < 6; ++f) {
    p[f] = L::load(a[f] + first);
    other[f] = L::load(b[f] + first);
    slope[f] = L::subtract(other[f], p[f]);
    least_slope = L::minimum(L::magnitude(slope[f]), least_slope);
  }
  for (unsigned extra = 6; extra < 8; ++extra) {
    p[extra] = zero;
    other[extra] = L::all(batch_mark.of[extra - 6]);
  }
  Vector lowest = L::minimum(p[0], other[0]);
  Vector highest = L::maximum(p[3], other[3]);
  for (unsigned k = 1; k < 3; ++k) {
    lowest = L::minimum(L::minimum(p[k], other[k]), lowest);
    highest = L::maximum(L::maximum(p[k + 3], other[k + 3]), highest);
  }
  const Vector reach = L::maximum(highest, L::subtract(zero, lowest));

  Vector scale[8];
  Vector shift[8];
  Vector top_shift = zero;
  scale[0] = L::all(1.0F);
  shift[0] = zero;
  for (unsigned f = 1; f < 6; ++f) {
    scale[f] = L::divide(slope[0], slope[f]);
    shift[f] = L::subtract(p[0], L::multiply(p[f], scale[f]));
    top_shift = L::maximum(L::magnitude(shift[f]), top_shift);
  }
  const Vector length = L::magnitude(slope[0]);
  const Vector position = L::add(L::maximum(L::magnitude(p[0]), L::magnitude(other[0])), top_shift);
  scale[6] = L::add(L::multiply(position, L::all(fused_margin_per_position)),
                    L::multiply(length, L::all(fused_margin_per_way)));
  scale[7] = reach;
  shift[6] = shift[7] = zero;
  const std::uint64_t fused =
      L::bits(L::both(L::less_equal(reach, L::all(fused_regular_limit)),
                      L::both(L::less_equal(L::all(1 / fused_regular_limit), least_slope),
                              L::less_equal(position, L::multiply(length, L::all(fused_limit))))));
  float p_rows[width][8];
  float other_rows[width][8];
  float scale_rows[width][8];
  float shift_rows[width][8];
  L::store_rows(p, p_rows);
  L::store_rows(other, other_rows);
  L::store_rows(scale, scale_rows);
  L::store_rows(shift, shift_rows);

  // Eight floats at a time are written onto six and what follows them, so in this order.
  const auto write = [&](unsigned lane) {
    CompiledShaft& shaft = out[lane];
    __builtin_prefetch(&shaft + 16, 1);  // strides this long are beyond hardware prefetchers
    __builtin_prefetch(reinterpret_cast<const char*>(&shaft + 16) + 64, 1);
    L::copy_row(p_rows[lane], &shaft.a);
    L::copy_row(other_rows[lane], &shaft.b);
    if (fused >> lane & 1) [[likely]] {
      const SlabOrder& order = slab_orders.by_negative[L::row_signs(scale_rows[lane]) & 0x3f];
      L::permute_row(scale_rows[lane], order.face, shaft.slab_scale);
      L::permute_row(shift_rows[lane], order.face, shaft.slab_shift);
      __builtin_memcpy(shaft.slab_near, order.near_stream, 8);
    } else {
      write_difference_slab<L>(p_rows[lane], other_rows[lane], shaft);
    }
  };
  if (count == width) {
#pragma GCC unroll 1
    for (unsigned lane = 0; lane < width; ++lane) write(lane);
  } else {
    for (unsigned lane = 0; lane < count; ++lane) write(lane);
  }
}

template <class L>
void compile_slabs(const float* const* a, const float* const* b, std::size_t count, CompiledShaft* out) noexcept {
  std::size_t i = 0;
  for (; i + L::width <= count; i += L::width) compile_slab_vector<L>(a, b, i, L::width, out + i);
  if (i == count) return;
  // The rest, padded with the last pair.
  float rest[12][L::width];
  const float* rest_a[6];
  const float* rest_b[6];
  const auto left = static_cast<unsigned>(count - i);
  for (unsigned f = 0; f < 6; ++f) {
    for (unsigned lane = 0; lane < L::width; ++lane) {
      const std::size_t source = lane < left ? i + lane : count - 1;
      rest[f][lane] = a[f][source];
      rest[f + 6][lane] = b[f][source];
    }
    rest_a[f] = rest[f];
    rest_b[f] = rest[f + 6];
  }
  compile_slab_vector<L>(rest_a, rest_b, 0, left, out + i);
}

}  // namespace shaftcull::kernel
