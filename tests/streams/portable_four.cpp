// SPDX-License-Identifier: MIT
/// FourFloats floats without vectors, as other processors have them: the same header, in another namespace.
#include "support/compiler.hpp"
#undef SHAFTCULL_TARGET_SSE2
#define shaftcull shaftcull_portable
#include "simd/baseline_four_floats.hpp"
#undef shaftcull

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace {

using shaftcull_portable::kernel::FourFloats;

FourFloats of(const std::array<float, 3>& floats) {
  return FourFloats::three_at(reinterpret_cast<const std::byte*>(floats.data()));
}

std::array<float, 4> stored(const FourFloats& four) {
  std::array<float, 4> floats;
  four.store(floats.data());
  return floats;
}

TEST(PortableFourFloats, ReadsThreeAndCalculates) {
  EXPECT_EQ(stored(FourFloats()), (std::array<float, 4>{0, 0, 0, 0}));
  EXPECT_EQ(stored(of({1, -2, 3})), (std::array<float, 4>{1, -2, 3, 0}));
  EXPECT_EQ(stored(of({1, -2, 3}) + of({4, 5, 0.5F})), (std::array<float, 4>{5, 3, 3.5F, 0}));
  EXPECT_EQ(stored(of({1, -2, 3}) - of({4, 5, 0.5F})), (std::array<float, 4>{-3, -7, 2.5F, 0}));
}

TEST(PortableFourFloats, ReadsFourAndCalculates) {
  constexpr float four[4] = {1, -2, 3, 7.9F};
  EXPECT_EQ(stored(FourFloats::load(four)), (std::array<float, 4>{1, -2, 3, 7.9F}));
  EXPECT_EQ(stored(FourFloats::all(5)), (std::array<float, 4>{5, 5, 5, 5}));
  EXPECT_EQ(stored(FourFloats::load(four) * FourFloats::all(2)), (std::array<float, 4>{2, -4, 6, 15.8F}));
  std::int32_t integers[4];
  FourFloats::load(four).store_integers(integers);
  EXPECT_EQ(std::to_array(integers), (std::array<std::int32_t, 4>{1, -2, 3, 7}));
}

TEST(PortableFourFloats, PassesOverNaNInTheFirstOfTwo) {
  const FourFloats a = FourFloats::of(1, NAN, 3, 4);
  const FourFloats b = FourFloats::of(2, 2, 2, 4);
  EXPECT_EQ(stored(minimum(a, b)), (std::array<float, 4>{1, 2, 2, 4}));
  EXPECT_EQ(stored(maximum(a, b)), (std::array<float, 4>{2, 2, 3, 4}));
}

TEST(PortableFourFloats, ComparesAllOfThem) {
  EXPECT_TRUE(FourFloats::Truth().everywhere());
  EXPECT_TRUE((of({1, 2, 3}) <= of({1, 3, 4})).everywhere());
  EXPECT_FALSE((of({2, 2, 3}) <= of({1, 3, 4})).everywhere());
  EXPECT_FALSE((of({1, 2, 5}) <= of({1, 3, 4})).everywhere());
  EXPECT_FALSE((of({1, NAN, 3}) <= of({1, 3, 4})).everywhere());
  EXPECT_FALSE((of({1, 2, 3}) <= of({1, NAN, 4})).everywhere());
  const FourFloats::Truth yes = FourFloats() <= FourFloats();
  const FourFloats::Truth no = of({1, 1, 1}) <= FourFloats();
  EXPECT_TRUE((yes & yes).everywhere());
  EXPECT_FALSE((yes & no).everywhere());
  EXPECT_FALSE((no & yes).everywhere());
}

TEST(PortableFourFloats, Transposes) {
  FourFloats rows[4] = {of({1, 2, 3}), of({4, 5, 6}), of({7, 8, 9}), of({10, 11, 12})};
  transpose(rows);
  EXPECT_EQ(stored(rows[0]), (std::array<float, 4>{1, 4, 7, 10}));
  EXPECT_EQ(stored(rows[1]), (std::array<float, 4>{2, 5, 8, 11}));
  EXPECT_EQ(stored(rows[2]), (std::array<float, 4>{3, 6, 9, 12}));
  EXPECT_EQ(stored(rows[3]), (std::array<float, 4>{0, 0, 0, 0}));
}

}  // namespace
