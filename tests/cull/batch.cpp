// SPDX-License-Identifier: MIT
/// compile_batch() makes the same shafts as forming and compiling them one by one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "caught.hpp"
#include "columns.hpp"
#include "compiled/shaft_data.hpp"
#include "cull/agreement.hpp"
#include "cull/equal_shafts.hpp"
#include "forms.hpp"
#include "instruction_sets.hpp"
#include "message_of.hpp"
#include "oracle/cases/shafts.hpp"
#include "oracle/random.hpp"
#include "shaftcull/compiled.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

void expect_batch(const std::vector<Box>& a, const std::vector<Box>& b) {
  const BoxColumns a_memory(a);
  const BoxColumns b_memory(b);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    std::vector<CompiledShaft> batch(a.size());
    for (const Contact contact : {Contact::closed, Contact::open}) {
      compile_batch(a_memory.view(), b_memory.view(), batch, {}, contact);
      for (std::size_t i = 0; i != a.size(); ++i) {
        SCOPED_TRACE(std::string(name(isa)) + ", pair " + std::to_string(i) + ": " +
                     source_text(ShaftInput{a[i], b[i], {}, contact}));
        complete(batch[i]);
        EXPECT_TRUE(batch[i].has_planes());
        expect_equal(batch[i], shaft_of({a[i], b[i], {}, contact}));
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

template <class MakeBox>
void expect_batch_of(std::uint64_t seed, const MakeBox& box) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  std::vector<Box> a;
  std::vector<Box> b;
  for (int i = 0; i != 1003; ++i) {
    a.push_back(box(random));
    b.push_back(random.one_in(20) ? a.back() : box(random));
  }
  expect_batch(a, b);
}

TEST(CompileBatch, RandomPairsCompileAsTheirShaftsDo) {
  expect_batch_of(71, [](Random& random) { return random.box(-5, 5, 0.2F, 1.0F); });
}

TEST(CompileBatch, GridAlignedPairsWithFacesInCommonCompileAsTheirShaftsDo) {
  expect_batch_of(72, [](Random& random) { return random.grid_box(-2, 2); });
}

TEST(CompileBatch, SweepsThatEndFarBeyondTheSceneCompileAsTheirShaftsDo) {
  Random random(77);
  std::vector<Box> a;
  std::vector<Box> b;
  for (int i = 0; i != 1003; ++i) {
    const ShaftInput input = random.one_in(3) ? random_shaft(random) : far_sweep_shaft(random);
    a.push_back(input.a);
    b.push_back(input.b);
  }
  expect_batch(a, b);
}

TEST(CompileBatch, EveryColouringOfTheFacesCompilesAsItsShaftDoes) {
  std::vector<Box> a;
  std::vector<Box> b;
  for (unsigned colouring = 0; colouring != colourings; ++colouring) {
    const ShaftInput input = coloured_shaft(colouring);
    a.push_back(input.a);
    b.push_back(input.b);
  }
  expect_batch(a, b);
}

TEST(CompileBatch, PairsFarFromTheOriginCompileAsTheirShaftsDo) {
  expect_batch_of(73, [](Random& random) { return random.box(1e6F, 1e6F + 10, 0.2F, 1.0F); });
}

TEST(CompileBatch, PairsOfEveryMagnitudeCompileAsTheirShaftsDo) {
  expect_batch_of(74, [](Random& random) {
    return Random::sorted({random.wild(), random.wild(), random.wild()}, {random.wild(), random.wild(), random.wild()});
  });
}

/// The shaft that compile_batch() should make of boxes with planes.
CompiledShaft formed_alone(const Box& a, const Box& b, std::span<const Plane> of_a, std::span<const Plane> of_b) {
  std::vector<Plane> planes(of_a.begin(), of_a.end());
  planes.insert(planes.end(), of_b.begin(), of_b.end());
  return shaft_of({a, b, planes});
}

/// Random boxes, each with some planes.
struct Patches {
  std::vector<Box> boxes;
  std::vector<Plane> planes;
  std::size_t planes_each;

  Patches(Random& random, std::size_t count, std::size_t each, bool wild) : planes_each(each) {
    for (std::size_t i = 0; i != count; ++i) {
      boxes.push_back(wild ? wild_box(random) : random.box(-5, 5, 0.2F, 1.0F));
      for (std::size_t k = 0; k != each; ++k) {
        planes.push_back(plane_through(random, random.one_in(2) ? boxes.back().lo : Vec3{0, 0, 0}, random.one_in(3)));
        if (wild) planes.back() = with_wild_planes(random, {boxes.back(), boxes.back()}).added.back();
      }
    }
  }
  [[nodiscard]] std::span<const Plane> of(std::size_t box) const {
    return std::span(planes).subspan(box * planes_each, planes_each);
  }
};

void expect_planes(const Patches& a, const Patches& b) {
  const BoxColumns a_memory(a.boxes);
  const BoxColumns b_memory(b.boxes);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    std::vector<CompiledShaft> batch(a.boxes.size());
    compile_batch(a_memory.view(), b_memory.view(), batch, {.a = a.planes, .b = b.planes});
    for (std::size_t i = 0; i != batch.size(); ++i) {
      SCOPED_TRACE(std::string(name(isa)) + ", pair " + std::to_string(i));
      EXPECT_FALSE(batch[i].has_planes());
      complete(batch[i]);
      expect_equal(batch[i], formed_alone(a.boxes[i], b.boxes[i], a.of(i), b.of(i)));
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(CompileBatch, PlanesOfBothBoxesAreAddedInTheirOrder) {
  Random random(101);
  for (const auto& [of_a, of_b] : {std::pair(1, 1), {0, 1}, {3, 0}, {2, 5}, {16, 0}, {8, 8}}) {
    const Patches a(random, 203, static_cast<std::size_t>(of_a), false);
    expect_planes(a, Patches(random, 203, static_cast<std::size_t>(of_b), false));
  }
}

TEST(CompileBatch, PlanesOfEveryMagnitudeAreAddedAsToAShaft) {
  Random random(102);
  const Patches a(random, 1003, 1, true);
  expect_planes(a, Patches(random, 1003, 1, true));
}

TEST(CompileBatch, PlanesAreAddedForEveryCount) {
  Random random(103);
  for (std::size_t count = 0; count != 70; ++count) {
    const Patches a(random, count, 1, false);
    expect_planes(a, Patches(random, count, 2, false));
  }
}

TEST(CompileBatch, IndexPairsOfOneViewAndOfTwoCompileAsTheirShaftsDo) {
  Random random(104);
  const Patches a(random, 50, 2, false);
  const Patches other(random, 70, 1, false);
  for (const Patches* b : {&a, &other}) {
    const BoxColumns a_memory(a.boxes);
    const BoxColumns b_memory(b->boxes);
    std::vector<IndexPair> pairs;
    for (int i = 0; i != 333; ++i) {
      pairs.push_back({random.below(50), random.below(static_cast<unsigned>(b->boxes.size()))});
    }
    pairs.push_back({49, static_cast<std::uint32_t>(b->boxes.size() - 1)});
    for (const Isa isa : isas_under_test()) {
      const UseIsa use(isa);
      for (const bool with_planes : {false, true}) {
        const BatchPlanes planes = with_planes ? BatchPlanes{.a = a.planes, .b = b->planes} : BatchPlanes{};
        for (const std::size_t size :
             {std::size_t{0}, std::size_t{1}, std::size_t{64}, std::size_t{65}, pairs.size()}) {
          std::vector<CompiledShaft> out(size + 1);
          kernel::data_of(out[size]).added_count = 99;
          compile_batch(a_memory.view(), b_memory.view(), std::span(pairs).first(size), std::span(out).first(size),
                        planes);
          EXPECT_EQ(kernel::data_of(out[size]).added_count, 99) << "written past the end";
          for (std::size_t i = 0; i != size; ++i) {
            const auto [in_a, in_b] = pairs[i];
            complete(out[i]);
            expect_equal(out[i], with_planes ? formed_alone(a.boxes[in_a], b->boxes[in_b], a.of(in_a), b->of(in_b))
                                             : shaft_of({a.boxes[in_a], b->boxes[in_b]}));
          }
        }
      }
    }
  }
}

/// The message of what a batch of index pairs of two boxes a and three boxes b is refused with, after checking that
/// nothing was written.
std::string refusal_of(const std::vector<IndexPair>& pairs, const BatchPlanes& planes, std::size_t out_size) {
  const std::vector<Box> boxes(3, Box{{0, 0, 0}, {1, 1, 1}});
  const BoxColumns memory(boxes);
  std::vector<CompiledShaft> out(out_size);
  for (CompiledShaft& shaft : out) kernel::data_of(shaft).added_count = 99;
  std::string message =
      message_of([&] { compile_batch(memory.view().slice(0, 2), memory.view(), pairs, out, planes); });
  for (const CompiledShaft& shaft : out) EXPECT_EQ(kernel::data_of(shaft).added_count, 99);
  return message;
}

TEST(CompileBatch, BadIndicesAndSizesOfPairsAreNamed) {
  EXPECT_EQ(refusal_of({{0, 0}, {1, 2}, {2, 0}, {0, 7}}, {}, 4), "pairs[2].a = 2, and there are 2 boxes a");
  EXPECT_EQ(refusal_of({{0, 0}, {1, 3}}, {}, 2), "pairs[1].b = 3, and there are 3 boxes b");
  EXPECT_EQ(refusal_of({{0xffffffff, 0}}, {}, 1), "pairs[0].a = 4294967295, and there are 2 boxes a");
  EXPECT_EQ(refusal_of({{0, 0}, {0, 0}}, {}, 3), "compile_batch needs as many pairs as shafts to write, not 2 and 3");
}

TEST(CompileBatch, BadPlanesAreNamed) {
  const Plane good{{1, 0, 0}, 1};
  const auto refusal = [&](const std::vector<Plane>& of_a, const std::vector<Plane>& of_b) {
    return refusal_of({{0, 0}}, {.a = of_a, .b = of_b}, 1);
  };
  EXPECT_EQ(refusal({good, good, good}, {}), "planes.a has 3 planes, not equally many for each of 2 boxes a");
  EXPECT_EQ(refusal({}, {good}), "planes.b has 1 plane, not equally many for each of 3 boxes b");
  EXPECT_EQ(refusal(std::vector<Plane>(20, good), std::vector<Plane>(21, good)),
            "a shaft has room for 16 added planes, not for 10 of box a and 7 of box b");
  EXPECT_EQ(refusal({}, {good, good, {{0, NAN, 0}, 1}}), "planes.b[2]: normal.y = nan; it must be finite");
  EXPECT_EQ(refusal({{{1, 0, 0}, INFINITY}, good}, {}), "planes.a[0]: offset = inf; it must be finite");
  EXPECT_EQ(refusal({good, {{0, -0.0F, 0}, 1}}, {}),
            "planes.a[1]: its normal is zero, which leaves no inside and outside to tell apart");
}

TEST(CompileBatch, BoxesThatNoPairNamesMayBeAnything) {
  std::vector<Box> boxes(40, Box{{0, 0, 0}, {1, 1, 1}});
  boxes[7].lo[1] = NAN;
  boxes[9].lo[2] = 2;
  const BoxColumns memory(boxes);
  for (const std::size_t size : {2U, 200U}) {  // fewer and more than there are boxes
    std::vector<IndexPair> pairs(size, IndexPair{3, 39});
    std::vector<CompiledShaft> out(size);
    EXPECT_NO_THROW(compile_batch(memory.view(), memory.view(), pairs, out));
    pairs[size - 1] = {0, 9};
    kernel::data_of(out[0]).added_count = 99;
    const auto error = caught<BadBound>([&] { compile_batch(memory.view(), memory.view(), pairs, out); });
    ASSERT_TRUE(error);
    EXPECT_EQ(error->index(), size - 1);
    EXPECT_THAT(error->what(), testing::HasSubstr("box b: lo.z = 2"));
    EXPECT_EQ(kernel::data_of(out[0]).added_count, 99);
  }
}

TEST(CompileBatch, EveryCountFillsAllAndNoMore) {
  Random random(75);
  std::vector<Box> a;
  std::vector<Box> b;
  for (int i = 0; i != 40; ++i) {
    a.push_back(random.box(-5, 5, 0.2F, 1.0F));
    b.push_back(random.box(-5, 5, 0.2F, 1.0F));
  }
  const BoxColumns a_memory(a);
  const BoxColumns b_memory(b);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (std::size_t count = 0; count != a.size(); ++count) {
      std::vector<CompiledShaft> batch(count + 1);
      kernel::data_of(batch[count]).added_count = 99;
      compile_batch(a_memory.view().slice(0, count), b_memory.view().slice(0, count), std::span(batch).first(count));
      EXPECT_EQ(kernel::data_of(batch[count]).added_count, 99) << "written past the end";
      for (std::size_t i = 0; i != count; ++i) {
        complete(batch[i]);
        expect_equal(batch[i], shaft_of({a[i], b[i]}));
      }
    }
  }
}

TEST(CompileBatch, PendingPlanesAreFoundByTheTestsThatNeedThem) {
  Random random(76);
  std::vector<Box> boxes;
  for (int i = 0; i != 200; ++i) boxes.push_back(random.box(-5, 5, 0.05F, 2.0F));
  const BoxColumns memory(boxes);
  const BoxColumns a({random.box(-5, 5, 0.2F, 2.0F)});
  const BoxColumns b({random.box(-5, 5, 0.2F, 2.0F)});
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    std::vector<CompiledShaft> pending(1);
    compile_batch(a.view(), b.view(), pending);
    const CompiledShaft single = shaft_of({a.view()[0], b.view()[0]});
    for (const Form form : forms) {
      std::vector<std::uint64_t> kept[2];
      std::vector<std::uint64_t> inside[2];
      for (std::size_t i = 0; i != 2; ++i) {
        kept[i].resize(bit_words(boxes.size()));
        inside[i].resize(bit_words(boxes.size()));
        classify(in_form(i == 0 ? pending[0] : single, form), memory.view(), kept[i], inside[i]);
      }
      EXPECT_EQ(kept[0], kept[1]);
      EXPECT_EQ(inside[0], inside[1]);
    }
  }
}

TEST(CompileBatch, SizesThatDifferAreRefused) {
  const BoxColumns three(std::vector<Box>(3, Box{{0, 0, 0}, {1, 1, 1}}));
  std::vector<CompiledShaft> out(2);
  EXPECT_THROW(compile_batch(three.view(), three.view(), out), InvalidArgument);
  EXPECT_THROW(compile_batch(three.view(), three.view().slice(0, 2), out), InvalidArgument);
}

TEST(CompileBatch, ABadBoxIsNamedAndNothingIsWritten) {
  const Box good{{0, 0, 0}, {1, 1, 1}};
  for (const Box& bad : {Box{{0, 0, 0}, {1, infinity, 1}}, Box{{0, 0, 2}, {1, 1, 1}}, Box{{0, NAN, 0}, {1, 1, 1}}}) {
    for (const bool in_first : {true, false}) {
      std::vector<Box> a(30, good);
      std::vector<Box> b(30, good);
      (in_first ? a : b)[17] = bad;
      (in_first ? b : a)[23] = bad;
      std::vector<CompiledShaft> out(30);
      kernel::data_of(out[0]).added_count = 99;
      const auto error = caught<BadBound>([&] { compile_batch(BoxColumns(a).view(), BoxColumns(b).view(), out); });
      ASSERT_TRUE(error);
      EXPECT_EQ(error->index(), 17U);
      EXPECT_THAT(error->what(), testing::HasSubstr("17"));
      EXPECT_EQ(kernel::data_of(out[0]).added_count, 99);
    }
  }
}

}  // namespace
}  // namespace shaftcull
