// SPDX-License-Identifier: MIT
/// How bounds are dealt into shares.
#include "batch/share_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace shaftcull::test {
namespace {

using batch::ShareKey;
using batch::SharePlan;

std::vector<std::size_t> sizes(const SharePlan& plan, const std::vector<ShareKey>& keys) {
  std::vector<std::size_t> count(plan.shares());
  for (const ShareKey& key : keys) ++count.at(plan.share_of(key));
  return count;
}

std::vector<ShareKey> random_keys(std::size_t size) {
  std::mt19937 random(7);  // NOLINT(cert-msc51-cpp): the same keys in every run
  std::uniform_real_distribution<float> number(-10, 10);
  std::vector<ShareKey> keys;
  for (std::size_t i = 0; i != size; ++i) keys.push_back({{number(random), number(random), number(random)}, i});
  return keys;
}

TEST(BatchSharePlan, OneShareHoldsAll) {
  EXPECT_EQ(SharePlan().shares(), 1);
  EXPECT_EQ(SharePlan().share_of({{1, 2, 3}, 4}), 0);
  EXPECT_EQ(SharePlan(random_keys(5), 1).share_of({{1, 2, 3}, 4}), 0);
}

TEST(BatchSharePlan, SharesOfTheSampleAreEquallyLarge) {
  const std::vector<ShareKey> keys = random_keys(1000);
  for (const std::size_t shares : {2U, 3U, 7U, 64U, 999U, 1000U}) {
    const std::vector<std::size_t> count = sizes(SharePlan(keys, shares), keys);
    EXPECT_GE(std::ranges::min(count), 1000 / shares) << shares << " shares";
    EXPECT_LE(std::ranges::max(count), 1000 / shares + 2) << shares << " shares";
  }
}

TEST(BatchSharePlan, EqualMiddlesAreDealtByPosition) {
  std::vector<ShareKey> keys;
  for (std::size_t i = 0; i != 100; ++i) keys.push_back({{1, 1, 1}, i});
  EXPECT_EQ(sizes(SharePlan(keys, 4), keys), (std::vector<std::size_t>{25, 25, 25, 25}));
}

TEST(BatchSharePlan, SharesAreNeighboursInSpace) {
  std::vector<ShareKey> keys;
  for (std::size_t i = 0; i != 100; ++i) keys.push_back({{0, static_cast<float>(i * 37 % 100), 0}, i});
  const SharePlan plan(keys, 4);
  for (const ShareKey& key : keys) EXPECT_EQ(plan.share_of(key), static_cast<std::size_t>(key.middle[1]) / 25);
}

TEST(BatchSharePlan, BoxesWithoutAMiddleHaveOne) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(batch::middle_of({{infinity, -infinity, 1}, {-infinity, infinity, 4}}), (Vec3{0, 0, 2.5F}));
  constexpr float largest = std::numeric_limits<float>::max();
  EXPECT_EQ(batch::middle_of({{largest, -largest, -infinity}, {largest, largest, 4}}), (Vec3{largest, 0, -infinity}));
}

TEST(BatchSharePlan, InfiniteMiddlesAreDealtToo) {
  std::vector<ShareKey> keys = random_keys(100);
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < 100; i += 3) keys[i].middle[i % 3] = i % 2 == 0 ? infinity : -infinity;
  const std::vector<std::size_t> count = sizes(SharePlan(keys, 8), keys);
  EXPECT_GE(std::ranges::min(count), 12);
}

}  // namespace
}  // namespace shaftcull::test
