/// Boxes outside the shaft, in slab form: is there a t in [t_begin, t_end] that satisfies all six constraints?
#pragma once

#include "compile/slab.hpp"
#include "exact/predicates.hpp"
#include "test/word.hpp"

namespace shaftcull::kernel {

/// A compiled shaft's slab constraints in registers, `uppers` of them bounding t from above.
template <class L, unsigned uppers, CompiledShaft::SlabForm form>
struct Slab {
  using Vector = typename L::Vector;
  Vector scale[6];
  Vector shift[6];
  Vector begin;
  Vector end;

  explicit Slab(const CompiledShaft& shaft) noexcept
      : begin(L::all(shaft.t_begin)), end(L::all(shaft.t_end)) {
    for (unsigned i = 0; i < 6; ++i) {
      scale[i] = L::all(shaft.slab_scale[i]);
      shift[i] = L::all(shaft.slab_shift[i]);
    }
  }

  /// The bound on t that coordinate x puts through constraint i.
  [[nodiscard]] Vector bound(unsigned i, Vector x) const noexcept {
    if constexpr (form == CompiledShaft::SlabForm::fused) {
      return L::multiply_add(x, scale[i], shift[i]);
    } else {
      return L::multiply(L::subtract(x, shift[i]), scale[i]);
    }
  }

  /// Largest lower bound − smallest upper bound of 8 (or so) boxes: positive outside. Never NaN, because minimum and
  /// maximum pass over a NaN in their first argument.
  [[nodiscard]] Vector gap(const float* const (&x)[6], std::size_t at) const noexcept {
    Vector upper = end;
    Vector lower = begin;
#pragma GCC unroll 6
    for (unsigned i = 0; i < 6; ++i) {
      const Vector t = bound(i, L::load(x[i] + at));
      if (i < uppers) {
        upper = L::minimum(t, upper);
      } else {
        lower = L::maximum(t, lower);
      }
    }
    return L::subtract(lower, upper);
  }
};

/// Bits of the boxes of the word at `at` that are outside, where some lane is too close to call.
template <class L, class SlabType>
[[gnu::noinline, gnu::cold]] std::uint64_t settle_slab_word(const CompiledShaft& shaft, const SlabType& slab,
                                                            const float* const (&x)[6], const float* const* stream,
                                                            std::size_t at) noexcept {
  const auto margin = L::all(shaft.slab_margin);
  std::uint64_t outside = 0;
  std::uint64_t undecided = 0;
  for (unsigned lane = 0; lane < word_bits; lane += L::width) {
    const auto gap = slab.gap(x, at + lane);
    outside |= L::bits(L::less(margin, gap)) << lane;
    undecided |= L::bits(L::less_equal(L::magnitude(gap), margin)) << lane;
  }
  const SlabPredicate exact(shaft);
  return outside | decide_lanes<L>(undecided, [&](unsigned lane) {
           return exact.outside(BoundAt<L, 6>(stream, at + lane).value);
         });
}

template <class L, unsigned uppers, CompiledShaft::SlabForm form>
void box_slab_words(const CompiledShaft& shaft, const float* const* stream, std::size_t words,
                    std::uint64_t* kept) noexcept {
  const Slab<L, uppers, form> slab(shaft);
  const auto margin = L::all(shaft.slab_margin);
  const float* x[6];
  for (unsigned i = 0; i < 6; ++i) x[i] = stream[shaft.slab_near[i]];

  for (std::size_t w = 0; w < words; ++w) {
    const std::size_t at = w * word_bits;
    std::uint64_t outside = 0;
    bool undecided = false;
    if constexpr (L::reads_signs) {
      auto decided = L::all(-1.0F);
      for (unsigned lane = 0; lane < word_bits; lane += L::width) {
        const auto gap = slab.gap(x, at + lane);
        const auto not_outside = L::subtract(margin, gap);  // negative iff gap > margin: float differences have the right sign
        outside |= L::signs(not_outside) << lane;
        decided = L::both_negative(decided, L::either_negative(not_outside, L::add(gap, margin)));
      }
      undecided = L::signs(decided) != (std::uint64_t{1} << L::width) - 1;
    } else {
      auto closest = L::all(__builtin_inff());
      for (unsigned lane = 0; lane < word_bits; lane += L::width) {
        const auto gap = slab.gap(x, at + lane);
        outside |= L::bits(L::less(margin, gap)) << lane;
        closest = L::minimum(L::magnitude(gap), closest);
      }
      undecided = L::bits(L::less_equal(closest, margin)) != 0;
    }
    if (undecided) [[unlikely]] {
      outside = settle_slab_word<L>(shaft, slab, x, stream, at);
    }
    kept[w] = ~outside;
  }
}

/// For shafts that no margin holds for.
template <class L>
void box_exact_words(const CompiledShaft& shaft, const float* const* stream, std::size_t words,
                     std::uint64_t* kept) noexcept {
  const SlabPredicate exact(shaft);
  for (std::size_t w = 0; w < words; ++w) {
    kept[w] = ~decide_lanes<L>(~std::uint64_t{0}, [&](unsigned lane) {
      return exact.outside(BoundAt<L, 6>(stream, w * word_bits + lane).value);
    });
  }
}

/// First stage of the slab form: writes the kept bits of `words` whole words.
template <class L>
void box_slab_stage(const CompiledShaft& shaft, const float* const* stream, std::size_t words,
                    std::uint64_t* kept) noexcept {
  using enum CompiledShaft::SlabForm;
  using Words = void(const CompiledShaft&, const float* const*, std::size_t, std::uint64_t*) noexcept;
  static constexpr Words* by_uppers[2][7] = {
      {box_slab_words<L, 0, fused>, box_slab_words<L, 1, fused>, box_slab_words<L, 2, fused>, box_slab_words<L, 3, fused>,
       box_slab_words<L, 4, fused>, box_slab_words<L, 5, fused>, box_slab_words<L, 6, fused>},
      {box_slab_words<L, 0, difference>, box_slab_words<L, 1, difference>, box_slab_words<L, 2, difference>,
       box_slab_words<L, 3, difference>, box_slab_words<L, 4, difference>, box_slab_words<L, 5, difference>,
       box_slab_words<L, 6, difference>}};
  if (shaft.slab_form == exact) [[unlikely]] return box_exact_words<L>(shaft, stream, words, kept);
  by_uppers[shaft.slab_form == difference][shaft.slab_uppers](shaft, stream, words, kept);
}

}  // namespace shaftcull::kernel
