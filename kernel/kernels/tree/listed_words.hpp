// SPDX-License-Identifier: MIT
/// Whole words of bounds, wherever they lie: what a walk through a bounds tree asks at each level.
#pragma once

#include "kernels/boxes/slab_stages.hpp"
#include "kernels/hulls/hull_stages.hpp"
#include "kernels/kernel_table.hpp"
#include "kernels/shared/survivors.hpp"
#include "kernels/shared/word.hpp"
#include "kernels/spheres/sphere_planes.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// Where the words of a list begin.
template <class L>
struct ListedWords {
  const std::uint32_t* word;

  std::size_t operator()(std::size_t w) const noexcept { return std::size_t{word[w]} * word_bits; }
};

/// Calls use(stream, i) for every word i of a list that still has bits, with the streams from its first bound on.
template <class L, unsigned streams, class Use>
void for_each_word(const float* const* stream, const std::uint32_t* word, std::size_t words, const std::uint64_t* bits,
                   unsigned least, Use use) noexcept {
  for (std::size_t i = 0; i < words; ++i) {
    if (static_cast<unsigned>(popcount(bits[i])) < least) continue;
    const float* at[streams];
    for (unsigned s = 0; s < streams; ++s) at[s] = stream[s] + std::size_t{word[i]} * word_bits;
    use(at, i);
  }
}

/// Runs stage(stream, words, bits), which clears bits, on the bounds of listed words whose bits are set.
template <class L, unsigned streams, class Stage>
void run_on_listed_survivors(const float* const* stream, const std::uint32_t* word, std::size_t words,
                             std::uint64_t* bits, Stage stage) noexcept {
  for_each_word<L, streams>(stream, word, words, bits, 1, [&](const float* const* at, std::size_t i) {
    run_on_survivors<L, streams>(at, word_bits, bits + i, stage);
  });
}

/// As HullStages::cull_boxes, for words of a list; not inlined for the same reason.
template <class L>
SHAFTCULL_NOINLINE void cull_listed_by_hull(const ShaftData& shaft, const float* const* stream,
                                            const std::uint32_t* word, std::size_t words,
                                            std::uint64_t* kept) noexcept {
  const HullData& hull = *shaft.hull;
  first_hull_stage<L>(hull, stream, words, kept, ListedWords<L>{word});
  if (!has_one_stage(hull)) {
    run_on_listed_survivors<L, 6>(stream, word, words, kept,
                                  [&](const float* const* some, std::size_t n, std::uint64_t* bits) {
                                    hull_edges_stage<L>(hull, some, n, bits);
                                  });
  }
  if (!shaft.is_open_hull()) [[likely]]
    return;
  for_each_word<L, 6>(stream, word, words, kept, 1, [&](const float* const* at, std::size_t i) {
    HullStages<L>::cull_touching_boxes(hull, at, word_bits, kept + i);
  });
}

/// As Stages::cull, for words of a list.
template <class L, class Stages>
void cull_listed_words(const ShaftData& shaft, const float* const* stream, const std::uint32_t* word, std::size_t words,
                       std::uint64_t* kept) noexcept {
  const ListedWords<L> position{word};
  if constexpr (Stages::streams == 6) {
    if (shaft.is_hull()) [[unlikely]]
      return cull_listed_by_hull<L>(shaft, stream, word, words, kept);
  }
  if (Stages::needs_planes(shaft)) {
    for (std::size_t i = 0; i < words; ++i) {
      const float* at[Stages::streams];
      const std::size_t first = position(i);
      for (unsigned s = 0; s < Stages::streams; ++s) at[s] = stream[s] + first;
      Stages::cull(shaft, at, word_bits, kept + i);
    }
  } else if constexpr (Stages::streams == 6) {
    box_slab_stage<L>(shaft, stream, words, kept, position);
    if (Stages::is_finished(shaft)) return;
    run_on_listed_survivors<L, 6>(stream, word, words, kept,
                                  [&](const float* const* some, std::size_t n, std::uint64_t* bits) {
                                    Stages::finish_words(shaft, some, n, bits);
                                  });
  } else {
    sphere_slab_stage<L, SphereCorners>(shaft, stream, words, kept, position);
    run_on_listed_survivors<L, 4>(stream, word, words, kept,
                                  [&](const float* const* some, std::size_t n, std::uint64_t* bits) {
                                    sphere_distance_stage<L>(shaft, some, n, bits);
                                  });
  }
}

/// The test of listed words, as Kernels has it.
template <class L, class Stages>
void test_listed_words(const ShaftData& shaft, const float* const* stream, const std::uint32_t* word, std::size_t words,
                       std::uint64_t* kept, std::uint64_t* inside, unsigned least_kept) noexcept {
  cull_listed_words<L, Stages>(shaft, stream, word, words, kept);
  if (inside == nullptr) return;
  for (std::size_t i = 0; i < words; ++i) inside[i] = 0;
  for_each_word<L, Stages::streams>(stream, word, words, kept, least_kept, [&](const float* const* at, std::size_t i) {
    Stages::find_inside(shaft, at, word_bits, kept + i, inside + i);
  });
}

}  // namespace shaftcull::kernel
