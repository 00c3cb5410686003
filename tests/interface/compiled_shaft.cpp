// SPDX-License-Identifier: MIT
/// What a CompiledShaft tells of itself.
#include "shaftcull/compiled.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "shaftcull/cull.hpp"
#include "shaftcull/paper.hpp"
#include "shaftcull/volumes.hpp"

namespace shaftcull {
namespace {

static_assert(sizeof(CompiledShaft) == 832 && alignof(CompiledShaft) == 64);
static_assert(std::is_trivially_copyable_v<CompiledShaft> && std::is_standard_layout_v<CompiledShaft>);
static_assert(std::is_nothrow_default_constructible_v<CompiledShaft>);
static_assert(!std::is_aggregate_v<CompiledShaft>, "nobody writes its bytes by their places");

constexpr Box lamp{{-0.0F, 1, 2}, {3, 4, 5}};
constexpr Box table{{-7, 1, -9}, {0x1p-149F, 11, 12}};

bool same_bits(const Box& one, const Box& other) {
  using Bits = std::array<std::uint32_t, 6>;
  return std::bit_cast<Bits>(one) == std::bit_cast<Bits>(other);
}

TEST(CompiledShaft, GivesTheBoxesItIsBetweenToTheBit) {
  std::array<CompiledShaft, 1> batch;
  const BoxStream from(std::vector<Box>{lamp});
  const BoxStream to(std::vector<Box>{table});
  compile_batch(from.view(), to.view(), batch);
  for (const CompiledShaft& shaft : {compile(Shaft(lamp, table)), compile(lamp, table), batch[0]}) {
    EXPECT_TRUE(shaft.formed());
    EXPECT_TRUE(same_bits(shaft.a(), lamp));
    EXPECT_TRUE(same_bits(shaft.b(), table));
  }
}

TEST(CompiledShaft, OfAMovingBoxGivesWhereItStartsAndEnds) {
  const CompiledShaft moved = swept(table, {1, 2, 3});
  EXPECT_TRUE(same_bits(moved.a(), table));
  EXPECT_EQ(moved.b(), (Box{{-6, 3, -6}, {1, 13, 15}}));
  const Box light{{-20, 0, 0}, {-19, 1, 1}};
  const CompiledShaft shade = shadow(light, table, 3);
  EXPECT_TRUE(same_bits(shade.a(), table));
  EXPECT_EQ(shade.b(), (Box{{-7 + 2 * 12, 1, -9 - 2 * 10}, {40, 11 + 2 * 11, 12 + 2 * 12}}));
  EXPECT_TRUE(same_bits(swept_infinite(table, {1, 0, 0}).a(), table));
  EXPECT_TRUE(same_bits(shadow(light, table).a(), table));
  EXPECT_FALSE(shade.has_planes());
}

TEST(CompiledShaft, HasPlanesFromAShaftAtOnceAndOtherwiseFromComplete) {
  EXPECT_TRUE(compile(Shaft(lamp, table)).has_planes());
  CompiledShaft shaft = compile(lamp, table);
  EXPECT_FALSE(shaft.has_planes());
  static_cast<void>(classify(shaft, lamp));
  EXPECT_FALSE(shaft.has_planes()) << "a query changed the shaft";
  const CompiledShaft before = shaft;
  complete(shaft);
  EXPECT_TRUE(shaft.has_planes());
  EXPECT_FALSE(before.has_planes()) << "copies share nothing";
}

TEST(CompiledShaft, HasTheContactThatItWasGiven) {
  std::array<CompiledShaft, 1> batch;
  const BoxStream from(std::vector<Box>{lamp});
  const BoxStream to(std::vector<Box>{table});
  const IndexPair pair[] = {{0, 0}};
  EXPECT_EQ(CompiledShaft().contact(), Contact::closed);
  EXPECT_EQ(compile(lamp, table).contact(), Contact::closed);
  EXPECT_EQ(compile(Shaft(lamp, table)).contact(), Contact::closed);
  EXPECT_EQ(swept(lamp, {1, 2, 3}).contact(), Contact::closed);
  EXPECT_EQ(compile(lamp, table, Contact::open).contact(), Contact::open);
  EXPECT_EQ(compile(lamp, table, Contact::closed).contact(), Contact::closed);
  compile_batch(from.view(), to.view(), batch, {}, Contact::open);
  EXPECT_EQ(batch[0].contact(), Contact::open);
  compile_batch(from.view(), to.view(), batch);
  EXPECT_EQ(batch[0].contact(), Contact::closed);
  compile_batch(from.view(), to.view(), pair, batch, {}, Contact::open);
  EXPECT_EQ(batch[0].contact(), Contact::open);
  complete(batch[0]);
  EXPECT_EQ(batch[0].contact(), Contact::open);
  set_contact(batch, Contact::closed);
  EXPECT_EQ(batch[0].contact(), Contact::closed);
  CompiledShaft moved = swept(lamp, {1, 2, 3});
  set_contact(moved, Contact::open);
  EXPECT_EQ(moved.contact(), Contact::open);
  EXPECT_TRUE(same_bits(moved.a(), lamp));
}

TEST(CompiledShaft, ThatWasNeverFormedHasEmptyBoxesAndNoPlanes) {
  CompiledShaft shaft;
  complete(shaft);  // does nothing
  EXPECT_FALSE(shaft.formed());
  EXPECT_FALSE(shaft.has_planes());
  for (const Box& box : {shaft.a(), shaft.b()}) {
    for (std::size_t k = 0; k != 3; ++k) {
      EXPECT_EQ(box.lo[k], std::numeric_limits<float>::infinity());
      EXPECT_EQ(box.hi[k], -std::numeric_limits<float>::infinity());
    }
  }
  shaft = compile(lamp, table);
  EXPECT_TRUE(shaft.formed());
  shaft = CompiledShaft();
  EXPECT_FALSE(shaft.formed());
}

}  // namespace
}  // namespace shaftcull
