/// First contact in a tree is what a flat scan finds, and the walk looks at little more than what is reached first.
#include "shaftcull/first_contact.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "columns.hpp"
#include "dispatch/active_kernels.hpp"
#include "message_of.hpp"
#include "sanitizers.hpp"
#include "shaftcull/hull.hpp"
#include "tree/access.hpp"
#include "tree/first_contact.hpp"
#include "tree/scenes.hpp"
#include "tree/visitors.hpp"
#include "tree/walk.hpp"

namespace shaftcull {
namespace {

template <class Index>
class TreeFirstContact : public testing::Test {
 protected:
  using Tree = BoundsTree<Box, Index>;

  /// The tree's answers for all shafts, one by one and together, are those of a scan of `boxes`.
  static void expect_flat(const Tree& tree, const std::vector<Box>& boxes, const std::vector<CompiledShaft>& shafts,
                          const ExcludingOf<Index>& excluding = {}) {
    const BoxColumns columns(boxes);
    std::vector<FirstContactOf<std::uint64_t>> flat(shafts.size());
    std::vector<FirstContactOf<Index>> many(shafts.size());
    first_contact_many(shafts, columns.view(), flat);
    first_contact_many(shafts, tree, many, excluding);
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      SCOPED_TRACE("shaft " + std::to_string(s) + " of " + std::to_string(boxes.size()) + " boxes");
      const FirstContactOf<std::uint64_t> one = first_contact(shafts[s], columns.view());
      EXPECT_EQ(flat[s], one);
      EXPECT_EQ(many[s].index, static_cast<Index>(one.index));
      EXPECT_EQ(many[s].time, one.time);
      EXPECT_EQ(first_contact(shafts[s], tree, excluding), many[s]);
      if (testing::Test::HasFailure()) return;
    }
  }
};
using IndexKinds = testing::Types<std::uint32_t, std::uint64_t>;
TYPED_TEST_SUITE(TreeFirstContact, IndexKinds);

TYPED_TEST(TreeFirstContact, IsThatOfAFlatScanForEveryShapeAndCount) {
  Random random(810);
  for (const Shape shape : shapes) {
    for (const std::size_t count : {0U, 1U, 63U, 64U, 65U, 129U, 4097U, 20000U}) {
      SCOPED_TRACE(text(shape));
      const std::vector<Box> boxes = scene<Box>(random, shape, count);
      const typename TestFixture::Tree tree{std::span<const Box>(boxes)};
      this->expect_flat(tree, boxes, shafts_for(random, random_cases(20)));
      if (this->HasFailure()) return;
    }
  }
}

TYPED_TEST(TreeFirstContact, StaysThatOfAFlatScanAsTheTreeChanges) {
  Random random(811);
  std::vector<Box> boxes = scene<Box>(random, Shape::grid, 5000);
  typename TestFixture::Tree tree{std::span<const Box>(boxes)};
  const std::vector<CompiledShaft> shafts = shafts_for(random, 30);
  boxes = scene<Box>(random, Shape::grid, boxes.size());
  tree.update(std::span<const Box>(boxes));
  this->expect_flat(tree, boxes, shafts);
  tree.rebuild();
  this->expect_flat(tree, boxes, shafts);
  this->expect_flat(typename TestFixture::Tree(tree), boxes, shafts);
  std::vector<Box> renumbered;
  for (const TypeParam i : tree.order()) renumbered.push_back(boxes[i]);
  tree.renumber();
  this->expect_flat(tree, renumbered, shafts);
}

TYPED_TEST(TreeFirstContact, LooksOnWhereTheFirstIsLeftOut) {
  Random random(812);
  for (const Shape shape : {Shape::uniform, Shape::grid}) {
    const std::vector<Box> boxes = scene<Box>(random, shape, 5000);
    typename TestFixture::Tree tree{std::span<const Box>(boxes)};
    const std::vector<CompiledShaft> shafts = shafts_for(random, 10);
    // Leaving out is as if the box were not there: an empty box is met by nothing.
    std::vector<std::uint64_t> mask(words_for(boxes.size()));
    std::vector<std::uint32_t> layers(boxes.size(), 2);
    std::vector<Box> rest = boxes;
    for (std::size_t i = 0; i != boxes.size(); ++i) {
      const bool is_masked = random.one_in(3);
      if (is_masked) mask[i / 64] |= std::uint64_t{1} << i % 64;
      if (random.one_in(3)) layers[i] = 5;
      if (is_masked || layers[i] == 5) rest[i] = empty_box;
    }
    tree.set_layers(layers);
    this->expect_flat(tree, rest, shafts, {.mask = mask, .only_layers = {2}});
    for (const CompiledShaft& shaft : shafts) {
      std::vector<Box> left = boxes;
      for (int i = 0; i != 5; ++i) {
        const auto first = first_contact(shaft, tree);
        if (!first) break;
        left[first.index] = empty_box;
        this->expect_flat(tree, left, {shaft}, {.own = {first.index}});
        left = boxes;
      }
    }
  }
}

TYPED_TEST(TreeFirstContact, WantsOneContactForEachShaft) {
  const typename TestFixture::Tree tree{std::vector<Box>(100, Box{{0, 0, 0}, {1, 1, 1}})};
  Random random(813);
  const std::vector<CompiledShaft> shafts = shafts_for(random, 3);
  std::vector<FirstContactOf<TypeParam>> two(2, {9, 0.25F});
  EXPECT_THAT(message_of([&] { first_contact_many(shafts, tree, two); }),
              testing::HasSubstr("contacts has room for 2 counts; 3 shafts need one each"));
  EXPECT_EQ(two, (std::vector<FirstContactOf<TypeParam>>(2, {9, 0.25F})));
}

TYPED_TEST(TreeFirstContact, TimesOfAListFitTheListAndTheTree) {
  const std::vector<Box> boxes(100, Box{{0, 0, 0}, {1, 1, 1}});
  typename TestFixture::Tree tree{std::span<const Box>(boxes)};
  const CompiledShaft shaft = compile({{-3, 0, 0}, {-2, 1, 1}}, {{1, 0, 0}, {2, 1, 1}});
  std::vector<float> times(3, 7);
  const std::vector<TypeParam> indices = {3, 99, 100};
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
  tree.update(std::span(indices).first(1), std::span<const Box>(boxes).first(1));
  EXPECT_THAT(
      message_of<NeedsRefit>([&] { entry_times(shaft, tree, std::span(indices).first(1), std::span(times).first(1)); }),
      testing::HasSubstr("entry_times of a tree whose bounds were updated; call refit() first"));
}

TYPED_TEST(TreeFirstContact, IsRefusedForAConvexHullInWhichNothingMoves) {
  const std::vector<Box> boxes(3, Box{{0, 0, 0}, {1, 1, 1}});
  const typename TestFixture::Tree tree{std::span<const Box>(boxes)};
  const std::vector<Vec3> points = {{-1, -1, -1}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}};
  const ConvexHull hull(points);
  const BoxColumns columns(boxes);
  std::vector<FirstContactOf<TypeParam>> contacts(1);
  std::vector<FirstContactOf<std::uint64_t>> flat(1);
  std::vector<float> times(1);
  const std::vector<TypeParam> indices = {0};
  const auto refuses = testing::HasSubstr("shaft 0 is a convex hull, in which nothing moves");
  EXPECT_THAT(message_of([&] { static_cast<void>(first_contact(hull, tree)); }), refuses);
  EXPECT_THAT(message_of([&] { static_cast<void>(first_contact(hull, columns.view())); }), refuses);
  EXPECT_THAT(message_of([&] { first_contact_many({&hull.compiled(), 1}, tree, contacts); }), refuses);
  EXPECT_THAT(message_of([&] { first_contact_many({&hull.compiled(), 1}, columns.view(), flat); }), refuses);
  EXPECT_THAT(message_of([&] { entry_times(hull, tree, indices, times); }), refuses);
}

std::size_t words_tested = 0;
kernel::TestListedWords* real_test = nullptr;

void count_words(const kernel::ShaftData& shaft, const float* const* stream, const std::uint32_t* word,
                 std::size_t words, std::uint64_t* kept, std::uint64_t* inside, unsigned least_kept) noexcept {
  words_tested += words;
  real_test(shaft, stream, word, words, kept, inside, least_kept);
}

/// Words of leaves and nodes that are tested to find the first contact, and to list everything.
struct Tested {
  std::size_t first;
  std::size_t all;
};
Tested words_tested_by(const CompiledShaft& shaft, const BoxTree& tree) {
  const auto& parts = *TreeAccess::parts(tree);
  kernel::Kernels kernels = kernel::active_kernels();
  real_test = kernels.listed_boxes;
  kernels.listed_boxes = count_words;
  words_tested = 0;
  const kernel::Exclusion<std::uint32_t> nothing({parts.order, false, kernels}, {}, {}, {});
  (void)kernel::FirstContactWalk<std::uint32_t>(parts, kernels, kernel::data_of(shaft), nothing).run();
  const std::size_t first = words_tested;
  words_tested = 0;
  kernel::Counter counter;
  kernel::Walk<Box, kernel::Counter>(parts, kernels, kernel::data_of(shaft), kernel::Question::kept, counter).run();
  return {first, words_tested};
}

TEST(FirstContactWalk, LooksAtLittleMoreThanWhatIsReachedFirst) {
  Random random(814);
  const std::vector<Box> boxes = scene<Box>(random, Shape::uniform, 200000);
  const BoxTree tree{std::span<const Box>(boxes)};
  // A plate that starts before all boxes, and moves through all of them.
  const Tested plate = words_tested_by(compile({{-9, -4, -4}, {-8, 4, 4}}, {{8, -4, -4}, {9, 4, 4}}), tree);
  EXPECT_LT(plate.first, plate.all / 20) << plate.all;
  // A large box that starts on thousands of boxes: all are reached at once, and the lowest index counts.
  const Tested large = words_tested_by(compile({{-4, -4, -4}, {0, 4, 4}}, {{0, -4, -4}, {4, 4, 4}}), tree);
  EXPECT_LT(large.first, large.all / 5) << large.all;
}

}  // namespace
}  // namespace shaftcull
