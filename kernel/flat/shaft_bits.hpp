// SPDX-License-Identifier: MIT
/// One bit for each shaft: a task tests its bounds tile by tile, each with those shafts only whose bit is not set yet.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "flat/shaft_tests.hpp"
#include "flat/tiling.hpp"
#include "parallel/parallel.hpp"
#include "parallel/shared_number.hpp"

namespace shaftcull::kernel {

/// Sets bit s, one of bit_words(shafts) words, iff shaft s keeps a bound.
inline void find_by_shaft(const ShaftTests& tests, std::span<std::uint64_t> found_bits) {
  std::fill(found_bits.begin(), found_bits.end(), 0);
  const Tiling tiling(tests.bounds().count, tests.shafts().size());
  static_assert(group_shafts == std::numeric_limits<std::uint64_t>::digits, "a group's bits are one word");
  parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    const IndexRange block = tiling.block(b);
    const IndexRange group = tiling.group(g);
    const std::uint64_t all = ~std::uint64_t{0} >> (group_shafts - group.size);
    const SharedNumber<std::uint64_t> found(found_bits[g]);
    for (std::size_t first = block.first; first != block.end();) {
      const std::size_t size = std::min(float_tile_bounds, block.end() - first);
      std::uint64_t found_here = 0;
      std::uint64_t left = all & ~found.load();
      if (left == 0) return;
      for (; left != 0; left &= left - 1) {
        const auto s = static_cast<std::size_t>(std::countr_zero(left));
        std::uint64_t bits[bit_words(float_tile_bounds)];
        tests.test_tile(group.first + s, first, size, bits);
        const bool is_any = std::any_of(bits, bits + bit_words(size), [](std::uint64_t word) { return word != 0; });
        found_here |= std::uint64_t{is_any} << s;
      }
      found.set_bits(found_here);
      first += size;
    }
  });
}

}  // namespace shaftcull::kernel
