// SPDX-License-Identifier: MIT
/// Slab coefficients of many shafts at once: one pair of boxes a lane.
///
/// Face f of box(u) is at p + u q, with p = a's face and q = b's face − p. A bound's coordinate x on that axis, at the
/// corner nearest to the shaft, bounds u by (x − p) / q: from above if only a touches that face of the shaft box (red),
/// from below if only b does (blue). Instead of u the kernels use the position t of face 0, the *reference* face: its
/// own bound on t is x itself, an operation less in six. kernel/compiled/slab.hpp has the margins.
#pragma once

#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "compiled/shaft_data.hpp"
#include "compiled/slab.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// Whether every box is finite with lo ≤ hi and hi − lo does not overflow. Boxes of which that is not true may be
/// finite all the same.
template <class L>
bool all_clearly_finite(const float* const* box, std::size_t count) noexcept {
  auto largest = L::all(0.0F);  // as unsigned integers: negative floats, infinities and NaN are above all others
  bool finite = true;
  for (unsigned k = 0; k < 3; ++k) {
    const float* lo = box[k];
    const float* hi = box[k + 3];
    std::size_t i = 0;
    for (; i + L::width <= count; i += L::width) {
      largest = L::maximum_of_bits(L::subtract(L::load(hi + i), L::load(lo + i)), largest);
    }
    for (; i < count; ++i) {
      const float extent = hi[i] - lo[i];
      finite = finite && extent >= 0 && extent <= FLT_MAX;
    }
  }
  // As integers again: as a float, the −0 of a flat box would pass, and the NaN that it was above with it.
  float lane[L::width];
  L::store(lane, largest);
  for (unsigned i = 0; i < L::width; ++i) {
    finite = finite && __builtin_bit_cast(std::uint32_t, lane[i]) <= __builtin_bit_cast(std::uint32_t, FLT_MAX);
  }
  return finite;
}

/// Whether every box is finite with lo ≤ hi.
template <class L>
bool all_finite(const float* const* box, std::size_t count) noexcept {
  if (all_clearly_finite<L>(box, count)) [[likely]]
    return true;
  for (unsigned k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < count; ++i) {
      if (!(box[k][i] <= box[k + 3][i] && box[k][i] >= -FLT_MAX && box[k + 3][i] <= FLT_MAX)) return false;
    }
  }
  return true;
}

/// Overwrites the slab coefficients of a shaft whose faces move by `slopes` by those of the difference form, for shafts
/// that the fused form does not suit.
template <class L>
void write_difference_slab(ShaftData& shaft, const float (&slopes)[6]) noexcept {
  const float* const p = shaft.a;
  unsigned negative = 0;
  float inverse[6];
  bool regular = shaft.largest_coordinate <= regular_limit;
  for (unsigned f = 0; f < 6; ++f) {
    const float slope = slopes[f];
    const float size = fabsf(slope);
    regular = regular && (size == 0 || size >= 1 / regular_limit);
    // A purple face bounds u from above, by +∞ (met) or −∞ (not met).
    inverse[f] = size == 0 ? (f < 3 ? INFINITY : -INFINITY) : 1.0F / slope;
    if (inverse[f] < 0) negative |= 1U << f;
  }
  const SlabOrder& order = slab_orders.by_negative[negative];
  for (unsigned i = 0; i < 6; ++i) {
    const unsigned f = order.face[i];
    shaft.slab_scale[i] = inverse[f];
    shaft.slab_shift[i] = p[f];
    shaft.slab_near[i] = near_stream[f];
  }
  shaft.slab_uppers = order.selectors.uppers;
  shaft.slab_form = regular ? ShaftData::SlabForm::difference : ShaftData::SlabForm::exact;
  shaft.slab_margin = regular ? difference_margin : INFINITY;
}

/// How a shaft's faces move from the box nearer to the origin to the farther one.
template <class L>
struct TravelFromNearer {
  const float* from;
  const float* to;
  float from_largest;  ///< largest magnitude of a coordinate
  float length;        ///< largest magnitude of a slope: the end of t in the relative form

  explicit TravelFromNearer(const ShaftData& shaft) noexcept : from(shaft.a), to(shaft.b), from_largest(0), length(0) {
    float to_largest = 0;
    const auto enlarge = [](float& largest, float x) { largest = fabsf(x) > largest ? fabsf(x) : largest; };
    for (unsigned f = 0; f < 6; ++f) {
      enlarge(from_largest, from[f]);
      enlarge(to_largest, to[f]);
      enlarge(length, to[f] - from[f]);
    }
    if (from_largest <= to_largest) return;
    const float* const farther = from;
    from = to;
    to = farther;
    from_largest = to_largest;
  }
};

/// Overwrites the slab coefficients of a shaft whose faces move by `slopes`, from the nearer box on, by those of the
/// relative form, if it suits.
template <class L>
bool write_relative_slab(ShaftData& shaft, const TravelFromNearer<L>& travel, const float (&slopes)[6]) noexcept {
  if (!(travel.from_largest <= far_apart * shaft.largest_coordinate && travel.length <= 0x1p127F)) return false;
  unsigned negative = 0;
  float scale[6];
  for (unsigned f = 0; f < 6; ++f) {
    const float slope = slopes[f];
    // A purple face as in the difference form. Other scales are 1 or more in magnitude, so that no product loses its
    // sign.
    scale[f] = slope == 0 ? (f < 3 ? INFINITY : -INFINITY) : travel.length / slope;
    if (slope != 0 && !(fabsf(scale[f]) <= FLT_MAX)) return false;
    if (scale[f] < 0) negative |= 1U << f;
  }
  const SlabOrder& order = slab_orders.by_negative[negative];
  for (unsigned i = 0; i < 6; ++i) {
    const unsigned f = order.face[i];
    shaft.slab_scale[i] = scale[f];
    shaft.slab_shift[i] = travel.from[f];
    shaft.slab_near[i] = near_stream[f];
  }
  shaft.slab_uppers = order.selectors.uppers;
  shaft.slab_form = ShaftData::SlabForm::relative;
  shaft.slab_margin = relative_margin;
  return true;
}

/// Overwrites the slab coefficients of a shaft whose coordinates are large, or that the fused form does not suit, by
/// those of the form that does, if that is another.
template <class L>
SHAFTCULL_COLD void rewrite_slab(ShaftData& shaft, bool fused_suits) noexcept {
  float slopes[6];
  if (shaft.largest_coordinate > largest_plain_coordinate) {
    const TravelFromNearer<L> travel(shaft);
    for (unsigned f = 0; f < 6; ++f) slopes[f] = travel.to[f] - travel.from[f];
    if (write_relative_slab<L>(shaft, travel, slopes)) return;
  }
  if (fused_suits) return;
  for (unsigned f = 0; f < 6; ++f) slopes[f] = shaft.b[f] - shaft.a[f];
  write_difference_slab<L>(shaft, slopes);
}

/// Compiles out[i] from boxes a[·][first + i] and b[·][first + i], for one whole vector of pairs; joining planes are
/// left pending.
template <class L>
void compile_slab_vector(const float* const* a, const float* const* b, std::size_t first, ShaftData* out) noexcept {
  using Vector = typename L::Vector;
  constexpr unsigned width = L::width;
  const Vector zero = L::all(0.0F);
  Vector p[8];
  Vector other[8];
  Vector slope[6];
  Vector least_slope = L::all(INFINITY);
  for (unsigned f = 0; f < 6; ++f) {
    p[f] = L::load(a[f] + first);
    other[f] = L::load(b[f] + first);
    slope[f] = L::subtract(other[f], p[f]);
    least_slope = L::minimum(L::magnitude(slope[f]), least_slope);
  }
  Vector lowest = L::minimum(p[0], other[0]);
  Vector highest = L::maximum(p[3], other[3]);
  for (unsigned k = 1; k < 3; ++k) {
    lowest = L::minimum(L::minimum(p[k], other[k]), lowest);
    highest = L::maximum(L::maximum(p[k + 3], other[k + 3]), highest);
  }
  const Vector largest_coordinate = L::maximum(highest, L::subtract(zero, lowest));

  Vector scale[8];
  Vector shift[8];
  Vector largest_shift = zero;
  scale[0] = L::all(1.0F);
  shift[0] = zero;
  for (unsigned f = 1; f < 6; ++f) {
    scale[f] = L::divide(slope[0], slope[f]);
    shift[f] = L::subtract(p[0], L::multiply(p[f], scale[f]));
    largest_shift = L::maximum(L::magnitude(shift[f]), largest_shift);
  }
  const Vector length = L::magnitude(slope[0]);
  const Vector position = L::add(L::maximum(L::magnitude(p[0]), L::magnitude(other[0])), largest_shift);
  const std::uint64_t fused =
      L::bits(L::both(L::less_equal(largest_coordinate, L::all(fused_regular_limit)),
                      L::both(L::less_equal(L::all(1 / fused_regular_limit), least_slope),
                              L::less_equal(position, L::multiply(length, L::all(fused_limit))))));

  // The rows of ShaftRow.
  scale[6] = L::add(L::multiply(position, L::all(fused_margin_per_position)),
                    L::multiply(length, L::all(fused_margin_per_travel)));
  scale[7] = largest_coordinate;
  shift[6] = shift[7] = p[6] = p[7] = zero;
  other[6] = L::all(batch_flags.of[0]);
  other[7] = L::all(batch_flags.of[1]);
  using EightFloats = typename L::EightFloats;
  typename EightFloats::Vector scale_row[width];
  typename EightFloats::Vector shift_row[width];
  typename EightFloats::Vector a_row[width];
  typename EightFloats::Vector b_row[width];
  L::transpose(scale, scale_row);
  L::transpose(shift, shift_row);
  L::transpose(p, a_row);
  L::transpose(other, b_row);
  for (unsigned lane = 0; lane < width; ++lane) {
    ShaftData& shaft = out[lane];
    prefetch_to_write(&shaft + 16);  // strides this long are beyond hardware prefetchers
    prefetch_to_write(reinterpret_cast<const char*>(&shaft + 16) + 64);
    EightFloats::store(row_of(shaft, ShaftRow::a), a_row[lane]);
    EightFloats::store(row_of(shaft, ShaftRow::b), b_row[lane]);
    const SlabOrder& order = slab_orders.by_negative[EightFloats::signs(scale_row[lane]) & 0x3f];
    EightFloats::store(row_of(shaft, ShaftRow::scale), EightFloats::permuted(scale_row[lane], order.face));
    EightFloats::store(row_of(shaft, ShaftRow::shift), EightFloats::permuted(shift_row[lane], order.face));
    std::memcpy(row_of(shaft, ShaftRow::selectors), &order.selectors, sizeof order.selectors);
  }

  const std::uint64_t plain = fused & L::bits(L::less_equal(largest_coordinate, L::all(largest_plain_coordinate)));
  if (plain != (std::uint64_t{1} << width) - 1) {
    for (unsigned lane = 0; lane < width; ++lane) {
      if ((plain >> lane & 1) == 0) rewrite_slab<L>(out[lane], (fused >> lane & 1) != 0);
    }
  }
}

template <class L>
void compile_slabs(const float* const* a, const float* const* b, std::size_t count, ShaftData* out) noexcept {
  std::size_t i = 0;
  for (; i + L::width <= count; i += L::width) compile_slab_vector<L>(a, b, i, out + i);
  if (i == count) return;
  // The rest, padded with the last pair.
  float rest[12][L::width];
  const float* rest_a[6];
  const float* rest_b[6];
  const std::size_t left = count - i;
  for (unsigned f = 0; f < 6; ++f) {
    for (unsigned lane = 0; lane < L::width; ++lane) {
      const std::size_t source = lane < left ? i + lane : count - 1;
      rest[f][lane] = a[f][source];
      rest[f + 6][lane] = b[f][source];
    }
    rest_a[f] = rest[f];
    rest_b[f] = rest[f + 6];
  }
  ShaftData shafts[L::width];
  compile_slab_vector<L>(rest_a, rest_b, 0, shafts);
  for (std::size_t lane = 0; lane < left; ++lane) {  // what comes before the planes
    std::memcpy(static_cast<void*>(&out[i + lane]), &shafts[lane], offsetof(ShaftData, added));
  }
}

}  // namespace shaftcull::kernel
