// SPDX-License-Identifier: MIT
/// The class Shaft: what it accepts, what it refuses and how it says so.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <type_traits>

#include "caught.hpp"
#include "message_of.hpp"
#include "shaftcull/paper.hpp"

namespace shaftcull {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const Box unit_box{{0, 0, 0}, {1, 1, 1}};
const Box far_box{{4, 5, 6}, {7, 8, 9}};

TEST(Shaft, HasItsBoxesAndTheBoxAroundThem) {
  const Shaft shaft(unit_box, far_box);
  EXPECT_EQ(shaft.a(), unit_box);
  EXPECT_EQ(shaft.b(), far_box);
  EXPECT_EQ(shaft.box(), (Box{{0, 0, 0}, {7, 8, 9}}));
}

TEST(Shaft, IsAValue) {
  static_assert(std::is_trivially_copyable_v<Shaft>);
  Shaft shaft(unit_box, far_box);
  const Shaft copy = shaft;
  shaft.add_plane({{1, 0, 0}, 3});
  EXPECT_EQ(copy.added_planes().size(), 0U);
  EXPECT_EQ(shaft.added_planes().size(), 1U);
}

TEST(Shaft, JoinsPointsFlatEqualAndNestedBoxes) {
  const Box point{{2, 2, 2}, {2, 2, 2}};
  EXPECT_EQ(Shaft(point, point).joining_planes().size(), 0U);
  EXPECT_EQ(Shaft(unit_box, unit_box).joining_planes().size(), 0U);
  EXPECT_EQ(Shaft(unit_box, {{0.25F, 0.25F, 0.25F}, {0.5F, 0.5F, 0.5F}}).joining_planes().size(), 0U);
  EXPECT_EQ(Shaft(unit_box, point).joining_planes().size(), 6U);
  EXPECT_EQ(Shaft(unit_box, {{3, 0, 0}, {4, 1, 1}}).joining_planes().size(), 0U);
}

TEST(Shaft, RefusesNanAndNamesBoxAndAxis) {
  Box bad = far_box;
  bad.hi[1] = NAN;
  EXPECT_THAT(message_of([&] { Shaft(unit_box, bad); }), HasSubstr("box b: hi.y = nan"));
}

TEST(Shaft, RefusesInfiniteBoxes) {
  Box bad = unit_box;
  bad.lo[2] = -INFINITY;
  EXPECT_THAT(message_of([&] { Shaft(bad, far_box); }), AllOf(HasSubstr("box a: lo.z = -inf"), HasSubstr("finite")));
}

TEST(Shaft, RefusesLoAboveHiAndNamesTheValues) {
  Box bad = unit_box;
  bad.lo[0] = 3;
  EXPECT_THAT(message_of([&] { Shaft(bad, far_box); }), HasSubstr("box a: lo.x = 3 is above hi.x = 1"));
}

TEST(AddedPlane, IsKeptAsGiven) {
  Shaft shaft(unit_box, far_box);
  const Plane plane{{2, -3, 0}, 4};
  shaft.add_plane(plane);
  ASSERT_EQ(shaft.added_planes().size(), 1U);
  EXPECT_EQ(shaft.added_planes()[0], plane);
}

TEST(AddedPlane, WithoutFiniteNumbersIsRefused) {
  Shaft shaft(unit_box, far_box);
  EXPECT_THAT(message_of([&] { shaft.add_plane({{0, NAN, 1}, 0}); }), HasSubstr("added plane 0: normal.y = nan"));
  EXPECT_THAT(message_of([&] { shaft.add_plane({{0, 0, 1}, INFINITY}); }), HasSubstr("offset = inf"));
  EXPECT_THAT(message_of([&] { shaft.add_plane({{0, -0.0F, 0}, 1}); }), HasSubstr("normal is zero"));
  EXPECT_EQ(shaft.added_planes().size(), 0U);
}

TEST(AddedPlane, BeyondTheRoomForThemIsRefused) {
  Shaft shaft(unit_box, far_box);
  for (std::size_t i = 0; i != max_added_planes; ++i) shaft.add_plane({{1, 0, 0}, static_cast<float>(i)});
  EXPECT_THAT(message_of([&] { shaft.add_plane({{1, 0, 0}, 1}); }), HasSubstr("room for 16"));
  EXPECT_EQ(shaft.added_planes().size(), max_added_planes);
}

}  // namespace
}  // namespace shaftcull
