/// The quick oracle: what it proves is what rationals say, and it proves most answers.
#include "quick_oracle.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "cases/families.hpp"
#include "dice.hpp"
#include "oracle.hpp"
#include "subject.hpp"

namespace shaftcull {
namespace {

/// Compares the oracles on bounds of every family; returns the share that was proved.
template <class MakeBound>
double proved_share(std::uint64_t seed, unsigned shafts, const MakeBound& bound_of) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  std::size_t asked = 0;
  std::size_t proved = 0;
  for (const Family& family : families) {
    for (unsigned i = 0; i != shafts; ++i) {
      const Subject subject = family.subject(dice, i * 37);
      const oracle::Hull exact(subject.a, subject.b, subject.added);
      const oracle::QuickHull quick(subject);
      for (int j = 0; j != 8; ++j) {
        const auto bound = bound_of(family, dice, subject, quick);
        const std::optional<Answer> answer = quick.answer(bound);
        ++asked;
        if (!answer) continue;
        ++proved;
        EXPECT_EQ(*answer, exact.answer(bound))
            << family.name << ":\n  " << source_text(subject) << "\n  " << source_text(bound);
      }
    }
  }
  return static_cast<double>(proved) / static_cast<double>(asked);
}

TEST(QuickOracle, ProvesNothingOfBoxesThatRationalsDeny) {
  EXPECT_GT(proved_share(51, 60,
                         [](const Family& family, Dice& dice, const Subject& subject, const oracle::QuickHull&) {
                           return family.box(dice, subject);
                         }),
            0.7);
}

TEST(QuickOracle, ProvesNothingOfSpheresThatRationalsDeny) {
  EXPECT_GT(proved_share(52, 20,
                         [](const Family& family, Dice& dice, const Subject& subject, const oracle::QuickHull& hull) {
                           return family.sphere(dice, subject, hull);
                         }),
            0.7);
}

}  // namespace
}  // namespace shaftcull
