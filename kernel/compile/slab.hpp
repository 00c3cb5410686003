/// Slab coefficients of many shafts at once: one pair of boxes a lane.
///
/// Face f of box(t) is at p + t q, with p = a's face and q = b's face − p. A bound's coordinate x on that axis, at the
/// corner nearest to the shaft, bounds t by (x − p) / q: from above if only a touches that face of the shaft box (red),
/// from below if only b does (blue). The error margins are derived in docs/exactness.md.
#pragma once

#include <cstddef>
#include <cstdint>

#include "shaftcull/compiled.hpp"

namespace shaftcull::kernel {

/// For every set of red faces (bit f for face f): the faces, red ones first.
struct SlabOrders {
  std::uint8_t face[64][6];
  std::uint8_t reds[64];
};

inline constexpr SlabOrders slab_orders = [] {
  SlabOrders orders{};
  for (unsigned set = 0; set < 64; ++set) {
    unsigned next = 0;
    for (unsigned f = 0; f < 6; ++f) {
      if (set >> f & 1) orders.face[set][next++] = static_cast<std::uint8_t>(f);
    }
    orders.reds[set] = static_cast<std::uint8_t>(next);
    for (unsigned f = 0; f < 6; ++f) {
      if (!(set >> f & 1)) orders.face[set][next++] = static_cast<std::uint8_t>(f);
    }
  }
  return orders;
}();

/// The stream that holds the corner of a bound nearest to face f of a shaft: the opposite face of the bound.
inline constexpr std::uint8_t near_stream[6] = {3, 4, 5, 0, 1, 2};

/// Half the distance from 1 to the next float: what a rounding may be off by, relatively.
inline constexpr float float_unit = 0x1p-24F;

/// Coordinates above this could overflow in a difference, slopes below its inverse in a quotient: such
/// shafts get a margin that leaves every lane to the exact predicates.
inline constexpr float regular_limit = 0x1p125F;

/// The largest shift that the fused form is used for: above it the margin, which grows with the shift, leaves
/// too many lanes undecided, and the difference form, a third slower, is the better bargain.
inline constexpr float fused_limit = 4096.0F;

inline constexpr float margin_slack = 1.0F + 0x1p-10F;  // terms of second order, and the margin's own rounding
inline constexpr float fused_margin = 16 * float_unit * margin_slack;
inline constexpr float fused_margin_per_shift = 12 * float_unit * margin_slack;
inline constexpr float difference_margin = 16 * float_unit * margin_slack;

/// Slab coefficients of one shaft in difference form, for pairs that the fused form does not suit.
template <class L>
void write_difference_slab(const float (&p)[6], const float (&q)[6], bool regular, CompiledShaft& out) noexcept {
  unsigned reds = 0;
  for (unsigned f = 0; f < 6; ++f) {  // a purple face bounds t from above, by +∞ (met) or −∞ (not met)
    if (q[f] == 0 || (q[f] > 0) == (f < 3)) reds |= 1U << f;
  }
  const std::uint8_t* order = slab_orders.face[reds];
  for (unsigned i = 0; i < 6; ++i) {
    const unsigned f = order[i];
    out.slab_scale[i] = q[f] == 0 ? (f < 3 ? __builtin_inff() : -__builtin_inff()) : 1.0F / q[f];
    out.slab_shift[i] = p[f];
    out.slab_near[i] = near_stream[f];
  }
  out.slab_uppers = slab_orders.reds[reds];
  out.slab_form = CompiledShaft::SlabForm::difference;
  out.slab_margin = regular ? difference_margin : __builtin_inff();
}

/// Compiles out[i] from boxes a[·][first + i] and b[·][first + i], for one vector of pairs; joining planes are
/// left pending.
template <class L>
void compile_slab_vector(const float* const* a, const float* const* b, std::size_t first, unsigned count,
                         CompiledShaft* out) noexcept {
  using Vector = typename L::Vector;
  constexpr unsigned width = L::width;
  float p[6][width];
  float other[6][width];
  float slope[6][width];
  float scale[6][width];
  float shift[6][width];
  float box[6][width];
  std::uint64_t red[6];
  float largest_shift[width];
  float largest_coordinate[width];
  float smallest_slope[width];

  const Vector zero = L::all(0.0F);
  const Vector one = L::all(1.0F);
  Vector top_shift = zero;
  Vector top_coordinate = zero;
  Vector least_slope = L::all(__builtin_inff());
  for (unsigned f = 0; f < 6; ++f) {
    const Vector pa = L::load(a[f] + first);
    const Vector pb = L::load(b[f] + first);
    const Vector q = L::subtract(pb, pa);
    const Vector inverse = L::divide(one, q);
    const Vector bias = L::multiply(L::subtract(zero, pa), inverse);
    red[f] = f < 3 ? L::bits(L::less(zero, q)) : L::bits(L::less(q, zero));
    L::store(p[f], pa);
    L::store(other[f], pb);
    L::store(slope[f], q);
    L::store(scale[f], inverse);
    L::store(shift[f], bias);
    L::store(box[f], f < 3 ? L::minimum(pa, pb) : L::maximum(pa, pb));
    top_shift = L::maximum(L::magnitude(bias), top_shift);
    top_coordinate = L::maximum(L::maximum(L::magnitude(pa), L::magnitude(pb)), top_coordinate);
    least_slope = L::minimum(L::magnitude(q), least_slope);
  }
  L::store(largest_shift, top_shift);
  L::store(largest_coordinate, top_coordinate);
  L::store(smallest_slope, least_slope);

  for (unsigned lane = 0; lane < count; ++lane) {
    CompiledShaft& shaft = out[lane];
    float* a_faces = reinterpret_cast<float*>(&shaft.a);
    float* b_faces = reinterpret_cast<float*>(&shaft.b);
    unsigned reds = 0;
    for (unsigned f = 0; f < 6; ++f) {
      a_faces[f] = p[f][lane];
      b_faces[f] = other[f][lane];
      shaft.face[f] = box[f][lane];
      reds |= static_cast<unsigned>(red[f] >> lane & 1) << f;
    }
    if (smallest_slope[lane] >= 1 / regular_limit && largest_coordinate[lane] <= regular_limit &&
        largest_shift[lane] <= fused_limit) {
      const std::uint8_t* order = slab_orders.face[reds];
      for (unsigned i = 0; i < 6; ++i) {
        const unsigned f = order[i];
        shaft.slab_scale[i] = scale[f][lane];
        shaft.slab_shift[i] = shift[f][lane];
        shaft.slab_near[i] = near_stream[f];
      }
      shaft.slab_uppers = slab_orders.reds[reds];
      shaft.slab_form = CompiledShaft::SlabForm::fused;
      shaft.slab_margin = fused_margin + fused_margin_per_shift * largest_shift[lane];
    } else {
      float p_lane[6];
      float q_lane[6];
      bool regular = largest_coordinate[lane] <= regular_limit;
      for (unsigned f = 0; f < 6; ++f) {
        p_lane[f] = p[f][lane];
        q_lane[f] = slope[f][lane];
        const float size = __builtin_fabsf(q_lane[f]);
        regular = regular && (size == 0 || size >= 1 / regular_limit);
      }
      write_difference_slab<L>(p_lane, q_lane, regular, shaft);
    }
    shaft.t_begin = 0.0F;
    shaft.t_end = 1.0F;
    shaft.joining_count = CompiledShaft::planes_pending;
    shaft.added_count = 0;
    shaft.answers_outside = true;
    shaft.answers_inside = true;
    shaft.answers_spheres = true;
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
