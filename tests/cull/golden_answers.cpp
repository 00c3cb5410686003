// SPDX-License-Identifier: MIT
/// All rows of the reference answers of the paper's original code.
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "cull/agreement.hpp"
#include "golden.hpp"
#include "oracle/hull.hpp"

namespace shaftcull {
namespace {

template <class Bound>
struct Rows {
  std::vector<Bound> bounds;
  std::vector<Answer> right;
};

Answer answer(bool outside, bool inside) {
  return outside ? Answer::outside : inside ? Answer::inside : Answer::overlap;
}

TEST(GoldenAnswers, EveryBoxRowMatches) {
  const std::vector<golden::ShaftRow> shafts = golden::load_shafts();
  std::map<std::size_t, Rows<Box>> rows;
  for (const golden::BoxRow& row : golden::load_boxes()) {
    rows[row.shaft].bounds.push_back(row.box);
    rows[row.shaft].right.push_back(answer(row.outside, row.inside));
  }
  for (const auto& [shaft, of_shaft] : rows) {
    SCOPED_TRACE("row " + std::to_string(shaft) + " of shafts.csv");
    expect_answers({shafts[shaft].a, shafts[shaft].b}, of_shaft.bounds, of_shaft.right);
    if (testing::Test::HasFailure()) break;
  }
}

TEST(GoldenAnswers, EverySphereRowMatchesButForTheOriginalsFalselyKept) {
  const std::vector<golden::ShaftRow> shafts = golden::load_shafts();
  std::map<std::size_t, Rows<Sphere>> rows;
  std::size_t falsely_kept = 0;
  for (const golden::SphereRow& row : golden::load_spheres()) {
    Answer right = answer(row.outside, row.inside);
    if (right == Answer::overlap) {
      const oracle::Hull hull(shafts[row.shaft].a, shafts[row.shaft].b);
      right = hull.answer(row.sphere) == Answer::outside ? Answer::outside : Answer::overlap;
      falsely_kept += right == Answer::outside;
    }
    rows[row.shaft].bounds.push_back(row.sphere);
    rows[row.shaft].right.push_back(right);
  }
  RecordProperty("falsely_kept_by_the_original", static_cast<int>(falsely_kept));
  for (const auto& [shaft, of_shaft] : rows) {
    SCOPED_TRACE("row " + std::to_string(shaft) + " of shafts.csv");
    expect_answers({shafts[shaft].a, shafts[shaft].b}, of_shaft.bounds, of_shaft.right);
    if (testing::Test::HasFailure()) break;
  }
}

}  // namespace
}  // namespace shaftcull
