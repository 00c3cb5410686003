// SPDX-License-Identifier: MIT
/// Words of bits as lists of positions: the same on every instruction set, whatever share of bits is set.
#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "dispatch/active_kernels.hpp"
#include "instruction_sets.hpp"
#include "kernels/kernel_table.hpp"
#include "oracle/random.hpp"

namespace shaftcull {
namespace {

TEST(SetBits, AreCountedAndListedInOrder) {
  constexpr std::uint32_t untouched = 0xffffffff;
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    const kernel::SetBits& set_bits = kernel::active_kernels().set_bits;
    Random random(111);
    for (const unsigned percent : {0U, 1U, 2U, 4U, 9U, 30U, 70U, 99U, 100U}) {
      for (std::size_t count = 0; count != 70; ++count) {
        std::vector<std::uint64_t> words(count);
        std::vector<std::uint32_t> right;
        for (std::uint32_t i = 0; i != 64 * count; ++i) {
          if (random.below(100) >= percent) continue;
          words[i / 64] |= std::uint64_t{1} << i % 64;
          right.push_back(i);
        }
        ASSERT_EQ(set_bits.count(words.data(), count), right.size());
        std::vector<std::uint32_t> listed(right.size() + kernel::set_bits_slack + 1, untouched);
        set_bits.write(words.data(), count, right.size(), listed.data());
        ASSERT_EQ(listed.back(), untouched);
        listed.resize(right.size());
        ASSERT_EQ(listed, right) << percent << " % of " << count << " words on " << name(isa);
      }
    }
  }
}

}  // namespace
}  // namespace shaftcull
