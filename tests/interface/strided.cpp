// SPDX-License-Identifier: MIT
/// Records by the names of members: what is packed is what the members hold, and wrong types do not compile.
#include "shaftcull/strided.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "message_of.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/tree.hpp"

namespace shaftcull {
namespace {

struct Point {
  float x, y, z;
};

class Constructed {
 public:
  Constructed(float x, float y, float z) noexcept : x_(x), y_(y), z_(z) {}
  [[nodiscard]] float sum() const noexcept { return x_ + y_ + z_; }

 private:
  float x_, y_, z_;
};

struct Object {
  std::uint8_t kind;
  float lo[3];
  Point hi;
  std::array<float, 3> centre;
  float radius;
  Constructed half_extent{0, 0, 0};
  double not_a_float;
  std::int32_t cell[3];
};

struct NamedObject : Object {
  std::uint64_t name;
};

template <class Item>
std::vector<Item> some_objects() {
  std::vector<Item> objects(70);
  for (std::size_t i = 0; i != objects.size(); ++i) {
    const auto x = static_cast<float>(i);
    objects[i].lo[0] = x;
    objects[i].lo[1] = -x;
    objects[i].lo[2] = 2 * x;
    objects[i].hi = {x + 1, 2 - x, 2 * x + 3};
    objects[i].centre = {x, x + 1, x + 2};
    objects[i].radius = x / 2;
    objects[i].half_extent = {1, x, 0};
  }
  return objects;
}

TEST(Records, OfMembersArePacked) {
  const std::vector<Object> objects = some_objects<Object>();
  const BoxStream boxes(strided(objects, &Object::lo, &Object::hi));
  const BoxStream centred(strided_centre_extents(objects, &Object::centre, &Object::half_extent));
  const SphereStream spheres(strided(objects, &Object::centre, &Object::radius));
  ASSERT_EQ(boxes.size(), objects.size());
  for (std::size_t i = 0; i != objects.size(); ++i) {
    const auto x = static_cast<float>(i);
    EXPECT_EQ(boxes[i], (Box{{x, -x, 2 * x}, {x + 1, 2 - x, 2 * x + 3}}));
    EXPECT_EQ(centred[i], (Box{{x - 1, 1, x + 2}, {x + 1, 2 * x + 1, x + 2}}));
    EXPECT_EQ(spheres[i], (Sphere{{x, x + 1, x + 2}, x / 2}));
  }
}

TEST(Records, OfDerivedObjectsAndSpansOfThemArePacked) {
  const std::vector<NamedObject> objects = some_objects<NamedObject>();
  const BoxStream boxes(strided(std::span(objects).subspan(5, 10), &NamedObject::lo, &NamedObject::hi));
  ASSERT_EQ(boxes.size(), 10U);
  EXPECT_EQ(boxes[0].lo, (Vec3{5, -5, 10}));
  const BoxTree tree(strided(objects, &Object::lo, &Object::hi));
  EXPECT_EQ(tree.size(), objects.size());
}

TEST(Records, OfNoObjectsAreEmpty) {
  const std::vector<Object> none;
  EXPECT_EQ(BoxStream(strided(none, &Object::lo, &Object::hi)).size(), 0U);
  EXPECT_EQ(SphereStream(strided(std::span<const Object>(), &Object::centre, &Object::radius)).size(), 0U);
  const std::span<const Object> null(static_cast<const Object*>(nullptr), 3);
  EXPECT_THAT(message_of([&] { BoxStream{strided(null, &Object::lo, &Object::hi)}; }),
              testing::HasSubstr("StridedBoxes::lo is null"));
}

template <class Member>
constexpr bool makes_records = requires(const std::vector<Object>& objects, Member Object::*member) {
  strided(objects, member, member);
};
static_assert(makes_records<float[3]> && makes_records<Point> && makes_records<Constructed> &&
              makes_records<std::array<float, 3>>);
static_assert(!makes_records<float>, "one float is no corner");
static_assert(!makes_records<double[3]> && !makes_records<std::int32_t[3]> && !makes_records<float[4]>);
static_assert(!makes_records<std::array<std::int32_t, 3>> && !makes_records<std::array<float, 4>>);
static_assert(!makes_records<Object>);

template <class Objects>
constexpr bool can_be_referred_to = requires(Objects&& objects) {
  strided(static_cast<Objects&&>(objects), &Object::lo, &Object::hi);
};
static_assert(can_be_referred_to<std::vector<Object>&> && can_be_referred_to<const std::array<Object, 2>&>);
static_assert(can_be_referred_to<std::span<Object>>);
static_assert(!can_be_referred_to<std::vector<Object>>, "a temporary array is gone before it is read");

}  // namespace
}  // namespace shaftcull
