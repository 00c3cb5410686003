// SPDX-License-Identifier: MIT
/// Picking indices of leaves by bits: on every instruction set, and nothing else is read or written.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "dispatch/active_kernels.hpp"
#include "instruction_sets.hpp"
#include "kernels/kernel_table.hpp"
#include "oracle/random.hpp"
#include "tree/kept_leaves.hpp"
#include "tree/leaf_indices.hpp"

namespace shaftcull {
namespace {

constexpr std::uint32_t untouched = 0xffffffff;
constexpr std::size_t space = 64;
constexpr std::size_t margin = 16;

/// Words of which some share of bits is set, none and all among them.
std::vector<std::uint64_t> words_of_bits() {
  std::vector<std::uint64_t> words{0, ~std::uint64_t{0}, 1, std::uint64_t{1} << 63, 0xffff, 0xffff'0000'0000'0000};
  Random random(112);
  for (const unsigned percent : {2U, 10U, 50U, 90U}) {
    for (unsigned i = 0; i != 100; ++i) {
      std::uint64_t word = 0;
      for (unsigned bit = 0; bit != 64; ++bit)
        word |= static_cast<std::uint64_t>(random.below(100) < percent ? 1 : 0) << bit;
      words.push_back(word);
    }
  }
  return words;
}

std::vector<std::uint32_t> those_of(const std::vector<std::uint32_t>& order, std::size_t first, std::uint64_t bits) {
  std::vector<std::uint32_t> picked;
  for (std::size_t i = 0; i != 64; ++i) {
    if ((bits >> i & 1) != 0) picked.push_back(order[first + i]);
  }
  return picked;
}

TEST(CompressIndices, WritesThoseOfSetBitsInOrderAndKeepsToItsRoom) {
  Random random(113);
  std::vector<std::uint32_t> from(64);
  for (std::uint32_t& index : from) index = random.below(0xffffffff);  // as floats, NaNs among them
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const std::uint64_t bits : words_of_bits()) {
      std::vector<std::uint32_t> out(margin + space + margin, untouched);
      const std::size_t picked = kernel::active_kernels().compress_indices(from.data(), bits, out.data() + margin);
      const auto start = out.begin() + margin;
      ASSERT_EQ(std::vector(start, start + static_cast<std::ptrdiff_t>(picked)), those_of(from, 0, bits)) << name(isa);
      ASSERT_EQ(std::vector(out.begin(), start), std::vector(margin, untouched)) << name(isa);
      ASSERT_EQ(std::vector(start + space, out.end()), std::vector(margin, untouched)) << name(isa);
    }
  }
}

/// Trees have a last word that is not whole.
TEST(LeafIndices, ArePickedInTheLastWordToo) {
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const std::size_t size : {1U, 63U, 64U, 65U, 100U, 128U}) {
      std::vector<std::uint32_t> order(size);
      std::iota(order.rbegin(), order.rend(), std::uint32_t{7});
      order.shrink_to_fit();
      const kernel::LeafIndices indices(order, true, kernel::active_kernels());
      for (std::uint64_t bits : words_of_bits()) {
        const std::size_t first = (size - 1) / 64 * 64;
        if (size - first < 64) bits &= (std::uint64_t{1} << (size - first)) - 1;
        std::vector<std::uint32_t> out(space);
        indices.prefetch(first);
        out.resize(indices.compress(first, bits, out.data()));
        ASSERT_EQ(out, those_of(order, first, bits)) << size << " leaves, " << name(isa);
      }
    }
  }
}

/// Lists of many shafts are written side by side, each by whoever has its turn.
TEST(LeafIndices, OfWhatWasFoundAreWrittenInOrderAndNothingElseIs) {
  constexpr std::size_t whole = 3000;  // words: more than one chunk of memory holds
  constexpr std::size_t size = 64 * whole + 17;
  std::vector<std::uint32_t> order(size);
  std::iota(order.rbegin(), order.rend(), std::uint32_t{7});
  const std::vector<std::uint64_t> words = words_of_bits();
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    const kernel::LeafIndices indices(order, true, kernel::active_kernels());
    for (const std::size_t last : {std::size_t{0}, std::size_t{1}, std::size_t{200}, whole}) {
      kernel::KeptLeavesOutput found;
      std::vector<std::uint32_t> expected;
      for (std::size_t w = 0; w <= last; ++w) {
        const std::uint64_t bits =
            words[w % words.size()] & (w == whole ? 0x1ffff : ~std::uint64_t{0});  // 17 leaves in the last word
        found.add_word(64 * w, bits);
        const std::vector<std::uint32_t> those = those_of(order, 64 * w, bits);
        expected.insert(expected.end(), those.begin(), those.end());
        if (w % 50 != 40 || w + 64 > whole) continue;
        found.add_range(64 * (w + 1), 64 * 3);
        expected.insert(expected.end(), order.begin() + static_cast<std::ptrdiff_t>(64 * (w + 1)),
                        order.begin() + static_cast<std::ptrdiff_t>(64 * (w + 4)));
      }
      ASSERT_EQ(found.count(), expected.size());
      std::vector<std::uint32_t> out(expected.size() + space, std::uint32_t{untouched});
      found.write(indices, out.data());
      ASSERT_EQ(std::vector(out.end() - space, out.end()), std::vector(space, std::uint32_t{untouched})) << name(isa);
      out.resize(expected.size());
      ASSERT_EQ(out, expected) << last << ", " << name(isa);
    }
  }
}

}  // namespace
}  // namespace shaftcull
