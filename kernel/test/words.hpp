/// Whole words of bounds, wherever they lie: what a walk through a bounds tree asks at each level.
#pragma once

#include "simd/float_environment.hpp"
#include "test/box_slab.hpp"
#include "test/kernels.hpp"
#include "test/word.hpp"

namespace shaftcull::kernel {

/// Words ahead of the one tested whose bounds are prefetched.
inline constexpr std::size_t prefetched_words = 2;

template <class L, unsigned streams>
void prefetch_word(const float* const* stream, std::uint32_t word) noexcept {
  for (unsigned s = 0; s < streams; ++s) {
    const float* const start = stream[s] + std::size_t{word} * word_bits;
    for (unsigned i = 0; i < word_bits; i += 16) __builtin_prefetch(start + i);
  }
}

/// The test of listed words, as Kernels has it.
template <class L, class Stages>
void test_listed_words(const CompiledShaft& shaft, const float* const* stream, const std::uint32_t* word,
                       std::size_t words, std::uint64_t* kept, std::uint64_t* inside, unsigned least_kept) noexcept {
  const FloatEnvironment<L> environment;
  for (std::size_t i = 0; i < words && i < prefetched_words; ++i) prefetch_word<L, Stages::streams>(stream, word[i]);
  for (std::size_t i = 0; i < words; ++i) {
    if (i + prefetched_words < words) prefetch_word<L, Stages::streams>(stream, word[i + prefetched_words]);
    const float* at[Stages::streams];
    for (unsigned s = 0; s < Stages::streams; ++s) at[s] = stream[s] + std::size_t{word[i]} * word_bits;
    Stages::cull(shaft, at, 1, kept + i);
    if (inside == nullptr) continue;
    inside[i] = 0;
    if (static_cast<unsigned>(__builtin_popcountll(kept[i])) < least_kept) continue;
    inside[i] = kept[i];
    Stages::contain(shaft, at, 1, inside + i);
  }
}

}  // namespace shaftcull::kernel
