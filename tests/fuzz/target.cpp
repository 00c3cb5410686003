// SPDX-License-Identifier: MIT
/// The target of libFuzzer: any bytes.
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <span>

#include "fuzz/check.hpp"
#include "fuzz/sights.hpp"
#include "fuzz/trees.hpp"

namespace {

/// One input in so many is compared with exact arithmetic, which takes some fifty times as long.
constexpr unsigned exact_every = 64;

/// And one in so many is put into trees.
constexpr unsigned trees_every = 16;

/// And of one in so many it is asked what its boxes see of each other.
constexpr unsigned sights_every = 64;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::span<const std::uint8_t> input(bytes, size);
  try {
    const auto it = shaftcull::fuzz::Case::read(input);
    // Drawn by content, so that an input that fails fails again.
    const unsigned draw = std::accumulate(input.begin(), input.end(), 0U,
                                          [](unsigned mix, unsigned byte) { return (mix ^ byte) * 0x01000193U; }) >>
                          8U;
    shaftcull::fuzz::check_answers(it, draw);
    if (draw % exact_every == 1) shaftcull::fuzz::check_exact(it, 4);
    if (draw % sights_every == 3) shaftcull::fuzz::check_sights(it);
    if (draw % trees_every == 2) shaftcull::fuzz::check_trees(it);
  } catch (const shaftcull::fuzz::Fault& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    std::abort();
  }
  return 0;
}
