// SPDX-License-Identifier: MIT
/// Boxes that block a shaft: every answer equals the one of exact arithmetic.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "caught.hpp"
#include "columns.hpp"
#include "cull/agreement.hpp"
#include "dispatch/active_kernels.hpp"
#include "guarded_floats.hpp"
#include "instruction_sets.hpp"
#include "message_of.hpp"
#include "oracle/blocking.hpp"
#include "oracle/cases/families.hpp"
#include "result_words.hpp"
#include "sanitizers.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/occluded.hpp"
#include "shaftcull/volumes.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

using Bits = std::vector<std::uint64_t>;

/// The bits of those boxes that the active instruction set's kernel says block the shaft.
Bits blocking(const CompiledShaft& shaft, const BoxView& boxes) {
  Bits bits(bit_words(boxes.count), 0x5555);
  kernel::active_kernels().blocking.boxes(kernel::data_of(shaft), boxes.stream.data(), boxes.count, bits.data(),
                                          nullptr);
  return bits;
}

/// Likewise of boxes that may hold one that does. Only whole words are asked about.
Bits holding(const CompiledShaft& shaft, const BoxView& boxes) {
  Bits bits;
  for (std::uint32_t word = 0; word != boxes.count / 64; ++word) {
    bits.push_back(0x5555);
    kernel::active_kernels().blocking.listed_nodes(kernel::data_of(shaft), boxes.stream.data(), &word, 1, &bits.back(),
                                                   nullptr, 1);
  }
  return bits;
}

/// Fails, with a reproducer for the first wrong one, unless boxes block the shaft exactly where the oracle says so.
/// Returns how many do.
std::size_t expect_exact_blocking(const ShaftInput& input, std::vector<Box> boxes) {
  std::vector<bool> right;
  for (const Box& box : boxes) right.push_back(oracle::blocks(input.a, input.b, box));
  const auto all = static_cast<std::size_t>(std::count(right.begin(), right.end(), true));
  const CompiledShaft shaft = compile(input.a, input.b);
  const BoxColumns memory(boxes);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    const Bits bits = blocking(shaft, memory.view());
    std::size_t wrong = 0;
    std::size_t first = 0;
    for (std::size_t i = boxes.size(); i-- != 0;) {
      if (bit(bits, i) == right[i]) continue;
      ++wrong;
      first = i;
    }
    EXPECT_EQ(wrong, 0U) << "of " << boxes.size() << " on " << name(isa) << ", form blocking; the first is bound "
                         << first << ":\n  " << source_text(input) << "\n  " << source_text(boxes[first]) << "\n  is "
                         << (right[first] ? "blocking" : "not blocking") << ", answered otherwise";
    EXPECT_EQ(occluded(shaft, memory.view()), all != 0);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i != boxes.size(); ++i) {
      if (right[i]) expected.push_back(i);
    }
    std::vector<std::uint32_t> listed(boxes.size());
    listed.resize(list_occluders(shaft, memory.view(), listed));
    EXPECT_EQ(listed, expected);
    EXPECT_EQ(find_occluder(shaft, memory.view()), all == 0 ? std::nullopt : std::optional(expected[0]));
    const Bits holds = holding(shaft, memory.view());
    for (std::size_t i = 0; i != 64 * holds.size(); ++i) {
      EXPECT_TRUE(bit(holds, i) || !right[i]) << "as a node of itself, " << source_text(boxes[i]);
    }
  }
  for (std::size_t i = 0; i != boxes.size(); ++i) {
    EXPECT_EQ(occluded(shaft, boxes[i]), right[i])
        << "alone\n  " << source_text(input) << "\n  " << source_text(boxes[i]);
  }
  return all;
}

/// Checks `shafts` random inputs, each with 70 boxes that `box_of` makes for it; at least one box in `one_in` blocks.
template <class MakeShaft, class MakeBox>
void expect_exact_occluders(std::uint64_t seed, std::size_t shafts, std::size_t one_in, const MakeShaft& shaft_of,
                            const MakeBox& box_of) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  std::size_t boxes = 0;
  std::size_t blocking = 0;
  for (std::size_t i = 0; i != random_cases(shafts) && !testing::Test::HasFailure(); ++i) {
    const ShaftInput input = shaft_of(random);
    std::vector<Box> some;
    for (int n = 0; n != 70; ++n) some.push_back(box_of(random, input));
    boxes += some.size();
    blocking += expect_exact_blocking(input, some);
  }
  EXPECT_GE(blocking * one_in, boxes) << "too few boxes block";
}

TEST(Occluded, RandomBoxesAreAnsweredExactly) {
  expect_exact_occluders(711, 60, 200, random_shaft,
                         [](Random& random, const ShaftInput&) { return random.box(-6, 6, 0.5F, 6.0F); });
}

TEST(Occluded, BoxesThatJustBlockOrJustDoNotAreAnsweredExactly) {
  expect_exact_occluders(712, 100, 10, random_shaft, blocking_box);
  expect_exact_occluders(
      713, 60, 10, [](Random& random) { return long_shaft(random, random.one_in(2)); }, blocking_box);
}

TEST(Occluded, BoxesOnAGridAreAnsweredExactly) {
  const auto shaft = [](Random& random) { return grid_shaft(random, 4); };
  expect_exact_occluders(714, 150, 12, shaft, blocking_box);
  expect_exact_occluders(715, 150, 200, shaft,
                         [](Random& random, const ShaftInput&) { return random.grid_box(-1, 5); });
}

TEST(Occluded, FlatShaftsAndFlatBoxesAreAnsweredExactly) {
  const auto flattened = [](Random& random, Box box, unsigned axis, float at) {
    if (random.one_in(4)) at += random.integer(0, 1);
    box.lo[axis] = box.hi[axis] = at;
    return box;
  };
  expect_exact_occluders(
      716, 200, 12,
      [&](Random& random) {
        ShaftInput input = grid_shaft(random, 4);
        for (unsigned axis = 0; axis != 3; ++axis) {
          if (random.one_in(3)) continue;
          const float at = random.integer(0, 4);
          input.a = flattened(random, input.a, axis, at);
          input.b = flattened(random, input.b, axis, at);
        }
        return input;
      },
      [&](Random& random, const ShaftInput& input) {
        Box box = blocking_box(random, input);
        for (unsigned axis = 0; axis != 3; ++axis) {
          if (random.one_in(2)) box = flattened(random, box, axis, random.one_in(4) ? 2 : input.a.lo[axis]);
        }
        return box;
      });
  expect_exact_occluders(717, 100, 12, degenerate_shaft, blocking_box);
}

TEST(Occluded, ShaftsOfEveryFamilyAreAnsweredExactly) {
  for (const Family& family : families) {
    SCOPED_TRACE(family.name);
    unsigned index = 0;
    expect_exact_occluders(
        718, 12, 70, [&](Random& random) { return family.shaft(random, index++ * 61); },
        [&](Random& random, const ShaftInput& input) {
          return random.one_in(3) ? family.box(random, input) : blocking_box(random, input);
        });
  }
}

TEST(Occluded, EveryMagnitudeIsAnsweredExactly) {
  for (const int exponent : {-149, -140, -126, -100, 100, 121}) {
    expect_exact_occluders(
        719, 8, 12, [=](Random& random) { return wild_shaft(random, exponent, exponent + 6); }, blocking_box);
  }
  expect_exact_occluders(720, 60, 20, far_sweep_shaft, blocking_box);
}

TEST(Occluded, TheWallThatAPatchLiesOnDoesNotBlockIt) {
  on_each_instruction_set([] {
    const Box patch{{1, 1, 0}, {2, 2, 0}};
    const Box other{{1, 1, 5}, {2, 2, 5}};
    const Box wall{{0, 0, -1}, {9, 9, 0}};
    const Box screen{{0, 0, 2}, {9, 9, 2}};
    const Box narrow_screen{{1, 1, 2}, {2, 2, 2}};
    EXPECT_FALSE(occluded(compile(patch, other), wall));
    EXPECT_TRUE(occluded(compile(patch, other), screen));
    EXPECT_TRUE(occluded(compile(patch, other), narrow_screen)) << "only segments between edges run along its edges";
  });
}

TEST(Occluded, TheMiddleOneOfThreeEqualCubesHidesTheOthers) {
  on_each_instruction_set([] {
    const Box first{{0, 0, 0}, {1, 1, 1}};
    const Box middle{{2, 0, 0}, {3, 1, 1}};
    const Box last{{4, 0, 0}, {5, 1, 1}};
    EXPECT_TRUE(occluded(compile(first, last), BoxColumns({middle}).view()));
    EXPECT_TRUE(occluded(compile(last, first), middle));
    EXPECT_FALSE(occluded(compile(first, last), Box{{2, 0, 0}, {3, 1, 0.875F}}));
    const Box tops[] = {{{0, 0, 1}, {1, 1, 1}}, {{4, 0, 1}, {5, 1, 1}}};
    EXPECT_FALSE(occluded(compile(tops[0], tops[1]), middle)) << "segments between two tops run along the third";
    EXPECT_TRUE(occluded(compile(tops[0], last), middle)) << "those from a top into a cube do not";
  });
}

TEST(Occluded, AWallFromFloorToCeilingHidesTheNextRoom) {
  on_each_instruction_set([] {
    const Box wall{{4, 0, 0}, {4.25F, 5, 3}};
    const Box side{{1, 5, 1}, {2, 5, 3}};  // a part of a wall, up to the ceiling
    const Box ceiling{{6, 4, 3}, {7, 5, 3}};
    const Box floor{{6, 4, 0}, {7, 5, 0}};
    const Box other_ceiling{{1, 1, 3}, {2, 2, 3}};
    for (const Box& solid : {wall, Box{{4, 0, 0}, {4, 5, 3}}}) {
      EXPECT_TRUE(occluded(compile(side, ceiling), solid));
      EXPECT_TRUE(occluded(compile(side, floor), solid));
      EXPECT_TRUE(occluded(compile(other_ceiling, floor), solid));
      EXPECT_FALSE(occluded(compile(other_ceiling, ceiling), solid)) << "all segments run along the wall's edge";
    }
    const std::vector<Vec3> sheet = {{4, 0, 0}, {4, 5, 0}, {4, 5, 3}, {4, 0, 3}};
    EXPECT_TRUE(occluded(compile(side, ceiling), sheet));
    EXPECT_FALSE(occluded(compile(other_ceiling, ceiling), sheet));
  });
}

TEST(Occluded, AnEndThatTouchesTheSolidIsHiddenUnlessItLiesInItsFace) {
  on_each_instruction_set([] {
    const Box solid{{0, 0, 0}, {4, 4, 1}};
    const Box below{{1, 1, -2}, {2, 2, -1}};
    EXPECT_TRUE(occluded(compile(Box{{1, 1, 1}, {2, 2, 2}}, below), solid)) << "it stands on the solid";
    EXPECT_FALSE(occluded(compile(Box{{1, 1, 1}, {2, 2, 1}}, Box{{1, 1, 3}, {2, 2, 3}}), solid)) << "it lies on it";
    EXPECT_TRUE(occluded(compile(Box{{1, 1, 1}, {2, 2, 1}}, below), solid)) << "it is seen through the solid alone";
    const std::vector<Vec3> sheet = {{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {0, 4, 1}};
    EXPECT_TRUE(occluded(compile(Box{{1, 1, 1}, {2, 2, 2}}, below), sheet));
    EXPECT_FALSE(occluded(compile(Box{{1, 1, 1}, {2, 2, 1}}, below), sheet));
  });
}

TEST(Occluded, AWallThatOnlyTogetherWithAnotherHidesAllIsNoOccluder) {
  on_each_instruction_set([] {
    const Box patch{{0, 0, 0}, {2, 2, 0}};
    const Box other{{0, 0, 5}, {2, 2, 5}};
    const BoxColumns halves({Box{{-1, -1, 2}, {1, 3, 3}}, Box{{1, -1, 2}, {3, 3, 3}}});
    EXPECT_FALSE(occluded(compile(patch, other), halves.view()));
    EXPECT_TRUE(occluded(compile(patch, other), Box{{-1, -1, 2}, {3, 3, 3}}));
  });
}

TEST(Occluded, AnUnboundedBoxBlocksAndAnEmptyOneOrOneWithNaNDoesNot) {
  const ShaftInput input{{{0, 0, 0}, {2, 2, 0}}, {{5, 1, 5}, {6, 2, 6}}};
  const Box good{{-1, -1, 2}, {9, 9, 3}};
  std::vector<Box> boxes = {good,
                            {{-infinity, -infinity, 2}, {infinity, infinity, 3}},
                            {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}}};
  for (const Box& box : boxes) EXPECT_TRUE(occluded(compile(input.a, input.b), box));
  for (std::size_t k = 0; k != 3; ++k) {
    for (Vec3 Box::*corner : {&Box::lo, &Box::hi}) {
      for (const float x : {infinity, -infinity, nan, 2.5F}) {
        boxes.push_back(good);
        (boxes.back().*corner)[k] = x;
      }
    }
    boxes.push_back(good);
    std::swap(boxes.back().lo[k], boxes.back().hi[k]);
  }
  boxes.push_back({{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}});
  boxes.resize(64, good);
  expect_exact_blocking(input, boxes);
}

TEST(Occluded, PlacesInAViewDoNotMatter) {
  const CompiledShaft shaft = compile(Box{{0, 0, 0}, {1, 1, 1}}, Box{{5, 0, 0}, {6, 1, 1}});
  const Box wall{{2, -1, -1}, {3, 2, 2}};
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    EXPECT_FALSE(occluded(shaft, BoxView()));
    for (const std::size_t count : {1U, 2U, 63U, 64U, 65U, 511U, 512U, 513U, 1600U}) {
      for (const std::size_t place : {std::size_t{0}, count / 2, count - 1}) {
        std::vector<Box> boxes(count, Box{{2, 0.5F, -1}, {3, 2, 2}});
        EXPECT_FALSE(occluded(shaft, BoxColumns(boxes).view()));
        boxes[place] = wall;
        const BoxColumns memory(boxes);
        EXPECT_TRUE(occluded(shaft, memory.view())) << count;
        EXPECT_EQ(find_occluder(shaft, memory.view()), place);
        std::uint32_t listed = 0;
        EXPECT_EQ(list_occluders(shaft, memory.view(), {&listed, 1}), 1U);
        EXPECT_EQ(listed, place);
        Bits expected(bit_words(count));
        expected[place / 64] |= std::uint64_t{1} << place % 64;
        EXPECT_EQ(blocking(shaft, memory.view()), expected) << name(isa) << ", " << place << " of " << count;
      }
    }
  }
}

TEST(Occluded, NothingBehindAViewIsRead) {
  // What a vector finds behind the last bound may be zeros, and a box at the origin only just blocks these shafts or
  // only just does not: it is one that floats leave undecided.
  const ShaftInput shafts[] = {{{{-1, -1, -1}, {-1, -1, -1}}, {{1, 1, 1}, {1, 1, 1}}},
                               {{{-2, -1, 0}, {-1, 1, 0}}, {{1, -1, 0}, {2, 1, 0}}},
                               {{{-1, 0, 0}, {-1, 0, 0}}, {{1, 0, 0}, {1, 0, 0}}},
                               {{{-2, -2, -2}, {-1, -1, -1}}, {{1, 1, 1}, {2, 2, 2}}}};
  for (const ShaftInput& input : shafts) {
    const CompiledShaft shaft = compile(input.a, input.b);
    const Box box{{0, 0, 0}, {0, 0, 0}};
    const bool blocks = oracle::blocks(input.a, input.b, box);
    for (const Isa isa : isas_under_test()) {
      const UseIsa use(isa);
      for (std::size_t count = 1; count <= 130; ++count) {
        const BoxColumns memory(std::vector<Box>(count, box));
        const GuardedView guarded(memory.view());
        EXPECT_EQ(occluded(shaft, guarded.view()), blocks) << name(isa) << ", " << count;
        std::vector<std::uint32_t> listed(count);
        EXPECT_EQ(list_occluders(shaft, guarded.view(), listed), blocks ? count : 0) << name(isa) << ", " << count;
      }
    }
  }
}

TEST(Occluded, AddedPlanesDoNotMatter) {
  on_each_instruction_set([] {
    const Box a{{0, 0, 0}, {1, 1, 1}};
    const Box b{{5, 0, 0}, {6, 1, 1}};
    const Plane plane{{1, 0, 0}, -5};
    EXPECT_TRUE(occluded(compile(a, b, std::span(&plane, 1)), Box{{2, -1, -1}, {3, 2, 2}}));
  });
}

TEST(Occluded, WhatDoesNotFitIsCountedAndNotWritten) {
  on_each_instruction_set([] {
    const BoxColumns walls(std::vector<Box>(20000, Box{{2, -1, -1}, {3, 2, 2}}));
    const CompiledShaft shaft = compile(Box{{0, 0, 0}, {1, 1, 1}}, Box{{5, 0, 0}, {6, 1, 1}});
    std::vector<std::uint32_t> listed(4, 7);
    EXPECT_EQ(list_occluders(shaft, walls.view(), std::span(listed).first(3)), 20000U);
    EXPECT_EQ(listed, (std::vector<std::uint32_t>{0, 1, 2, 7}));
  });
}

TEST(Occluded, ShaftsThatAreNotBetweenTwoBoxesAreRefusedByName) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  std::vector<CompiledShaft> shafts(2, compile(box, box));
  const BoxColumns solids({box});
  Bits bits(1, 7);
  for (const CompiledShaft& other :
       {swept(box, {1, 2, 3}), swept_infinite(box, {1, 2, 3}), shadow(Box{{5, 5, 5}, {6, 6, 6}}, box),
        shadow(Box{{5, 5, 5}, {6, 6, 6}}, box, 2)}) {
    shafts[1] = other;
    EXPECT_THAT(message_of([&] { occluded_many(shafts, solids.view(), bits); }), testing::HasSubstr("shaft 1 is that"));
    EXPECT_THAT(message_of([&] { (void)occluded(other, box); }), testing::HasSubstr("only a shaft between two boxes"));
    EXPECT_THROW((void)find_occluder(other, solids.view()), InvalidArgument);
    EXPECT_THROW((void)occluded(other, BoxTree(solids.view())), InvalidArgument);
  }
  const ConvexHull hull(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  EXPECT_THAT(message_of([&] { (void)occluded(hull, box); }), testing::HasSubstr("a hull of one set of points"));
  EXPECT_EQ(bits[0], 7U);
}

TEST(Occluded, ABitAndAListAShaftSayWhatEachShaftSays) {
  Random random(731);
  std::vector<Box> solids;
  for (int i = 0; i != 1500; ++i) solids.push_back(random.box(-5, 5, 0.1F, 0.5F));
  const BoxColumns memory(solids);
  std::vector<CompiledShaft> shafts;
  for (int s = 0; s != 130; ++s) shafts.push_back(compile(random.box(-6, 6, 0, 0.15F), random.box(-6, 6, 0, 0.15F)));
  Bits expected(3);
  for (std::size_t s = 0; s != shafts.size(); ++s) {
    expected[s / 64] |= std::uint64_t{occluded(shafts[s], memory.view())} << s % 64;
  }
  int count = 0;
  for (const std::uint64_t word : expected) count += std::popcount(word);
  EXPECT_TRUE(count > 5 && count < 125) << count;
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    Bits bits(3, 0x5555);
    occluded_many(shafts, memory.view(), bits);
    EXPECT_EQ(bits, expected) << name(isa);
    IndexLists lists;
    list_occluders_many(shafts, memory.view(), lists);
    ASSERT_EQ(lists.size(), shafts.size());
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      std::vector<std::uint32_t> one(solids.size());
      one.resize(list_occluders(shafts[s], memory.view(), one));
      EXPECT_EQ(std::vector<std::uint32_t>(lists[s].begin(), lists[s].end()), one);
    }
    occluded_many(shafts, BoxView(), bits);
    EXPECT_EQ(bits, Bits(3));
  }
}

}  // namespace
}  // namespace shaftcull
