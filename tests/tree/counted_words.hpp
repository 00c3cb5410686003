// SPDX-License-Identifier: MIT
/// How many words of boxes a walk tests.
#pragma once

#include <cstddef>
#include <cstdint>

#include "dispatch/active_kernels.hpp"

namespace shaftcull {

inline std::size_t words_tested = 0;
inline kernel::TestListedWords* real_test = nullptr;

/// The active kernels, which count in `words_tested`, from 0 on, how many words of leaves and nodes they test.
[[nodiscard]] inline kernel::Kernels counting_kernels() {
  kernel::Kernels kernels = kernel::active_kernels();
  real_test = kernels.listed_boxes;
  kernels.listed_boxes = [](const kernel::ShaftData& shaft, const float* const* stream, const std::uint32_t* word,
                            std::size_t words, std::uint64_t* kept, std::uint64_t* inside,
                            unsigned least_kept) noexcept {
    words_tested += words;
    real_test(shaft, stream, word, words, kept, inside, least_kept);
  };
  words_tested = 0;
  return kernels;
}

}  // namespace shaftcull
