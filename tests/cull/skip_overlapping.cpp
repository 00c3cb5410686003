// SPDX-License-Identifier: MIT
/// First contact without what the moving box overlaps at the start: the same as by exact arithmetic, in views and
/// trees.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "columns.hpp"
#include "instruction_sets.hpp"
#include "oracle/cases/families.hpp"
#include "oracle/cases/moving.hpp"
#include "oracle/entry_time.hpp"
#include "oracle/hull.hpp"
#include "oracle/moving_hull.hpp"
#include "oracle/open_contact.hpp"
#include "oracle/quick_hull.hpp"
#include "oracle/shaft_input.hpp"
#include "sanitizers.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/tree.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

/// Answers of a shaft by exact arithmetic, by the contact that it has.
class AnyHull {
 public:
  explicit AnyHull(const ShaftInput& input) {
    if (input.contact == Contact::open) {
      open_ = std::make_unique<oracle::OpenHull>(input);
    } else {
      between_ = std::make_unique<oracle::Hull>(input.a, input.b, input.added);
    }
  }
  explicit AnyHull(const MovingInput& input) {
    if (input.contact == Contact::open) {
      open_ = std::make_unique<oracle::OpenHull>(input);
    } else {
      moving_ = std::make_unique<oracle::MovingHull>(input);
    }
  }

  template <class Bound>
  [[nodiscard]] bool keeps(const Bound& bound) const {
    const Answer answer = open_ ? open_->answer(bound) : between_ ? between_->answer(bound) : moving_->answer(bound);
    return answer != Answer::outside;
  }

 private:
  std::unique_ptr<oracle::OpenHull> open_;
  std::unique_ptr<oracle::Hull> between_;
  std::unique_ptr<oracle::MovingHull> moving_;
};

const Box& start_of(const ShaftInput& input) { return input.a; }
const Box& start_of(const MovingInput& input) { return input.box; }

template <class Bound>
auto time_of(const ShaftInput& input, const Bound& bound) {
  return oracle::entry_time(input.a, input.b, bound);
}
template <class Bound>
auto time_of(const MovingInput& input, const Bound& bound) {
  return oracle::entry_time(input, bound);
}

template <class Bound>
Vec3 normal_of(const ShaftInput& input, const Bound& bound) {
  return oracle::contact_normal(input.a, input.b, bound);
}
template <class Bound>
Vec3 normal_of(const MovingInput& input, const Bound& bound) {
  return oracle::contact_normal(input, bound);
}

/// First contact by the definition, and how many bounds that the shaft keeps are skipped.
struct Expected {
  FirstContact first;
  std::size_t skipped = 0;
};

template <class Input, class Bound>
Expected expected_contact(const Input& input, const std::vector<Bound>& bounds) {
  const AnyHull hull(input);
  const AnyHull start(ShaftInput{start_of(input), start_of(input), {}, input.contact});
  Expected expected;
  decltype(time_of(input, bounds[0])) least;
  for (std::size_t i = 0; i != bounds.size(); ++i) {
    if (!hull.keeps(bounds[i])) continue;
    const auto time = time_of(input, bounds[i]).value();
    const bool is_skipped = start.keeps(bounds[i]);
    const bool is_at_start = time <= std::remove_cv_t<decltype(time)>{};
    if (input.contact == Contact::closed) {
      EXPECT_EQ(is_skipped, is_at_start) << source_text(bounds[i]);
    }
    if (is_skipped) {
      EXPECT_TRUE(is_at_start) << source_text(bounds[i]);
      ++expected.skipped;
      continue;
    }
    if (least && *least <= time) continue;
    least = time;
    expected.first = {static_cast<std::uint32_t>(i), oracle::rounded_down(time)};
  }
  if (expected.first) expected.first.normal = normal_of(input, bounds[expected.first.index]);
  return expected;
}

/// Compares what a view, candidates and a tree answer. Returns how many bounds are skipped.
template <class Input, class Bound>
std::size_t expect_contact_beyond(const Input& input, const std::vector<Bound>& bounds) {
  const auto [expected, skipped] = expected_contact(input, bounds);
  const CompiledShaft shaft = shaft_of(input);
  const auto memory = columns(bounds);
  const BoundsTree<Bound> tree{std::span<const Bound>(bounds)};
  std::vector<std::uint32_t> all(bounds.size());
  std::iota(all.rbegin(), all.rend(), 0U);
  const Query skip{.skip_overlapping = true};
  const Query skip_some{.only = all, .skip_overlapping = true};
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    const std::string source = source_text(input) + " on " + std::string(name(isa));
    std::vector<FirstContact> many(3);
    EXPECT_EQ(first_contact(shaft, memory.view(), skip), expected) << source;
    EXPECT_EQ(first_contact(shaft, memory.view(), skip_some), expected) << source;
    EXPECT_EQ(first_contact(shaft, tree, skip), expected) << source;
    EXPECT_EQ(first_contact(shaft, tree, skip_some), expected) << source;
    first_contact_many(std::vector<CompiledShaft>(3, shaft), memory.view(), many, skip);
    EXPECT_EQ(many, std::vector<FirstContact>(3, expected)) << source;
    first_contact_many(std::vector<CompiledShaft>(3, shaft), tree, many, skip);
    EXPECT_EQ(many, std::vector<FirstContact>(3, expected)) << source;
  }
  return skipped;
}

template <class Bound>
class SkipOverlapping : public testing::Test {};
using BoundKinds = testing::Types<Box, Sphere>;
TYPED_TEST_SUITE(SkipOverlapping, BoundKinds);

/// A bound on a lattice, flat on some axes or a point, near a box: many only touch it.
template <class Bound>
Bound lattice_bound(Random& random, float step) {
  const auto at = [&] { return step * random.integer(-6, 6); };
  if constexpr (std::is_same_v<Bound, Box>) {
    return Random::sorted({at(), at(), at()}, {at(), at(), at()});
  } else {
    return {{at(), at(), at()}, step * random.integer(0, 4)};
  }
}

TYPED_TEST(SkipOverlapping, IsThatOfExactArithmeticForAllFamilies) {
  std::size_t skipped = 0;
  for (const Family& family : families) {
    SCOPED_TRACE(family.name);
    Random random(820);
    for (unsigned i = 0; i != random_cases(16) && !testing::Test::HasFailure(); ++i) {
      ShaftInput input = family.shaft(random, i * 17);
      if (i % 2 == 1) input.contact = Contact::open;
      const oracle::QuickHull hull(input);
      std::vector<TypeParam> bounds;
      while (bounds.size() != 20) {
        if constexpr (std::is_same_v<TypeParam, Box>) {
          bounds.push_back(family.box(random, input));
        } else {
          bounds.push_back(family.sphere(random, input, hull));
        }
      }
      skipped += expect_contact_beyond(input, bounds);
    }
  }
  EXPECT_GT(skipped, 0U) << "the cases are too easy";
}

TYPED_TEST(SkipOverlapping, IsThatOfExactArithmeticForBoundsThatTouchTheStart) {
  Random random(821);
  for (const float step : {1.0F, 0.1F, 0x1p-140F, 0x1p100F}) {
    std::size_t skipped = 0;
    for (unsigned i = 0; i != random_cases(60) && !testing::Test::HasFailure(); ++i) {
      ShaftInput input{lattice_bound<Box>(random, step), lattice_bound<Box>(random, step)};
      if (i % 2 == 1) input.contact = Contact::open;
      std::vector<TypeParam> bounds;
      while (bounds.size() != 40) bounds.push_back(lattice_bound<TypeParam>(random, step));
      skipped += expect_contact_beyond(input, bounds);
    }
    EXPECT_GT(skipped, 0U) << "the cases are too easy";
  }
}

TYPED_TEST(SkipOverlapping, IsThatOfExactArithmeticForSweepsAndShadows) {
  Random random(822);
  for (unsigned i = 0; i != random_cases(200) && !testing::Test::HasFailure(); ++i) {
    MovingInput input{moving_kinds[i % 4], random.grid_box(-6, 6)};
    for (float& d : input.displacement) d = random.integer(-6, 6);
    input.displacement[i / 4 % 3] = 3;
    input.light = random.grid_box(-6, 6);
    const float apart = input.box.hi[0] + 2 - input.light.lo[0];
    input.light.lo[0] += apart;
    input.light.hi[0] += apart;
    input.reach = random.integer(1, 5);
    if (i % 8 > 3) input.contact = Contact::open;
    std::vector<TypeParam> bounds;
    while (bounds.size() != 24) bounds.push_back(lattice_bound<TypeParam>(random, 1));
    expect_contact_beyond(input, bounds);
  }
}

TEST(SkipOverlappingSpheres, ThatTouchTheStartButForAnUlpAreToldApart) {
  Random random(823);
  for (std::size_t i = 0; i != random_cases(60) && !testing::Test::HasFailure(); ++i) {
    ShaftInput input{{{0, 0, 0}, {1, 1, 1}}, {{4, 4, 4}, {5, 5, 5}}};
    if (i % 2 == 1) input.contact = Contact::open;
    std::vector<Sphere> spheres;
    while (spheres.size() != 40) {
      // 3² + 4² = 5², 2² + 3² + 6² = 7²: centres off a corner or an edge whose distance is a float.
      const bool at_corner = random.one_in(2);
      const float scale = 0x1p-3F * random.integer(1, 9);
      Sphere sphere{{1 + 3 * scale, 1 + (at_corner ? 2 : 4) * scale, at_corner ? 1 + 6 * scale : 0.5F},
                    (at_corner ? 7 : 5) * scale};
      if (random.one_in(3)) sphere.radius = random.nudge(sphere.radius);
      if (random.one_in(3)) sphere.centre[random.below(2)] = random.nudge(sphere.centre[0]);
      spheres.push_back(sphere);
    }
    expect_contact_beyond(input, spheres);
  }
}

TEST(SkipOverlapping, ABodyBesideAWallIsStoppedByItWithOpenContactAlone) {
  const Box body{{0, 0, 0}, {1, 1, 1}};
  const std::vector<Box> boxes = {{{-9, -1, -9}, {9, 0, 9}},     // the floor on which it stands
                                  {{0.5F, 0.5F, 0}, {2, 2, 2}},  // overlaps it
                                  {{1, 0, 0}, {2, 1, 1}},        // a wall that it touches
                                  {{4, 0, 0}, {5, 1, 1}}};
  on_each_instruction_set([&] {
    const BoxTree tree{std::span<const Box>(boxes)};
    CompiledShaft shaft = compile(body, {{8, 0, 0}, {9, 1, 1}});
    EXPECT_EQ(first_contact(shaft, tree), (FirstContact{0, 0}));
    EXPECT_EQ(first_contact(shaft, tree, {.skip_overlapping = true}), (FirstContact{3, 0.375F, {-1, 0, 0}}));
    set_contact(shaft, Contact::open);
    EXPECT_EQ(first_contact(shaft, tree), (FirstContact{1, 0}));
    EXPECT_EQ(first_contact(shaft, tree, {.skip_overlapping = true}), (FirstContact{2, 0, {-1, 0, 0}}));
  });
}

TYPED_TEST(SkipOverlapping, IsWhatAShaftFromTheStartToItselfKeepsWhateverTheNumbers) {
  Random random(824);
  const CompiledShaft closed = compile({{0, 0, 0}, {2, 2, 2}}, {{5, 4, 3}, {8, 8, 8}});
  const CompiledShaft still = compile(closed.a(), closed.a());
  for (std::size_t i = 0; i != random_cases(4000) && !testing::Test::HasFailure(); ++i) {
    TypeParam bound = lattice_bound<TypeParam>(random, 1);
    const float odd = random.one_in(3) ? nan : random.one_in(2) ? infinity : -infinity;
    if constexpr (std::is_same_v<TypeParam, Box>) {
      (random.one_in(2) ? bound.lo : bound.hi)[random.below(3)] = odd;
    } else {
      (random.one_in(3) ? bound.radius : bound.centre[random.below(3)]) = odd;
    }
    const auto memory = columns(std::vector<TypeParam>{bound});
    for (const Contact contact : {Contact::closed, Contact::open}) {
      CompiledShaft shaft = closed;
      CompiledShaft start = still;
      set_contact(shaft, contact);
      set_contact(start, contact);
      const bool is_first = keeps(shaft, bound) && !keeps(start, bound);
      EXPECT_EQ(static_cast<bool>(first_contact(shaft, memory.view(), {.skip_overlapping = true})), is_first)
          << source_text(bound) << (contact == Contact::open ? " open" : " closed");
    }
  }
}

}  // namespace
}  // namespace shaftcull
