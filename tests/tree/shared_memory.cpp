// SPDX-License-Identifier: MIT
/// Outputs that share memory with inputs or with each other are refused, and nothing is written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "caught.hpp"
#include "columns.hpp"
#include "message_of.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/query.hpp"
#include "shaftcull/tree.hpp"
#include "support/overlap.hpp"
#include "tree/scenes.hpp"
#include "tree/volumes.hpp"

namespace shaftcull {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(SharedMemory, RangesThatOnlyTouchAreApart) {
  const std::array<std::uint32_t, 8> memory{};
  const auto bytes = [&](std::size_t first, std::size_t count) {
    return kernel::bytes_of(memory.data() + first, count);
  };
  EXPECT_FALSE(kernel::overlap(bytes(0, 4), bytes(4, 4)));
  EXPECT_FALSE(kernel::overlap(bytes(4, 4), bytes(0, 4)));
  EXPECT_TRUE(kernel::overlap(bytes(0, 5), bytes(4, 4)));
  EXPECT_TRUE(kernel::overlap(bytes(4, 4), bytes(0, 5)));
  EXPECT_TRUE(kernel::overlap(bytes(0, 8), bytes(3, 1)));
  EXPECT_TRUE(kernel::overlap(bytes(3, 1), bytes(0, 8)));
  EXPECT_FALSE(kernel::overlap(bytes(3, 0), bytes(0, 8)));
  EXPECT_FALSE(kernel::overlap(bytes(0, 8), bytes(3, 0)));
}

template <class Tree>
class TreeSharedMemory : public testing::Test {
 protected:
  static constexpr std::size_t count = 5000;

  static std::vector<BoundOf<Tree>> leaves_of(const Tree& tree) {
    std::vector<BoundOf<Tree>> leaves;
    for (std::size_t p = 0; p != tree.size(); ++p) leaves.push_back(tree.leaves()[p]);
    return leaves;
  }
  static Tree random_tree() {
    Random random(51);
    return Tree{std::span<const BoundOf<Tree>>(scene<BoundOf<Tree>>(random, Shape::uniform, count))};
  }

  const CompiledShaft shaft_ = compile({{-4, -4, -4}, {0, 0, 0}}, {{1, 1, 1}, {4, 4, 4}});
};
TYPED_TEST_SUITE(TreeSharedMemory, TreeKinds);

TYPED_TEST(TreeSharedMemory, ATreesOwnLeavesAreNoUpdateOfIt) {
  using Bound = BoundOf<TypeParam>;
  TypeParam tree = this->random_tree();
  const std::vector<Bound> before = this->leaves_of(tree);
  const auto refusal = AllOf(HasSubstr("update: "), HasSubstr("the tree's leaves share memory"));

  EXPECT_THAT(message_of([&] { tree.update(tree.leaves()); }), refusal);
  const std::vector<std::uint32_t> indices = {1, 2, 3};
  EXPECT_THAT(message_of([&] { tree.update(indices, tree.leaves().slice(7, 3)); }), refusal);

  // One stream of many is enough, and so is one float of it.
  const auto memory = columns(before);
  auto mixed = memory.view();
  mixed.stream[2] = tree.leaves().stream[1];
  EXPECT_THAT(message_of([&] { tree.update(mixed); }), refusal);
  auto last = memory.view().slice(0, 3);
  last.stream[0] = tree.leaves().stream[0] + (bit_words(this->count) * 64 - 1);
  EXPECT_THAT(message_of([&] { tree.update(indices, last); }), refusal);

  // So are records in that memory, forwards and backwards.
  typename TypeParam::Records records{tree.leaves().stream[0], tree.leaves().stream[3], sizeof(float), 3};
  EXPECT_THAT(message_of([&] { tree.update(indices, records); }), refusal);
  records.stride = 0 - sizeof(float);
  EXPECT_THAT(message_of([&] { tree.update(indices, records); }), refusal);

  EXPECT_EQ(this->leaves_of(tree), before);
  EXPECT_FALSE(tree.needs_refit());
}

TYPED_TEST(TreeSharedMemory, AnotherTreesLeavesAndTheTreesOwnOrderMayBeRead) {
  using Bound = BoundOf<TypeParam>;
  TypeParam tree = this->random_tree();
  const std::vector<Bound> before = this->leaves_of(tree);
  const TypeParam copy = tree;
  tree.update(tree.order(), copy.leaves());  // bound order()[p] gets the value of leaf p, which it has already
  tree.refit();
  EXPECT_EQ(this->leaves_of(tree), before);
}

TYPED_TEST(TreeSharedMemory, OutputsOfAQueryMustNotBeWhatItLeavesOutNorOneAnother) {
  const TypeParam tree = this->random_tree();
  const std::vector<std::uint32_t> untouched(200, 7);
  std::vector<std::uint32_t> memory = untouched;
  const std::span<std::uint32_t> all(memory);
  const auto shares = [](const char* one, const char* other) {
    return AllOf(HasSubstr(one), HasSubstr(other), HasSubstr("share memory"));
  };
  EXPECT_THAT(message_of([&] { static_cast<void>(list(this->shaft_, tree, all, {.exclude = all.subspan(199, 1)})); }),
              shares("list: kept", "query.exclude "));
  EXPECT_THAT(
      message_of([&] { static_cast<void>(list_classified(this->shaft_, tree, all.first(100), all.subspan(99))); }),
      shares("list_classified: overlap", "inside"));
  EXPECT_THAT(message_of([&] {
                static_cast<void>(list_classified(this->shaft_, tree, all.first(100), all.subspan(100),
                                                  {.exclude_each = all.subspan(100, 2)}));
              }),
              shares("list_classified: inside", "query.exclude_each"));
  EXPECT_EQ(memory, untouched);
  EXPECT_NO_THROW(static_cast<void>(
      list_classified(this->shaft_, tree, all.first(90), all.subspan(90, 90), {.exclude = all.subspan(180)})));

  std::vector<std::uint64_t> mask(bit_words(this->count));
  EXPECT_THAT(message_of([&] {
                count_many({&this->shaft_, 1}, tree, std::span(mask).first(1), {.exclude_mask = mask});
              }),
              shares("count_many: kept_counts", "query.exclude_mask"));
  EXPECT_EQ(mask, std::vector<std::uint64_t>(bit_words(this->count)));
}

TYPED_TEST(TreeSharedMemory, ListsMustNotBeOneListNorWhatTheQueryLeavesOut) {
  const TypeParam tree = this->random_tree();
  const std::span<const CompiledShaft> shafts(&this->shaft_, 1);
  IndexLists lists{{0, 2}, {11, 12}};
  IndexLists others{{0, 1}, {13}};
  const auto expect_unchanged = [&] {
    EXPECT_EQ(lists.offsets, (std::vector<std::uint64_t>{0, 2}));
    EXPECT_EQ(lists.indices, (std::vector<std::uint32_t>{11, 12}));
    EXPECT_EQ(others.indices, (std::vector<std::uint32_t>{13}));
  };
  EXPECT_THAT(message_of([&] { list_classified_many(shafts, tree, lists, lists); }),
              HasSubstr("list_classified_many: overlap and inside share memory"));
  expect_unchanged();
  EXPECT_THAT(message_of([&] { list_many(shafts, tree, lists, {.exclude = lists.indices}); }),
              HasSubstr("list_many: lists and query.exclude share memory"));
  EXPECT_THAT(message_of([&] { list_many(shafts, tree, lists, {.exclude_each = lists.indices}); }),
              HasSubstr("list_many: lists and query.exclude_each share memory"));
  EXPECT_THAT(message_of([&] { list_classified_many(shafts, tree, lists, others, {.exclude = others.indices}); }),
              HasSubstr("list_classified_many: inside and query.exclude share memory"));
  expect_unchanged();
}

TYPED_TEST(TreeSharedMemory, AListMayOverwriteItsCandidatesFromTheirBeginningOnly) {
  const TypeParam tree = this->random_tree();
  std::vector<std::uint32_t> candidates;
  for (std::uint32_t i = 0; i != 2000; ++i) candidates.push_back(i * 7 % 5000);
  std::vector<std::uint32_t> expected(candidates.size());
  expected.resize(list(this->shaft_, tree.leaves(), std::span(expected), {.only = candidates}));
  ASSERT_GT(expected.size(), 10U);

  std::vector<std::uint32_t> memory(10, 0);
  memory.insert(memory.end(), candidates.begin(), candidates.end());
  memory.insert(memory.end(), candidates.size(), 0);
  const std::vector<std::uint32_t> before = memory;
  const auto all = std::span(memory);
  const std::span<const std::uint32_t> in = all.subspan(10, candidates.size());
  for (const std::size_t start :
       {std::size_t{0}, std::size_t{9}, std::size_t{11}, std::size_t{9 + candidates.size()}}) {
    EXPECT_THAT(
        message_of([&] {
          static_cast<void>(list(this->shaft_, tree.leaves(), all.subspan(start, candidates.size()), {.only = in}));
        }),
        HasSubstr("list: kept and query.only share memory"))
        << start;
  }
  EXPECT_EQ(memory, before);
  const std::span<std::uint32_t> behind = all.subspan(10 + candidates.size());
  ASSERT_EQ(list(this->shaft_, tree.leaves(), behind, {.only = in}), expected.size());
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), behind.begin()));
  // What `kept` has room for past the number of candidates is never written.
  ASSERT_EQ(list(this->shaft_, tree.leaves(), all, {.only = behind.first(0)}), 0U);
  ASSERT_EQ(list(this->shaft_, tree.leaves(), all.subspan(10), {.only = in}), expected.size());
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), all.begin() + 10));
}

TYPED_TEST(TreeSharedMemory, ListsOfManyRefuseCandidatesThatAreTheirMemory) {
  const TypeParam tree = this->random_tree();
  IndexLists lists{{0, 3}, {11, 12, 13}};
  EXPECT_THAT(message_of([&] {
                list_many({&this->shaft_, 1}, tree.leaves(), lists,
                          {.only = std::span<const std::uint32_t>(lists.indices).last(1)});
              }),
              HasSubstr("list_many: lists and query.only share memory"));
  EXPECT_EQ(lists.indices, (std::vector<std::uint32_t>{11, 12, 13}));
}

TYPED_TEST(TreeSharedMemory, IndicesLeftOutMustExist) {
  const TypeParam tree = this->random_tree();
  std::vector<std::uint32_t> own = {4999, 5000};
  EXPECT_THAT(message_of([&] { static_cast<void>(shaftcull::count(this->shaft_, tree, {.exclude = own})); }),
              HasSubstr("query.exclude[1] = 5000 is not below the number of bounds, 5000"));
  const auto refusal = HasSubstr("query.exclude_each[1] = 5000 is not below the number of bounds, 5000");
  EXPECT_THAT(message_of([&] { static_cast<void>(shaftcull::count(this->shaft_, tree, {.exclude_each = own})); }),
              refusal);
  IndexLists lists;
  const std::vector<CompiledShaft> shafts(2, this->shaft_);
  EXPECT_THAT(message_of([&] { list_many(shafts, tree, lists, {.exclude_each = own}); }), refusal);
  std::vector<std::uint64_t> counts(2);
  EXPECT_THAT(message_of([&] { count_many(shafts, tree, counts, {.exclude_each = own}); }), refusal);
  own[1] = 0;
  EXPECT_NO_THROW(list_many(shafts, tree, lists, {.exclude_each = own}));
}

}  // namespace
}  // namespace shaftcull
