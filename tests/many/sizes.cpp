// SPDX-License-Identifier: MIT
/// Every number of bounds and of shafts: bits, counts and lists, of candidates too, are the answers that the scalar
/// kernels give one bound at a time, and nothing is read past the last bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "columns.hpp"
#include "forms.hpp"
#include "guarded_floats.hpp"
#include "instruction_sets.hpp"
#include "many/workload.hpp"
#include "oracle/random.hpp"
#include "result_words.hpp"
#include "sanitizers.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull {
namespace {

constexpr std::uint64_t seed = 191;
constexpr std::size_t most_bounds = 8193;
constexpr std::size_t shaft_counts[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 63, 64, 65};
constexpr std::size_t most_shafts = 65;
constexpr std::size_t special_shafts[] = {0, 1, 2, 3, 4, 64};  // see mixed_shafts()

/// 0 to 200 and around every power of two up to 8,192; where a sanitizer makes each slow, every seventh of the first
/// and around every other power.
std::vector<std::size_t> bound_counts() {
  std::vector<std::size_t> counts;
  for (std::size_t count = 0; count <= 200; count += has_shadow_memory ? 7 : 1) counts.push_back(count);
  for (std::size_t power = 256; power <= 8192; power *= has_shadow_memory ? 4 : 2)
    counts.insert(counts.end(), {power - 1, power, power + 1});
  for (const std::size_t other : {1500U, 2100U, 3000U, 6145U}) counts.push_back(other);
  return counts;
}

/// Shafts of every form: around all bounds, with added planes, of stationary faces, too large for floats; the others
/// drawn.
std::vector<CompiledShaft> mixed_shafts() {
  std::vector<CompiledShaft> shafts = random_shafts(seed, most_shafts);
  const Box world{{-6, -6, -6}, {6, 6, 6}};
  const std::vector<Plane> planes = {{{1, 0, 0}, 2}, {{0, 1, 1}, 3}, {{0, 0, 1}, 1}};
  shafts[1] = compile(world, world, std::span(planes).first(2));
  shafts[2] = compile({{-4, -1, -1}, {-3, 1, 1}}, {{3, -1, -1}, {4, 1, 1}});
  shafts[3] = compile({{-3e38F, -2, -2}, {-1, 2, 2}}, {{0, -1, -3}, {2, 1, 1}});
  shafts[4] = compile({{0, 0, 0}, {1, 1, 1}}, {{2, 3, 0}, {4, 4, 2}});
  shafts[64] = compile({{-5, -4, -4}, {-2, 3, 1}}, {{1, -2, 0}, {5, 2, 4}}, std::span(planes).last(1));
  return shafts;
}

std::vector<Box> mixed_boxes() {
  std::vector<Box> boxes = random_boxes(seed + 1, most_bounds);
  Random random(seed + 2);
  for (std::size_t i = 0; i < boxes.size(); i += 5) boxes[i] = random.grid_box(-5, 5);  // many that touch
  return boxes;
}

std::vector<Sphere> mixed_spheres() {
  std::vector<Sphere> spheres = random_spheres(seed + 3, most_bounds);
  Random random(seed + 4);
  for (std::size_t i = 0; i < spheres.size(); i += 5) {
    spheres[i] = {{random.integer(-5, 5), random.integer(-5, 5), random.integer(-5, 5)}, random.integer(-1, 2)};
  }
  return spheres;
}

/// What the scalar kernels say of every shaft and bound, one at a time, as rows of bits.
struct Expected {
  std::vector<std::uint64_t> kept[most_shafts];
  std::vector<std::uint64_t> inside[most_shafts];

  template <class Bound>
  Expected(const std::vector<CompiledShaft>& shafts, const std::vector<Bound>& bounds) {
    const UseIsa scalar(Isa::scalar);
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      kept[s].resize(bit_words(bounds.size()));
      inside[s].resize(bit_words(bounds.size()));
      for (std::size_t i = 0; i != bounds.size(); ++i) {
        const Answer answer = classify(shafts[s], bounds[i]);
        kept[s][i / 64] |= std::uint64_t{answer != Answer::outside} << i % 64;
        inside[s][i / 64] |= std::uint64_t{answer == Answer::inside} << i % 64;
      }
    }
  }
};

/// The bits of the first `count` bounds.
std::vector<std::uint64_t> first_of(const std::vector<std::uint64_t>& bits, std::size_t count) {
  std::vector<std::uint64_t> some(bits.begin(), bits.begin() + static_cast<std::ptrdiff_t>(bit_words(count)));
  if (count % 64 != 0) some.back() &= (std::uint64_t{1} << count % 64) - 1;
  return some;
}

std::vector<std::uint32_t> indices_of(const std::vector<std::uint64_t>& bits) {
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i != bits.size() * 64; ++i) {
    if ((bits[i / 64] >> i % 64 & 1U) != 0) indices.push_back(i);
  }
  return indices;
}

/// What a number of shafts and of bounds should give.
struct Part {
  std::vector<std::uint64_t> kept;
  std::vector<std::uint64_t> inside;
  std::vector<std::uint64_t> counts;
  std::vector<std::uint64_t> offsets{0};
  std::vector<std::uint32_t> indices;
  std::vector<KeptCounts> classified;
  std::vector<std::uint32_t> overlaps;
  std::vector<std::uint32_t> insides;

  Part(const Expected& expected, std::size_t first_shaft, std::size_t shafts, std::size_t bounds) {
    for (std::size_t s = first_shaft; s != first_shaft + shafts; ++s) {
      const std::vector<std::uint64_t> kept_row = first_of(expected.kept[s], bounds);
      const std::vector<std::uint64_t> inside_row = first_of(expected.inside[s], bounds);
      const std::vector<std::uint32_t> row = indices_of(kept_row);
      kept.insert(kept.end(), kept_row.begin(), kept_row.end());
      inside.insert(inside.end(), inside_row.begin(), inside_row.end());
      indices.insert(indices.end(), row.begin(), row.end());
      counts.push_back(row.size());
      offsets.push_back(indices.size());
      const std::vector<std::uint32_t> inside_of_row = indices_of(inside_row);
      insides.insert(insides.end(), inside_of_row.begin(), inside_of_row.end());
      std::set_difference(row.begin(), row.end(), inside_of_row.begin(), inside_of_row.end(),
                          std::back_inserter(overlaps));
      classified.push_back({row.size() - inside_of_row.size(), inside_of_row.size()});
    }
  }
};

/// All that one shaft is asked, in both forms.
template <class View>
void expect_one(const CompiledShaft& shaft, const View& view, const Part& right) {
  std::vector<std::uint64_t> kept(bit_words(view.count));
  std::vector<std::uint64_t> inside(kept.size());
  for (const Form form : forms) {
    std::fill(kept.begin(), kept.end(), sentinel);
    cull(in_form(shaft, form), view, kept);
    ASSERT_EQ(kept, right.kept) << "cull";
    std::fill(inside.begin(), inside.end(), sentinel);
    classify(in_form(shaft, form), view, kept, inside);
    ASSERT_EQ(kept, right.kept) << "classify";
    ASSERT_EQ(inside, right.inside) << "classify";
    ASSERT_EQ(count(in_form(shaft, form), view), right.counts[0]) << "count";
    ASSERT_EQ(count_classified(in_form(shaft, form), view), right.classified[0]) << "count_classified";
    ASSERT_EQ(any(in_form(shaft, form), view), right.counts[0] != 0) << "any";
    std::vector<std::uint32_t> indices(right.counts[0]);
    ASSERT_EQ(list(in_form(shaft, form), view, std::span(indices)), right.counts[0]) << "list";
    ASSERT_EQ(indices, right.indices) << "list";
    const std::size_t limit = right.counts[0] / 2 + 1;
    indices.assign(limit, 12345);
    const auto listed = static_cast<std::ptrdiff_t>(std::min<std::size_t>(limit, right.counts[0]));
    ASSERT_EQ(count(in_form(shaft, form), view, {.limit = limit}), listed) << "count, limited";
    ASSERT_EQ(list(in_form(shaft, form), view, std::span(indices), {.limit = limit}), listed) << "list, limited";
    ASSERT_TRUE(std::equal(right.indices.begin(), right.indices.begin() + listed, indices.begin())) << "list, limited";
    std::vector<std::uint32_t> overlap(right.classified[0].overlap);
    indices.resize(right.classified[0].inside);
    ASSERT_EQ(list_classified(in_form(shaft, form), view, overlap, indices), right.classified[0]) << "list_classified";
    ASSERT_EQ(overlap, right.overlaps) << "list_classified";
    ASSERT_EQ(indices, right.insides) << "list_classified";
  }
  std::fill(inside.begin(), inside.end(), sentinel);
  classify(shaft, view, {}, inside);
  ASSERT_EQ(inside, right.inside) << "classify, inside alone";
  std::vector<std::uint32_t> candidates(view.count);
  std::iota(candidates.begin(), candidates.end(), 0U);
  candidates.resize(list(shaft, view, std::span(candidates), {.only = candidates}));
  ASSERT_EQ(candidates, right.indices) << "list of candidates";
}

/// All that many are asked.
template <class View>
void expect_many(std::span<const CompiledShaft> shafts, const View& view, const Part& right) {
  std::vector<std::uint64_t> kept(right.kept.size(), sentinel);
  std::vector<std::uint64_t> inside(right.kept.size(), sentinel);
  cull_many(shafts, view, kept);
  ASSERT_EQ(kept, right.kept) << "cull_many";
  classify_many(shafts, view, kept, inside);
  ASSERT_EQ(kept, right.kept) << "classify_many";
  ASSERT_EQ(inside, right.inside) << "classify_many";
  std::vector<std::uint64_t> counts(shafts.size(), sentinel);
  count_many(shafts, view, counts);
  ASSERT_EQ(counts, right.counts) << "count_many";
  IndexLists lists;
  list_many(shafts, view, lists);
  ASSERT_EQ(lists.offsets, right.offsets) << "list_many";
  ASSERT_EQ(lists.indices, right.indices) << "list_many";
  IndexLists insides;
  list_classified_many(shafts, view, lists, insides);
  ASSERT_EQ(lists.indices, right.overlaps) << "list_classified_many";
  ASSERT_EQ(insides.indices, right.insides) << "list_classified_many";
  for (std::size_t s = 0; s != shafts.size(); ++s) {
    ASSERT_EQ(lists[s].size(), right.classified[s].overlap) << "list_classified_many";
    ASSERT_EQ(insides[s].size(), right.classified[s].inside) << "list_classified_many";
  }
  std::fill(inside.begin(), inside.end(), sentinel);
  classify_many(shafts, view, {}, inside);
  ASSERT_EQ(inside, right.inside) << "classify_many, inside alone";
  std::vector<KeptCounts> classified(shafts.size(), untouched_counts);
  count_classified_many(shafts, view, classified);
  ASSERT_EQ(classified, right.classified) << "count_classified_many";
  std::vector<std::uint64_t> bits(bit_words(shafts.size()), sentinel);
  any_many(shafts, view, bits);
  for (std::size_t s = 0; s != bits.size() * 64; ++s) {
    ASSERT_EQ(bits[s / 64] >> s % 64 & 1U, s < shafts.size() && right.counts[s] != 0 ? 1U : 0U) << "any_many " << s;
  }
  std::vector<std::uint32_t> candidates(view.count);
  std::iota(candidates.begin(), candidates.end(), 0U);
  list_many(shafts, view, lists, {.only = candidates});
  ASSERT_EQ(lists.offsets, right.offsets) << "list_many of candidates";
  ASSERT_EQ(lists.indices, right.indices) << "list_many of candidates";
}

template <class Bound>
void expect_every_size(const std::vector<Bound>& bounds) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const std::vector<CompiledShaft> shafts = mixed_shafts();
  const Expected expected(shafts, bounds);
  const auto memory = columns(bounds);
  for (const std::size_t bound_count : bound_counts()) {
    const GuardedView guarded(memory.view().slice(0, bound_count));
    for (const std::size_t shaft_count : shaft_counts) {
      const Part right(expected, 0, shaft_count, bound_count);
      for (const Isa isa : isas_under_test()) {
        SCOPED_TRACE(std::string(name(isa)) + ", " + std::to_string(shaft_count) + " shafts, " +
                     std::to_string(bound_count) + " bounds");
        const UseIsa use(isa);
        expect_many(std::span(shafts).first(shaft_count), guarded.view(), right);
        if (testing::Test::HasFatalFailure()) return;
      }
    }
    for (const std::size_t s : special_shafts) {
      const Part right(expected, s, 1, bound_count);
      for (const Isa isa : isas_under_test()) {
        SCOPED_TRACE(std::string(name(isa)) + ", shaft " + std::to_string(s) + ", " + std::to_string(bound_count) +
                     " bounds");
        const UseIsa use(isa);
        expect_one(shafts[s], guarded.view(), right);
        if (testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

TEST(Sizes, EveryNumberOfBoxesAndShaftsGivesTheAnswersOfOneAtATime) { expect_every_size(mixed_boxes()); }

TEST(Sizes, EveryNumberOfSpheresAndShaftsGivesTheAnswersOfOneAtATime) { expect_every_size(mixed_spheres()); }

}  // namespace
}  // namespace shaftcull
