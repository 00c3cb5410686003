/// compile_batch() makes the same shafts as forming and compiling them one by one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "cases/shafts.hpp"
#include "columns.hpp"
#include "cull/agreement.hpp"
#include "cull/equal_shafts.hpp"
#include "dice.hpp"
#include "instruction_sets.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/shaft.hpp"

namespace shaftcull {
namespace {

void expect_batch(const std::vector<Box>& a, const std::vector<Box>& b) {
  const BoxColumns a_memory(a);
  const BoxColumns b_memory(b);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    std::vector<CompiledShaft> batch(a.size());
    compile_batch(a_memory.view(), b_memory.view(), batch);
    for (std::size_t i = 0; i != a.size(); ++i) {
      SCOPED_TRACE(std::string(name(isa)) + ", pair " + std::to_string(i) + ": " + source_text(Subject{a[i], b[i]}));
      complete(batch[i]);
      EXPECT_TRUE(batch[i].has_planes());
      expect_equal(batch[i], compile(Shaft(a[i], b[i])));
      if (testing::Test::HasFailure()) return;
    }
  }
}

template <class MakeBox>
void expect_batch_of(std::uint64_t seed, const MakeBox& box) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Dice dice(seed);
  std::vector<Box> a;
  std::vector<Box> b;
  for (int i = 0; i != 1003; ++i) {
    a.push_back(box(dice));
    b.push_back(dice.one_in(20) ? a.back() : box(dice));
  }
  expect_batch(a, b);
}

TEST(CompileBatch, RandomPairs) {
  expect_batch_of(71, [](Dice& dice) { return dice.box(-5, 5, 0.2F, 1.0F); });
}

TEST(CompileBatch, GridAlignedPairsWithFacesInCommon) {
  expect_batch_of(72, [](Dice& dice) { return dice.grid_box(-2, 2); });
}

TEST(CompileBatch, EveryColouringOfTheFaces) {
  std::vector<Box> a;
  std::vector<Box> b;
  for (unsigned colouring = 0; colouring != colourings; ++colouring) {
    const Subject subject = coloured_subject(colouring);
    a.push_back(subject.a);
    b.push_back(subject.b);
  }
  expect_batch(a, b);
}

TEST(CompileBatch, PairsFarFromTheOrigin) {
  expect_batch_of(73, [](Dice& dice) { return dice.box(1e6F, 1e6F + 10, 0.2F, 1.0F); });
}

TEST(CompileBatch, PairsOfEveryMagnitude) {
  expect_batch_of(74, [](Dice& dice) {
    return Dice::sorted({dice.wild(), dice.wild(), dice.wild()}, {dice.wild(), dice.wild(), dice.wild()});
  });
}

TEST(CompileBatch, EveryCountFillsAllAndNoMore) {
  Dice dice(75);
  std::vector<Box> a;
  std::vector<Box> b;
  for (int i = 0; i != 40; ++i) {
    a.push_back(dice.box(-5, 5, 0.2F, 1.0F));
    b.push_back(dice.box(-5, 5, 0.2F, 1.0F));
  }
  const BoxColumns a_memory(a);
  const BoxColumns b_memory(b);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (std::size_t count = 0; count != a.size(); ++count) {
      std::vector<CompiledShaft> batch(count + 1);
      batch[count].added_count = 99;
      compile_batch(a_memory.view().slice(0, count), b_memory.view().slice(0, count), std::span(batch).first(count));
      EXPECT_EQ(batch[count].added_count, 99) << "written past the end";
      for (std::size_t i = 0; i != count; ++i) {
        complete(batch[i]);
        expect_equal(batch[i], compile(Shaft(a[i], b[i])));
      }
    }
  }
}

TEST(CompileBatch, PendingPlanesAreFoundByTheTestsThatNeedThem) {
  Dice dice(76);
  std::vector<Box> boxes;
  for (int i = 0; i != 200; ++i) boxes.push_back(dice.box(-5, 5, 0.05F, 2.0F));
  const BoxColumns memory(boxes);
  const BoxColumns a({dice.box(-5, 5, 0.2F, 2.0F)});
  const BoxColumns b({dice.box(-5, 5, 0.2F, 2.0F)});
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    std::vector<CompiledShaft> pending(1);
    compile_batch(a.view(), b.view(), pending);
    const CompiledShaft single = compile(Shaft(a.view()[0], b.view()[0]));
    for (const Form form : {Form::slab, Form::planes}) {
      std::vector<std::uint64_t> kept[2];
      std::vector<std::uint64_t> inside[2];
      for (std::size_t i = 0; i != 2; ++i) {
        kept[i].resize(words_for(boxes.size()));
        inside[i].resize(words_for(boxes.size()));
        classify(i == 0 ? pending[0] : single, memory.view(), kept[i], inside[i], form);
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
  constexpr float inf = std::numeric_limits<float>::infinity();
  const Box good{{0, 0, 0}, {1, 1, 1}};
  for (const Box& bad : {Box{{0, 0, 0}, {1, inf, 1}}, Box{{0, 0, 2}, {1, 1, 1}}, Box{{0, NAN, 0}, {1, 1, 1}}}) {
    for (const bool in_first : {true, false}) {
      std::vector<Box> a(30, good);
      std::vector<Box> b(30, good);
      (in_first ? a : b)[17] = bad;
      (in_first ? b : a)[23] = bad;
      std::vector<CompiledShaft> out(30);
      out[0].added_count = 99;
      try {
        compile_batch(BoxColumns(a).view(), BoxColumns(b).view(), out);
        ADD_FAILURE() << "nothing was thrown";
      } catch (const BadBound& error) {
        EXPECT_EQ(error.index(), 17U);
        EXPECT_THAT(error.what(), testing::HasSubstr("17"));
      }
      EXPECT_EQ(out[0].added_count, 99);
    }
  }
}

}  // namespace
}  // namespace shaftcull
