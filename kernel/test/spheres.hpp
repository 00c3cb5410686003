/// Spheres: a cheap stage that culls most, one that accepts most of the rest, and the exact predicate for what is left.
#pragma once

#include "exact/predicates.hpp"
#include "test/box_planes.hpp"
#include "test/box_slab.hpp"
#include "test/mutant.hpp"
#include "test/word.hpp"

namespace shaftcull::kernel {

/// A sphere's centre in place of both corners of a box.
template <class L>
struct CentreStreams {
  const float* stream[6];

  explicit CentreStreams(const float* const* sphere) noexcept {
    for (unsigned k = 0; k < 6; ++k) stream[k] = sphere[k % 3];
  }
};

/// Slab form: the box around each sphere against the slab constraints. Clears nothing that could meet the shaft.
template <class L, unsigned uppers>
void sphere_slab_words(const CompiledShaft& shaft, const float* const* stream, std::size_t words,
                       std::uint64_t* kept) noexcept {
  // centre ± radius is rounded once more than a box's coordinate: 22 and 14 units instead of 20 and 12.
  const Slab<L, uppers, CompiledShaft::SlabForm::fused> slab(shaft, 1.25F * shaft.slab_margin);
  const float* centre[6];
  bool hi[6];
  for (unsigned i = 0; i < 6; ++i) {
    centre[i] = stream[shaft.slab_near[i] % 3];
    hi[i] = shaft.slab_near[i] >= 3;
  }
  typename L::Vector sign[6];
  for (unsigned i = 0; i < 6; ++i) sign[i] = L::all(hi[i] ? 1.0F : -1.0F);

  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t outside = 0;
#pragma GCC unroll 4
    for (unsigned four = 0; four < word_bits; four += 4 * L::width) {
      typename L::Vector room[4];
#pragma GCC unroll 4
      for (unsigned v = 0; v < 4; ++v) {
        const std::size_t at = w * word_bits + four + v * L::width;
        const auto radius = L::load(stream[3] + at);
        room[v] = slab.room([&](unsigned i) { return L::multiply_add(radius, sign[i], L::load(centre[i] + at)); });
        room[v] = L::either_negative(room[v], radius);
      }
      outside |= L::signs(room) << four;
    }
    kept[w] = ~outside;
  }
}

/// Plane form: centres against faces and unit-normal planes moved out by the radius. Clears nothing that could meet the
/// shaft; where faces nearly coincide or are purple it serves the slab form too.
template <class L>
void sphere_planes_stage(const CompiledShaft& shaft, const float* const* stream, std::size_t words,
                         std::uint64_t* kept) noexcept {
  const auto margin = L::all(shaft.joining_margin);
  const CentreStreams<L> centres(stream);
  const JoiningPlanes<L> planes(shaft, shaft.joining_near0, shaft.joining_near1, centres.stream);
  // The centre of a sphere that meets the shaft box is at most r beyond it, so errors grow by a few units of r.
  const auto minus_widened = L::all(-(1.0F + 8 * float_unit * radius_margin_factor));
  const auto zero = L::all(0.0F);
  const auto largest = L::all(__FLT_MAX__);  // beyond it a sum has overflowed and proves nothing
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t outside = 0;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      const std::size_t at = w * word_bits + lane;
      const auto radius = L::load(stream[3] + at);
      auto beyond = L::less(radius, zero);
      for (unsigned k = 0; k < 3; ++k) {
        const auto centre = L::load(stream[k] + at);
        // The rounded difference exceeds r only if the exact one does: r is a float.
        beyond = L::either(beyond, L::less(radius, L::subtract(L::all(shaft.face[k]), centre)));
        beyond = L::either(beyond, L::less(radius, L::subtract(centre, L::all(shaft.face[k + 3]))));
      }
      outside |= L::bits(beyond) << lane;
    }
    kept[w] = ~outside;
    if (kept[w] == 0) continue;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      if (L::width < 8 && (kept[w] & lanes_of<L>(lane)) == 0) continue;  // as box_planes_stage()
      const std::size_t at = w * word_bits + lane;
      const auto value = L::multiply_add(L::load(stream[3] + at), minus_widened, planes.largest_value(at));
      outside |= L::bits(L::both(L::less(margin, value), L::less_equal(value, largest))) << lane;
    }
    kept[w] = ~outside;
  }
}

/// First stage of the slab form: writes the kept bits of `words` whole words.
template <class L>
void sphere_slab_stage(const CompiledShaft& shaft, const float* const* stream, std::size_t words,
                       std::uint64_t* kept) noexcept {
  using Words = void(const CompiledShaft&, const float* const*, std::size_t, std::uint64_t*) noexcept;
  static constexpr Words* by_uppers[6] = {sphere_slab_words<L, 1>, sphere_slab_words<L, 2>, sphere_slab_words<L, 3>,
                                          sphere_slab_words<L, 4>, sphere_slab_words<L, 5>, sphere_slab_words<L, 6>};
  by_uppers[shaft.slab_uppers - 1](shaft, stream, words, kept);
}

/// Accepts every kept sphere that a point of one well-chosen box on the way from a to b is certainly within reach of; asks the exact
/// predicate about the others, and about those near an added plane.
template <class L>
void sphere_settle_stage(const CompiledShaft& shaft, const float* const* stream, std::size_t words,
                         std::uint64_t* kept) noexcept {
  using Vector = typename L::Vector;
  const float* a = reinterpret_cast<const float*>(&shaft.a);
  const float* b = reinterpret_cast<const float*>(&shaft.b);
  Vector start[6];
  Vector slope[6];
  float reach = 0;
  for (unsigned f = 0; f < 6; ++f) {
    start[f] = L::all(a[f]);
    slope[f] = L::all(b[f] - a[f]);
    reach = __builtin_fmaxf(reach, __builtin_fmaxf(__builtin_fabsf(a[f]), __builtin_fabsf(b[f])));
  }
  // A gap is off by 8 units of reach and one of itself; over three axes √3 · 8 < 16.
  const Vector minus_error = L::all(-17 * float_unit * accept_margin_factor * reach);
  const Vector shrink = L::all(1 - 16 * float_unit * accept_margin_factor);
  const Vector least = L::all(0x1p-60F);  // its square is far above what underflow can take away,
  const Vector most = L::all(0x1p60F);    // and the square of this far below overflow
  const Vector zero = L::all(0.0F);
  const Vector one = L::all(1.0F);
  const Vector half = L::all(0.5F);
  const Vector t_at_a = L::all(shaft.t_at_a);
  const Vector inverse_way = L::all(1 / (shaft.t_at_b - shaft.t_at_a));
  const Vector first = L::all(__builtin_fminf(shaft.t_at_a, shaft.t_at_b));
  const Vector last = L::all(__builtin_fmaxf(shaft.t_at_a, shaft.t_at_b));
  const CentreStreams<L> centres(stream);

  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t accepted = 0;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      if ((kept[w] & lanes_of<L>(lane)) == 0) continue;
      const std::size_t at = w * word_bits + lane;
      const Vector radius = L::load(stream[3] + at);
      const Vector centre[3] = {L::load(stream[0] + at), L::load(stream[1] + at), L::load(stream[2] + at)};

      // Any will do for a proof; the middle of those that meet the box around the sphere is rarely a bad one.
      Vector upper = last;
      Vector lower = first;
      for (unsigned i = 0; i < 6; ++i) {
        const unsigned near = shaft.slab_near[i];
        const Vector c = centre[near % 3];
        const Vector x = near < 3 ? L::subtract(c, radius) : L::add(c, radius);
        const Vector scale = L::all(shaft.slab_scale[i]);
        const Vector shift = L::all(shaft.slab_shift[i]);
        const Vector t = shaft.slab_form == CompiledShaft::SlabForm::fused ? L::multiply_add(x, scale, shift)
                                                                           : L::multiply(L::subtract(x, shift), scale);
        if (i < shaft.slab_uppers) {
          upper = L::minimum(t, upper);
        } else {
          lower = L::maximum(t, lower);
        }
      }
      const Vector middle = L::multiply(half, L::add(lower, upper));
      const Vector u = L::minimum(L::maximum(L::multiply(L::subtract(middle, t_at_a), inverse_way), zero), one);

      Vector square = zero;
      for (unsigned k = 0; k < 3; ++k) {
        const Vector below = L::subtract(L::multiply_add(u, slope[k], start[k]), centre[k]);
        const Vector above = L::subtract(centre[k], L::multiply_add(u, slope[k + 3], start[k + 3]));
        const Vector gap = L::maximum(below, L::maximum(above, zero));
        square = L::multiply_add(gap, gap, square);
      }
      const Vector sure = L::multiply_add(radius, shrink, minus_error);
      const auto usable = L::both(L::less(least, sure), L::less(sure, most));
      accepted |= L::bits(L::both(usable, L::less_equal(square, L::multiply(sure, sure)))) << lane;
    }
    std::uint64_t undecided = kept[w] & ~accepted;
    for (unsigned i = 0; i < shaft.added_count; ++i) {
      for (unsigned lane = 0; lane < word_bits; lane += L::width) {
        if ((kept[w] & lanes_of<L>(lane)) == 0) continue;
        const std::size_t at = w * word_bits + lane;
        const Vector radius = L::load(stream[3] + at);
        const Vector value = L::multiply_add(radius, L::all(-shaft.added_length[i]),
                                             added_value<L>(shaft, i, shaft.added_near, centres.stream, at));
        const Vector margin = L::multiply_add(radius, L::all(shaft.added_slack[i]), L::all(shaft.added_margin[i]));
        const auto finite = L::less_equal(L::magnitude(value), L::all(__FLT_MAX__));  // a sum may have overflowed
        const std::uint64_t positive = L::bits(L::both(finite, L::less(margin, value))) << lane;
        const std::uint64_t negative = L::bits(L::both(finite, L::less(L::add(value, margin), zero))) << lane;
        kept[w] &= ~positive;
        undecided |= ~(positive | negative) & lanes_of<L>(lane);
      }
    }
    undecided &= kept[w];
    if (undecided != 0) {
      kept[w] &= ~decide_lanes<L>(undecided, [&](unsigned lane) {
        return sphere_outside(shaft, BoundAt<L, 4>(stream, w * word_bits + lane).value);
      });
    }
  }
}

/// Clears the bits of spheres that are not inside.
template <class L>
void sphere_inside_stage(const CompiledShaft& shaft, const float* const* stream, std::size_t words,
                         std::uint64_t* inside) noexcept {
  using Vector = typename L::Vector;
  const CentreStreams<L> centres(stream);
  const Vector zero = L::all(0.0F);
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t candidates = 0;
    std::uint64_t undecided = 0;
    for (unsigned lane = 0; lane < word_bits; lane += L::width) {
      if ((inside[w] & lanes_of<L>(lane)) == 0) continue;
      const std::size_t at = w * word_bits + lane;
      const Vector radius = L::load(stream[3] + at);
      auto possible = L::less_equal(zero, radius);
      auto sure = L::less_equal(zero, radius);
      for (unsigned k = 0; k < 3; ++k) {
        const Vector centre = L::load(stream[k] + at);
        const Vector above_lo = L::subtract(centre, L::all(shaft.face[k]));
        const Vector below_hi = L::subtract(L::all(shaft.face[k + 3]), centre);
        // A rounded difference that is not equal to r is on the same side of it as the exact one.
        possible = L::both(possible, L::both(L::less_equal(radius, above_lo), L::less_equal(radius, below_hi)));
        sure = L::both(sure, L::both(L::less(radius, above_lo), L::less(radius, below_hi)));
      }
      std::uint64_t within = L::bits(possible) << lane & inside[w];
      if (within == 0) continue;
      std::uint64_t certain = L::bits(sure) << lane;
      const auto test = [&](Vector value, Vector margin) {
        certain &= L::bits(L::less(L::add(value, margin), zero)) << lane;
        within &= ~(L::bits(L::less(margin, value)) << lane);
      };
      const Vector joining = largest_joining_value<L>(shaft, shaft.joining_near0, shaft.joining_near1, centres.stream, at);
      const Vector growth = L::all(8 * float_unit * radius_margin_factor);
      test(L::add(joining, radius), L::multiply_add(radius, growth, L::all(shaft.joining_margin)));
      for (unsigned i = 0; i < shaft.added_count; ++i) {
        test(L::multiply_add(radius, L::all(shaft.added_length[i]),
                             added_value<L>(shaft, i, shaft.added_near, centres.stream, at)),
             L::multiply_add(radius, L::all(shaft.added_slack[i]), L::all(shaft.added_margin[i])));
      }
      candidates |= within;
      undecided |= within & ~certain;
    }
    inside[w] = candidates & ~undecided;
    if (undecided != 0) [[unlikely]] {
      inside[w] |= decide_lanes<L>(undecided, [&](unsigned lane) {
        return sphere_inside(shaft, BoundAt<L, 4>(stream, w * word_bits + lane).value);
      });
    }
  }
}

}  // namespace shaftcull::kernel
