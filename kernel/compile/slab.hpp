/// Slab coefficients of many shafts at once: one pair of boxes a lane.
///
/// Face f of box(u) is at p + u q, with p = a's face and q = b's face − p. A bound's coordinate x on that axis, at the
/// corner nearest to the shaft, bounds u by (x − p) / q: from above if only a touches that face of the shaft box (red),
/// from below if only b does (blue). Instead of u the kernels use the position t of one lo face, the *leading* one: its
/// own bound on t is x itself, an operation less in six. The error margins are derived in docs/exactness.md.
#pragma once

#include <cstddef>
#include <cstdint>

#include "shaftcull/compiled.hpp"

namespace shaftcull::kernel {

/// For every set of red faces (bit f for face f): what a compiled shaft says of the order of its constraints, those that bound t
/// from above first, and of these the leading face first.
struct SlabOrder {
  std::uint32_t face[8];        ///< the last two are not used
  std::uint8_t near_stream[6];  ///< as CompiledShaft::slab_near and what follows it there
  std::uint8_t uppers;
  std::uint8_t form;
};

/// The leading face: the first lo face that is red, so that t grows with u; if none is, face 0, which makes t fall as u grows, and
/// the blue faces bound it from above.
constexpr unsigned leading_face(unsigned reds) noexcept {
  return (reds & 1) != 0 ? 0 : (reds & 2) != 0 ? 1 : (reds & 4) != 0 ? 2 : 0;
}
constexpr bool falls(unsigned reds) noexcept { return (reds & 7) == 0; }

/// The stream that holds the corner of a bound nearest to face f of a shaft: the opposite face of the bound.
inline constexpr std::uint8_t near_stream[6] = {3, 4, 5, 0, 1, 2};

inline constexpr auto slab_orders = [] {
  struct {
    SlabOrder by_reds[64];
  } orders{};
  for (unsigned reds = 0; reds < 64; ++reds) {
    SlabOrder& order = orders.by_reds[reds];
    unsigned next = 0;
    for (const bool upper : {true, false}) {
      for (unsigned f = 0; f < 6; ++f) {
        if (((reds >> f & 1) != falls(reds)) != upper) continue;
        order.face[next] = f;
        order.near_stream[next++] = near_stream[f];
      }
      if (upper) order.uppers = static_cast<std::uint8_t>(next);
    }
    order.form = static_cast<std::uint8_t>(CompiledShaft::SlabForm::fused);
  }
  return orders;
}();

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

/// Whether every box is finite with lo ≤ hi.
template <class L>
bool all_finite(const float* const* box, std::size_t count) noexcept {
  const auto largest = L::all(__FLT_MAX__);
  const auto least = L::all(-__FLT_MAX__);
  bool good = true;
  for (unsigned k = 0; k < 3; ++k) {
    const float* lo = box[k];
    const float* hi = box[k + 3];
    std::size_t i = 0;
    auto finite = L::less(least, largest);  // all true
    for (; i + L::width <= count; i += L::width) {
      const auto low = L::load(lo + i);
      const auto high = L::load(hi + i);
      finite = L::both(finite, L::both(L::less_equal(low, high), L::both(L::less_equal(least, low), L::less_equal(high, largest))));
    }
    good = good && L::bits(finite) == (std::uint64_t{1} << L::width) - 1;
    for (; i < count; ++i) good = good && lo[i] <= hi[i] && lo[i] >= -__FLT_MAX__ && hi[i] <= __FLT_MAX__;
  }
  return good;
}

/// Slab coefficients of one shaft in difference form, for pairs that the fused form does not suit.
template <class L>
void write_difference_slab(const float (&p)[8], const float (&q)[6], bool regular, CompiledShaft& out) noexcept {
  unsigned reds = 0;
  for (unsigned f = 0; f < 6; ++f) {  // a purple face bounds u from above, by +∞ (met) or −∞ (not met)
    if (q[f] == 0 || (q[f] > 0) == (f < 3)) reds |= 1U << f;
  }
  const SlabOrder& order = slab_orders.by_reds[reds];
  const float direction = falls(reds) ? -1.0F : 1.0F;
  for (unsigned i = 0; i < 6; ++i) {
    const unsigned f = order.face[i];
    const float inverse = q[f] == 0 ? (f < 3 ? __builtin_inff() : -__builtin_inff()) : 1.0F / q[f];
    out.slab_scale[i] = direction * inverse;
    out.slab_shift[i] = p[f];
    out.slab_near[i] = near_stream[f];
  }
  out.slab_uppers = order.uppers;
  out.slab_form = regular ? CompiledShaft::SlabForm::difference : CompiledShaft::SlabForm::exact;
  out.slab_margin = regular ? difference_margin : __builtin_inff();
  out.t_at_a = 0.0F;
  out.t_at_b = direction;
}

/// Compiles out[i] from boxes a[·][first + i] and b[·][first + i], for one vector of pairs; joining planes are
/// left pending.
template <class L>
void compile_slab_vector(const float* const* a, const float* const* b, std::size_t first, unsigned count,
                         CompiledShaft* out) noexcept {
  using Vector = typename L::Vector;
  constexpr unsigned width = L::width;
  const Vector zero = L::all(0.0F);
  Vector p[6];
  Vector other[6];
  Vector slope[6];
  Vector red_set = zero;  // a sum of 2^f over red faces f: small integers are exact
  Vector top_coordinate = zero;
  Vector least_slope = L::all(__builtin_inff());
  typename L::Mask red_lo[3];
  for (unsigned f = 0; f < 6; ++f) {
    p[f] = L::load(a[f] + first);
    other[f] = L::load(b[f] + first);
    slope[f] = L::subtract(other[f], p[f]);
    const auto red = f < 3 ? L::less(zero, slope[f]) : L::less(slope[f], zero);
    if (f < 3) red_lo[f] = red;
    red_set = L::add(red_set, L::choose(red, L::all(static_cast<float>(1U << f)), zero));
    top_coordinate = L::maximum(L::maximum(L::magnitude(p[f]), L::magnitude(other[f])), top_coordinate);
    least_slope = L::minimum(L::magnitude(slope[f]), least_slope);
  }
  // As leading_face() has it.
  const auto leading = [&](const Vector (&of)[6]) {
    return L::choose(red_lo[0], of[0], L::choose(red_lo[1], of[1], L::choose(red_lo[2], of[2], of[0])));
  };
  const Vector start = leading(p);
  const Vector end = leading(other);
  const Vector way = leading(slope);

  Vector scale[6];
  Vector shift[6];
  Vector top_shift = zero;
  for (unsigned f = 0; f < 6; ++f) {
    scale[f] = L::divide(way, slope[f]);
    shift[f] = L::subtract(start, L::multiply(p[f], scale[f]));
    top_shift = L::maximum(L::magnitude(shift[f]), top_shift);
  }
  const Vector length = L::magnitude(way);
  const Vector position = L::add(L::maximum(L::magnitude(start), L::magnitude(end)), top_shift);
  float margin[width];
  L::store(margin, L::add(L::multiply(position, L::all(fused_margin_per_position)),
                          L::multiply(length, L::all(fused_margin_per_way))));
  float reaches[width];
  L::store(reaches, top_coordinate);
  float reds[width];
  L::store(reds, red_set);
  float starts[width];
  L::store(starts, start);
  float ends[width];
  L::store(ends, end);
  const std::uint64_t regular = L::bits(L::less_equal(top_coordinate, L::all(regular_limit)));
  const std::uint64_t fused =
      L::bits(L::both(L::less_equal(top_coordinate, L::all(fused_regular_limit)),
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

  // Rows are written eight floats at a time where that is quicker: two more than they have, onto members that are
  // written after them.
  for (unsigned lane = 0; lane < count; ++lane) {
    CompiledShaft& shaft = out[lane];
    __builtin_prefetch(&shaft + 16, 1);  // strides this long are beyond hardware prefetchers
    __builtin_prefetch(reinterpret_cast<const char*>(&shaft + 16) + 64, 1);
    const bool is_fused = fused >> lane & 1;
    shaft.reach = reaches[lane];
    if (is_fused) [[likely]] {
      const SlabOrder& order = slab_orders.by_reds[static_cast<int>(reds[lane])];
      L::permute_row(scale_rows[lane], order.face, shaft.slab_scale);
      L::permute_row(shift_rows[lane], order.face, shaft.slab_shift);
      __builtin_memcpy(shaft.slab_near, order.near_stream, 8);
      shaft.slab_margin = margin[lane];
    }
    L::copy_row(p_rows[lane], &shaft.a);
    L::copy_row(other_rows[lane], &shaft.b);
    shaft.t_at_a = starts[lane];
    shaft.t_at_b = ends[lane];
    shaft.joining_count = CompiledShaft::planes_pending;
    shaft.added_count = 0;
    shaft.answers_outside = true;
    shaft.answers_inside = true;
    shaft.answers_spheres = true;
    if (is_fused) [[likely]] continue;
    float slope_row[6];
    bool is_regular = regular >> lane & 1;
    for (unsigned f = 0; f < 6; ++f) {
      slope_row[f] = other_rows[lane][f] - p_rows[lane][f];
      const float size = __builtin_fabsf(slope_row[f]);
      is_regular = is_regular && (size == 0 || size >= 1 / regular_limit);
    }
    write_difference_slab<L>(p_rows[lane], slope_row, is_regular, shaft);
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
