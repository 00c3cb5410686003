// SPDX-License-Identifier: MIT
/// compile() of two boxes, with planes or without, makes the same shaft as the paper's tool, and as compile_batch().
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
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
#include "special_floats.hpp"

namespace shaftcull {
namespace {

/// Compares the shaft of a pair, before and after its joining planes are made, with that of Shaft.
void expect_pair(const ShaftInput& input) {
  Shaft formed(input.a, input.b);
  for (const Plane& plane : input.added) formed.add_plane(plane);
  const CompiledShaft expected = compile(formed);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    SCOPED_TRACE(std::string(name(isa)) + ": " + source_text(input));
    CompiledShaft shaft = compile(input.a, input.b, input.added);
    EXPECT_FALSE(shaft.has_planes());
    EXPECT_EQ(shaft.contact(), Contact::closed);
    EXPECT_EQ(shaft.form(), Form::slab);
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

TEST(CompilePair, PlanesAreAddedAsToAShaft) {
  for (const bool is_wild : {false, true}) {
    expect_pairs(94, [&](Random& random) {
      ShaftInput input = is_wild ? wild_shaft(random) : random_shaft(random);
      const std::size_t count = random.one_in(20) ? max_added_planes : random.below(4);
      while (input.added.size() != count) {
        input.added.push_back(is_wild ? with_wild_planes(random, {input.a, input.b}).added.back()
                                      : plane_through(random, input.a.lo, random.one_in(3)));
      }
      return input;
    });
  }
}

TEST(CompilePair, PlanesAreThoseOfABatchToTheBit) {
  Random random(95);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (int i = 0; i != 300; ++i) {
      const ShaftInput input = random_shaft(random);
      const Plane planes[] = {plane_through(random, input.a.lo, false), plane_through(random, input.b.hi, true)};
      const Contact contact = i % 2 == 0 ? Contact::closed : Contact::open;
      CompiledShaft batch;
      compile_batch(BoxColumns({input.a}).view(), BoxColumns({input.b}).view(), std::span(&batch, 1),
                    {.a = std::span(planes).first(1), .b = std::span(planes).last(1)}, contact);
      CompiledShaft shaft = compile(input.a, input.b, planes, contact);
      ASSERT_EQ(shaft.contact(), contact);
      complete(batch);
      complete(shaft);
      expect_equal(shaft, batch);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(CompilePair, PlanesThatCannotBeAddedAreNamed) {
  const Box a{{0, 0, 0}, {1, 1, 1}};
  const Box b{{2, 3, 4}, {3, 4, 5}};
  const Plane good{{1, 0, 0}, 1};
  const auto refusal = [&](const std::vector<Plane>& planes) {
    return message_of([&] { static_cast<void>(compile(a, b, planes)); });
  };
  EXPECT_EQ(refusal({good, good, {{0, std::nanf(""), 0}, 1}}), "planes[2]: normal.y = nan; it must be finite");
  EXPECT_EQ(refusal({{{1, 0, 0}, INFINITY}, good}), "planes[0]: offset = inf; it must be finite");
  EXPECT_EQ(refusal({good, {{0, -0.0F, 0}, 1}}),
            "planes[1]: its normal is zero, which leaves no inside and outside to tell apart");
  EXPECT_EQ(refusal(std::vector<Plane>(max_added_planes + 1, good)),
            "a shaft has room for 16 added planes only, not for 17");
  EXPECT_THAT(message_of([&] { static_cast<void>(compile(a, b, std::span(static_cast<const Plane*>(nullptr), 2))); }),
              testing::HasSubstr("planes is null"));
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
  const Box good{{-1, -1, -1}, {1, 1, 1}};
  const std::vector<Plane> planes(2, Plane{{1, 2, 3}, 4});
  std::vector<Box> bad;
  for (std::size_t k = 0; k != 3; ++k) {
    for (const float value : {std::nanf(""), infinity, -infinity}) {
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
        const std::string right = message_of([&] { static_cast<void>(Shaft(input.a, input.b)); });
        EXPECT_EQ(message_of([&] { static_cast<void>(compile(input.a, input.b)); }), right);
        EXPECT_EQ(message_of([&] { static_cast<void>(compile(input.a, input.b, planes)); }), right);
      }
    }
  }
}

}  // namespace
}  // namespace shaftcull
