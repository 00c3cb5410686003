// SPDX-License-Identifier: MIT
/// All rows of the reference answers of the paper's original code, asked of the convex hull of a shaft's sixteen
/// corners. Its planes are those of the shaft, so spheres are answered as the original answers them, too.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "golden.hpp"
#include "instruction_sets.hpp"
#include "oracle/shaft_input.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/hull.hpp"

namespace shaftcull {
namespace {

std::vector<ConvexHull> golden_hulls() {
  std::vector<ConvexHull> hulls;
  for (const golden::ShaftRow& row : golden::load_shafts()) {
    std::vector<Vec3> corners;
    for (const Box& box : {row.a, row.b}) {
      for (unsigned corner = 0; corner != 8; ++corner) {
        Vec3 point{};
        for (std::size_t k = 0; k != 3; ++k) point[k] = (corner >> k & 1U) != 0 ? box.hi[k] : box.lo[k];
        corners.push_back(point);
      }
    }
    hulls.emplace_back(corners);
  }
  return hulls;
}

Answer answer(bool outside, bool inside) {
  return outside ? Answer::outside : inside ? Answer::inside : Answer::overlap;
}

TEST(HullGoldenAnswers, EveryBoxRowMatches) {
  const std::vector<ConvexHull> hulls = golden_hulls();
  const std::vector<golden::BoxRow> rows = golden::load_boxes();
  on_each_instruction_set([&] {
    for (const golden::BoxRow& row : rows) {
      ASSERT_EQ(classify(hulls[row.shaft], row.box), answer(row.outside, row.inside))
          << "shaft " << row.shaft << ", " << source_text(row.box);
    }
  });
}

TEST(HullGoldenAnswers, EverySphereRowMatches) {
  const std::vector<ConvexHull> hulls = golden_hulls();
  const std::vector<golden::SphereRow> rows = golden::load_spheres();
  on_each_instruction_set([&] {
    for (const golden::SphereRow& row : rows) {
      ASSERT_EQ(classify(hulls[row.shaft], row.sphere), answer(row.outside, row.inside))
          << "shaft " << row.shaft << ", " << source_text(row.sphere);
    }
  });
}

}  // namespace
}  // namespace shaftcull
