// SPDX-License-Identifier: MIT
/// Every verb of kept bounds, with every option alone and with several: the answers for one bound at a time, put
/// together by plain loops, are those of views, streams and trees, for one shaft and for many.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "caught.hpp"
#include "options/listed.hpp"
#include "options/query_case.hpp"
#include "options/scenes.hpp"
#include "options/truth.hpp"
#include "oracle/random.hpp"
#include "result_words.hpp"
#include "sanitizers.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {
namespace {

/// Bits, flags and numbers of one shaft.
void expect_bits_and_numbers(const CompiledShaft& shaft, const Bounds& bounds, const Query& query,
                             const ShaftLists& right) {
  const Query all = unlimited(query);
  const std::vector<std::uint64_t> right_kept = bits_of(right.kept, bounds.size());
  const std::vector<std::uint64_t> right_inside = bits_of(right.inside, bounds.size());
  const std::vector<std::uint64_t> unwritten(right_kept.size(), sentinel);
  std::vector<std::uint64_t> kept = unwritten;
  std::vector<std::uint64_t> inside = unwritten;
  cull(shaft, bounds, kept, all);
  EXPECT_EQ(kept, right_kept) << "cull";
  kept = unwritten;
  classify(shaft, bounds, kept, inside, all);
  EXPECT_EQ(kept, right_kept) << "classify";
  EXPECT_EQ(inside, right_inside) << "classify";
  inside = unwritten;
  classify(shaft, bounds, {}, inside, all);
  EXPECT_EQ(inside, right_inside) << "classify without kept";
  EXPECT_EQ(any(shaft, bounds, all), !right.kept.empty());
  EXPECT_EQ(count(shaft, bounds, all), right.kept.size());
  EXPECT_EQ(count(shaft, bounds, query), std::min(right.kept.size(), query.limit));
  EXPECT_EQ(count_classified(shaft, bounds, all), (KeptCounts{right.overlap.size(), right.inside.size()}));
}

/// Lists of one shaft, in room of every size.
void expect_lists_of_one(Random& random, const CompiledShaft& shaft, const Bounds& bounds, const Query& query,
                         const ShaftLists& right) {
  const Query all = unlimited(query);
  const Indices first = limited(right.kept, query);
  for (const std::size_t room : rooms_for(random, first.size())) {
    expect_listed(first, room, [&](std::span<std::uint32_t> kept) {
      EXPECT_EQ(list(shaft, bounds, kept, query), first.size()) << "list";
    });
  }
  expect_listed(right.kept, a_room_for(random, right.kept.size()), [&](std::span<std::uint32_t> kept) {
    EXPECT_EQ(list(shaft, bounds, kept, all), right.kept.size()) << "list";
  });
  for (const std::size_t size : {std::size_t{0}, std::size_t{3}, first.size(), first.size() + 300}) {
    Indices kept(size, 0x5e5e5e5e);
    EXPECT_EQ(list(shaft, bounds, kept, query), first.size()) << "list into a vector of " << size;
    EXPECT_EQ(kept, first) << "list into a vector of " << size;
  }
  const KeptCounts counts{right.overlap.size(), right.inside.size()};
  for (int again = 0; again != 3; ++again) {
    expect_listed(right.inside, a_room_for(random, counts.inside), [&](std::span<std::uint32_t> inside) {
      expect_listed(right.overlap, a_room_for(random, counts.overlap), [&](std::span<std::uint32_t> overlap) {
        EXPECT_EQ(list_classified(shaft, bounds, overlap, inside, all), counts) << "list_classified";
      });
    });
  }
  if (!query.only) return;
  // A list may overwrite its candidates, with less room than they take, as much or more.
  const std::size_t candidates = query.only->size();
  for (const std::size_t room : {candidates / 2, candidates, candidates + 10}) {
    Indices memory(query.only->begin(), query.only->end());
    memory.resize(candidates + 64, 0x5e5e5e5e);
    const Indices before = memory;
    Query in_place = query;
    in_place.only = std::span<const std::uint32_t>(memory).first(candidates);
    EXPECT_EQ(list(shaft, bounds, std::span(memory).first(room), in_place), first.size()) << "list in place";
    const auto fit = static_cast<std::ptrdiff_t>(std::min(room, first.size()));
    EXPECT_TRUE(std::equal(first.begin(), first.begin() + fit, memory.begin())) << "list in place";
    const auto behind = static_cast<std::ptrdiff_t>(room);
    EXPECT_TRUE(std::equal(memory.begin() + behind, memory.end(), before.begin() + behind))
        << "list in place wrote past its room";
  }
}

/// Verbs of many shafts.
void expect_many(std::span<const CompiledShaft> shafts, const Bounds& bounds, const Query& query,
                 const std::vector<ShaftLists>& right) {
  const Query all = unlimited(query);
  const std::size_t row = bit_words(bounds.size());
  std::vector<std::uint64_t> right_kept;
  std::vector<std::uint64_t> right_inside;
  std::vector<std::uint64_t> right_any(bit_words(shafts.size()));
  std::vector<std::uint64_t> right_counts;
  std::vector<std::uint64_t> right_limited;
  std::vector<KeptCounts> right_classified;
  std::vector<Indices> kept;
  std::vector<Indices> first;
  std::vector<Indices> overlap;
  std::vector<Indices> inside;
  for (std::size_t s = 0; s != shafts.size(); ++s) {
    const std::vector<std::uint64_t> kept_row = bits_of(right[s].kept, bounds.size());
    const std::vector<std::uint64_t> inside_row = bits_of(right[s].inside, bounds.size());
    right_kept.insert(right_kept.end(), kept_row.begin(), kept_row.end());
    right_inside.insert(right_inside.end(), inside_row.begin(), inside_row.end());
    right_any[s / 64] |= std::uint64_t{!right[s].kept.empty()} << s % 64;
    right_classified.push_back({right[s].overlap.size(), right[s].inside.size()});
    kept.push_back(right[s].kept);
    first.push_back(limited(right[s].kept, query));
    overlap.push_back(right[s].overlap);
    inside.push_back(right[s].inside);
    right_counts.push_back(kept.back().size());
    right_limited.push_back(first.back().size());
  }

  const std::vector<std::uint64_t> unwritten(shafts.size() * row, sentinel);
  std::vector<std::uint64_t> kept_rows = unwritten;
  std::vector<std::uint64_t> inside_rows = unwritten;
  cull_many(shafts, bounds, kept_rows, all);
  expect_rows(kept_rows, right_kept, "cull_many", row);
  kept_rows = unwritten;
  classify_many(shafts, bounds, kept_rows, inside_rows, all);
  expect_rows(kept_rows, right_kept, "classify_many, kept", row);
  expect_rows(inside_rows, right_inside, "classify_many, inside", row);
  inside_rows = unwritten;
  classify_many(shafts, bounds, {}, inside_rows, all);
  expect_rows(inside_rows, right_inside, "classify_many without kept", row);

  std::vector<std::uint64_t> found(right_any.size(), sentinel);
  any_many(shafts, bounds, found, all);
  EXPECT_EQ(found, right_any) << "any_many";
  std::vector<std::uint64_t> counts(shafts.size(), sentinel);
  count_many(shafts, bounds, counts, all);
  expect_rows(counts, right_counts, "count_many");
  counts.assign(shafts.size(), sentinel);
  count_many(shafts, bounds, counts, query);
  expect_rows(counts, right_limited, "count_many with the limit");
  std::vector<KeptCounts> classified(shafts.size(), KeptCounts{SIZE_MAX / 3, SIZE_MAX / 3});
  count_classified_many(shafts, bounds, classified, all);
  expect_rows(classified, right_classified, "count_classified_many");

  IndexLists lists{{0, 2}, {11, 12}};  // of a call before
  IndexLists others;
  list_many(shafts, bounds, lists, all);
  expect_lists(lists, kept, "list_many");
  list_many(shafts, bounds, lists, query);
  expect_lists(lists, first, "list_many with the limit");
  list_classified_many(shafts, bounds, lists, others, all);
  expect_lists(lists, overlap, "list_classified_many, overlap");
  expect_lists(others, inside, "list_classified_many, inside");
}

/// Numbers of results in all cases of a test, so that a test of nothing is noticed.
struct Found {
  std::size_t overlap = 0;
  std::size_t inside = 0;
  std::size_t cut = 0;  ///< lists that a limit ended
};

/// How large a scene is, and how many cases are tried with it.
struct Plan {
  std::size_t bounds;
  std::size_t shafts;
  std::size_t cases;
};

template <class Bound>
void expect_all(std::uint64_t seed, const Plan& plan, Found& found) {
  SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::to_string(plan.bounds) + " bounds, " +
               std::to_string(plan.shafts) + " shafts");
  Random random(seed);
  const bool has_layers = random.one_in(2);
  const bool by_vertices = std::is_same_v<Bound, Triangle> && random.one_in(2);
  const TriangleTest test = by_vertices ? TriangleTest::vertices : TriangleTest::exact;
  const Scene<Bound> scene(random, bounds_of<Bound>(random, plan.bounds), has_layers);
  const ShaftSet shafts(random, plan.shafts, true);
  const Truth truth = truth_of(shafts.all(), scene.bounds(), test);
  for (std::size_t i = 0; i != random_cases(plan.cases); ++i) {
    const QueryCase options(random, truth, has_layers ? Options::all : Options::all & ~Options::layer_mask, test);
    SCOPED_TRACE(options.text());
    const Query query = options.of_all();
    for (const Holder& holder : scene.holders()) {
      if (options.asks_for_layers() && !holder.has_layers) continue;
      SCOPED_TRACE(holder.name);
      std::vector<ShaftLists> right;
      for (std::size_t s = 0; s != plan.shafts; ++s) {
        right.push_back(options.lists(truth, scene.layers(), s, holder.order));
        found.overlap += right.back().overlap.size();
        found.inside += right.back().inside.size();
        found.cut += static_cast<std::size_t>(right.back().kept.size() > query.limit);
      }
      expect_many(shafts.all(), holder.bounds, query, right);
      for (int again = 0; again != (plan.bounds < 1000 ? 3 : 1); ++again) {
        const std::size_t s = random.below(static_cast<unsigned>(shafts.all().size()));
        SCOPED_TRACE("shaft " + std::to_string(s) + " alone");
        expect_bits_and_numbers(shafts.all()[s], holder.bounds, options.of_one(s), right[s]);
        expect_lists_of_one(random, shafts.all()[s], holder.bounds, options.of_one(s), right[s]);
      }
      if (testing::Test::HasFailure()) return;
    }
  }
}

template <class Bound>
class QueryOptions : public testing::Test {
 protected:
  static void expect_plans(std::uint64_t seed, std::span<const Plan> plans) {
    Found found;
    for (const Plan& plan : plans) {
      expect_all<Bound>(seed++, plan, found);
      if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(found.overlap, 1000U);
    EXPECT_GT(found.inside, 1000U);
    if (random_cases(6) == 6 && plans.size() > 8) {  // of fewer cases none may be cut
      EXPECT_GT(found.cut, 1U);
    }
  }
};
TYPED_TEST_SUITE(QueryOptions, BoundKinds);

TYPED_TEST(QueryOptions, LeaveTheSameOfFewBounds) {
  std::vector<Plan> plans;
  for (const std::size_t bounds : {0U, 1U, 63U, 64U, 65U}) {
    for (const std::size_t shafts : {1U, 2U, 7U, 63U, 64U, 65U, 130U}) plans.push_back({bounds, shafts, 4});
  }
  this->expect_plans(1000, plans);
}

TYPED_TEST(QueryOptions, LeaveTheSameOfAFewHundredBounds) {
  std::vector<Plan> plans;
  for (const std::size_t bounds : {511U, 512U, 513U}) {
    for (const std::size_t shafts : {1U, 2U, 7U, 64U}) plans.push_back({bounds, shafts, 3});
  }
  plans.push_back({511, 63, 2});
  plans.push_back({512, 65, 2});
  plans.push_back({513, 130, 2});
  this->expect_plans(2000, plans);
}

TYPED_TEST(QueryOptions, LeaveTheSameOfThousandsOfBounds) {
  std::vector<Plan> plans;
  for (const std::size_t bounds : {2047U, 2048U, 2049U}) {
    for (const std::size_t shafts : {1U, 2U, 7U}) plans.push_back({bounds, shafts, 4});
  }
  plans.push_back({2047, 65, 1});
  plans.push_back({2048, 63, 1});
  plans.push_back({2049, 130, 1});
  this->expect_plans(3000, plans);
}

TYPED_TEST(QueryOptions, LeaveTheSameOfManyThousandsOfBounds) {
  constexpr Plan plans[] = {{16383, 7, 1}, {16384, 1, 3}, {16384, 7, 1}, {16385, 2, 2},
                            {16385, 9, 1}, {40000, 1, 3}, {40000, 7, 1}};
  this->expect_plans(4200, plans);
}

TYPED_TEST(QueryOptions, OfNoShaftsGiveNothing) {
  Random random(5000);
  const Scene<TypeParam> scene(random, bounds_of<TypeParam>(random, 100), true);
  const Indices some = {3, 70};
  for (const Holder& holder : scene.holders()) {
    SCOPED_TRACE(holder.name);
    Query query{.exclude = {1}, .only = some};
    if (holder.has_layers) query.layer_mask = 1;
    cull_many({}, holder.bounds, {}, query);
    classify_many({}, holder.bounds, {}, {}, query);
    any_many({}, holder.bounds, {}, query);
    count_many({}, holder.bounds, {}, query);
    count_classified_many({}, holder.bounds, {}, query);
    IndexLists lists{{0, 1}, {5}};
    IndexLists others = lists;
    query.limit = 1;
    list_many({}, holder.bounds, lists, query);
    EXPECT_EQ(lists.offsets, std::vector<std::uint64_t>{0});
    EXPECT_TRUE(lists.indices.empty());
    lists = others;
    list_classified_many({}, holder.bounds, lists, others, unlimited(query));
    EXPECT_EQ(lists.size(), 0U);
    EXPECT_EQ(others.size(), 0U);
    EXPECT_TRUE(others.indices.empty());
  }
}

}  // namespace
}  // namespace shaftcull
