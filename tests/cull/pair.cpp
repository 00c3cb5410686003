// SPDX-License-Identifier: MIT
/// compile() of two boxes makes the same shaft as forming and compiling it in two steps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "columns.hpp"
#include "cull/agreement.hpp"
#include "cull/equal_shafts.hpp"
#include "forms.hpp"
#include "instruction_sets.hpp"
#include "message_of.hpp"
#include "oracle/cases/shafts.hpp"
#include "oracle/random.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/paper.hpp"

namespace shaftcull {
namespace {

/// Compares the shaft of a pair, before and after its planes are made, with that of Shaft.
void expect_pair(const ShaftInput& input) {
  const CompiledShaft expected = compile(Shaft(input.a, input.b));
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    SCOPED_TRACE(std::string(name(isa)) + ": " + source_text(input));
    CompiledShaft shaft = compile(input.a, input.b);
    EXPECT_FALSE(shaft.has_planes());
    complete(shaft);
    expect_equal(shaft, expected);
  }
}

template <class MakeShaft>
void expect_pairs(std::uint64_t seed, const MakeShaft& input, int pairs = 2000) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (int i = 0; i != pairs && !testing::Test::HasFailure(); ++i) expect_pair(input(random));
}

TEST(CompilePair, RandomBoxesCompileAsTheirShaftDoes) { expect_pairs(81, random_shaft); }

TEST(CompilePair, BoxesOnAGridCompileAsTheirShaftDoes) {
  expect_pairs(82, [](Random& random) { return grid_shaft(random, 3); });
}

TEST(CompilePair, EqualContainedTouchingFlatBoxesAndPointsCompileAsTheirShaftDoes) {
  expect_pairs(83, degenerate_shaft);
}

TEST(CompilePair, FacesThatNearlyCoincideCompileAsTheirShaftDoes) { expect_pairs(84, nearly_equal_shaft); }

TEST(CompilePair, BoxesFarFromTheOriginCompileAsTheirShaftDoes) {
  expect_pairs(85, [](Random& random) { return distant_shaft(random, std::exp2(random.uniform(5, 25))); });
}

TEST(CompilePair, CoordinatesOfEveryMagnitudeCompileAsTheirShaftDoes) {
  expect_pairs(86, [](Random& random) { return wild_shaft(random); });
}

TEST(CompilePair, DenormalCoordinatesCompileAsTheirShaftDoes) {
  expect_pairs(87, [](Random& random) { return wild_shaft(random, -149, -127); });
}

TEST(CompilePair, HugeCoordinatesCompileAsTheirShaftDoes) {
  expect_pairs(88, huge_shaft);
  expect_pairs(89, [](Random& random) { return wild_shaft(random, 120, 127); });
}

TEST(CompilePair, SweepsThatEndFarBeyondTheSceneCompileAsTheirShaftDoes) { expect_pairs(93, far_sweep_shaft); }

/// Around the limits between the fused, the difference and the exact form.
TEST(CompilePair, MagnitudesAroundTheLimitsOfFormsCompileAsTheirShaftDoes) {
  for (const int exponent : {-126, -61, -60, 19, 20, 59, 60, 124, 125, 126}) {
    expect_pairs(
        90, [&](Random& random) { return wild_shaft(random, exponent - 1, exponent + 1); }, 300);
  }
}

TEST(CompilePair, EveryColouringOfTheFacesCompilesAsItsShaftDoes) {
  for (unsigned colouring = 0; colouring != colourings; ++colouring) expect_pair(coloured_shaft(colouring));
}

TEST(CompilePair, ZerosOfBothSignsCompileAsTheirShaftDoes) {
  expect_pairs(91, [](Random& random) {
    const auto zero = [&] { return random.one_in(2) ? 0.0F : -0.0F; };
    ShaftInput input = grid_shaft(random, 1);
    for (Box* box : {&input.a, &input.b}) {
      for (std::size_t k = 0; k != 3; ++k) {
        if (box->lo[k] == 0) box->lo[k] = zero();
        if (box->hi[k] == 0) box->hi[k] = zero();
      }
    }
    return input;
  });
}

TEST(CompilePair, AnswersWhatShaftAnswers) {
  Random random(92);
  std::vector<Box> boxes;
  for (int i = 0; i != 300; ++i) boxes.push_back(random.box(-5, 5, 0.05F, 1.0F));
  const BoxColumns memory(boxes);
  const auto answers = [&](const CompiledShaft& shaft, Form form) {
    std::vector<std::uint64_t> kept(bit_words(boxes.size()));
    std::vector<std::uint64_t> inside(bit_words(boxes.size()));
    classify(in_form(shaft, form), memory.view(), kept, inside);
    return std::pair(kept, inside);
  };
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (int i = 0; i != 50; ++i) {
      const ShaftInput input = random_shaft(random);
      for (const Form form : forms) {
        EXPECT_EQ(answers(compile(input.a, input.b), form), answers(compile(Shaft(input.a, input.b)), form));
      }
    }
  }
}

TEST(CompilePair, ABadBoxIsRefusedAsShaftRefusesIt) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  const Box good{{-1, -1, -1}, {1, 1, 1}};
  std::vector<Box> bad;
  for (std::size_t k = 0; k != 3; ++k) {
    for (const float value : {std::nanf(""), inf, -inf}) {
      bad.insert(bad.end(), {good, good});
      bad[bad.size() - 2].lo[k] = value;
      bad.back().hi[k] = value;
    }
    bad.push_back(good);
    bad.back().lo[k] = 1.5F;
  }
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const Box& box : bad) {
      for (const bool is_first : {true, false}) {
        const ShaftInput input = is_first ? ShaftInput{box, good} : ShaftInput{good, box};
        SCOPED_TRACE(source_text(input));
        EXPECT_EQ(message_of([&] { static_cast<void>(compile(input.a, input.b)); }),
                  message_of([&] { static_cast<void>(Shaft(input.a, input.b)); }));
      }
    }
  }
}

}  // namespace
}  // namespace shaftcull
