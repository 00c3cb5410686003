// SPDX-License-Identifier: MIT
/// What a ConvexHull takes, refuses, and keeps through copies and moves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "columns.hpp"
#include "float_modes.hpp"
#include "instruction_sets.hpp"
#include "message_of.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/geometry.hpp"
#include "shaftcull/hull.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

using testing::HasSubstr;

const std::vector<Vec3> tetrahedron = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};

// A shaft that is copied from a temporary hull would refer to memory that is gone; calls take temporary hulls.
static_assert(!std::is_convertible_v<ConvexHull, CompiledShaft> && !std::is_constructible_v<CompiledShaft, ConvexHull>);
static_assert(!std::is_assignable_v<CompiledShaft&, ConvexHull> &&
              !std::is_convertible_v<const ConvexHull, CompiledShaft>);
static_assert(std::is_convertible_v<const ConvexHull&, CompiledShaft>);
static_assert(std::is_invocable_v<decltype([](const CompiledShaft& /*shaft*/) {}), ConvexHull>);

TEST(HullInterface, CopiesOfTheShaftHaveAContactOfTheirOwn) {
  const ConvexHull hull(tetrahedron);
  const Box behind{{-1, -1, -1}, {0, 5, 5}};
  std::vector<CompiledShaft> shafts = {compile({{0, 0, 0}, {1, 1, 1}}, {{2, 2, 2}, {3, 3, 3}}), hull.compiled()};
  EXPECT_TRUE(keeps(shafts[1], behind));
  set_contact(shafts, Contact::open);
  EXPECT_EQ(shafts[1].contact(), Contact::open);
  EXPECT_EQ(hull.compiled().contact(), Contact::closed);
  EXPECT_FALSE(keeps(shafts[1], behind));
  EXPECT_TRUE(keeps(hull, behind));
  EXPECT_EQ(CompiledShaft(shafts[1]).contact(), Contact::open);
  set_contact(shafts[1], Contact::closed);
  EXPECT_EQ(shafts[1].contact(), Contact::closed);
  EXPECT_TRUE(keeps(shafts[1], behind));
}

TEST(HullInterface, AShaftAroundTheHullHasThePlanesThatAHullHasNot) {
  const Box a{{0, 0, 0}, {2, 3, 1}};
  const Box b{{9, 2, 1}, {10, 6, 4}};
  std::vector<Vec3> corners;
  for (const Box* box : {&a, &b}) {
    for (unsigned c = 0; c != 8; ++c) {
      corners.push_back({(c & 1U) != 0 ? box->hi[0] : box->lo[0], (c & 2U) != 0 ? box->hi[1] : box->lo[1],
                         (c & 4U) != 0 ? box->hi[2] : box->lo[2]});
    }
  }
  const ConvexHull hull(corners);
  const std::vector<Plane> planes = {{{1, 2, -1}, 8}, {{-1, 0, 3}, 2}};
  const CompiledShaft around = compile(hull.box(), hull.box(), planes);
  const CompiledShaft with_planes = compile(a, b, planes);
  unsigned kept = 0;
  unsigned beyond = 0;
  for (unsigned i = 0; i != 11 * 7 * 5; ++i) {
    const unsigned row = i / 11;
    const unsigned layer = row / 7;
    const Vec3 at = {static_cast<float>(i % 11), static_cast<float>(row % 7), static_cast<float>(layer)};
    const Box box{at, {at[0] + 0.5F, at[1] + 0.5F, at[2] + 0.5F}};
    EXPECT_EQ(keeps(hull, box) && keeps(around, box), keeps(with_planes, box));
    kept += keeps(with_planes, box) ? 1 : 0;
    beyond += keeps(hull, box) && !keeps(around, box) ? 1 : 0;
  }
  EXPECT_GT(kept, 5U);
  EXPECT_GT(beyond, 5U);
}

TEST(HullInterface, TheTestIsThatOfTheViewAndKept) {
  EXPECT_EQ(ConvexHull(tetrahedron).test(), HullTest::exact);
  ConvexHull view(tetrahedron, {}, HullTest::conservative);
  EXPECT_EQ(view.test(), HullTest::conservative);
  EXPECT_EQ(ConvexHull(view).test(), HullTest::conservative);
  EXPECT_EQ(casters(view, {9, 9, 9}).test(), HullTest::conservative);
  EXPECT_EQ(casters_towards(view, {0, 1, 0}).test(), HullTest::conservative);
  EXPECT_EQ(casters(ConvexHull(tetrahedron), {9, 9, 9}).test(), HullTest::exact);
  const ConvexHull moved = std::move(view);
  EXPECT_EQ(moved.test(), HullTest::conservative);
  EXPECT_EQ(view.test(), HullTest::exact);  // NOLINT: what is left of it
  EXPECT_THAT(message_of([] { const ConvexHull hull(tetrahedron, {}, static_cast<HullTest>(2)); }),
              HasSubstr("test = 2 is neither HullTest::exact nor HullTest::conservative"));
}

TEST(HullInterface, AConservativeHullKeepsWhatNoFaceParts) {
  // The box is beside an edge of the octahedron: beyond none of its faces, and outside.
  const Box beside{{2.25F, 2.25F, -5}, {5, 5, 5}};
  const Box below{{2, 2, 2}, {3, 3, 3}};
  const Box within{{0.5F, 0.5F, 0.5F}, {1, 1, 1}};
  const std::vector<Vec3> corners{{-4, 0, 0}, {4, 0, 0}, {0, -4, 0}, {0, 4, 0}, {0, 0, -4}, {0, 0, 4}};
  const ConvexHull exact(corners);
  const ConvexHull conservative(corners, {}, HullTest::conservative);
  on_each_instruction_set([&] {
    EXPECT_EQ(classify(conservative, below), Answer::outside);
    EXPECT_EQ(classify(conservative, within), Answer::inside);
    EXPECT_EQ(classify(exact, within), Answer::inside);
    EXPECT_EQ(classify(exact, beside), Answer::outside);
    EXPECT_EQ(classify(conservative, beside), Answer::overlap);
    EXPECT_FALSE(keeps(conservative, Box{{1, 1, 1}, {1, 0.5F, 1}}));  // empty
    EXPECT_FALSE(keeps(conservative, Box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}}));
    // Faces across axes are among those of the box around a hull. What has no faces is culled by that box.
    for (const std::vector<Vec3>& points :
         {std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}},
          std::vector<Vec3>{{1, 1, 1}}, std::vector<Vec3>{{0, 0, 0}, {1, 1, 1}}}) {
      const ConvexHull hull(points, {}, HullTest::conservative);
      EXPECT_TRUE(keeps(hull, Box{{1, 1, 1}, {2, 2, 2}}));
      for (unsigned k = 0; k != 3; ++k) {
        Box box{{0.5F, 0.5F, 0.5F}, {2, 2, 2}};
        box.lo[k] = 1.5F;
        EXPECT_FALSE(keeps(hull, box));
        std::vector<std::uint64_t> kept(2);
        cull(hull, BoxStream(std::vector<Box>(70, box)), kept);
        EXPECT_EQ(kept, std::vector<std::uint64_t>(2));
      }
    }
  });
}

TEST(HullInterface, SpheresOfNegativeRadiusAreOutside) {
  const ConvexHull hull(tetrahedron);
  const std::vector<Sphere> spheres(70, Sphere{{0.8F, 0.8F, 0.8F}, -0.125F});  // deep inside
  on_each_instruction_set([&] {
    std::vector<std::uint64_t> kept(2, 5);
    std::vector<std::uint64_t> inside(2, 5);
    classify(hull.compiled(), SphereColumns(spheres).view(), kept, inside);
    EXPECT_EQ(kept, std::vector<std::uint64_t>(2));
    EXPECT_EQ(inside, std::vector<std::uint64_t>(2));
  });
}

TEST(HullInterface, VerticesThatMakeNoHullAreRefused) {
  const auto refusal = [](const std::vector<Vec3>& points, const std::vector<Vec3>& directions) {
    return message_of([&] { const ConvexHull hull(points, directions); });
  };
  EXPECT_THAT(refusal({}, {}), HasSubstr("there is no point"));
  EXPECT_THAT(refusal({}, {{1, 0, 0}}), HasSubstr("there is no point"));
  EXPECT_THAT(refusal(std::vector<Vec3>(33, Vec3{}), {}),
              HasSubstr("33 points and 0 directions; together there can be 32"));
  EXPECT_THAT(refusal(std::vector<Vec3>(30, Vec3{}), std::vector<Vec3>(3, Vec3{1, 0, 0})),
              HasSubstr("30 points and 3"));
  EXPECT_THAT(refusal({{0, 0, 0}, {1, nan, 0}}, {}), HasSubstr("point 1: y = nan is not finite"));
  EXPECT_THAT(refusal({{0, 0, 0}}, {{1, 0, 0}, {0, 0, infinity}}), HasSubstr("direction 1: z = inf is not finite"));
  EXPECT_THAT(refusal({{0, 0, 0}}, {{0, 0, 0}}), HasSubstr("direction 0 is zero"));
  EXPECT_THAT(message_of([] { const ConvexHull hull(std::span<const Vec3>(static_cast<const Vec3*>(nullptr), 2)); }),
              HasSubstr("points"));
}

TEST(HullInterface, ViewsThatMatricesDoNotShowAreRefused) {
  std::vector<float> matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const auto refusal = [&](ClipDepth depth) {
    return message_of([&] { static_cast<void>(frustum(std::span<const float, 16>(matrix.data(), 16), depth)); });
  };
  EXPECT_EQ(frustum(std::span<const float, 16>(matrix.data(), 16), ClipDepth::zero_to_one).box(),
            (Box{{-1, -1, 0}, {1, 1, 1}}));
  EXPECT_EQ(frustum(std::span<const float, 16>(matrix.data(), 16), ClipDepth::minus_one_to_one).box(),
            (Box{{-1, -1, -1}, {1, 1, 1}}));
  matrix[10] = 0;  // all is at one depth
  EXPECT_THAT(refusal(ClipDepth::zero_to_one), HasSubstr("frustum"));
  matrix[10] = nan;
  EXPECT_THAT(refusal(ClipDepth::zero_to_one), HasSubstr("frustum: matrix[10] = nan is not finite"));
  matrix[10] = 1e-39F;  // corners at 10³⁹
  EXPECT_THAT(refusal(ClipDepth::zero_to_one), HasSubstr("beyond all floats"));
  matrix[10] = 1;
  EXPECT_THAT(refusal(static_cast<ClipDepth>(7)), HasSubstr("frustum: depth = 7"));
  matrix[0] = 0;
  matrix[15] = -1;  // w is negative everywhere
  EXPECT_THAT(refusal(ClipDepth::zero_to_one), HasSubstr("frustum: the left plane leaves nothing in view"));
}

TEST(HullInterface, CastersThatCannotBeFormedAreRefused) {
  const ConvexHull full(std::vector<Vec3>(32, Vec3{1, 2, 3}));
  const ConvexHull some(tetrahedron);
  ConvexHull moved_from(tetrahedron);
  const ConvexHull moved_to = std::move(moved_from);
  const auto refusal = [](const ConvexHull& view, const Vec3& light) {
    return message_of([&] { static_cast<void>(casters(view, light)); });
  };
  const auto refusal_of_sun = [](const ConvexHull& view, const Vec3& towards) {
    return message_of([&] { static_cast<void>(casters_towards(view, towards)); });
  };
  EXPECT_THAT(refusal(full, {0, 0, 0}), HasSubstr("casters: the view has 32 points and directions"));
  EXPECT_THAT(refusal_of_sun(full, {0, 0, 1}), HasSubstr("casters_towards: the view has 32 points and directions"));
  EXPECT_THAT(refusal(some, {0, nan, 0}), HasSubstr("casters: light.y = nan is not finite"));
  EXPECT_THAT(refusal_of_sun(some, {0, 0, infinity}), HasSubstr("casters_towards: towards_sun.z = inf is not finite"));
  EXPECT_THAT(refusal_of_sun(some, {0, -0.0F, 0}), HasSubstr("casters_towards: towards_sun is zero"));
  EXPECT_THAT(refusal(moved_from, {0, 0, 0}), HasSubstr("casters: the view was never formed"));  // NOLINT: that is it
  EXPECT_THAT(refusal_of_sun(moved_from, {0, 0, 1}), HasSubstr("casters_towards: the view was never formed"));
}

#ifdef SHAFTCULL_HAS_FLOAT_MODES
TEST(HullInterface, ViewsAndSunsAreThoseOfTheNumbersGivenInEveryMode) {
  const ConvexHull some(tetrahedron);
  const Vec3 sun = {1e-40F, 0, 0};
  std::vector<float> matrix(16, 0.0F);
  for (const std::size_t i : {0U, 5U, 10U, 15U}) matrix[i] = 1e-40F;
  const std::span<const float, 16> view(matrix.data(), 16);
  const Box box = frustum(view, ClipDepth::zero_to_one).box();
  for (const Mode& mode : modes) {
    const InMode in(mode);
    EXPECT_EQ(casters_towards(some, sun).directions().front(), sun) << mode.name;
    EXPECT_EQ(view_planes(view, ClipDepth::zero_to_one).count, 6U) << mode.name;
    EXPECT_EQ(frustum(view, ClipDepth::zero_to_one).box(), box) << mode.name;
  }
}
#endif

TEST(HullInterface, TellsWhatItWasGiven) {
  const std::vector<Vec3> directions = {{0, 0, -1}};
  const ConvexHull hull(tetrahedron, directions);
  EXPECT_THAT(hull.points(), testing::ElementsAreArray(tetrahedron));
  EXPECT_THAT(hull.directions(), testing::ElementsAreArray(directions));
  EXPECT_EQ(hull.box(), (Box{{0, 0, -infinity}, {4, 4, 4}}));
  EXPECT_EQ(hull.compiled().a(), hull.box());
  EXPECT_EQ(hull.compiled().b(), hull.box());
  EXPECT_TRUE(hull.compiled().formed());
  EXPECT_TRUE(hull.compiled().has_planes());
}

TEST(HullInterface, ACopyOutlivesWhatItWasCopiedFrom) {
  auto original = std::make_unique<ConvexHull>(tetrahedron);
  const ConvexHull copy = *original;
  original.reset();
  std::vector<ConvexHull> others;  // in the memory that the original has left
  for (int i = 0; i != 8; ++i) others.emplace_back(std::vector<Vec3>{{9, 9, 9}});
  EXPECT_EQ(classify(copy, Box{{1, 1, 1}, {1.25F, 1.25F, 1.25F}}), Answer::inside);
  EXPECT_EQ(classify(copy, Box{{9, 9, 9}, {9, 9, 9}}), Answer::outside);
}

TEST(HullInterface, CopiesAndMovesAnswerAlike) {
  on_each_instruction_set([] {
    const Box in = {{1, 1, 1}, {1.25F, 1.25F, 1.25F}};
    const Box out = {{3, 3, 3}, {4, 4, 4}};
    ConvexHull hull(tetrahedron);
    const ConvexHull copy = hull;
    ConvexHull moved = std::move(hull);
    for (const ConvexHull* each : {&copy, &std::as_const(moved)}) {
      EXPECT_EQ(classify(*each, in), Answer::inside);
      EXPECT_EQ(classify(*each, out), Answer::outside);
    }
    // What is left of one that was moved from is documented. NOLINTNEXTLINE(bugprone-use-after-move,clang-analyzer-*)
    EXPECT_FALSE(hull.compiled().formed());
    EXPECT_TRUE(hull.points().empty());
    const ConvexHull copy_of_nothing = hull;
    EXPECT_FALSE(copy_of_nothing.compiled().formed());
    hull = moved;
    moved = ConvexHull(std::vector<Vec3>{{9, 9, 9}});
    EXPECT_EQ(classify(hull, in), Answer::inside);
    EXPECT_EQ(classify(moved, in), Answer::outside);
    const ConvexHull& itself = hull;
    hull = itself;
    EXPECT_EQ(classify(hull, in), Answer::inside);
  });
}

}  // namespace
}  // namespace shaftcull
