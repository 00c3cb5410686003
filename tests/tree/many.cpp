// SPDX-License-Identifier: MIT
/// Many shafts, any number of threads: the same answers in the same order; and bounds left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "many/workload.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/tree.hpp"
#include "tree/flat.hpp"
#include "tree/scenes.hpp"
#include "tree/volumes.hpp"

namespace shaftcull {
namespace {

template <class Tree>
class TreeMany : public testing::Test {
 protected:
  TreeMany() {
    Random random(61);
    bounds_ = scene<BoundOf<Tree>>(random, Shape::uniform, 9000);
    tree_ = Tree(std::span<const BoundOf<Tree>>(bounds_));
    shafts_ = shafts_for(random, 53);
  }
  std::vector<BoundOf<Tree>> bounds_;
  Tree tree_;
  std::vector<CompiledShaft> shafts_;
};

TYPED_TEST_SUITE(TreeMany, TreeKinds);

TYPED_TEST(TreeMany, CountsAndListsAreThoseOfSingleShaftsOnAnyNumberOfThreads) {
  for (const int threads : thread_counts) {
    with_threads(threads, [&] {
      std::vector<std::uint64_t> counts(this->shafts_.size(), 99);
      count_many(this->shafts_, this->tree_, counts);
      std::vector<KeptCounts> classified(this->shafts_.size(), KeptCounts{99, 99});
      count_classified_many(this->shafts_, this->tree_, classified);
      IndexLists kept;
      IndexLists overlap;
      IndexLists inside;
      for (int again = 0; again != 2; ++again) {  // into used memory
        list_many(this->shafts_, this->tree_, kept);
        list_classified_many(this->shafts_, this->tree_, overlap, inside);
      }
      ASSERT_EQ(kept.size(), this->shafts_.size());
      for (std::size_t s = 0; s != this->shafts_.size(); ++s) {
        SCOPED_TRACE("shaft " + std::to_string(s) + ", " + std::to_string(threads) + " threads");
        std::vector<std::uint32_t> one(this->bounds_.size());
        one.resize(list(this->shafts_[s], this->tree_, std::span(one)));
        EXPECT_EQ(counts[s], one.size());
        EXPECT_EQ(classified[s], (KeptCounts{overlap[s].size(), inside[s].size()}));
        EXPECT_EQ(std::vector<std::uint32_t>(kept[s].begin(), kept[s].end()), one);
        const FlatAnswers flat(this->shafts_[s], this->bounds_);
        EXPECT_EQ(sorted(kept[s]), flat.kept());
        EXPECT_EQ(sorted(overlap[s]), flat.overlap);
        EXPECT_EQ(sorted(inside[s]), flat.inside);
      }
    });
  }
}

// Lists that are worth tasks of their own come at once, late, or never; there may be fewer of them than threads.
TEST(TreeManyOfFew, ListsAreThoseOfSingleShafts) {
  Random random(67);
  const std::vector<Box> bounds = scene<Box>(random, Shape::uniform, 20000);
  const BoxTree tree{std::span<const Box>(bounds)};
  const Box all = tree.box();
  const CompiledShaft large = compile(all, all);
  const Box corner{all.lo, all.lo};
  const CompiledShaft small = compile(corner, corner);
  const std::vector<std::uint32_t> kept_by_large = [&] {
    std::vector<std::uint32_t> kept;
    list(large, tree, kept);
    return kept;
  }();
  ASSERT_EQ(kept_by_large.size(), bounds.size());
  std::vector<std::uint32_t> kept_by_small;
  list(small, tree, kept_by_small);
  for (const int threads : thread_counts) {
    for (const std::size_t count : {1U, 2U, 3U, 5U, 17U, 31U, 32U, 33U}) {
      for (const std::size_t first_large : {std::size_t{0}, std::size_t{1}, count / 2, count}) {
        SCOPED_TRACE(testing::Message() << count << " shafts, large from " << first_large << " on, " << threads
                                        << " threads");
        std::vector<CompiledShaft> shafts;
        for (std::size_t s = 0; s != count; ++s) shafts.push_back(s < first_large ? small : large);
        IndexLists kept;
        IndexLists overlap;
        IndexLists inside;
        with_threads(threads, [&] {
          list_many(shafts, tree, kept);
          list_classified_many(shafts, tree, overlap, inside);
        });
        ASSERT_EQ(kept.size(), count);
        for (std::size_t s = 0; s != count; ++s) {
          const std::vector<std::uint32_t>& right = s < first_large ? kept_by_small : kept_by_large;
          EXPECT_TRUE(std::equal(kept[s].begin(), kept[s].end(), right.begin(), right.end())) << s;
          EXPECT_EQ(overlap[s].size() + inside[s].size(), right.size()) << s;
        }
      }
    }
  }
}

TYPED_TEST(TreeMany, BitsAreThoseOfSingleShaftsOnAnyNumberOfThreads) {
  const std::size_t row = bit_words(this->bounds_.size());
  // More than a word of shafts for any_many(), the last of which keep nothing.
  std::vector<CompiledShaft> shafts = this->shafts_;
  while (shafts.size() != 130) shafts.push_back(compile({{90, 0, 0}, {91, 1, 1}}, {{99, 0, 0}, {99, 1, 1}}));
  std::vector<std::uint64_t> expected_any(3);
  for (std::size_t s = 0; s != shafts.size(); ++s) {
    expected_any[s / 64] |= std::uint64_t{count(shafts[s], this->tree_) != 0} << s % 64;
  }
  for (const int threads : thread_counts) {
    with_threads(threads, [&] {
      std::vector<std::uint64_t> kept(shafts.size() * row, 99);
      std::vector<std::uint64_t> both(kept.size(), 99);
      std::vector<std::uint64_t> inside(kept.size(), 99);
      std::vector<std::uint64_t> inside_alone(kept.size(), 99);
      std::vector<std::uint64_t> found(3, 99);
      cull_many(shafts, this->tree_, kept);
      classify_many(shafts, this->tree_, both, inside);
      classify_many(shafts, this->tree_, {}, inside_alone);
      any_many(shafts, this->tree_, found);
      EXPECT_EQ(found, expected_any);
      EXPECT_EQ(kept == both, true);
      EXPECT_EQ(inside == inside_alone, true);
      for (std::size_t s = 0; s != shafts.size(); ++s) {
        const FlatAnswers flat(shafts[s], this->bounds_);
        const auto row_of = [&](const std::vector<std::uint64_t>& rows) {
          return std::vector<std::uint64_t>(rows.begin() + static_cast<std::ptrdiff_t>(s * row),
                                            rows.begin() + static_cast<std::ptrdiff_t>((s + 1) * row));
        };
        ASSERT_EQ(row_of(kept), bits_of(flat.kept(), this->bounds_.size())) << "shaft " << s;
        ASSERT_EQ(row_of(inside), bits_of(flat.inside, this->bounds_.size())) << "shaft " << s;
      }
    });
  }
}

TYPED_TEST(TreeMany, LeavesOutWhatIsExcludedAndNothingElse) {
  Random random(62);
  std::vector<std::uint64_t> mask(bit_words(this->bounds_.size()));
  for (std::uint64_t& word : mask)
    word = random.one_in(3) ? 0 : std::uint64_t{random.below(0xffffffff)} << random.below(33);
  // What a shaft keeps is what is worth leaving out of it.
  std::vector<std::uint32_t> own;
  for (const CompiledShaft& shaft : this->shafts_) {
    const Indices kept = FlatAnswers(shaft, this->bounds_).kept();
    for (int i = 0; i != 3; ++i) {
      own.push_back(kept.empty() ? 5U : kept[random.below(static_cast<unsigned>(kept.size()))]);
    }
  }
  for (const bool use_mask : {false, true}) {
    for (const bool use_own : {false, true}) {
      Query query;
      if (use_mask) query.exclude_mask = mask;
      if (use_own) query.exclude_each = own;
      IndexLists kept;
      IndexLists overlap;
      IndexLists inside;
      std::vector<std::uint64_t> counts(this->shafts_.size());
      list_many(this->shafts_, this->tree_, kept, query);
      list_classified_many(this->shafts_, this->tree_, overlap, inside, query);
      count_many(this->shafts_, this->tree_, counts, query);
      std::vector<KeptCounts> classified(this->shafts_.size());
      count_classified_many(this->shafts_, this->tree_, classified, query);
      const std::size_t row = bit_words(this->bounds_.size());
      std::vector<std::uint64_t> kept_bits(this->shafts_.size() * row);
      std::vector<std::uint64_t> inside_bits(kept_bits.size());
      std::vector<std::uint64_t> found(1);
      classify_many(this->shafts_, this->tree_, kept_bits, inside_bits, query);
      any_many(this->shafts_, this->tree_, found, query);
      for (std::size_t s = 0; s != this->shafts_.size(); ++s) {
        FlatAnswers flat(this->shafts_[s], this->bounds_);
        const std::span<const std::uint32_t> own_of_shaft = std::span(own).subspan(3 * s, 3);
        const auto is_out = [&](std::uint32_t i) {
          return (use_mask && (mask[i / 64] >> i % 64 & 1) != 0) ||
                 (use_own && std::find(own_of_shaft.begin(), own_of_shaft.end(), i) != own_of_shaft.end());
        };
        std::erase_if(flat.overlap, is_out);
        std::erase_if(flat.inside, is_out);
        EXPECT_EQ(sorted(kept[s]), flat.kept());
        EXPECT_EQ(sorted(overlap[s]), flat.overlap);
        EXPECT_EQ(sorted(inside[s]), flat.inside);
        EXPECT_EQ(counts[s], flat.kept().size());
        EXPECT_EQ(classified[s], (KeptCounts{flat.overlap.size(), flat.inside.size()}));
        const auto first = static_cast<std::ptrdiff_t>(s * row);
        const auto end = first + static_cast<std::ptrdiff_t>(row);
        EXPECT_EQ(std::vector(kept_bits.begin() + first, kept_bits.begin() + end),
                  bits_of(flat.kept(), this->bounds_.size()));
        EXPECT_EQ(std::vector(inside_bits.begin() + first, inside_bits.begin() + end),
                  bits_of(flat.inside, this->bounds_.size()));
        EXPECT_EQ((found[0] >> s & 1) != 0, !flat.kept().empty());
      }
    }
  }
}

TYPED_TEST(TreeMany, TheOrderDoesNotDependOnTheNumberOfThreads) {
  Random random(63);
  // So many that threads halve them together; with sizes apart, and with many ties.
  for (const Shape shape : {Shape::uniform, Shape::wild_sizes, Shape::grid}) {
    const auto bounds = scene<BoundOf<TypeParam>>(random, shape, 140000);
    const auto order_here = [&] {
      const TypeParam tree{std::span<const BoundOf<TypeParam>>(bounds)};
      return std::vector<std::uint32_t>(tree.order().begin(), tree.order().end());
    };
    const std::vector<std::uint32_t> order = order_here();
    for (const int threads : thread_counts) {
      with_threads(threads, [&] { EXPECT_EQ(order_here() == order, true) << text(shape) << ", " << threads; });
    }
  }
}

TYPED_TEST(TreeMany, WhatDoesNotFitIsCountedAndNotWritten) {
  for (const CompiledShaft& shaft : this->shafts_) {
    std::vector<std::uint32_t> all(this->bounds_.size());
    all.resize(list(shaft, this->tree_, std::span(all)));
    for (const std::size_t room : {std::size_t{0}, all.size() / 2, all.size()}) {
      std::vector<std::uint32_t> some(room + 1, 12345);
      EXPECT_EQ(list(shaft, this->tree_, std::span(some).first(room)), all.size());
      EXPECT_EQ(some.back(), 12345U);
      EXPECT_TRUE(std::equal(some.begin(), some.end() - 1, all.begin()));
    }
  }
}

}  // namespace
}  // namespace shaftcull
