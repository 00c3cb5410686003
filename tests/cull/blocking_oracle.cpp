// SPDX-License-Identifier: MIT
/// Of boxes that block a shaft, the oracle's answer is that of the definition: segments between points of both ends
/// decide.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "oracle/blocking.hpp"
#include "oracle/cases/families.hpp"
#include "sanitizers.hpp"

namespace shaftcull {
namespace {

/// A rational point of a box, in its relative interior; often near a corner, where few segments decide.
oracle::RationalPoint inner_point(Random& random, const Box& box) {
  oracle::RationalPoint point;
  const bool is_near_corner = !random.one_in(3);
  for (std::size_t k = 0; k != 3; ++k) {
    const unsigned of_997 = is_near_corner ? (random.one_in(2) ? 1U : 996U) : 1 + random.below(996);
    const mpq_class part(of_997, 997);
    point[k] = box.lo[k] + part * (mpq_class(box.hi[k]) - box.lo[k]);
  }
  return point;
}

TEST(Oracle, SegmentsBetweenRelativeInteriorsPassWhatBlocks) {
  constexpr std::uint64_t seed = 702;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  std::size_t blocking = 0;
  std::size_t seen_free = 0;
  std::size_t free = 0;
  for (std::size_t i = 0; i != random_cases(3000); ++i) {
    const ShaftInput input{random.grid_box(0, 3), random.grid_box(0, 3)};
    Box box = random.grid_box(-1, 4);
    const std::size_t across = random.below(4);  // of 3, no wall
    for (std::size_t k = 0; k != 3 && across != 3; ++k) {
      if (k == across) continue;
      box.lo[k] = random.integer(-1, 0);
      box.hi[k] = random.integer(3, 4);
    }
    const bool is_blocking = oracle::blocks(input.a, input.b, box);
    bool is_free = false;
    for (int n = 0; n != 60 && !is_free; ++n) {
      is_free = !oracle::passes_through(inner_point(random, input.a), inner_point(random, input.b), box);
    }
    EXPECT_FALSE(is_blocking && is_free) << source_text(input) << "\n  " << source_text(box);
    blocking += is_blocking ? 1U : 0U;
    free += is_blocking ? 0U : 1U;
    seen_free += is_free ? 1U : 0U;
  }
  EXPECT_GE(blocking, random_cases(200));
  EXPECT_GE(seen_free * 10, free * 9) << "of most boxes that do not block, a sample shows it";
}

TEST(Oracle, TheSegmentsBetweenCornersDecideForAllSegments) {
  constexpr std::uint64_t seed = 701;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  std::size_t blocking = 0;
  for (std::size_t i = 0; i != random_cases(2000); ++i) {
    const ShaftInput input{random.grid_box(0, 3), random.grid_box(0, 3)};
    const Box box = random.one_in(2) ? random.grid_box(-1, 4) : blocking_box(random, input);
    const bool is_blocking = oracle::blocks(input.a, input.b, box);
    blocking += is_blocking ? 1U : 0U;
    if (is_blocking) {  // otherwise samples, which include the corners, say nothing new
      EXPECT_TRUE(oracle::blocks_samples(input.a, input.b, box, 3)) << source_text(input) << "\n  " << source_text(box);
    }
  }
  EXPECT_GE(blocking, random_cases(100));
}

}  // namespace
}  // namespace shaftcull
