// SPDX-License-Identifier: MIT
/// The quick oracle: what it proves is what rationals say, and it proves most answers.
#include "oracle/quick_hull.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "oracle/cases/families.hpp"
#include "oracle/hull.hpp"
#include "oracle/random.hpp"
#include "oracle/shaft_input.hpp"

namespace shaftcull {
namespace {

/// Compares the oracles on bounds of every family; returns the share that was proved.
template <class MakeBound>
double proved_share(std::uint64_t seed, unsigned shafts, const MakeBound& bound_of) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  std::size_t asked = 0;
  std::size_t proved = 0;
  for (const Family& family : families) {
    for (unsigned i = 0; i != shafts; ++i) {
      const ShaftInput input = family.shaft(random, i * 37);
      const oracle::Hull exact(input.a, input.b, input.added);
      const oracle::QuickHull quick(input);
      for (int j = 0; j != 8; ++j) {
        const auto bound = bound_of(family, random, input, quick);
        const std::optional<Answer> answer = quick.answer(bound);
        ++asked;
        if (!answer) continue;
        ++proved;
        EXPECT_EQ(*answer, exact.answer(bound))
            << family.name << ":\n  " << source_text(input) << "\n  " << source_text(bound);
      }
    }
  }
  return static_cast<double>(proved) / static_cast<double>(asked);
}

TEST(QuickHull, ProvesNothingOfBoxesThatRationalsDeny) {
  EXPECT_GT(proved_share(51, 60,
                         [](const Family& family, Random& random, const ShaftInput& input, const oracle::QuickHull&) {
                           return family.box(random, input);
                         }),
            0.7);
}

TEST(QuickHull, ProvesNothingOfSpheresThatRationalsDeny) {
  EXPECT_GT(proved_share(52, 20,
                         [](const Family& family, Random& random, const ShaftInput& input,
                            const oracle::QuickHull& hull) { return family.sphere(random, input, hull); }),
            0.7);
}

}  // namespace
}  // namespace shaftcull
