// SPDX-License-Identifier: MIT
/// What calls about visibility refuse, and what they say then.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "caught.hpp"
#include "columns.hpp"
#include "message_of.hpp"
#include "shaftcull/shaftcull.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

using testing::HasSubstr;

constexpr Box unit{{0, 0, 0}, {1, 1, 1}};

template <class T>
std::span<const T> none_at_all() {
  return {static_cast<const T*>(nullptr), 3};
}

/// What a call says that refuses a bound, after its position.
template <class Call>
std::string bad_bound(const Call& call) {
  if (const auto bad = caught<BadBound>(call)) return std::to_string(bad->index()) + ": " + bad->what();
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

std::vector<Box> boxes_with(const Box& last) { return {unit, unit, last}; }

TEST(VisibilityErrors, PatchesHaveOneSideOrTwo) {
  const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5F}};
  const std::vector<std::size_t> first = {0, 3};
  EXPECT_TRUE(PatchSet(corners, first, PatchSides::front).has_planes());
  EXPECT_FALSE(PatchSet(corners, first, PatchSides::both).has_planes());
  EXPECT_EQ(message_of([&] { PatchSet(corners, first, static_cast<PatchSides>(2)); }),
            "sides = 2 is neither PatchSides::front nor PatchSides::both");
}

TEST(VisibilityErrors, PatchesAreFiniteAndHaveAnInside) {
  for (const float x : {nan, infinity, -infinity}) {
    for (std::size_t k = 0; k != 6; ++k) {
      Box box = unit;
      (k < 3 ? box.lo[k] : box.hi[k - 3]) = x;
      EXPECT_EQ(bad_bound([&] { PatchSet(columns(boxes_with(box)).view()); }), "2: patch 2 is not finite");
      EXPECT_THROW(PatchSet(std::span<const Box>(boxes_with(box))), BadBound);
    }
  }
  const Box upside_down{{0, 2, 0}, {1, 1, 1}};
  const std::string why = "2: patch 2 has lo > hi: lo.y = 2 is above hi.y = 1";
  EXPECT_EQ(bad_bound([&] { PatchSet(columns(boxes_with(upside_down)).view()); }), why);
  EXPECT_EQ(bad_bound([&] { PatchSet(std::span<const Box>(boxes_with(upside_down))); }), why);
  const Box empty{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  EXPECT_EQ(bad_bound([&] { PatchSet(std::span<const Box>(boxes_with(empty))); }), "2: patch 2 is not finite");
  EXPECT_EQ(message_of([] { PatchSet(none_at_all<Box>()); }), "boxes is null; it must point to the first of 3 boxes");
  BoxView view;
  view.count = 1;
  EXPECT_THROW(PatchSet{view}, InvalidArgument);
}

TEST(VisibilityErrors, PlanesAreFiniteAndOneForEachPatch) {
  const std::vector<Box> boxes(3, unit);
  const Plane up{{0, 0, 1}, 0};
  const auto refused = [&](const Plane& plane) {
    const std::vector<Plane> planes{up, plane, up};
    return bad_bound([&] { PatchSet(std::span<const Box>(boxes), planes); });
  };
  EXPECT_EQ(refused({{0, nan, 1}, 0}), "1: patch 1 has a plane that is not finite");
  EXPECT_EQ(refused({{0, 0, -infinity}, 0}), "1: patch 1 has a plane that is not finite");
  EXPECT_EQ(refused({{0, 0, 1}, infinity}), "1: patch 1 has a plane that is not finite");
  EXPECT_EQ(refused({{0, -0.0F, 0}, 1}), "1: patch 1 has a plane whose normal is zero");
  for (const std::size_t count : {1U, 2U, 4U}) {
    const std::vector<Plane> planes(count, up);
    EXPECT_THAT(message_of([&] { PatchSet(std::span<const Box>(boxes), planes); }),
                HasSubstr("for 3 patches; there must be one for each, or none"));
  }
  EXPECT_THROW(PatchSet(std::span<const Box>(boxes), none_at_all<Plane>()), InvalidArgument);
  EXPECT_FALSE(PatchSet(std::span<const Box>(boxes)).has_planes());
  EXPECT_TRUE(PatchSet(std::span<const Box>(boxes), std::vector<Plane>(3, up)).has_planes());
}

/// Occluders after something was refused are what they were before.
class Refusing {
 public:
  Refusing() { begin(); }
  template <class Add>
  std::string bad(const Add& add) {
    std::string said = bad_bound([&] { add(occluders_); });
    expect_unchanged();
    return said;
  }
  template <class Add>
  std::string invalid(const Add& add) {
    std::string said = message_of([&] { add(occluders_); });
    expect_unchanged();
    return said;
  }
  Occluders& occluders() { return occluders_; }

 private:
  void begin() {
    occluders_.add_boxes(std::span<const Box>(&unit, 1));
    occluders_.add_solids(std::span<const Box>(&unit, 1));
  }
  void expect_unchanged() {
    if (failed_calls_undo) {
      EXPECT_EQ(occluders_.size(), 2U);
    } else {
      occluders_ = {};
      begin();
    }
  }

  Occluders occluders_;
};

TEST(VisibilityErrors, OccludersAreFiniteAndHaveAnInside) {
  Refusing refusing;
  const std::vector<Box> broken = boxes_with({{0, 0, 0}, {1, infinity, 1}});
  const std::vector<Box> empty = boxes_with({{0, 0, 3}, {1, 1, 1}});
  const auto said = [&](const auto& add) { return refusing.bad(add); };
  EXPECT_EQ(said([&](Occluders& to) { to.add_boxes(std::span<const Box>(broken)); }), "2: box 2 is not finite");
  EXPECT_EQ(said([&](Occluders& to) { to.add_boxes(columns(broken).view()); }), "2: box 2 is not finite");
  EXPECT_EQ(said([&](Occluders& to) { to.add_boxes(std::span<const Box>(empty)); }),
            "2: box 2 has lo > hi: lo.z = 3 is above hi.z = 1");
  EXPECT_EQ(said([&](Occluders& to) { to.add_solids(std::span<const Box>(broken)); }), "2: solid 2 is not finite");
  EXPECT_EQ(said([&](Occluders& to) { to.add_solids(columns(empty).view()); }),
            "2: solid 2 has lo > hi: lo.z = 3 is above hi.z = 1");
  EXPECT_EQ(said([&](Occluders& to) {
              const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                              {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, nan}};
              to.add_solid_hulls(corners, std::vector<std::size_t>{0, 4, 8});
            }),
            "1: hull 1 has a corner that is not finite");
  EXPECT_EQ(said([&](Occluders& to) {
              const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, infinity, 0}};
              to.add_polygons(corners, std::vector<std::size_t>{0, 3});
            }),
            "0: polygon 0 has a corner that is not finite");
  EXPECT_EQ(said([&](Occluders& to) {
              const Triangle triangle{{{{0, 0, 0}, {1, 0, nan}, {0, 1, 0}}}};
              to.add_triangles(TriangleColumns({triangle}).view());
            }),
            "0: triangle 0 is not finite");
  EXPECT_THROW(refusing.occluders().add_boxes(none_at_all<Box>()), InvalidArgument);
  EXPECT_THROW(refusing.occluders().add_solids(none_at_all<Box>()), InvalidArgument);
  EXPECT_THROW(refusing.occluders().add_polygons(none_at_all<Vec3>(), std::vector<std::size_t>{0, 3}), InvalidArgument);
  EXPECT_THROW(refusing.occluders().add_solid_hulls(std::vector<Vec3>(4), none_at_all<std::size_t>()), InvalidArgument);
  TriangleView view;
  view.count = 1;
  EXPECT_THROW(refusing.occluders().add_triangles(view), InvalidArgument);
  EXPECT_EQ(refusing.occluders().size(), 2U);
}

TEST(VisibilityErrors, NothingOfARefusedAdditionStays) {
  const Box points[] = {{{0, 0, -9}, {0, 0, -9}}, {{0, 0, 9}, {0, 0, 9}}};
  const PatchSet patches{std::span<const Box>(points)};
  const std::vector<Vec3> wall{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  std::vector<Vec3> broken{{7, 7, 7}, {8, 7, 7}, {7, 8, 7}, {7, 8, 8}};
  broken.insert(broken.end(), wall.begin(), wall.end());
  broken.back()[0] = nan;
  const std::vector<std::size_t> two{0, 4, 8};
  Occluders occluders;
  EXPECT_THROW(occluders.add_polygons(broken, two), BadBound);
  EXPECT_THROW(occluders.add_solid_hulls(broken, two), BadBound);
  EXPECT_EQ(occluders.size(), 0U);
  EXPECT_EQ(occluders.add_polygons(wall, std::vector<std::size_t>{0, 4}), 0U);
  EXPECT_EQ(count_visibility(patches, occluders).occluded, 1U);
}

TEST(VisibilityErrors, HullsHaveFourCornersOrMoreAndPolygonsThree) {
  Refusing refusing;
  EXPECT_EQ(refusing.invalid([&](Occluders& to) {
    to.add_solid_hulls(std::vector<Vec3>(3), std::vector<std::size_t>{0, 3});
  }),
            "hull 0 has 3 corners; it takes 4 or more");
  for (const std::size_t count : {3U, 33U}) {
    EXPECT_EQ(message_of([&] { static_cast<void>(inscribed_box(std::vector<Vec3>(count))); }),
              "a solid hull has " + std::to_string(count) + " corners; it takes 4 to 32");
  }
  EXPECT_EQ(refusing.invalid([&](Occluders& to) {
    to.add_polygons(std::vector<Vec3>(5), std::vector<std::size_t>{0, 3, 5});
  }),
            "polygon 1 has 2 corners; it takes 3 or more");
  EXPECT_EQ(refusing.invalid([&](Occluders& to) {
    to.add_polygons(std::vector<Vec3>(3), std::vector<std::size_t>{0, 0, 3});
  }),
            "polygon 0 has 0 corners; it takes 3 or more");
  EXPECT_EQ(message_of([] {
              static_cast<void>(inscribed_box(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, nan}, {0, 0, 1}}));
            }),
            "corner 2 of a solid hull is not finite");
  EXPECT_THROW(static_cast<void>(inscribed_box(none_at_all<Vec3>())), InvalidArgument);
  EXPECT_NO_THROW(refusing.occluders().add_solid_hulls(std::vector<Vec3>(40), std::vector<std::size_t>{0, 4, 40}));
  EXPECT_EQ(refusing.occluders().size(), 4U);
}

TEST(VisibilityErrors, ListsOfPartsAscendFromZeroToTheNumber) {
  Refusing refusing;
  const std::vector<Vec3> corners(8);
  const std::vector<Triangle> triangles(8);
  const TriangleColumns columns_of_triangles(triangles);
  const auto all = [&](const std::vector<std::size_t>& first) {
    const std::string hulls = refusing.invalid([&](Occluders& to) { to.add_solid_hulls(corners, first); });
    EXPECT_EQ(refusing.invalid([&](Occluders& to) { to.add_polygons(corners, first); }), hulls);
    std::string groups;
    if (!first.empty()) {
      groups = "; " + refusing.invalid([&](Occluders& to) { to.add_triangles(columns_of_triangles.view(), first); });
    }
    return hulls + groups;
  };
  const std::string ends =
      "first_corner must begin with 0 and end with the number of corners, 8; "
      "first_triangle must begin with 0 and end with the number of triangles, 8";
  EXPECT_EQ(all({1, 8}), ends);
  EXPECT_EQ(all({0, 4}), ends);
  EXPECT_EQ(all({0, 9}), ends);
  EXPECT_EQ(all({0}), ends);
  EXPECT_EQ(all({}), "first_corner must begin with 0 and end with the number of corners, 8");
  EXPECT_EQ(all({0, 5, 4, 8}),
            "first_corner[2] = 4 is less than the one before it; "
            "first_triangle[2] = 4 is less than the one before it");
  EXPECT_EQ(refusing.invalid([&](Occluders& to) {
    to.add_triangles(columns_of_triangles.view(), std::vector<std::size_t>{0, 3, 3, 8});
  }),
            "group 1 of triangles is empty");
  // No parts of nothing.
  EXPECT_EQ(refusing.occluders().add_polygons({}, {}), 2U);
  EXPECT_EQ(refusing.occluders().add_solid_hulls({}, std::vector<std::size_t>{0}), 2U);
  EXPECT_EQ(refusing.occluders().add_triangles(TriangleView{}), 2U);
}

TEST(VisibilityErrors, OptionsAndCallbacksAreChecked) {
  const PatchSet patches{std::span<const Box>(boxes_with(unit))};
  const Occluders occluders;
  const auto ignore = [](const SightBatch&) {};
  const auto all = [&](const VisibilityOptions& options) {
    std::string said = message_of([&] { static_cast<void>(count_visibility(patches, occluders, options)); });
    EXPECT_EQ(message_of([&] { static_cast<void>(count_visibility(patches, patches, occluders, options)); }), said);
    EXPECT_EQ(message_of([&] { visibility(patches, occluders, ignore, options); }), said);
    EXPECT_EQ(message_of([&] { visibility(patches, patches, occluders, ignore, options); }), said);
    EXPECT_EQ(message_of([&] { static_cast<void>(collect_visibility(patches, occluders, options)); }), said);
    std::vector<std::uint64_t> bits(3);
    EXPECT_EQ(message_of([&] { visibility_bits(patches, occluders, Sight::clear, bits, options); }), said);
    return said;
  };
  VisibilityOptions small;
  small.memory = (std::size_t{1} << 20) - 1;
  EXPECT_EQ(all(small), "memory is 1048575 bytes; it takes 1 MB (1048576) or more");
  VisibilityOptions odd;
  odd.contact = static_cast<Contact>(2);
  EXPECT_THAT(all(odd), HasSubstr("Contact"));

  EXPECT_EQ(message_of([&] { visibility(patches, occluders, std::function<void(const SightBatch&)>()); }),
            "deliver is empty; it is called with the answers");
  EXPECT_EQ(message_of([&] { visibility(patches, patches, occluders, std::function<void(const SightBatch&)>()); }),
            "deliver is empty; it is called with the answers");
  std::vector<std::uint64_t> bits(3);
  EXPECT_EQ(message_of([&] { visibility_bits(patches, occluders, static_cast<Sight>(4), bits); }),
            "sight = 4 is none of Sight::undecided, Sight::clear, Sight::occluded and Sight::facing_away");
  for (const std::size_t words : {0U, 2U, 4U}) {
    bits.assign(words, 7);
    const std::string why =
        "bits has " + std::to_string(words) +
        " words; 3 rows, one for each patch of a, of bit_words(3) = 1 word, a bit for each patch of b, "
        "take 3";
    EXPECT_EQ(message_of([&] { visibility_bits(patches, occluders, Sight::clear, bits); }), why);
    EXPECT_EQ(message_of([&] { visibility_bits(patches, patches, occluders, Sight::clear, bits); }), why);
    EXPECT_EQ(bits, std::vector<std::uint64_t>(words, 7));
  }
  EXPECT_THROW(visibility_bits(patches, occluders, Sight::clear, {static_cast<std::uint64_t*>(nullptr), 3}),
               InvalidArgument);
}

TEST(VisibilityErrors, MergedBoxesAreFiniteAndHaveAnInside) {
  EXPECT_EQ(bad_bound([] {
              static_cast<void>(merged_boxes(boxes_with({{0, nan, 0}, {1, 1, 1}})));
            }),
            "2: box 2 is not finite");
  EXPECT_EQ(bad_bound([] {
              static_cast<void>(merged_boxes(boxes_with({{0, 2, 0}, {1, 1, 1}})));
            }),
            "2: box 2 has lo > hi: lo.y = 2 is above hi.y = 1");
  EXPECT_THROW(static_cast<void>(merged_boxes(none_at_all<Box>())), InvalidArgument);
  EXPECT_TRUE(merged_boxes({}).empty());
}

TEST(VisibilityErrors, SightsHaveNames) {
  EXPECT_EQ(name(Sight::undecided), "undecided");
  EXPECT_EQ(name(Sight::clear), "clear");
  EXPECT_EQ(name(Sight::occluded), "occluded");
  EXPECT_EQ(name(Sight::facing_away), "facing_away");
}

}  // namespace
}  // namespace shaftcull
