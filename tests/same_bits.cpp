// SPDX-License-Identifier: MIT
/// Answers to made-up cases that are on record: every compiler, optimisation level, instruction set, form and way to
/// ask must give them.
#include <gtest/gtest.h>

#include "hashes/hashes.hpp"
#include "instruction_sets.hpp"

namespace shaftcull {
namespace {

using hashes::Family;
using hashes::Way;

TEST(SameBits, EveryBuildInstructionSetAndWayGivesTheAnswersOnRecord) {
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const Family& family : hashes::families()) {
      for (const Way way : family.ways) {
        const char* const text = way == Way::slab ? "slab form" : way == Way::planes ? "plane form" : "many";
        EXPECT_EQ(family.hash_of(family.few, way), family.hash_of_few)
            << name(isa) << ", " << family.name << ", " << text;
      }
    }
  }
}

}  // namespace
}  // namespace shaftcull
