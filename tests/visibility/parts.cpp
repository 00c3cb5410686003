// SPDX-License-Identifier: MIT
/// Parts of all pairs: every pair is in one part, with the answer that it has otherwise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "many/workload.hpp"
#include "message_of.hpp"
#include "oracle/sight_agreement.hpp"
#include "sanitizers.hpp"

namespace shaftcull {
namespace {

VisibilityOptions part_of(const SightCase& of, std::uint32_t part, std::uint32_t parts) {
  VisibilityOptions options = of.options;
  options.part = part;
  options.parts = parts;
  return options;
}

void append(Visibility& all, const Visibility& part) {
  all.blocks.insert(all.blocks.end(), part.blocks.begin(), part.blocks.end());
  all.undecided.insert(all.undecided.end(), part.undecided.begin(), part.undecided.end());
  const std::size_t before = all.candidates.size();
  all.candidates.insert(all.candidates.end(), part.candidates.begin(), part.candidates.end());
  if (all.first_candidate.empty()) all.first_candidate.push_back(0);
  for (std::size_t i = 1; i < part.first_candidate.size(); ++i) {
    all.first_candidate.push_back(before + part.first_candidate[i]);
  }
  all.counts += part.counts;
}

/// A pair that is both has either answer.
bool are_alike(Sight p, Sight q) {
  const auto sees_nothing = [](Sight sight) { return sight == Sight::occluded || sight == Sight::facing_away; };
  return p == q || (sees_nothing(p) && sees_nothing(q));
}

void expect_same_answers(const SightCase& of, const Visibility& parts, const Visibility& whole) {
  const SightTable found(of, parts);
  const SightTable right(of, whole);
  ASSERT_EQ(found.fault(), "");
  for (std::size_t i = 0; i != of.a.size(); ++i) {
    for (std::size_t j = 0; j != of.b.size(); ++j) {
      const SightTable::Entry& of_part = found.at(i, j);
      const SightTable::Entry& of_whole = right.at(i, j);
      ASSERT_EQ(of_part.sight.has_value(), of_whole.sight.has_value()) << i << ", " << j;
      if (!of_whole.sight) continue;
      ASSERT_TRUE(are_alike(*of_part.sight, *of_whole.sight)) << i << ", " << j;
      ASSERT_EQ(of_part.candidates, of_whole.candidates) << i << ", " << j;
    }
  }
}

TEST(VisibilityParts, HaveEachPairOnceWithItsAnswer) {
  const std::uint64_t cases = random_cases(60);
  std::uint64_t split = 0;
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    const auto scenery = static_cast<SightScenery>(seed % sight_sceneries);
    const SightCase of(random_sight_scene(scenery, seed, seed % 5 == 0 ? 400 : 100));
    const Visibility whole = of.collect(of.options);
    for (const std::uint32_t parts : {1U, 2U, 3U, 16U}) {
      Visibility all;
      std::uint64_t with_pairs = 0;
      for (std::uint32_t part = 0; part != parts; ++part) {
        const Visibility some = of.collect(part_of(of, part, parts));
        EXPECT_EQ(of.count(part_of(of, part, parts)), some.counts);
        with_pairs += some.counts.total() != 0 ? 1 : 0;
        append(all, some);
      }
      split += with_pairs > 1 ? 1 : 0;
      ASSERT_EQ(all.counts.total(), of.pairs());
      expect_same_answers(of, all, whole);
      if (testing::Test::HasFatalFailure()) FAIL() << "seed " << seed << ", " << parts << " parts";
    }
  }
  EXPECT_GT(split, cases);
}

TEST(VisibilityParts, HaveAboutAsManyPairsEach) {
  std::vector<Box> boxes;
  Random random(5);
  for (int i = 0; i != 3000; ++i) boxes.push_back(random.box(-1, 1, 0, 0.01F));
  const PatchSet one{std::span<const Box>(boxes)};
  const PatchSet other{std::span<const Box>(boxes).first(700)};
  for (const std::uint32_t parts : {2U, 7U, 100U}) {
    for (const bool is_of_one_set : {true, false}) {
      std::vector<std::uint64_t> pairs;
      std::uint64_t reported = 0;
      for (std::uint32_t part = 0; part != parts; ++part) {
        VisibilityOptions options;
        options.part = part;
        options.parts = parts;
        options.progress = [&](const VisibilityProgress& progress) {
          reported = progress.total;
          return true;
        };
        pairs.push_back(
            (is_of_one_set ? count_visibility(one, {}, options) : count_visibility(one, other, {}, options)).total());
        EXPECT_EQ(reported, pairs.back());
      }
      std::uint64_t all = 0;
      for (const std::uint64_t some : pairs) all += some;
      EXPECT_EQ(all, is_of_one_set ? 3000U * 2999 / 2 : 3000U * 700);
      const std::uint64_t share = all / parts;
      const std::uint64_t off = std::max<std::uint64_t>(share / 4, 64 * 64);  // a group of patches is not split
      EXPECT_LE(*std::max_element(pairs.begin(), pairs.end()), share + off + 1);
      EXPECT_GE(*std::min_element(pairs.begin(), pairs.end()) + off, share);
    }
  }
  // More parts than there are pairs: most of them are empty.
  std::uint64_t all = 0;
  for (std::uint32_t part = 0; part != 30; ++part) {
    VisibilityOptions options;
    options.part = part;
    options.parts = 30;
    all += count_visibility(PatchSet{std::span<const Box>(boxes).first(5)}, {}, options).total();
  }
  EXPECT_EQ(all, 10U);
  VisibilityOptions last;
  last.part = UINT32_MAX - 1;
  last.parts = UINT32_MAX;
  EXPECT_LE(count_visibility(one, {}, last).total(), 64U * 64);
  EXPECT_EQ(count_visibility(PatchSet{}, {}, last).total(), 0U);
}

TEST(VisibilityParts, DoNotDependOnThreadsMemoryAndVerdicts) {
  const SightCase of(random_sight_scene(SightScenery::room, 11, has_shadow_memory ? 600 : 1500));
  for (const std::uint32_t part : {0U, 2U, 4U}) {
    VisibilityOptions options = part_of(of, part, 5);
    Visibility one;
    with_threads(1, [&] { one = of.collect(options); });
    options.memory = std::size_t{1} << 20;
    Visibility other;
    with_threads(3, [&] { other = of.collect(options); });
    EXPECT_EQ(one.blocks, other.blocks);
    EXPECT_EQ(one.undecided, other.undecided);
    EXPECT_EQ(one.candidates, other.candidates);
    options.resolve = [](const UndecidedPairs&, std::span<Sight> verdict) {
      std::fill(verdict.begin(), verdict.end(), Sight::clear);
    };
    const SightCounts decided = of.count(options);
    EXPECT_EQ(decided.undecided, 0U);
    EXPECT_EQ(decided.clear, one.counts.clear + one.counts.undecided);
  }
}

TEST(VisibilityParts, WriteTheBitsOfTheirPairs) {
  const SightCase of(random_sight_scene(SightScenery::room, 3, 300));
  const std::size_t words = of.a.size() * bit_words(of.scene.is_of_one_set ? of.a.size() : of.b.size());
  std::vector<std::uint64_t> whole(words);
  std::vector<std::uint64_t> joined(words);
  std::vector<std::uint64_t> some(words, ~std::uint64_t{0});
  of.bits(Sight::clear, whole, of.options);
  for (std::uint32_t part = 0; part != 4; ++part) {
    of.bits(Sight::clear, some, part_of(of, part, 4));
    for (std::size_t i = 0; i != words; ++i) {
      EXPECT_EQ(joined[i] & some[i], 0U);
      joined[i] |= some[i];
    }
  }
  EXPECT_EQ(joined, whole);
}

TEST(VisibilityParts, AreNumberedFrom0) {
  const SightCase of(random_sight_scene(SightScenery::room, 3, 20));
  const auto message = [&](std::uint32_t part, std::uint32_t parts) {
    return message_of([&] { static_cast<void>(of.count(part_of(of, part, parts))); });
  };
  EXPECT_EQ(message(3, 3), "part is 3; of 3 parts, it is 0 to 2");
  EXPECT_EQ(message(2, 1), "part is 2; of 1 part, it is 0");
  EXPECT_EQ(message(0, 0), "parts is 0; it is 1 or more");
}

}  // namespace
}  // namespace shaftcull
