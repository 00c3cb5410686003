// SPDX-License-Identifier: MIT
/// Bits, counts and lists all say what cull() and classify() say, whatever the number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "columns.hpp"
#include "forms.hpp"
#include "many/workload.hpp"
#include "misaligned.hpp"
#include "result_words.hpp"
#include "sanitizers.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/tree.hpp"

namespace shaftcull {
namespace {

/// Counts of bounds on either side of words, of tiles and of blocks of tiles.
constexpr std::size_t few_bound_counts[] = {0, 1, 63, 64, 65, 1023, 1024, 1025, 2047, 2048, 2049, 2560, 2561, 5000};
constexpr std::size_t few_shaft_counts[] = {0, 1, 63, 64, 65, 200};

/// Calls check(shafts, view, expected) for every count of shafts and of bounds, on every number of threads.
template <class Columns, class Check>
void for_all_sizes(const Columns& memory, const Check& check) {
  const std::vector<CompiledShaft> most_shafts = random_shafts(81, 200);
  for (const std::size_t shaft_count : few_shaft_counts) {
    const std::vector<CompiledShaft> shafts(most_shafts.begin(),
                                            most_shafts.begin() + static_cast<std::ptrdiff_t>(shaft_count));
    for (const std::size_t bound_count : few_bound_counts) {
      // Many of both say nothing more than many of each, and take long under a sanitizer.
      if (shaft_count > 65 && bound_count > 65 && bound_count != 2049) continue;
      const auto view = memory.view().slice(0, bound_count);
      const ExpectedRows expected(shafts, view);
      for (const int threads : thread_counts) {
        SCOPED_TRACE(std::to_string(shaft_count) + " shafts, " + std::to_string(bound_count) + " bounds, " +
                     std::to_string(threads) + " threads");
        with_threads(threads, [&] { check(shafts, view, expected); });
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

/// What is expected of every shaft, as lists.
std::vector<ExpectedLists> lists_of(const ExpectedRows& expected, std::size_t shafts) {
  std::vector<ExpectedLists> lists;
  for (std::size_t s = 0; s != shafts; ++s) lists.push_back(expected.lists(s));
  return lists;
}

/// Runs the same check for boxes and for spheres.
template <class Check>
void for_boxes_and_spheres(const Check& check) {
  for_all_sizes(BoxColumns(random_boxes(82, 5000)), check);
  for_all_sizes(SphereColumns(random_spheres(83, 5000)), check);
}

TEST(Outputs, CullManyWritesTheRowsThatCullGives) {
  for_boxes_and_spheres([](const auto& shafts, const auto& view, const ExpectedRows& expected) {
    std::vector<std::uint64_t> rows(expected.kept.size(), sentinel);
    cull_many(shafts, view, rows);
    EXPECT_EQ(rows, expected.kept);
    cull_many(in_form(shafts, Form::planes), view, rows);
    EXPECT_EQ(rows, expected.kept);
  });
}

TEST(Outputs, ClassifyManyWritesTheRowsThatClassifyGives) {
  for_boxes_and_spheres([](const auto& shafts, const auto& view, const ExpectedRows& expected) {
    std::vector<std::uint64_t> kept(expected.kept.size(), sentinel);
    std::vector<std::uint64_t> inside(expected.inside.size(), sentinel);
    classify_many(shafts, view, kept, inside);
    EXPECT_EQ(kept, expected.kept);
    EXPECT_EQ(inside, expected.inside);
  });
}

TEST(Outputs, CountManyCountsTheBitsOfEachRow) {
  for_boxes_and_spheres([](const auto& shafts, const auto& view, const ExpectedRows& expected) {
    std::vector<std::uint64_t> counts(shafts.size(), sentinel);
    count_many(shafts, view, counts);
    const auto right = lists_of(expected, shafts.size());
    for (std::size_t s = 0; s != shafts.size(); ++s) EXPECT_EQ(counts[s], right[s].kept.size()) << "shaft " << s;
  });
}

TEST(Outputs, ClassifyManyOfBoundsInsideAloneWritesTheInsideRowsThatClassifyGives) {
  for_boxes_and_spheres([](const auto& shafts, const auto& view, const ExpectedRows& expected) {
    std::vector<std::uint64_t> inside(expected.inside.size(), sentinel);
    classify_many(shafts, view, {}, inside);
    EXPECT_EQ(inside, expected.inside);
  });
}

TEST(Outputs, CountClassifiedManyCountsTheBitsOfEachRow) {
  for_boxes_and_spheres([](const auto& shafts, const auto& view, const ExpectedRows& expected) {
    std::vector<KeptCounts> counts(shafts.size(), untouched_counts);
    count_classified_many(shafts, view, counts);
    const auto right = lists_of(expected, shafts.size());
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      EXPECT_EQ(counts[s], (KeptCounts{right[s].overlap.size(), right[s].inside.size()})) << "shaft " << s;
    }
  });
}

TEST(Outputs, AnyManySetsABitForEachShaftThatKeepsAny) {
  for_boxes_and_spheres([](const auto& shafts, const auto& view, const ExpectedRows& expected) {
    const auto right = lists_of(expected, shafts.size());
    for (const Form form : forms) {
      std::vector<std::uint64_t> bits(bit_words(shafts.size()), sentinel);
      any_many(in_form(shafts, form), view, bits);
      for (std::size_t s = 0; s != 64 * bits.size(); ++s) {
        const bool keeps = s < shafts.size() && !right[s].kept.empty();
        EXPECT_EQ(bits[s / 64] >> s % 64 & 1U, keeps ? 1U : 0U) << "shaft " << s;
      }
    }
  });
}

TEST(Outputs, CountManyCountsTheBitsOfEachRowUpToTheLimit) {
  for_boxes_and_spheres([](const auto& shafts, const auto& view, const ExpectedRows& expected) {
    const auto right = lists_of(expected, shafts.size());
    for (const std::size_t limit : {0U, 1U, 7U, 100U, 100000U}) {
      std::vector<std::uint64_t> right_counts;
      for (const auto& lists : right) right_counts.push_back(std::min(limit, lists.kept.size()));
      for (const Form form : forms) {
        SCOPED_TRACE("limit " + std::to_string(limit) + ", form " + std::to_string(static_cast<int>(form)));
        std::vector<std::uint64_t> counts(shafts.size(), sentinel);
        count_many(in_form(shafts, form), view, counts, {.limit = limit});
        EXPECT_EQ(counts, right_counts);
      }
    }
  });
}

TEST(Outputs, ListManyListsTheFirstSetBitsOfEachRowUpToTheLimit) {
  IndexLists lists;  // used again and again
  for_boxes_and_spheres([&lists](const auto& shafts, const auto& view, const ExpectedRows& expected) {
    const auto right = lists_of(expected, shafts.size());
    for (const std::size_t limit : {0U, 1U, 7U, 100U, 3000U}) {
      std::vector<std::uint64_t> right_offsets = {0};
      std::vector<std::uint32_t> right_indices;
      for (const ExpectedLists& each : right) {
        const auto listed = std::span(each.kept).first(std::min(limit, each.kept.size()));
        right_indices.insert(right_indices.end(), listed.begin(), listed.end());
        right_offsets.push_back(right_indices.size());
      }
      for (const Form form : forms) {
        SCOPED_TRACE("limit " + std::to_string(limit) + ", form " + std::to_string(static_cast<int>(form)));
        list_many(in_form(shafts, form), view, lists, {.limit = limit});
        EXPECT_EQ(lists.offsets, right_offsets);
        EXPECT_EQ(lists.indices, right_indices);
      }
    }
  });
}

TEST(Outputs, AnyManyFindsWhatOnlyTheLastTaskSees) {
  BoxStream boxes(400000);  // empty ones, which no shaft keeps
  std::vector<CompiledShaft> shafts = random_shafts(89, 70);
  const Box far{{100, 100, 100}, {101, 101, 101}};
  shafts[66] = compile(far, far);
  boxes.update(boxes.size() - 1, std::vector<Box>{far});
  for (const int threads : thread_counts) {
    std::vector<std::uint64_t> bits(2, sentinel);
    with_threads(threads, [&] { any_many(shafts, boxes, bits); });
    EXPECT_EQ(bits, (std::vector<std::uint64_t>{0, 4})) << threads << " threads";
  }
}

TEST(Outputs, ShaftsOfOneCallMayHaveDifferentForms) {
  for (const Contact contact : {Contact::closed, Contact::open}) {
    for_boxes_and_spheres([&](const auto& shafts, const auto& view, const ExpectedRows& /*expected*/) {
      std::vector<CompiledShaft> slab(shafts.begin(), shafts.end());
      set_contact(slab, contact);
      std::vector<CompiledShaft> mixed = slab;
      for (std::size_t s = 0; s < mixed.size(); s += 2) set_form(mixed[s], Form::planes);
      std::vector<std::uint64_t> right(slab.size() * bit_words(view.count));
      std::vector<std::uint64_t> right_inside(right.size());
      classify_many(slab, view, right, right_inside);
      std::vector<std::uint64_t> rows(right.size());
      std::vector<std::uint64_t> inside(right.size());
      classify_many(mixed, view, rows, inside);
      EXPECT_EQ(rows, right);
      EXPECT_EQ(inside, right_inside);
      using Bound = std::remove_cvref_t<decltype(view[0])>;
      const BoundsTree<Bound> tree(view);
      std::fill(rows.begin(), rows.end(), 1);
      classify_many(mixed, tree, rows, inside);
      EXPECT_EQ(rows, right) << "of a tree";
      EXPECT_EQ(inside, right_inside) << "of a tree";
    });
  }
}

TEST(Outputs, FirstContactManyFindsTheFirstOfManyTasks) {
  std::vector<Box>
      boxes;  // each is reached before the one in front of it: what tasks find is handed over again and again
  constexpr std::size_t count = 400000;
  for (std::size_t i = 0; i != count; ++i) {
    const auto x = static_cast<float>(2 * count - i);
    boxes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
  }
  const BoxStream stream{std::span<const Box>(boxes)};
  const std::vector<CompiledShaft> shafts(8, compile({{0, 0, 0}, {1, 1, 1}}, {{0x1p20F, 0, 0}, {0x1p20F + 1, 1, 1}}));
  for (const int threads : thread_counts) {
    std::vector<FirstContact> contacts(shafts.size());
    with_threads(threads, [&] { first_contact_many(shafts, stream, contacts); });
    for (const FirstContact& contact : contacts) EXPECT_EQ(contact.index, count - 1) << threads << " threads";
  }
}

TEST(Outputs, FirstContactManyFindsTheFirstWhereTwoTasksHandOverAtOnce) {
  // Two tasks, each of which finds one box for each of the shafts: they hand over one shaft after the other, side by
  // side.
  std::vector<Box> boxes(16384, Box{{0, 9, 0}, {1, 10, 1}});
  boxes[5] = {{50, 0, 0}, {51, 1, 1}};
  boxes[10000] = {{40, 0, 0}, {41, 1, 1}};
  const std::vector<CompiledShaft> shafts(64, compile({{0, 0, 0}, {1, 1, 1}}, {{99, 0, 0}, {100, 1, 1}}));
  for (const std::uint32_t first : {10000U, 5U}) {
    boxes[first] = {{30, 0, 0}, {31, 1, 1}};
    const BoxStream stream{std::span<const Box>(boxes)};
    for (int call = 0; call != (has_shadow_memory ? 25 : 150); ++call) {
      std::vector<FirstContact> contacts(shafts.size());
      with_threads(2, [&] { first_contact_many(shafts, stream, contacts); });
      for (const FirstContact& contact : contacts) ASSERT_EQ(contact.index, first) << "call " << call;
    }
    boxes[first] = {{60, 0, 0}, {61, 1, 1}};
  }
}

TEST(Outputs, ListClassifiedManyListsTheSetBitsOfEachRowAscending) {
  IndexLists overlap;
  IndexLists inside;
  for_boxes_and_spheres([&](const auto& shafts, const auto& view, const ExpectedRows& expected) {
    list_classified_many(shafts, view, overlap, inside);
    ASSERT_EQ(overlap.size(), shafts.size());
    ASSERT_EQ(inside.size(), shafts.size());
    const auto right = lists_of(expected, shafts.size());
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      EXPECT_TRUE(std::ranges::equal(overlap[s], right[s].overlap)) << "shaft " << s;
      EXPECT_TRUE(std::ranges::equal(inside[s], right[s].inside)) << "shaft " << s;
    }
  });
}

TEST(Outputs, ListManyListsTheSetBitsOfEachRowAscending) {
  IndexLists lists;  // used again and again, so that what it held before must not matter
  for_boxes_and_spheres([&lists](const auto& shafts, const auto& view, const ExpectedRows& expected) {
    list_many(shafts, view, lists);
    ASSERT_EQ(lists.size(), shafts.size());
    ASSERT_EQ(lists.offsets.front(), 0U);
    ASSERT_EQ(lists.offsets.back(), lists.indices.size());
    const auto right = lists_of(expected, shafts.size());
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      EXPECT_TRUE(std::ranges::equal(lists[s], right[s].kept)) << "shaft " << s;
    }
  });
}

TEST(Outputs, ListManyListsEverythingIfAllIsKept) {
  const std::vector<CompiledShaft> shafts(3, compile({{-9, -9, -9}, {0, 0, 0}}, {{0, 0, 0}, {9, 9, 9}}));
  const BoxColumns memory(std::vector<Box>(5000, Box{{-1, -1, -1}, {1, 1, 1}}));
  IndexLists lists;
  list_many(shafts, memory.view(), lists);
  ASSERT_EQ(lists.indices.size(), 15000U);
  for (std::uint32_t i = 0; i != 15000; ++i) ASSERT_EQ(lists.indices[i], i % 5000);
}

/// A whole tile, which many shafts test in ways of their own, and one that is not whole.
template <class Columns>
void expect_every_misalignment(const Columns& memory) {
  const std::vector<CompiledShaft> shafts = random_shafts(86, 8);  // enough for a grid
  const ExpectedRows expected(shafts, memory.view());
  for (std::size_t offset = 0; offset != 16; ++offset) {
    SCOPED_TRACE(std::to_string(offset) + " floats off, and one more with each stream");
    const Misaligned moved(memory.view(), offset, 1);
    std::vector<std::uint64_t> kept(expected.kept.size(), sentinel);
    std::vector<std::uint64_t> inside(expected.inside.size(), sentinel);
    classify_many(shafts, moved.view(), kept, inside);
    EXPECT_EQ(kept, expected.kept);
    EXPECT_EQ(inside, expected.inside);
  }
}

TEST(Outputs, EveryMisalignmentOfTilesGivesTheSameAnswers) {
  expect_every_misalignment(BoxColumns(random_boxes(87, 2048 + 100)));
  expect_every_misalignment(SphereColumns(random_spheres(88, 2048 + 100)));
}

TEST(Outputs, TheLargestTileOnAGridMayKeepAQuarterOfItsBounds) {
  // As many as later stages collect, and one more, which they do not.
  const std::vector<CompiledShaft> shafts(8, random_shafts(89, 1).front());
  const Vec3 met = shafts.front().a().lo;
  for (const std::size_t kept_count : {640U, 641U}) {
    SCOPED_TRACE(kept_count);
    std::vector<Box> boxes;
    std::vector<Sphere> spheres;
    for (std::size_t i = 0; i != 2560; ++i) {
      const bool keeps = i % 4 == 0 || (i == 1 && kept_count == 641);
      const Vec3 centre = keeps ? met : Vec3{1000, 1000, 1000};
      boxes.push_back({centre, centre});
      spheres.push_back({centre, 0.0F});
    }
    const auto expect_agreement = [&](const auto& memory) {
      const ExpectedRows expected(shafts, memory.view());
      std::uint64_t bits = 0;
      for (const std::uint64_t word : expected.kept) bits += static_cast<std::uint64_t>(std::popcount(word));
      ASSERT_EQ(bits, shafts.size() * kept_count);
      std::vector<std::uint64_t> kept(expected.kept.size(), sentinel);
      std::vector<std::uint64_t> all_inside(expected.inside.size(), sentinel);
      classify_many(shafts, memory.view(), kept, all_inside);
      EXPECT_EQ(kept, expected.kept);
      EXPECT_EQ(all_inside, expected.inside);
    };
    expect_agreement(BoxColumns(boxes));
    expect_agreement(SphereColumns(spheres));
  }
}

TEST(Outputs, ManyTasksAgreeWithCull) {
  // Enough tiles that every kind of cut has many tasks; with and without a second group of shafts.
  const BoxColumns memory(random_boxes(84, 100001));
  for (const std::size_t shaft_count : {20U, 66U}) {
    const std::vector<CompiledShaft> shafts = random_shafts(85, shaft_count);
    const ExpectedRows expected(shafts, memory.view());
    for (const int threads : thread_counts) {
      with_threads(threads, [&] {
        std::vector<std::uint64_t> rows(expected.kept.size(), sentinel);
        cull_many(shafts, memory.view(), rows);
        EXPECT_EQ(rows, expected.kept);
        std::vector<std::uint64_t> inside(expected.inside.size(), sentinel);
        std::fill(rows.begin(), rows.end(), sentinel);
        classify_many(shafts, memory.view(), rows, inside);
        EXPECT_EQ(rows, expected.kept);
        EXPECT_EQ(inside, expected.inside);
        std::vector<std::uint64_t> counts(shafts.size());
        count_many(shafts, memory.view(), counts);
        IndexLists lists;
        list_many(shafts, memory.view(), lists);
        const std::size_t words = bit_words(memory.view().count);
        for (std::size_t s = 0; s != shafts.size(); ++s) {
          EXPECT_EQ(lists[s].size(), counts[s]);
          std::vector<std::uint64_t> row(words);
          for (const std::uint32_t i : lists[s]) row[i / 64] |= std::uint64_t{1} << i % 64;
          EXPECT_TRUE(std::equal(row.begin(), row.end(), rows.begin() + static_cast<std::ptrdiff_t>(s * words)));
          EXPECT_TRUE(std::is_sorted(lists[s].begin(), lists[s].end()));
        }
      });
    }
  }
}

}  // namespace
}  // namespace shaftcull
