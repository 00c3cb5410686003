// SPDX-License-Identifier: MIT
/// Convex hulls with open contact against the oracle: on every instruction set, in views, alone, and in trees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "columns.hpp"
#include "hull/with_contact.hpp"
#include "instruction_sets.hpp"
#include "oracle/cases/hulls.hpp"
#include "oracle/convex_hull.hpp"
#include "oracle/open_contact.hpp"
#include "oracle/random.hpp"
#include "oracle/shaft_input.hpp"
#include "sanitizers.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/tree.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

/// Answers about all bounds, after checking that views of any size, one bound alone and trees agree.
template <class Tree, class Bound>
std::vector<Answer> answers(const CompiledShaft& shaft, const std::vector<Bound>& bounds) {
  const auto memory = columns(bounds);
  const std::size_t words = bit_words(bounds.size());
  std::vector<std::uint64_t> kept(words, ~std::uint64_t{0});
  std::vector<std::uint64_t> inside = kept;
  classify(shaft, memory.view(), kept, inside);
  std::vector<std::uint64_t> other(words);
  std::vector<std::uint64_t> other_inside(words);
  cull(shaft, memory.view(), other);
  EXPECT_EQ(other, kept);
  classify(shaft, memory.view(), {}, other_inside);
  EXPECT_EQ(other_inside, inside);
  const Tree tree{std::span<const Bound>(bounds)};
  classify(shaft, tree, other, other_inside);
  EXPECT_EQ(other, kept) << "in a tree";
  EXPECT_EQ(other_inside, inside) << "in a tree";
  EXPECT_EQ(count(shaft, tree), count(shaft, memory.view()));
  for (const std::size_t few : {2U, 5U, 16U}) {  // other stages than of many
    if (few > bounds.size()) break;
    std::uint64_t word = 0;
    cull(shaft, memory.view().slice(0, few), {&word, 1});
    EXPECT_EQ(word, kept[0] & ((std::uint64_t{1} << few) - 1)) << few;
  }
  std::vector<Answer> all;
  for (std::size_t i = 0; i != bounds.size(); ++i) {
    const bool is_kept = (kept[i / 64] >> i % 64 & 1U) != 0;
    const bool is_inside = (inside[i / 64] >> i % 64 & 1U) != 0;
    all.push_back(!is_kept ? Answer::outside : is_inside ? Answer::inside : Answer::overlap);
    EXPECT_EQ(classify(shaft, bounds[i]), all.back()) << "alone";
    EXPECT_EQ(keeps(shaft, bounds[i]), is_kept) << "alone";
  }
  return all;
}

/// Fails, with a reproducer for the first wrong one, unless all answers are right. `correct` is given each with its
/// position, and returns what it should be.
template <class Tree, class Bound, class Correct>
void expect_right(const HullInput& input, const std::vector<Bound>& bounds, HullTest test, const Correct& correct) {
  const ConvexHull hull(input.points, input.directions, test);
  const CompiledShaft shaft = with_contact(hull, Contact::open);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    const std::vector<Answer> found = answers<Tree>(shaft, bounds);
    for (std::size_t i = 0; i != bounds.size(); ++i) {
      const Answer right = correct(i, found[i]);
      ASSERT_EQ(found[i], right) << "on " << name(isa) << "; bound " << i << ":\n  " << source_text(input) << "\n  "
                                 << source_text(bounds[i]) << "\n  is " << text(right) << ", answered "
                                 << text(found[i]);
    }
  }
}

void expect_exact_open(const HullInput& input, const std::vector<Box>& boxes) {
  const oracle::OpenHull oracle(input);
  std::vector<Answer> right;
  for (const Box& box : boxes) right.push_back(oracle.answer(box));
  expect_right<BoxTree>(input, boxes, HullTest::exact, [&](std::size_t i, Answer) { return right[i]; });
  // A conservative hull may keep a box that is outside, on all instruction sets alike, and not one that it does not
  // keep with closed contact.
  const ConvexHull hull(input.points, input.directions, HullTest::conservative);
  std::vector<Answer> conservative;
  expect_right<BoxTree>(input, boxes, HullTest::conservative, [&](std::size_t i, Answer found) {
    if (conservative.size() == i) {
      const bool may_be_kept = right[i] == Answer::outside && found != Answer::outside && keeps(hull, boxes[i]);
      conservative.push_back(may_be_kept ? found : right[i]);
    }
    return conservative[i];
  });
}

void expect_sound_open(const HullInput& input, const std::vector<Sphere>& spheres) {
  const oracle::OpenConvexHull oracle(input);
  std::vector<Answer> right;
  expect_right<SphereTree>(input, spheres, HullTest::exact, [&](std::size_t i, Answer found) {
    if (right.size() == i) right.push_back(oracle.corrected(spheres[i], found));
    return right[i];
  });
  expect_right<SphereTree>(input, spheres, HullTest::conservative, [&](std::size_t i, Answer) { return right[i]; });
}

TEST(HullContact, OnAGridBoxesThatTouchAreOutsideAndFlatOnesWhereTheyMeetAreNot) {
  Random random(1);
  std::size_t touching = 0;
  std::size_t flat = 0;
  for (std::uint64_t i = 0; i != random_cases(500); ++i) {
    const int side = 1 + static_cast<int>(random.below(2));
    const unsigned most = random.one_in(2) ? 3 : 6;  // many are flat
    HullInput input = hull_of(random, most, [&] { return random.integer(-side, side); });
    if (random.one_in(3)) {  // in a plane, which may be across an axis
      const std::size_t k = random.below(3);
      const std::size_t from = random.below(3);
      for (Vec3& p : input.points) p[k] = from == k ? 0 : p[from];
      std::erase_if(input.directions, [&](Vec3& d) {
        d[k] = from == k ? 0 : d[from];
        return d == Vec3{0, 0, 0};
      });
    }
    std::vector<Box> boxes;
    for (unsigned b = 0; b != 24; ++b) boxes.push_back(random.grid_box(-side - 1, side + 1));
    expect_exact_open(input, boxes);
    if (HasFatalFailure()) return;
    const oracle::OpenHull open(input);
    const oracle::ConvexHull closed(input);
    for (const Box& box : boxes) {
      const bool is_kept = open.answer(box) != Answer::outside;
      touching += closed.answer(box) != Answer::outside && !is_kept ? 1 : 0;
      flat += is_kept && (box.lo[0] == box.hi[0] || box.lo[1] == box.hi[1] || box.lo[2] == box.hi[2]) ? 1 : 0;
    }
  }
  EXPECT_GT(touching, random_cases(500));
  EXPECT_GT(flat, random_cases(500));
}

TEST(HullContact, BoxesOfEveryFamilyAreAnsweredExactly) {
  for (const HullFamily& family : hull_families) {
    SCOPED_TRACE(family.name);
    Random random(2);
    for (std::uint64_t i = 0; i != random_cases(25); ++i) {
      const HullInput input = family.input(random);
      std::vector<Box> boxes;
      while (boxes.size() != 6) boxes.push_back(family.box(random, input));
      const Vec3& p = input.points[random.below(static_cast<unsigned>(input.points.size()))];
      boxes.push_back({p, p});
      expect_exact_open(input, boxes);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(HullContact, UnboundedAndEmptyBoxes) {
  Random random(3);
  for (std::uint64_t i = 0; i != random_cases(100); ++i) {
    const HullInput input = hull_of(random, 5, [&] { return random.integer(-2, 2); });
    std::vector<Box> boxes = {{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}}};
    for (unsigned b = 0; b != 20; ++b) {
      Box box = random.grid_box(-3, 3);
      for (std::size_t k = 0; k != 3; ++k) {
        if (random.one_in(3)) box.lo[k] = -infinity;
        if (random.one_in(3)) box.hi[k] = infinity;
      }
      boxes.push_back(box);
    }
    expect_exact_open(input, boxes);
    if (HasFatalFailure()) return;
  }
}

TEST(HullContact, SpheresThatTouchTheHullsBoxAreOutside) {
  Random random(4);
  for (std::uint64_t i = 0; i != random_cases(200); ++i) {
    const HullInput input = hull_of(random, 6, [&] { return random.integer(-2, 2); });
    const oracle::ConvexHull hull(input);
    std::vector<Sphere> spheres;
    for (unsigned s = 0; s != 30; ++s) {
      const Vec3 centre = {random.integer(-4, 4), random.integer(-4, 4), random.integer(-4, 4)};
      spheres.push_back(random.one_in(3) ? touching_sphere(random, hull, centre)
                                         : Sphere{centre, random.integer(0, 3)});
    }
    spheres.push_back({input.points[0], 0});
    expect_sound_open(input, spheres);
    if (HasFatalFailure()) return;
  }
}

TEST(HullContact, SpheresOfEveryFamilyThatMeetAreKept) {
  for (const HullFamily& family : hull_families) {
    SCOPED_TRACE(family.name);
    Random random(5);
    for (std::uint64_t i = 0; i != random_cases(25); ++i) {
      const HullInput input = family.input(random);
      const oracle::ConvexHull hull(input);
      std::vector<Sphere> spheres;
      while (spheres.size() != 20) spheres.push_back(family.sphere(random, input, hull));
      expect_sound_open(input, spheres);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(HullContact, TheWallBehindAPolygonIsOutsideAndASheetOfGlassIsNot) {
  // Between a square in the plane x = 0 and a leaning one.
  const std::vector<Vec3> corners = {{0, 0, 0}, {0, 4, 0}, {0, 0, 4}, {0, 4, 4},
                                     {8, 0, 0}, {8, 4, 0}, {9, 0, 4}, {9, 4, 4}};
  const Box wall{{-1, -9, -9}, {0, 9, 9}};
  const Box flush{{0, -9, -9}, {0, 9, 9}};  // in the plane of the square
  const Box floor{{-9, -9, -1}, {9, 9, 0}};
  const Box glass{{4, -9, -9}, {4, 9, 9}};
  const Box shelf{{0, 1, 1}, {1, 2, 2}};
  for (const HullTest test : {HullTest::exact, HullTest::conservative}) {
    const ConvexHull hull(corners, {}, test);
    const CompiledShaft open = with_contact(hull, Contact::open);
    on_each_instruction_set([&] {
      for (const Box& box : {wall, flush, floor, glass, shelf}) EXPECT_TRUE(keeps(hull, box));
      for (const Box& box : {wall, flush, floor}) EXPECT_FALSE(keeps(open, box));
      EXPECT_EQ(classify(open, glass), Answer::overlap);
      EXPECT_EQ(classify(open, shelf), Answer::inside);
    });
  }
}

TEST(HullContact, LeavesInTheSurfaceOfANodeThatIsInsideAreOutside) {
  // A prism with a face aslant, x + y = 2, and points in it along z: the boxes of their nodes are in the hull.
  std::vector<Vec3> corners;
  for (const float z : {0.0F, 8.0F}) {
    for (const auto& [x, y] : {std::pair{0.0F, 2.0F}, {2.0F, 0.0F}, {8.0F, 2.0F}, {2.0F, 8.0F}}) {
      corners.push_back({x, y, z});
    }
  }
  const ConvexHull hull(corners);
  const CompiledShaft open = with_contact(hull, Contact::open);
  std::vector<Box> boxes;
  for (unsigned i = 0; i != 500; ++i) {
    const float z = 1 + static_cast<float>(i) / 128;
    boxes.push_back({{1, 1, z}, {1, 1, z}});
  }
  const BoxTree tree{std::span<const Box>(boxes)};
  on_each_instruction_set([&] {
    EXPECT_EQ(count(hull, tree), 500U);
    EXPECT_EQ(count(open, tree), 0U);
    EXPECT_EQ(count_classified(open, tree), (KeptCounts{0, 0}));
  });
}

TEST(HullContact, ManyShaftsOfEitherContactAnswerAsAlone) {
  Random random(6);
  std::vector<Box> boxes;
  for (unsigned b = 0; b != 3000; ++b) boxes.push_back(random.grid_box(-12, 12));
  const BoxStream stream{std::span<const Box>(boxes)};
  const BoxTree tree{std::span<const Box>(boxes)};
  std::vector<ConvexHull> hulls;
  std::vector<CompiledShaft> shafts;
  for (unsigned h = 0; h != 6; ++h) {
    const HullInput input = hull_of(random, 8, [&] { return random.integer(-9, 9); });
    hulls.emplace_back(input.points, input.directions, h % 2 == 0 ? HullTest::exact : HullTest::conservative);
  }
  for (const ConvexHull& hull : hulls) {
    shafts.push_back(hull);
    shafts.push_back(with_contact(hull, Contact::open));
    shafts.push_back(compile(random.grid_box(-9, 9), random.grid_box(-9, 9)));
  }
  on_each_instruction_set([&] {
    const std::size_t words = bit_words(boxes.size());
    std::vector<std::uint64_t> kept(shafts.size() * words);
    std::vector<std::uint64_t> inside(kept.size());
    std::vector<std::uint64_t> tree_kept(kept.size());
    std::vector<std::uint64_t> tree_inside(kept.size());
    classify_many(shafts, stream, kept, inside);
    classify_many(shafts, tree, tree_kept, tree_inside);
    EXPECT_EQ(kept, tree_kept);
    EXPECT_EQ(inside, tree_inside);
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      std::vector<std::uint64_t> alone(words);
      cull(shafts[s], stream, alone);
      EXPECT_TRUE(std::equal(alone.begin(), alone.end(), kept.begin() + static_cast<std::ptrdiff_t>(s * words)));
    }
  });
}

}  // namespace
}  // namespace shaftcull
