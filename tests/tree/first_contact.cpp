// SPDX-License-Identifier: MIT
/// First contact in a tree is what a flat scan finds, and the walk looks at little more than what is reached first.
#include "shaftcull/first_contact.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "columns.hpp"
#include "dispatch/active_kernels.hpp"
#include "message_of.hpp"
#include "sanitizers.hpp"
#include "shaftcull/hull.hpp"
#include "tree/first_contact_walk.hpp"
#include "tree/scenes.hpp"
#include "tree/tree_access.hpp"
#include "tree/walked.hpp"

namespace shaftcull {
namespace {

template <class Bound>
class TreeFirstContact : public testing::Test {
 protected:
  using Tree = BoundsTree<Bound>;

  /// The tree's answers for all shafts, one by one and together, are those of a scan of `bounds`.
  static void expect_flat(const Tree& tree, const std::vector<Bound>& bounds, const std::vector<CompiledShaft>& shafts,
                          const Query& query = {}) {
    const auto memory = columns(bounds);
    std::vector<FirstContact> flat(shafts.size());
    std::vector<FirstContact> many(shafts.size());
    const Query of_all{.skip_overlapping = query.skip_overlapping};
    first_contact_many(shafts, memory.view(), flat, of_all);
    first_contact_many(shafts, tree, many, query);
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      SCOPED_TRACE("shaft " + std::to_string(s) + " of " + std::to_string(bounds.size()) + " bounds");
      const FirstContact one = first_contact(shafts[s], memory.view(), of_all);
      EXPECT_EQ(flat[s], one);
      EXPECT_EQ(many[s], one);
      EXPECT_EQ(first_contact(shafts[s], tree, query), many[s]);
      if (testing::Test::HasFailure()) return;
    }
  }
};
using BoundKinds = testing::Types<Box, Sphere>;
TYPED_TEST_SUITE(TreeFirstContact, BoundKinds);

/// What no shaft meets.
template <class Bound>
Bound empty_bound() {
  if constexpr (std::is_same_v<Bound, Box>) {
    return empty_box;
  } else {
    return {{0, 0, 0}, -1};
  }
}

/// Some of the size of a unit cube, with a face on x = 0.
template <class Bound>
Bound unit_bound() {
  if constexpr (std::is_same_v<Bound, Box>) {
    return {{0, 0, 0}, {1, 1, 1}};
  } else {
    return {{0.5F, 0.5F, 0.5F}, 0.5F};
  }
}

TYPED_TEST(TreeFirstContact, IsThatOfAFlatScanForEveryShapeAndCount) {
  using Bound = TypeParam;
  Random random(810);
  for (const Shape shape : shapes) {
    for (const std::size_t count : {0U, 1U, 63U, 64U, 65U, 129U, 4097U, 20000U}) {
      SCOPED_TRACE(text(shape));
      const std::vector<Bound> bounds = scene<Bound>(random, shape, count);
      const typename TestFixture::Tree tree{std::span<const Bound>(bounds)};
      this->expect_flat(tree, bounds, shafts_for(random, random_cases(20)));
      if (this->HasFailure()) return;
    }
  }
}

TYPED_TEST(TreeFirstContact, StaysThatOfAFlatScanAsTheTreeChanges) {
  using Bound = TypeParam;
  Random random(811);
  std::vector<Bound> bounds = scene<Bound>(random, Shape::grid, 5000);
  typename TestFixture::Tree tree{std::span<const Bound>(bounds)};
  const std::vector<CompiledShaft> shafts = shafts_for(random, 30);
  bounds = scene<Bound>(random, Shape::grid, bounds.size());
  tree.update(std::span<const Bound>(bounds));
  this->expect_flat(tree, bounds, shafts);
  tree.rebuild();
  this->expect_flat(tree, bounds, shafts);
  this->expect_flat(typename TestFixture::Tree(tree), bounds, shafts);
  std::vector<Bound> reordered;
  for (const std::uint32_t i : tree.order()) reordered.push_back(bounds[i]);
  tree.reorder();
  this->expect_flat(tree, reordered, shafts);
}

TYPED_TEST(TreeFirstContact, LooksOnWhereTheFirstIsLeftOut) {
  using Bound = TypeParam;
  Random random(812);
  for (const Shape shape : {Shape::uniform, Shape::grid}) {
    const std::vector<Bound> bounds = scene<Bound>(random, shape, 5000);
    typename TestFixture::Tree tree{std::span<const Bound>(bounds)};
    const std::vector<CompiledShaft> shafts = shafts_for(random, 10);
    // Leaving out is as if the bound were not there: an empty bound is met by nothing.
    std::vector<std::uint64_t> mask(bit_words(bounds.size()));
    std::vector<std::uint32_t> layers(bounds.size(), 2);
    std::vector<Bound> rest = bounds;
    for (std::size_t i = 0; i != bounds.size(); ++i) {
      const bool is_masked = random.one_in(3);
      if (is_masked) mask[i / 64] |= std::uint64_t{1} << i % 64;
      if (random.one_in(3)) layers[i] = 5;
      if (is_masked || layers[i] == 5) rest[i] = empty_bound<Bound>();
    }
    tree.set_layers(layers);
    this->expect_flat(tree, rest, shafts, {.exclude_mask = mask, .layer_mask = {2}});
    for (const CompiledShaft& shaft : shafts) {
      std::vector<Bound> left = bounds;
      for (int i = 0; i != 5; ++i) {
        const auto first = first_contact(shaft, tree);
        if (!first) break;
        left[first.index] = empty_bound<Bound>();
        this->expect_flat(tree, left, {shaft}, {.exclude = {first.index}});
        left = bounds;
      }
    }
  }
}

TYPED_TEST(TreeFirstContact, WantsOneContactForEachShaft) {
  using Bound = TypeParam;
  const typename TestFixture::Tree tree{std::vector<Bound>(100, unit_bound<Bound>())};
  Random random(813);
  const std::vector<CompiledShaft> shafts = shafts_for(random, 3);
  std::vector<FirstContact> two(2, {9, 0.25F});
  EXPECT_THAT(message_of([&] { first_contact_many(shafts, tree, two); }),
              testing::HasSubstr("contacts has room for 2; 3 shafts need one each"));
  EXPECT_EQ(two, (std::vector<FirstContact>(2, {9, 0.25F})));
}

TYPED_TEST(TreeFirstContact, TimesOfAListFitTheListAndTheTree) {
  using Bound = TypeParam;
  const std::vector<Bound> bounds(100, unit_bound<Bound>());
  typename TestFixture::Tree tree{std::span<const Bound>(bounds)};
  const CompiledShaft shaft = compile({{-3, 0, 0}, {-2, 1, 1}}, {{1, 0, 0}, {2, 1, 1}});
  std::vector<float> times(3, 7);
  const std::vector<std::uint32_t> indices = {3, 99, 100};
  EXPECT_THAT(message_of([&] { entry_times(shaft, tree, indices, times); }),
              testing::HasSubstr("indices[2] = 100 is not below the number of bounds, 100"));
  EXPECT_THAT(message_of([&] { entry_times(shaft, tree, std::span(indices).first(2), times); }),
              testing::HasSubstr("times has room for 3 times; 2 indices need one each"));
  EXPECT_THAT(message_of([&] {
                entry_times(shaft, tree, std::span(indices).first(2), {static_cast<float*>(nullptr), 2});
              }),
              testing::HasSubstr("times is null"));
  EXPECT_EQ(times, std::vector<float>(3, 7));
  entry_times(shaft, tree, std::span(indices).first(2), std::span(times).first(2));
  EXPECT_EQ(times, (std::vector<float>{0.5F, 0.5F, 7}));
  tree.update(std::span(indices).first(1), std::span<const Bound>(bounds).first(1));
  EXPECT_THAT(
      message_of<NeedsRefit>([&] { entry_times(shaft, tree, std::span(indices).first(1), std::span(times).first(1)); }),
      testing::HasSubstr("a tree whose bounds were updated; call refit() first"));
}

TYPED_TEST(TreeFirstContact, IsRefusedForAConvexHullInWhichNothingMoves) {
  using Bound = TypeParam;
  const std::vector<Bound> bounds(3, unit_bound<Bound>());
  const typename TestFixture::Tree tree{std::span<const Bound>(bounds)};
  const std::vector<Vec3> points = {{-1, -1, -1}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}};
  const ConvexHull hull(points);
  const auto memory = columns(bounds);
  std::vector<FirstContact> contacts(1);
  std::vector<FirstContact> flat(1);
  std::vector<float> times(1);
  const std::vector<std::uint32_t> indices = {0};
  const auto refuses = testing::HasSubstr("shaft 0 is a convex hull, in which nothing moves");
  EXPECT_THAT(message_of([&] { static_cast<void>(first_contact(hull, tree)); }), refuses);
  EXPECT_THAT(message_of([&] { static_cast<void>(first_contact(hull, memory.view())); }), refuses);
  EXPECT_THAT(message_of([&] { first_contact_many({&hull.compiled(), 1}, tree, contacts); }), refuses);
  EXPECT_THAT(message_of([&] { first_contact_many({&hull.compiled(), 1}, memory.view(), flat); }), refuses);
  EXPECT_THAT(message_of([&] { entry_times(hull, tree, indices, times); }), refuses);
}

TYPED_TEST(TreeFirstContact, IsThatOfAFlatScanWithoutThousandsThatOverlapTheStart) {
  Random random(815);
  const std::vector<TypeParam> bounds = scene<TypeParam>(random, Shape::uniform, 20000);
  const BoundsTree<TypeParam> tree{std::span<const TypeParam>(bounds)};
  std::vector<CompiledShaft> shafts;
  for (unsigned s = 0; s != 40; ++s) {
    shafts.push_back(compile(random.box(-6, 6, 0.1F, 4), random.box(-6, 6, 0.1F, 4)));
    if (s % 2 == 1) set_contact(shafts.back(), Contact::open);
  }
  this->expect_flat(tree, bounds, shafts, {.skip_overlapping = true});
}

std::size_t contact_words_tested = 0;
kernel::TestListedWords* test_boxes = nullptr;
kernel::TestListedWords* test_spheres = nullptr;

template <kernel::TestListedWords*& real_test>
void count_words(const kernel::ShaftData& shaft, const float* const* stream, const std::uint32_t* word,
                 std::size_t words, std::uint64_t* kept, std::uint64_t* inside, unsigned least_kept) noexcept {
  contact_words_tested += words;
  real_test(shaft, stream, word, words, kept, inside, least_kept);
}

/// Words of leaves and nodes that are tested to find the first contact, and to list everything.
struct Tested {
  std::size_t first;
  std::size_t all;
};
template <class Bound>
Tested words_tested_by(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, bool skips_overlapping = false) {
  const auto& parts = *TreeAccess::parts(tree);
  kernel::Kernels kernels = kernel::active_kernels();
  test_boxes = kernels.listed_boxes;
  test_spheres = kernels.listed_spheres;
  kernels.listed_boxes = count_words<test_boxes>;
  kernels.listed_spheres = count_words<test_spheres>;
  contact_words_tested = 0;
  const kernel::Exclusion nothing({parts.order, false, kernels}, {}, {});
  (void)kernel::FirstContactWalk<Bound>(parts, kernels, kernel::data_of(shaft), nothing, skips_overlapping).run();
  const std::size_t first = contact_words_tested;
  contact_words_tested = 0;
  kernel::Counter counter(kernels);
  walk(parts, kernels, shaft, kernel::Question::kept, counter);
  return {first, contact_words_tested};
}

template <class Bound>
class FirstContactWalk : public testing::Test {};
TYPED_TEST_SUITE(FirstContactWalk, BoundKinds);

TYPED_TEST(FirstContactWalk, LooksAtLittleMoreThanWhatIsReachedFirst) {
  Random random(814);
  const std::vector<TypeParam> bounds = scene<TypeParam>(random, Shape::uniform, 200000);
  const BoundsTree<TypeParam> tree{std::span<const TypeParam>(bounds)};
  // A plate that starts before all boxes, and moves through all of them.
  const Tested plate = words_tested_by(compile({{-9, -4, -4}, {-8, 4, 4}}, {{8, -4, -4}, {9, 4, 4}}), tree);
  EXPECT_LT(plate.first, plate.all / 20) << plate.all;
  // A large box that starts on thousands of boxes: all are reached at once, and the lowest index counts.
  const Tested large = words_tested_by(compile({{-4, -4, -4}, {0, 4, 4}}, {{0, -4, -4}, {4, 4, 4}}), tree);
  EXPECT_LT(large.first, large.all / 5) << large.all;
  // Where the box starts around everything, nothing below the top is looked at.
  const Tested skipped =
      words_tested_by(compile({{-50, -50, -50}, {50, 50, 50}}, {{9, 0, 0}, {99, 50, 50}}), tree, true);
  EXPECT_LE(skipped.first, 2U) << skipped.all;
}

}  // namespace
}  // namespace shaftcull
