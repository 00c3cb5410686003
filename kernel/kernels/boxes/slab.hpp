// SPDX-License-Identifier: MIT
/// Boxes outside the shaft, in slab form: is there a t between box a's and box b's that satisfies all six constraints?
#pragma once

#include <cfloat>
#include <cmath>

#include "exact/predicates.hpp"
#include "kernels/forming/slab.hpp"
#include "kernels/shared/word.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// An interval length that says outside, for lanes without a bound.
inline constexpr float outside_for_certain = -1.0F;

/// How many constraints bound t from above: so many, or what the shaft says. Loops over whole words know it when they
/// are compiled; what tests less is compiled once for all shafts.
inline constexpr unsigned any_uppers = 7;
template <class L, unsigned known>
struct Uppers {
  static constexpr unsigned count = known;
  explicit Uppers(const ShaftData& /*shaft*/) noexcept {}
};
template <class L>
struct Uppers<L, any_uppers> {
  unsigned count;
  explicit Uppers(const ShaftData& shaft) noexcept : count(shaft.slab_uppers) {}
};

/// A compiled shaft's slab constraints in registers, those that bound t from above first.
template <class L, unsigned known_uppers, ShaftData::SlabForm form>
struct Slab {
  static constexpr bool fused = form == ShaftData::SlabForm::fused;
  static constexpr bool relative = form == ShaftData::SlabForm::relative;
  static constexpr bool endless = form == ShaftData::SlabForm::endless;
  using Vector = typename L::Vector;
  Vector scale[6];
  Vector shift[6];
  Vector begin;
  Vector end;
  Vector margin;
  Vector two_margins;
  Vector narrower;  ///< 1 ∓ the margin, in the relative form
  Vector wider;
  Vector direction;  ///< of the first face, in the endless form: −0 if it moves down
  [[no_unique_address]] Uppers<L, known_uppers> uppers;

  Slab(const ShaftData& shaft, float error_margin, bool exactly) noexcept
      : margin(L::all(error_margin)), two_margins(L::all(2 * error_margin)), uppers(shaft) {
    const float t_at_a = fused ? shaft.a[0] : 0.0F;
    const float t_at_b = fused ? shaft.b[0] : 1.0F;
    begin = L::all(t_at_a < t_at_b ? t_at_a : t_at_b);
    end = L::all(t_at_a < t_at_b ? t_at_b : t_at_a);
    for (unsigned i = 0; i < 6; ++i) {
      scale[i] = L::all(shaft.slab_scale[i]);
      shift[i] = L::all(shaft.slab_shift[i]);
    }
    if constexpr (relative) {
      end = L::all(TravelFromNearer<L>(shaft).length);
      narrower = L::all(1 - error_margin);
      wider = L::all(1 + error_margin);
      two_margins = L::all(FLT_MAX);
    }
    if constexpr (endless) {  // lower bounds carry the margin
      float denormals = relative_denormals;
      if (!exactly) {  // corners of spheres are rounded once more, relatively to where they are
        float largest = 0;
        for (unsigned i = 0; i < 6; ++i) {
          const float shifted = fabsf(shaft.slab_shift[i] * shaft.slab_scale[i]);
          if (shifted <= FLT_MAX) largest = shifted > largest ? shifted : largest;  // purple faces need none
        }
        denormals += endless_corner_margin * largest;
      }
      begin = L::all(-denormals);
      end = L::all(FLT_MAX);
      direction = L::all(shaft.slab_scale[0] < 0 ? -0.0F : 0.0F);
      narrower = L::all(-(1 + endless_kept_per_margin * error_margin));
      margin = L::all(3 * denormals);
      two_margins = L::all(FLT_MAX);
      for (unsigned i = uppers.count; i < 6; ++i) scale[i] = L::all(shaft.slab_scale[i] * (1 - error_margin));
    }
    if constexpr (fused) {  // lower bounds carry the margin
      begin = L::subtract(begin, margin);
      for (unsigned i = uppers.count; i < 6; ++i) shift[i] = L::subtract(shift[i], margin);
    }
  }

  /// The bound on t that coordinate x puts through constraint i.
  [[nodiscard]] Vector bound(unsigned i, Vector x) const noexcept {
    if constexpr (fused) {
      return i == 0 ? x : L::multiply_add(x, scale[i], shift[i]);
    } else if constexpr (endless) {
      const Vector distance = L::subtract(x, shift[i]);
      return i == 0             ? L::flip_sign(distance, direction)
             : i < uppers.count ? L::multiply(distance, scale[i])
                                : L::multiply_add(distance, scale[i], begin);
    } else {
      return L::multiply(L::subtract(x, shift[i]), scale[i]);
    }
  }

  /// Length of the interval of t that all constraints allow, plus the margin: smallest upper bound − largest lower
  /// bound + margin. Negative if certainly outside, above two margins if certainly not. coordinate(i) is what
  /// constraint i reads. Never NaN, because minimum and maximum pass over a NaN in their first argument. A bound that
  /// is read and not computed may be a signalling NaN. Of zeros either will do: no margin is so close
  /// (docs/exactness.md).
  template <class Coordinate>
  [[nodiscard]] Vector interval_length(Coordinate coordinate) const noexcept {
    if constexpr (endless) {
      Vector excess;
      const Vector length = endless_length(coordinate, excess);
      return L::choose(L::less_equal(L::all(0.0F), excess), L::all(INFINITY), length);
    }
    // Its own loop, not one that endless_length() shares: g++ 12 then puts four scalar lanes into a register.
    Vector upper = end;
    Vector lower = begin;
    SHAFTCULL_UNROLL(6)
    for (unsigned i = 0; i < 6; ++i) {
      const Vector t = bound(i, coordinate(i));
      if (i < uppers.count) {
        upper = fused && i == 0 ? L::minimum(t, upper) : L::minimum_of_computed(t, upper);
      } else {
        lower = L::maximum_of_computed(t, lower);
      }
    }
    if constexpr (fused) {
      return L::subtract(upper, lower);
    } else if constexpr (relative) {
      // No length here, but with the same signs: +∞ if certainly not outside, negative if certainly outside, else
      // undecided.
      const Vector least = L::multiply_add(upper, narrower, L::all(-relative_denormals));
      const Vector most = L::multiply_add(upper, wider, L::all(relative_denormals));
      return L::choose(L::less_equal(lower, least), L::all(INFINITY), L::subtract(most, lower));
    } else {
      return L::subtract(margin, L::subtract(lower, upper));
    }
  }

  /// The same in the endless form: negative if certainly outside. If not, then `excess` is negative unless it is
  /// certainly not outside.
  template <class Coordinate>
  [[nodiscard]] Vector endless_length(Coordinate coordinate, Vector& excess) const noexcept {
    Vector upper = end;
    Vector lower = begin;
    SHAFTCULL_UNROLL(6)
    for (unsigned i = 0; i < 6; ++i) {
      const Vector t = bound(i, coordinate(i));
      if (i < uppers.count) {
        upper = L::minimum(t, upper);
      } else {
        lower = L::maximum(t, lower);
      }
    }
    lower = L::minimum(lower, end);  // of bounds that are met later than at any float, if they are infinite
    excess = L::multiply_add(lower, narrower, L::subtract(upper, margin));
    return L::subtract(upper, lower);
  }
};

/// What the constraints of a shaft read: a corner of each box.
template <class L>
struct BoxCorners {
  static constexpr bool exactly = true;
  static constexpr bool has_radius = false;
  using Vector = typename L::Vector;
  const float* x[6];

  BoxCorners(const ShaftData& shaft, const float* const* box) noexcept {
    for (unsigned i = 0; i < 6; ++i) x[i] = box[shaft.slab_near[i]];
  }
  template <class Word>
  [[nodiscard]] Vector coordinate(unsigned i, const Word& word, std::size_t at, std::size_t lane) const noexcept {
    return word.load(x[i], at, lane);
  }
};

/// Likewise of boxes around spheres. Later stages test the spheres themselves.
template <class L>
struct BoxedSphereCorners : BoxCorners<L> {
  static constexpr bool exactly = false;
  using BoxCorners<L>::BoxCorners;
};

/// Likewise of spheres that come without boxes around them.
template <class L>
struct SphereCorners {
  static constexpr bool exactly = false;
  static constexpr bool has_radius = true;  // if negative, the sphere is outside
  using Vector = typename L::Vector;
  const float* centre[6];
  const float* radius;
  Vector sign[6];  // of the radius: −0 where a constraint reads the lo corner

  SphereCorners(const ShaftData& shaft, const float* const* sphere) noexcept : radius(sphere[3]) {
    for (unsigned i = 0; i < 6; ++i) {
      centre[i] = sphere[shaft.slab_near[i] % 3];
      sign[i] = L::all(shaft.slab_near[i] < 3 ? -0.0F : 0.0F);
    }
  }
  template <class Word>
  [[nodiscard]] Vector coordinate(unsigned i, const Word& word, std::size_t at, std::size_t lane) const noexcept {
    return L::add(word.load(centre[i], at, lane), L::flip_sign(word.load(radius, at, lane), sign[i]));
  }
};

/// Positions of consecutive words. operator()(w) is the position of the first bound of word w.
template <class L>
struct ConsecutiveWords {
  std::size_t first = 0;
  unsigned rest = 0;  ///< bounds of one more word, which they do not fill

  std::size_t operator()(std::size_t w) const noexcept { return first + w * word_bits; }
};

/// Writes the kept bits of the words from `first` on that `undecided` has a bit for. It makes what it reads of the
/// shaft anew: what the caller has stays in registers, which it would have to store for each call to refer to.
template <class L, ShaftData::SlabForm form, class Words, class Word>
SHAFTCULL_COLD void resolve_slab_words(const ShaftData& shaft, float margin, const float* const* stream,
                                       const Words& position, std::size_t first, std::uint64_t undecided,
                                       const Word& word, std::uint64_t* kept) noexcept {
  const Slab<L, any_uppers, form> slab(shaft, margin, true);
  const BoxCorners<L> corners(shaft, stream);
  for (; undecided != 0; undecided &= undecided - 1) {
    const std::size_t w = first + static_cast<unsigned>(trailing_zeros(undecided));
    const std::size_t at = position(w);
    std::uint64_t outside = 0;
    std::uint64_t near = 0;
    for (unsigned lane = 0; lane < word.bounds; lane += L::width) {
      const auto length =
          word.choose(lane, slab.interval_length([&](unsigned i) { return corners.coordinate(i, word, at, lane); }),
                      L::all(outside_for_certain));
      outside |= L::bits(L::less(length, L::all(0.0F))) << lane;
      near |= L::bits(L::less_equal(length, slab.two_margins)) << lane;
    }
    near &= ~outside;
    if (near != 0) {
      const SlabPredicate exact(shaft);
      outside |=
          decide_lanes<L>(near, [&](unsigned lane) { return exact.outside(BoundAt<L, 6>(stream, at + lane).value); });
    }
    kept[w] = ~outside & word.lanes();
  }
}

/// Writes the kept bits of the word at `at`: exactly, or without the bits of those that are outside for certain.
/// Returns whether a lane is undecided, so that the word's bits mean nothing yet.
template <class L, class SlabType, class Corners, class Word>
SHAFTCULL_ALWAYS_INLINE [[nodiscard]] inline bool slab_word(const SlabType& slab, const Corners& corners,
                                                            std::size_t at, const Word& word,
                                                            std::uint64_t& kept) noexcept {
  std::uint64_t outside = 0;
  if constexpr (SlabType::endless && Corners::exactly) {
    std::uint64_t undecided = 0;
    for (std::size_t four = 0; four < word.bounds; four += 4 * L::width) {
      typename L::Vector length[4];
      typename L::Vector excess[4];
      SHAFTCULL_UNROLL(4)
      for (unsigned v = 0; v < 4; ++v) {
        length[v] = slab.endless_length(
            [&](unsigned i) { return corners.coordinate(i, word, at, four + v * L::width); }, excess[v]);
        length[v] = word.choose(four + v * L::width, length[v], L::all(outside_for_certain));
      }
      const std::uint64_t negative = L::signs(length);
      outside |= negative << four;
      undecided |= L::signs(excess) & ~negative;
    }
    kept = ~outside & word.lanes();
    return undecided != 0;
  }
  typename L::SignCollector signs(slab.two_margins);
  // Of vectors that fill a word four at a time, the compiler sees here that they do.
  for (std::size_t four = 0; four < word_bits && four < word.bounds; four += 4 * L::width) {
    typename L::Vector length[4];
    SHAFTCULL_UNROLL(4)
    for (unsigned v = 0; v < 4; ++v) {
      // Not by way of an object for the vector: with one, g++ 12 does not put four scalar lanes into a register.
      length[v] =
          slab.interval_length([&](unsigned i) { return corners.coordinate(i, word, at, four + v * L::width); });
      if constexpr (Corners::has_radius) {
        length[v] = L::either_negative(length[v], word.load(corners.radius, at, four + v * L::width));
      }
      length[v] = word.choose(four + v * L::width, length[v], L::all(outside_for_certain));
    }
    if constexpr (Corners::exactly) {
      outside |= signs.collect(length) << four;
    } else {
      outside |= L::signs(length) << four;
    }
  }
  kept = ~outside & word.lanes();
  if constexpr (Corners::exactly) {
    return signs.any_undecided();
  } else {
    return false;
  }
}

/// What is not the loop over whole words is compiled for each number of uppers only where calls for few bounds are
/// common: for shafts between two boxes, and boxes and spheres as they come. There it makes them a quarter faster; for
/// all others it would double what a set takes to compile.
template <template <class> class Corners, unsigned uppers, ShaftData::SlabForm form>
inline constexpr unsigned uppers_of_few = (form == ShaftData::SlabForm::fused ||
                                           form == ShaftData::SlabForm::difference)
                                              ? uppers
                                              : any_uppers;
template <unsigned uppers, ShaftData::SlabForm form>
inline constexpr unsigned uppers_of_few<BoxedSphereCorners, uppers, form> = any_uppers;

/// Writes the kept bits of the rest behind whole words, as slab_words(). Apart from those, whose loop would be five
/// times as long with it.
template <class L, template <class> class Corners, unsigned uppers, ShaftData::SlabForm form, class Words>
SHAFTCULL_NOINLINE void slab_rest(const ShaftData& shaft, float margin, const float* const* stream,
                                  const Words& position, std::size_t words, std::uint64_t* kept) noexcept {
  const Slab<L, uppers, form> slab(shaft, margin, Corners<L>::exactly);
  const Corners<L> corners(shaft, stream);
  const PartialWord<L> rest{position.rest};
  const bool is_undecided = slab_word<L>(slab, corners, position(words), rest, kept[words]);
  if constexpr (Corners<L>::exactly) {
    if (is_undecided) [[unlikely]] {
      resolve_slab_words<L, form>(shaft, margin, stream, position, words, 1, rest, kept);
    }
  }
}

/// Writes the kept bits of `words` whole words, and of the rest behind them if there is one: exactly, or clears the
/// bits of those that are outside for certain.
template <class L, template <class> class Corners, class Words, unsigned uppers, ShaftData::SlabForm form>
void slab_words(const ShaftData& shaft, float margin, const float* const* stream, const Words& position,
                std::size_t words, std::uint64_t* kept) noexcept {
  if constexpr (requires { position.rest; }) {
    if (position.rest != 0) {
      slab_rest<L, Corners, uppers_of_few<Corners, uppers, form>, form>(shaft, margin, stream, position, words, kept);
    }
    if (words == 0) return;
  }
  const Slab<L, uppers, form> slab(shaft, margin, Corners<L>::exactly);
  const Corners<L> corners(shaft, stream);
  for (std::size_t first = 0; first < words; first += word_bits) {
    const std::size_t some = words - first < word_bits ? words - first : word_bits;
    std::uint64_t undecided = 0;  // a bit a word
    for (std::size_t w = 0; w < some; ++w) {
      const bool is_undecided = slab_word<L>(slab, corners, position(first + w), WholeWord<L>{}, kept[first + w]);
      undecided |= std::uint64_t{is_undecided} << w;
    }
    if constexpr (Corners<L>::exactly) {
      if (undecided != 0) [[unlikely]] {
        resolve_slab_words<L, form>(shaft, margin, stream, position, first, undecided, WholeWord<L>{}, kept);
      }
    }
  }
}

/// Of some lanes of the word at `at` those that are kept.
template <class L>
std::uint64_t exactly_kept(const SlabPredicate& exact, const float* const* stream, std::size_t at,
                           std::uint64_t lanes) noexcept {
  return lanes &
         ~decide_lanes<L>(lanes, [&](unsigned lane) { return exact.outside(BoundAt<L, 6>(stream, at + lane).value); });
}

/// For shafts that no margin holds for.
template <class L, class Words>
void box_exact_words(const ShaftData& shaft, const float* const* stream, const Words& position, std::size_t words,
                     std::uint64_t* kept) noexcept {
  const SlabPredicate exact(shaft);
  for (std::size_t w = 0; w < words; ++w) kept[w] = exactly_kept<L>(exact, stream, position(w), ~std::uint64_t{0});
  if constexpr (requires { position.rest; }) {
    if (position.rest != 0) kept[words] = exactly_kept<L>(exact, stream, position(words), first_bits(position.rest));
  }
}

/// Calls Test::run<uppers, form> with what suits a shaft: its form, and how many constraints bound t from above. In the
/// fused form the reference face's always does. Spheres are tested in the fused and the endless form alone
/// (outside_needs_planes()).
template <class Test, class... Arguments>
void with_slab_of(const ShaftData& shaft, Arguments... arguments) noexcept {
  using enum ShaftData::SlabForm;
  using Run = void(const ShaftData&, Arguments...) noexcept;
  if constexpr (Test::exactly) {
    if (shaft.slab_form == relative) return Test::template run<any_uppers, relative>(shaft, arguments...);
    static constexpr Run* difference_by_uppers[7] = {
        Test::template run<0, difference>, Test::template run<1, difference>, Test::template run<2, difference>,
        Test::template run<3, difference>, Test::template run<4, difference>, Test::template run<5, difference>,
        Test::template run<6, difference>};
    if (shaft.slab_form == difference) return difference_by_uppers[shaft.slab_uppers](shaft, arguments...);
  }
  // A box that moves without end has a face that bounds t from above, and one that bounds it from below.
  static constexpr Run* endless_by_uppers[7] = {nullptr,
                                                Test::template run<1, endless>,
                                                Test::template run<2, endless>,
                                                Test::template run<3, endless>,
                                                Test::template run<4, endless>,
                                                Test::template run<5, endless>,
                                                nullptr};
  if (shaft.slab_form == endless) return endless_by_uppers[shaft.slab_uppers](shaft, arguments...);
  static constexpr Run* fused_by_uppers[7] = {nullptr,
                                              Test::template run<1, fused>,
                                              Test::template run<2, fused>,
                                              Test::template run<3, fused>,
                                              Test::template run<4, fused>,
                                              Test::template run<5, fused>,
                                              Test::template run<6, fused>};
  fused_by_uppers[shaft.slab_uppers](shaft, arguments...);
}

/// Words of a stream, most of which hold no bound that is undecided.
template <class L, template <class> class Corners, class Words>
struct TestSlabWords {
  static constexpr bool exactly = Corners<L>::exactly;

  /// Itself, not a function that calls it: that takes a sixth of a call for one word.
  template <unsigned uppers, ShaftData::SlabForm form>
  static constexpr auto* run = slab_words<L, Corners, Words, uppers, form>;
};

/// First stage of the slab form: writes the kept bits of `words` whole words, and of the rest behind them if there is
/// one.
template <class L, class Words = ConsecutiveWords<L>>
void box_slab_stage(const ShaftData& shaft, const float* const* stream, std::size_t words, std::uint64_t* kept,
                    const Words& position = {}) noexcept {
  if (shaft.slab_form == ShaftData::SlabForm::exact) [[unlikely]] {
    return box_exact_words<L>(shaft, stream, position, words, kept);
  }
  with_slab_of<TestSlabWords<L, BoxCorners, Words>, float, const float* const*, const Words&>(
      shaft, shaft.slab_margin, stream, position, words, kept);
}

/// The kept bits of one word of boxes at `at`, of which some are probably undecided.
template <class L, class Word>
std::uint64_t undecided_slab_word(const ShaftData& shaft, const float* const* stream, std::size_t at,
                                  const Word& word) noexcept {
  using enum ShaftData::SlabForm;
  if (shaft.slab_form == exact) [[unlikely]] {
    const SlabPredicate exact(shaft);
    return exactly_kept<L>(exact, stream, at, word.lanes());
  }
  std::uint64_t kept;
  const auto resolve = [&]<ShaftData::SlabForm form>() {
    resolve_slab_words<L, form>(shaft, shaft.slab_margin, stream, ConsecutiveWords<L>{.first = at}, 0, 1, word, &kept);
  };
  switch (shaft.slab_form) {
    case relative:
      resolve.template operator()<relative>();
      break;
    case difference:
      resolve.template operator()<difference>();
      break;
    case endless:
      resolve.template operator()<endless>();
      break;
    default:
      resolve.template operator()<fused>();
      break;
  }
  return kept;
}

/// Likewise for spheres, or boxes around them, and a shaft in the fused or the endless form: clears the bits of those
/// that are outside for certain. Their corners are rounded once more than those of boxes: 22 and 14 units instead of 20
/// and 12 (docs/exactness.md).
template <class L, template <class> class Corners, class Words = ConsecutiveWords<L>>
void sphere_slab_stage(const ShaftData& shaft, const float* const* stream, std::size_t words, std::uint64_t* kept,
                       const Words& position = {}) noexcept {
  constexpr float wider = 1.17F;
  with_slab_of<TestSlabWords<L, Corners, Words>, float, const float* const*, const Words&>(
      shaft, wider * shaft.slab_margin, stream, position, words, kept);
}

}  // namespace shaftcull::kernel
