// SPDX-License-Identifier: MIT
/// Boxes that block shafts, with every option that the calls take, in views, streams and trees: their answers follow
/// from those for one box at a time, by plain loops.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "instruction_sets.hpp"
#include "options/listed.hpp"
#include "options/query_case.hpp"
#include "options/scenes.hpp"
#include "options/truth.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {
namespace {

/// Between small boxes on both sides of the solids. Forms and contacts are of all sorts, and some have added planes:
/// blocking does not depend on these.
std::vector<CompiledShaft> shafts_across(Random& random, std::size_t count) {
  std::vector<CompiledShaft> shafts;
  while (shafts.size() != count) {
    Box a = random.box(-4, 4, 0, 0.4F);
    Box b = random.box(-4, 4, 0, 0.4F);
    for (float* const x : {&a.lo[0], &a.hi[0]}) *x -= 10;
    for (float* const x : {&b.lo[0], &b.hi[0]}) *x += 10;
    const Plane plane{{1, 0, 0}, -20};
    shafts.push_back(compile(a, b, std::span(&plane, random.one_in(6) ? 1 : 0)));
    if (random.one_in(3)) set_contact(shafts.back(), Contact::open);
    if (random.one_in(4)) set_form(shafts.back(), Form::planes);
  }
  return shafts;
}

/// Walls and blocks between the two sides, of which some hide one from the other, and boxes that hide nothing.
std::vector<Box> solids_of(Random& random, std::size_t count) {
  std::vector<Box> solids;
  while (solids.size() != count) {
    if (random.one_in(2)) {
      solids.push_back(bound_of<Box>(random));
      continue;
    }
    const Vec3 centre = random.vec3(-3, 3);
    Box solid{centre, centre};
    for (std::size_t k = 0; k != 3; ++k) {
      const float half = k == 0 ? random.integer(0, 1) * 0.2F : random.uniform(0.5F, 5.0F);
      solid.lo[k] -= half;
      solid.hi[k] += half;
    }
    solids.push_back(solid);
  }
  return solids;
}

void expect_one(Random& random, const CompiledShaft& shaft, const Bounds& solids, const Query& query,
                const Indices& right) {
  const Query all = unlimited(query);
  EXPECT_EQ(occluded(shaft, solids, all), !right.empty());
  EXPECT_EQ(find_occluder(shaft, solids, all),
            right.empty() ? std::nullopt : std::optional<std::uint32_t>(right.front()));
  const Indices first = limited(right, query);
  for (const std::size_t room : rooms_for(random, first.size())) {
    expect_listed(first, room, [&](std::span<std::uint32_t> blocking) {
      EXPECT_EQ(list_occluders(shaft, solids, blocking, query), first.size());
    });
  }
  expect_listed(right, a_room_for(random, right.size()), [&](std::span<std::uint32_t> blocking) {
    EXPECT_EQ(list_occluders(shaft, solids, blocking, all), right.size());
  });
}

void expect_many(std::span<const CompiledShaft> shafts, const Bounds& solids, const Query& query,
                 const std::vector<Indices>& right) {
  std::vector<std::uint64_t> bits(bit_words(shafts.size()));
  std::vector<Indices> first;
  for (std::size_t s = 0; s != shafts.size(); ++s) {
    bits[s / 64] |= std::uint64_t{!right[s].empty()} << s % 64;
    first.push_back(limited(right[s], query));
  }
  std::vector<std::uint64_t> are_occluded(bits.size(), sentinel);
  occluded_many(shafts, solids, are_occluded, unlimited(query));
  EXPECT_EQ(are_occluded, bits) << "occluded_many";
  IndexLists lists{{0, 2}, {11, 12}};
  list_occluders_many(shafts, solids, lists, unlimited(query));
  expect_lists(lists, right, "list_occluders_many");
  list_occluders_many(shafts, solids, lists, query);
  expect_lists(lists, first, "list_occluders_many with the limit");
}

class OcclusionOptions : public testing::Test {
 protected:
  void expect_all(std::uint64_t seed, std::size_t bounds, std::size_t shaft_count, std::size_t cases) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::to_string(bounds) + " boxes, " +
                 std::to_string(shaft_count) + " shafts");
    Random random(seed);
    const bool has_layers = random.one_in(2);
    const Scene<Box> scene(random, solids_of(random, bounds), has_layers);
    const std::vector<CompiledShaft> shafts = shafts_across(random, shaft_count);
    const Truth truth = [&] {
      const UseIsa scalar(Isa::scalar);
      return Truth(shafts.size(), bounds, [&](std::size_t s, std::uint32_t i) {
        return occluded(shafts[s], scene.bounds()[i]) ? Answer::overlap : Answer::outside;
      });
    }();
    const unsigned allowed = Options::all & ~Options::only & ~(has_layers ? 0U : Options::layer_mask);
    for (std::size_t i = 0; i != random_cases(cases); ++i) {
      const QueryCase options(random, truth, allowed);
      SCOPED_TRACE(options.text());
      for (const Holder& holder : scene.holders()) {
        SCOPED_TRACE(holder.name);
        std::vector<Indices> right;
        for (std::size_t s = 0; s != shafts.size(); ++s) {
          right.push_back(options.lists(truth, scene.layers(), s, holder.order).kept);
          found_ += right.back().size();
        }
        expect_many(shafts, holder.bounds, options.of_all(), right);
        for (int again = 0; again != 3; ++again) {
          const std::size_t s = random.below(static_cast<unsigned>(shafts.size()));
          SCOPED_TRACE("shaft " + std::to_string(s) + " alone");
          expect_one(random, shafts[s], holder.bounds, options.of_one(s), right[s]);
        }
        if (HasFailure()) return;
      }
    }
  }

  std::size_t found_ = 0;
};

TEST_F(OcclusionOptions, LeaveTheSameOccludersInViewsStreamsAndTrees) {
  std::uint64_t seed = 7000;
  for (const std::size_t bounds : {0U, 1U, 63U, 64U, 65U}) {
    for (const std::size_t shafts : {1U, 2U, 7U, 63U, 64U, 65U, 130U}) {
      expect_all(seed++, bounds, shafts, 10);
      if (HasFailure()) return;
    }
  }
  for (const std::size_t bounds : {511U, 512U, 513U, 2047U, 2048U, 2049U}) {
    for (const std::size_t shafts : {1U, 7U}) {
      expect_all(seed++, bounds, shafts, 8);
      if (HasFailure()) return;
    }
  }
  expect_all(seed++, 2049, 65, 2);
  expect_all(seed++, 16383, 2, 4);
  expect_all(seed++, 16385, 7, 2);
  expect_all(seed++, 40000, 2, 3);
  EXPECT_GT(found_, 1000U);
}

TEST_F(OcclusionOptions, OfNoShaftsGiveNothing) {
  const BoxStream solids(std::vector<Box>(3, Box{{0, 0, 0}, {1, 1, 1}}));
  occluded_many({}, solids, {}, {.exclude = {1}});
  IndexLists lists{{0, 1}, {5}};
  list_occluders_many({}, solids, lists, {.exclude = {1}, .limit = 3});
  EXPECT_EQ(lists.offsets, std::vector<std::uint64_t>{0});
  EXPECT_TRUE(lists.indices.empty());
}

}  // namespace
}  // namespace shaftcull
