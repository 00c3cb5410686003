// SPDX-License-Identifier: MIT
/// The baseline of the benchmarks gives the reference answers, however its shafts are formed.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "golden.hpp"
#include "peers/paper/shaft.hpp"

namespace {

using shaftcull::Box;
using shaftcull::paper::Answer;
using shaftcull::paper::Formation;
using shaftcull::paper::Options;
using shaftcull::paper::Shaft;
namespace golden = shaftcull::golden;

class PaperBaseline : public testing::TestWithParam<Options> {
 protected:
  static std::vector<Shaft> form_all() {
    std::vector<Shaft> shafts;
    for (const golden::ShaftRow& row : golden::load_shafts()) {
      shaftcull::paper::Corners a;
      shaftcull::paper::Corners b;
      copy(row.a, a);
      copy(row.b, b);
      shafts.emplace_back(a, b, GetParam());
    }
    return shafts;
  }
  static void copy(const Box& box, shaftcull::paper::Corners& corners) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      corners[0][axis] = box.lo[axis];
      corners[1][axis] = box.hi[axis];
    }
  }
  static Answer answer(bool outside, bool inside) {
    return outside ? Answer::outside : inside ? Answer::inside : Answer::overlap;
  }
};

TEST_P(PaperBaseline, GivesTheReferenceAnswerForEveryBox) {
  const std::vector<Shaft> shafts = form_all();
  std::size_t row_number = 0;
  for (const golden::BoxRow& row : golden::load_boxes()) {
    ++row_number;
    shaftcull::paper::Corners box;
    copy(row.box, box);
    ASSERT_EQ(shafts[row.shaft].classify(box), answer(row.outside, row.inside)) << "boxes.csv, row " << row_number;
    ASSERT_EQ(shafts[row.shaft].outside(box), row.outside) << "boxes.csv, row " << row_number;
  }
}

TEST_P(PaperBaseline, GivesTheReferenceAnswerForEverySphere) {
  if (!GetParam().spheres) GTEST_SKIP() << "formed without spheres";
  const std::vector<Shaft> shafts = form_all();
  std::size_t row_number = 0;
  for (const golden::SphereRow& row : golden::load_spheres()) {
    ++row_number;
    const auto& [x, y, z] = row.sphere.centre;
    const shaftcull::paper::Ball ball{{x, y, z}, row.sphere.radius};
    ASSERT_EQ(shafts[row.shaft].classify(ball), answer(row.outside, row.inside)) << "spheres.csv, row " << row_number;
    ASSERT_EQ(shafts[row.shaft].outside(ball), row.outside) << "spheres.csv, row " << row_number;
  }
}

TEST_P(PaperBaseline, HasAsManyPlanesAsTheReference) {
  if (GetParam().formation == Formation::table) GTEST_SKIP() << "the table adds needless planes where faces coincide";
  const std::vector<Shaft> shafts = form_all();
  for (const golden::ShaftRow& row : golden::load_shafts()) {
    std::size_t count = 0;
    for (const auto* plane = shafts[row.shaft].first_plane(); plane != nullptr; plane = plane->next) ++count;
    ASSERT_EQ(count, row.plane_count) << "shaft " << row.shaft;
  }
}

TEST_P(PaperBaseline, TestsThePlaneThatCutsMostFirst) {
  if (!GetParam().sorted) GTEST_SKIP() << "not sorted";
  for (const Shaft& shaft : form_all()) {
    for (const auto* plane = shaft.first_plane(); plane != nullptr && plane->next != nullptr; plane = plane->next) {
      ASSERT_GE(plane->culled_area, plane->next->culled_area);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Options, PaperBaseline,
                         testing::Values(Options{Formation::run_time, true, true},
                                         Options{Formation::table, true, true},
                                         Options{Formation::run_time, false, false},
                                         Options{Formation::table, false, false}),
                         [](const auto& test) {
                           const Options& options = test.param;
                           return std::string(options.formation == Formation::table ? "Table" : "RunTime") +
                                  (options.sorted ? "Sorted" : "Unsorted") + (options.spheres ? "ForSpheres" : "");
                         });

}  // namespace
