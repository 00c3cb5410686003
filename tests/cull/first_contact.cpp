// SPDX-License-Identifier: MIT
/// First contact: which bound is reached first, and when, are those of exact arithmetic, in views and in trees.
#include "shaftcull/first_contact.hpp"
#include "forms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "columns.hpp"
#include "instruction_sets.hpp"
#include "oracle/cases/families.hpp"
#include "oracle/cases/moving.hpp"
#include "oracle/entry_time.hpp"
#include "oracle/hull.hpp"
#include "oracle/moving_hull.hpp"
#include "oracle/quick_hull.hpp"
#include "oracle/shaft_input.hpp"
#include "sanitizers.hpp"
#include "shaftcull/geometry.hpp"
#include "shaftcull/volumes.hpp"

namespace shaftcull {
namespace {

/// First contact by the definition: of the bounds that are not outside, the one with the least time.
template <class Hull, class TimeOf, class NormalOf, class Bound>
FirstContact expected_contact(const Hull& hull, const TimeOf& time_of, const NormalOf& normal_of,
                              const std::vector<Bound>& bounds) {
  FirstContact first;
  decltype(time_of(bounds[0])) least;
  for (std::size_t i = 0; i != bounds.size(); ++i) {
    if (hull.answer(bounds[i]) == Answer::outside) continue;
    const auto time = time_of(bounds[i]);
    if (!time.has_value()) {
      ADD_FAILURE() << "a bound that meets the shaft is never reached: " << source_text(bounds[i]);
      continue;
    }
    if (least && *least <= *time) continue;
    least = time;
    first = {static_cast<std::uint32_t>(i), oracle::rounded_down(*time)};
  }
  if (first) first.normal = normal_of(bounds[first.index]);
  return first;
}

std::string text_of(const FirstContact& contact) {
  std::string text = std::to_string(contact.index) + " at " + std::to_string(contact.time) + ", normal";
  for (const float n : contact.normal) text += ' ' + std::to_string(n);
  return text;
}

/// Asks a view and trees, whose first contact must be the one expected.
template <class Bound>
void expect_contact(const CompiledShaft& shaft, const std::vector<Bound>& bounds, const FirstContact& expected,
                    const std::string& source) {
  const auto memory = columns(bounds);
  const auto expect = [&](const FirstContact& found, const char* of, Isa isa) {
    if (found == expected) return;
    ADD_FAILURE() << "on " << name(isa) << ", form " << of << "; of " << bounds.size() << " " << text_of(expected)
                  << " is first, answered " << text_of(found) << ":\n  " << source << "; "
                  << (found ? source_text(bounds[found.index]) : std::string()) << "; "
                  << (expected ? source_text(bounds[expected.index]) : std::string());
  };
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    for (const Form form : forms) expect(first_contact(in_form(shaft, form), memory.view()), "view", isa);
    std::vector<FirstContact> many(3);
    first_contact_many(std::vector<CompiledShaft>(3, shaft), memory.view(), many);
    for (const auto& one : many) expect(one, "view of many shafts", isa);
    const BoundsTree<Bound> tree{std::span<const Bound>(bounds)};
    expect(first_contact(shaft, tree), "tree", isa);
  }
}

template <class Bound>
void expect_contact(const ShaftInput& input, const std::vector<Bound>& bounds) {
  const auto expected = expected_contact(
      oracle::Hull(input.a, input.b, input.added),
      [&](const Bound& bound) { return oracle::entry_time(input.a, input.b, bound); },
      [&](const Bound& bound) { return oracle::contact_normal(input.a, input.b, bound); }, bounds);
  expect_contact(shaft_of(input), bounds, expected, source_text(input));
}

template <class Bound>
void expect_contact(const MovingInput& input, const std::vector<Bound>& bounds) {
  const auto expected = expected_contact(
      oracle::MovingHull(input), [&](const Bound& bound) { return oracle::entry_time(input, bound); },
      [&](const Bound& bound) { return oracle::contact_normal(input, bound); }, bounds);
  expect_contact(shaft_of(input), bounds, expected, source_text(input));
}

/// Bounds of one kind from a family.
template <class Bound>
class FamilyBounds {
 public:
  FamilyBounds(const Family& family, const ShaftInput& input) : family_(family), input_(input), hull_(input) {}

  Bound operator()(Random& random) const {
    if constexpr (std::is_same_v<Bound, Box>) {
      return family_.box(random, input_);
    } else {
      return family_.sphere(random, input_, hull_);
    }
  }

 private:
  const Family& family_;
  const ShaftInput& input_;
  oracle::QuickHull hull_;
};

template <class Bound>
Bound grid_bound(Random& random) {
  if constexpr (std::is_same_v<Bound, Box>) {
    return random.grid_box(-12, 12);
  } else {
    return {{random.integer(-12, 12), random.integer(-12, 12), random.integer(-12, 12)}, random.integer(0, 5)};
  }
}

template <class Bound>
Bound any_bound(Random& random) {
  if constexpr (std::is_same_v<Bound, Box>) {
    return random.box(-12, 12, 0.01F, 3);
  } else {
    return {random.vec3(-12, 12), random.uniform(0.01F, 4)};
  }
}

/// Asks about 24 bounds, and some of them again.
template <class Input, class NextBound>
void expect_contact_of(Random& random, const Input& input, const NextBound& next) {
  std::vector<decltype(next())> bounds;
  while (bounds.size() != 24) bounds.push_back(next());
  for (int same = 0; same != 6; ++same) bounds.push_back(bounds[random.below(24)]);  // ties
  expect_contact(input, bounds);
  std::reverse(bounds.begin(), bounds.end());
  expect_contact(input, bounds);
}

template <class Bound>
class FirstContactOfBounds : public testing::Test {};
using BoundKinds = testing::Types<Box, Sphere>;
TYPED_TEST_SUITE(FirstContactOfBounds, BoundKinds);

TYPED_TEST(FirstContactOfBounds, IsThatOfExactArithmeticForAllFamilies) {
  for (const Family& family : families) {
    SCOPED_TRACE(family.name);
    Random random(800);
    for (unsigned i = 0; i != random_cases(40) && !testing::Test::HasFailure(); ++i) {
      const ShaftInput input = family.shaft(random, i * 17);
      const FamilyBounds<TypeParam> bounds(family, input);
      expect_contact_of(random, input, [&] { return bounds(random); });
    }
  }
}

TYPED_TEST(FirstContactOfBounds, IsThatOfExactArithmeticForSweepsAndShadows) {
  using Kind = MovingInput::Kind;
  Random random(804);
  for (unsigned i = 0; i != random_cases(400) && !testing::Test::HasFailure(); ++i) {
    const bool is_on_grid = random.one_in(2);
    const auto box = [&] { return is_on_grid ? random.grid_box(-8, 8) : random.box(-8, 8, 0.01F, 1.5F); };
    MovingInput input{static_cast<Kind>(i % 4), box()};
    for (float& d : input.displacement) d = is_on_grid ? random.integer(-6, 6) : random.uniform(-20, 20);
    input.displacement[i / 4 % 3] = is_on_grid ? 3.0F : 1e-3F;  // never 0
    input.light = box();
    const float apart = input.box.hi[0] + 2 - input.light.lo[0];
    if (is_on_grid) {
      input.light.lo[0] += apart;
      input.light.hi[0] += apart;
    } else {
      input.light = {{input.box.hi[0] + 0.3F, -1, -2}, {input.box.hi[0] + 1, 1, -1}};
    }
    input.reach = is_on_grid ? random.integer(1, 5) : random.uniform(1, 9);
    expect_contact_of(random, input,
                      [&] { return is_on_grid ? grid_bound<TypeParam>(random) : any_bound<TypeParam>(random); });
  }
}

TEST(FirstContact, IsToldHoweverLateItIs) {
  on_each_instruction_set([] {
    const CompiledShaft shaft = swept_infinite({{0, 0, 0}, {1, 1, 1}}, {0x1p-100F, 0, 0});
    const std::vector<Box> boxes = {{{0x1p100F, 0, 0}, {0x1.8p100F, 1, 1}}, {{0x1p99F, 0, 0}, {0x1.8p99F, 1, 1}}};
    const FirstContact contact = first_contact(shaft, BoxColumns(boxes).view());
    EXPECT_EQ(contact.index, 1U);
    EXPECT_EQ(contact.time, std::numeric_limits<float>::max()) << "the time is 2¹⁹⁹";
  });
}

/// Where a face is at the start, how far it goes, and a place that it reaches on the way.
struct Reach {
  float from;
  float to;
  float place;

  [[nodiscard]] mpq_class time() const {
    return (mpq_class(place) - mpq_class(from)) / (mpq_class(to) - mpq_class(from));
  }
  [[nodiscard]] double rounded_time() const {
    const double start = from;
    return (static_cast<double>(place) - start) / (static_cast<double>(to) - start);
  }
  /// Random, with differences of 48 bits; the face starts at minus `low`.
  Reach(Random& random, float low, float time)
      : from(-low),
        to(0x1p24F * random.integer(0x700000, 0x7fffff)),
        place(0x1p24F * std::round(time * to * 0x1p-24F)) {}
};

/// Two faces that reach two places at times which differ by about a rounding of a double.
std::pair<Reach, Reach> nearly_equal_times(Random& random) {
  const Reach one(random, random.integer(1, 0xffffff), random.uniform(0.1F, 0.4F));
  const mpq_class t = one.time();
  std::pair<Reach, Reach> nearest(one, one);
  mpq_class least = 1;
  for (int tries = 0; tries != 400; ++tries) {
    // (place + low) / (to + low) = t where low = (t to − place) / (1 − t).
    Reach other(random, 0, static_cast<float>(t.get_d()));
    other.from = -static_cast<float>(mpq_class((t * mpq_class(other.to) - mpq_class(other.place)) / (1 - t)).get_d());
    const mpq_class difference = abs(other.time() - t);
    if (difference == 0 || difference >= least) continue;
    least = difference;
    nearest.second = other;
  }
  return nearest;
}

TEST(FirstContact, TellsTimesApartThatDoublesCannotTellApart) {
  Random random(801);
  std::size_t misled = 0;
  for (std::size_t i = 0; i != random_cases(100) && !HasFailure(); ++i) {
    const auto [x, y] = nearly_equal_times(random);
    constexpr float far = 0x1p60F;
    const ShaftInput input{{{-far, -far, 0}, {x.from, y.from, 1}}, {{-far, -far, 0}, {x.to, y.to, 1}}};
    const Box reached_by_x{{x.place, -far, 0}, {far, far, 1}};
    const Box reached_by_y{{-far, y.place, 0}, {far, far, 1}};
    expect_contact(input, std::vector<Box>{reached_by_x, reached_by_y});
    expect_contact(input, std::vector<Box>{reached_by_y, reached_by_x});
    expect_contact(input, std::vector<Box>{Box{{x.place, y.place, 0}, {far, far, 1}}});  // by the later of both
    const bool is_x_first = x.time() < y.time();
    if (is_x_first != (x.rounded_time() < y.rounded_time())) ++misled;
  }
  EXPECT_GT(misled, 0U) << "the cases are too easy";
}

TEST(FirstContact, IsExactForPlacesAFewUnitsApart) {
  Random random(802);
  for (std::size_t i = 0; i != random_cases(200) && !HasFailure(); ++i) {
    const ShaftInput input{random.box(-4, 4, 0.1F, 1.0F), random.box(-4, 4, 0.1F, 1.0F)};
    const double t = static_cast<double>(random.uniform(0.1F, 0.9F));
    std::vector<Box> boxes;
    for (int n = 0; n != 12; ++n) {
      // Touches box(t) on one axis, to a few units in the last place, and contains it on the others.
      const std::size_t k = random.below(3);
      Box box{{-50, -50, -50}, {50, 50, 50}};
      const bool is_above = input.b.hi[k] > input.a.hi[k];
      const Vec3& from = is_above ? input.a.hi : input.a.lo;
      const Vec3& to = is_above ? input.b.hi : input.b.lo;
      const float at = random.nudge(static_cast<float>(
          static_cast<double>(from[k]) + t * (static_cast<double>(to[k]) - static_cast<double>(from[k]))));
      (is_above ? box.lo : box.hi)[k] = at;
      boxes.push_back(box);
    }
    expect_contact(input, boxes);
  }
}

TEST(FirstContact, IsTheLowestIndexOfThoseThatTouchAtTheStart) {
  on_each_instruction_set([] {
    const CompiledShaft shaft = compile({{0, 0, 0}, {1, 1, 1}}, {{5, 0, 0}, {6, 1, 1}});
    std::vector<Box> boxes(300, Box{{1, 0, 0}, {2, 1, 1}});  // touch box a
    boxes[0] = {{9, 0, 0}, {10, 1, 1}};
    boxes[1] = {{1.5F, 0, 0}, {2, 1, 1}};
    const BoxTree tree{std::span<const Box>(boxes)};
    const FirstContact expected{2, 0, {-1, 0, 0}};
    EXPECT_EQ(first_contact(shaft, tree), expected);
    EXPECT_EQ(first_contact(shaft, BoxColumns(boxes).view()), expected);
  });
}

TEST(FirstContact, OfABodyGrownByASkinIsWhatComesThatNear) {
  Random random(805);
  for (unsigned i = 0; i != random_cases(300) && !HasFailure(); ++i) {
    constexpr float skin = 0.25F;  // so that sums are exact
    const MovingInput body{
        MovingInput::Kind::swept, random.grid_box(-4, 4), {random.integer(-6, 6), random.integer(-6, 6), 3}};
    std::vector<Box> boxes;
    std::vector<Box> grown;  // meets the body when the box is that near to it, on every axis
    while (boxes.size() != 24) {
      boxes.push_back(random.grid_box(-12, 12));
      grown.push_back(boxes.back());
      for (std::size_t k = 0; k != 3; ++k) {
        grown.back().lo[k] -= skin;
        grown.back().hi[k] += skin;
      }
    }
    const FirstContact expected = expected_contact(
        oracle::MovingHull(body), [&](const Box& box) { return oracle::entry_time(body, box); },
        [&](const Box& box) { return oracle::contact_normal(body, box); }, grown);
    const CompiledShaft shaft = swept(inflated(body.box, skin), body.displacement);
    EXPECT_EQ(first_contact(shaft, BoxTree(boxes)), expected) << source_text(body);
    EXPECT_EQ(first_contact(shaft, BoxColumns(boxes).view()), expected) << source_text(body);
  }
}

TEST(FirstContact, IsNothingWhereNothingIsKept) {
  on_each_instruction_set([] {
    const CompiledShaft shaft = compile({{0, 0, 0}, {1, 1, 1}}, {{5, 0, 0}, {6, 1, 1}});
    const std::vector<Box> beside(70, Box{{0, 3, 0}, {1, 4, 1}});
    for (const std::vector<Box>& boxes : {std::vector<Box>(), beside}) {
      const BoxTree tree{std::span<const Box>(boxes)};
      EXPECT_FALSE(first_contact(shaft, tree));
      EXPECT_FALSE(first_contact(shaft, BoxColumns(boxes).view()));
      std::vector<FirstContact> contacts(2, FirstContact{7, 0.5F});
      first_contact_many(std::vector<CompiledShaft>(2, shaft), tree, contacts);
      EXPECT_EQ(contacts, std::vector<FirstContact>(2));
      EXPECT_EQ(contacts[0].index, FirstContact::none);
    }
  });
}

TYPED_TEST(FirstContactOfBounds, EntryTimesAreThoseOfExactArithmeticForAllFamilies) {
  for (const Family& family : families) {
    SCOPED_TRACE(family.name);
    Random random(803);
    for (unsigned i = 0; i != random_cases(40) && !testing::Test::HasFailure(); ++i) {
      const ShaftInput input = family.shaft(random, i * 13);
      const oracle::Hull hull(input.a, input.b, input.added);
      const FamilyBounds<TypeParam> next(family, input);
      std::vector<TypeParam> bounds;
      std::vector<float> expected;
      while (bounds.size() != 20) {
        bounds.push_back(next(random));
        expected.push_back(hull.answer(bounds.back()) == Answer::outside
                               ? std::numeric_limits<float>::infinity()
                               : oracle::rounded_down(oracle::entry_time(input.a, input.b, bounds.back()).value()));
      }
      const CompiledShaft shaft = shaft_of(input);
      const auto memory = columns(bounds);
      const BoundsTree<TypeParam> tree{std::span<const TypeParam>(bounds)};
      std::vector<std::uint32_t> indices(bounds.size());
      std::iota(indices.rbegin(), indices.rend(), 0U);
      for (const Isa isa : isas_under_test()) {
        const UseIsa use(isa);
        std::vector<float> times(bounds.size());
        entry_times(shaft, memory.view(), indices, times);
        ASSERT_EQ(std::vector<float>(times.rbegin(), times.rend()), expected) << source_text(input) << name(isa);
        std::fill(times.begin(), times.end(), 7.0F);
        entry_times(shaft, tree, indices, times);
        ASSERT_EQ(std::vector<float>(times.rbegin(), times.rend()), expected) << source_text(input) << name(isa);
      }
    }
  }
}

TEST(FirstContact, TimeIsRoundedDown) {
  on_each_instruction_set([] {
    // A third of the way: the float below 1/3, and 2/3 likewise.
    const CompiledShaft shaft = compile({{0, 0, 0}, {1, 1, 1}}, {{3, 0, 0}, {4, 1, 1}});
    for (const float x : {2.0F, 3.0F}) {
      const std::vector<Box> boxes = {{{x, 0, 0}, {9, 1, 1}}};
      const float time = first_contact(shaft, BoxColumns(boxes).view()).time;
      EXPECT_LT(3 * static_cast<double>(time), static_cast<double>(x) - 1);
      EXPECT_GT(3 * static_cast<double>(std::nextafter(time, 2.0F)), static_cast<double>(x) - 1);
    }
  });
}

}  // namespace
}  // namespace shaftcull
