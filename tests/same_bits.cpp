// SPDX-License-Identifier: MIT
/// Answers to made-up cases that are on record: every compiler, optimisation level, instruction set, form and way to
/// ask must give them.
#include <gtest/gtest.h>

#include "hashes/hashes.hpp"
#include "instruction_sets.hpp"

namespace shaftcull {
namespace {

using hashes::Deviation;
using hashes::Family;
using hashes::Way;

TEST(SameBits, EveryBuildInstructionSetAndWayGivesTheAnswersOnRecord) {
  for (const Family& family : hashes::families()) {
    for (const Deviation& found : hashes::deviations(family, true, isas_under_test())) {
      ADD_FAILURE() << family.name << ": " << found.hash << " and not " << family.hash_of_few << " on "
                    << name(found.isa) << ", " << name(found.way);
    }
  }
}

TEST(SameBits, AHashThatDiffersIsTold) {
  constexpr Way ways[] = {Way::slab, Way::planes, Way::many};
  const auto hash_of = [](std::uint64_t scenes, Way way) { return scenes + (way == Way::planes ? 1 : 0); };
  const Family family{"made up", "", ways, hash_of, 10, 20, 10, 21};
  const std::vector<Isa> isas = isas_under_test();
  const std::vector<Deviation> of_few = hashes::deviations(family, true, isas);
  ASSERT_EQ(of_few.size(), isas.size());
  for (std::size_t i = 0; i != isas.size(); ++i) {
    EXPECT_EQ(of_few[i].isa, isas[i]);
    EXPECT_EQ(of_few[i].way, Way::planes);
    EXPECT_EQ(of_few[i].hash, 11U);
  }
  EXPECT_EQ(hashes::deviations(family, false, isas).size(), 2 * isas.size());
}

}  // namespace
}  // namespace shaftcull
