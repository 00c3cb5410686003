// SPDX-License-Identifier: MIT
/// Open contact: what only touches a shaft is outside. Every answer equals the one of exact arithmetic, in every form
/// and on every instruction set; and every verb, of views and of trees, gives the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "columns.hpp"
#include "cull/agreement.hpp"
#include "instruction_sets.hpp"
#include "oracle/cases/families.hpp"
#include "oracle/open_contact.hpp"
#include "oracle/quick_hull.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"
#include "shaftcull/shaftcull.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

ShaftInput opened(ShaftInput input) {
  input.contact = Contact::open;
  return input;
}

/// The box, or the box without its extent on one axis or two, at the one face or the other.
Box flattened(Random& random, Box box) {
  for (unsigned axes = random.below(3); axes != 0; --axes) {
    const std::size_t k = random.below(3);
    (random.one_in(2) ? box.lo[k] : box.hi[k]) = random.one_in(2) ? box.lo[k] : box.hi[k];
    if (box.lo[k] != box.hi[k]) box.hi[k] = box.lo[k];
  }
  return box;
}

template <class MakeShaft>
void check(std::uint64_t seed, std::size_t shafts, std::size_t count, const Family& family, const MakeShaft& shaft_of) {
  SCOPED_TRACE(std::string(family.name) + ", seed " + std::to_string(seed));
  Random random(seed);
  for (unsigned i = 0; i != random_cases(shafts) && !testing::Test::HasFailure(); ++i) {
    const ShaftInput input = opened(shaft_of(random, i));
    std::vector<Box> boxes;
    std::vector<Sphere> spheres;
    const oracle::QuickHull hull(input);
    for (std::size_t k = 0; k != count; ++k) {
      boxes.push_back(family.box(random, input));
      if (random.one_in(3)) boxes.back() = flattened(random, boxes.back());
      if (k % 2 == 0) spheres.push_back(family.sphere(random, input, hull));
    }
    expect_exact(input, boxes);
    expect_exact(input, spheres);
  }
}

TEST(OpenContact, EveryFamilyOfShaftsAndBoundsIsAnsweredExactly) {
  std::uint64_t seed = 100;
  for (const Family& family : families) check(++seed, 12, 24, family, family.shaft);
}

TEST(OpenContact, EveryColouringOfTheFacesAnswersExactly) {
  constexpr std::uint64_t seed = 10;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (unsigned colouring = random.below(3); colouring < colourings && !HasFailure(); colouring += 3) {
    const ShaftInput input = opened(coloured_shaft(colouring));
    std::vector<Box> boxes;
    std::vector<Sphere> spheres;
    for (int i = 0; i != 16; ++i) {
      boxes.push_back(lattice_box(random, 5));
      spheres.push_back({{random.integer(-1, 5), random.integer(-1, 5), random.integer(-1, 5)}, random.integer(0, 2)});
    }
    expect_exact(input, boxes);
    expect_exact(input, spheres);
  }
}

/// Nearly all of them touch. Whole numbers, then tenths, of which none is a float.
TEST(OpenContact, BoundsOnALatticeWithHalfOfTheExtentsFlatAreAnsweredExactly) {
  constexpr std::uint64_t seed = 11;
  SCOPED_TRACE("seed " + std::to_string(seed));
  for (const float step : {1.0F, 0.1F, 0x1p-140F, 0x1.9p120F}) {
    Random random(seed);
    const auto scaled = [&](Box box) {
      for (std::size_t k = 0; k != 3; ++k) {
        box.lo[k] *= step;
        box.hi[k] *= step;
      }
      return box;
    };
    for (std::size_t i = 0; i != random_cases(100) && !HasFailure(); ++i) {
      ShaftInput input = lattice_shaft(random);
      input = opened({scaled(input.a), scaled(input.b), {}});
      std::vector<Box> boxes;
      std::vector<Sphere> spheres;
      for (int k = 0; k != 64; ++k) {
        boxes.push_back(scaled(lattice_box(random, 4)));
        if (k % 2 == 0) spheres.push_back({boxes.back().hi, step * random.integer(0, 2)});
        if (random.one_in(16)) boxes.back().lo[random.below(3)] = -infinity;
        if (random.one_in(16)) boxes.back().hi[random.below(3)] = infinity;
      }
      expect_exact(input, boxes);
      expect_exact(input, spheres);
    }
  }
}

TEST(OpenContact, BoundsThatTouchAddedPlanesOnALatticeAreAnsweredExactly) {
  constexpr std::uint64_t seed = 12;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (std::size_t i = 0; i != random_cases(100) && !HasFailure(); ++i) {
    const ShaftInput input = opened(with_planes(random, lattice_shaft(random), true));
    std::vector<Box> boxes;
    std::vector<Sphere> spheres;
    for (int k = 0; k != 32; ++k) {
      boxes.push_back(lattice_box(random, 4));
      spheres.push_back({boxes.back().lo, random.integer(0, 2)});
    }
    expect_exact(input, boxes);
    expect_exact(input, spheres);
  }
}

/// A shaft that does not leave a line or a plane, and boxes that do not either.
TEST(OpenContact, ShaftsThatAreFlatAnswerExactly) {
  constexpr std::uint64_t seed = 13;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (std::size_t i = 0; i != random_cases(100) && !HasFailure(); ++i) {
    const bool whole = random.one_in(2);
    ShaftInput input = opened(whole ? lattice_shaft(random) : random_shaft(random));
    const unsigned axes = 1 + random.below(7);
    for (std::size_t k = 0; k != 3; ++k) {
      if ((axes >> k & 1U) != 0) input.a.hi[k] = input.b.lo[k] = input.b.hi[k] = input.a.lo[k];
    }
    std::vector<Box> boxes;
    for (int j = 0; j != 48; ++j) {
      boxes.push_back(whole ? lattice_box(random, 4) : touching_box(random, input));
      for (std::size_t k = 0; k != 3; ++k) {
        if ((axes >> k & 1U) == 0 || random.one_in(3)) continue;
        boxes.back().lo[k] = input.a.lo[k];
        if (random.one_in(2)) boxes.back().hi[k] = input.a.lo[k];
        boxes.back().hi[k] = std::max(boxes.back().lo[k], boxes.back().hi[k]);
      }
    }
    expect_exact(input, boxes);
  }
}

/// What it is for: two patches, what they lie on, and what is between them.
class OpenContactRoom : public testing::Test {
 protected:
  const Box floor_{{-10, -10, -1}, {10, 10, 0}};
  const Box ceiling_{{-10, -10, 8}, {10, 10, 9}};
  const Box wall_{{4, -10, 0}, {5, 10, 8}};
  const Box on_floor_{{0, 0, 0}, {1, 1, 0}};
  const Box on_ceiling_{{0, 0, 8}, {1, 1, 8}};
  const Box on_wall_{{4, 0, 2}, {4, 1, 3}};
};

TEST_F(OpenContactRoom, KeepsNoWallThatAPatchLiesOn) {
  on_each_instruction_set([&] {
    for (const auto& [a, b] : {std::pair(on_floor_, on_ceiling_), std::pair(on_floor_, on_wall_)}) {
      const CompiledShaft closed = compile(a, b);
      const CompiledShaft open = compile(a, b, Contact::open);
      EXPECT_TRUE(keeps(closed, floor_));
      for (const Box& box : {floor_, ceiling_, wall_}) EXPECT_FALSE(keeps(open, box));
    }
  });
}

TEST_F(OpenContactRoom, KeepsWhatIsBetweenThePatches) {
  on_each_instruction_set([&] {
    const CompiledShaft open = compile(on_floor_, on_ceiling_, Contact::open);
    EXPECT_TRUE(keeps(open, Box{{0.4F, 0.4F, 2}, {0.6F, 0.6F, 3}})) << "a box";
    EXPECT_TRUE(keeps(open, Box{{-1, -1, 4}, {2, 2, 4}})) << "a sheet of glass";
    EXPECT_TRUE(keeps(open, Box{{0.5F, 0.5F, 4}, {0.5F, 0.5F, 4}})) << "a point";
    EXPECT_TRUE(keeps(open, Sphere{{1.5F, 0.5F, 4}, 0.75F})) << "a sphere";
    EXPECT_FALSE(keeps(open, Sphere{{1.5F, 0.5F, 4}, 0.5F})) << "a sphere that touches";
    EXPECT_FALSE(keeps(open, Box{{0, -1, 1}, {0, 2, 4}})) << "a sheet in the shaft's side";
    EXPECT_FALSE(keeps(open, Box{{0, 0.5F, 4}, {0, 0.5F, 4}})) << "a point of it";
    EXPECT_FALSE(keeps(open, Box{{1, 0, 0}, {3, 1, 8}})) << "a box beside it";
    EXPECT_FALSE(keeps(open, on_floor_)) << "the patch itself";
  });
}

TEST_F(OpenContactRoom, InAPlaneKeepsWhatReachesIntoTheShaft) {
  on_each_instruction_set([&] {
    const Box strip{{0, 0, 0}, {1, 1, 0}};
    const Box other{{5, 0, 0}, {6, 1, 0}};
    const CompiledShaft open = compile(strip, other, Contact::open);
    EXPECT_TRUE(keeps(open, Box{{2, 0, 0}, {3, 1, 0}})) << "a rectangle in the plane";
    EXPECT_TRUE(keeps(open, Box{{2, 0, -1}, {3, 1, 1}})) << "a box across the plane";
    EXPECT_FALSE(keeps(open, Box{{2, 0, 0}, {3, 1, 1}})) << "a box on the plane";
    EXPECT_FALSE(keeps(open, Box{{2, 1, 0}, {3, 2, 0}})) << "a rectangle beside the shaft";
  });
}

/// A flat bound in the shaft's surface is in the shaft, and outside.
TEST(OpenContact, WhatIsInsideIsKept) {
  on_each_instruction_set([] {
    constexpr std::uint64_t seed = 14;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::size_t in_surface = 0;
    for (std::size_t i = 0; i != random_cases(200); ++i) {
      const ShaftInput input = opened(lattice_shaft(random, 2));
      std::vector<Box> boxes;
      for (int k = 0; k != 200; ++k) boxes.push_back(lattice_box(random, 3));
      const auto memory = columns(boxes);
      std::vector<std::uint64_t> kept(bit_words(boxes.size()));
      std::vector<std::uint64_t> inside(kept.size());
      std::vector<std::uint64_t> alone(kept.size());
      const CompiledShaft shaft = compile(input.a, input.b, Contact::open);
      classify(shaft, memory.view(), kept, inside);
      classify(shaft, memory.view(), {}, alone);
      EXPECT_EQ(alone, inside) << source_text(input);
      std::vector<std::uint64_t> row(kept.size());
      classify_many({&shaft, 1}, memory.view(), {}, row);
      EXPECT_EQ(row, inside) << source_text(input);
      classify(compile(input.a, input.b), memory.view(), {}, alone);
      for (std::size_t w = 0; w != kept.size(); ++w) {
        EXPECT_EQ(inside[w], alone[w] & kept[w]) << source_text(input);
        in_surface += alone[w] != inside[w] ? 1 : 0;
      }
    }
    EXPECT_GT(in_surface, 0U);
  });
}

/// Closed again after it was open, a shaft answers as one that never was.
TEST(OpenContact, CanBeTakenBack) {
  on_each_instruction_set([] {
    Random random(15);
    for (std::size_t i = 0; i != 100; ++i) {
      const ShaftInput input = lattice_shaft(random);
      std::vector<Box> boxes;
      for (int k = 0; k != 100; ++k) boxes.push_back(lattice_box(random, 4));
      const auto memory = columns(boxes);
      const auto bits = [&](const CompiledShaft& shaft) {
        std::vector<std::uint64_t> kept(bit_words(boxes.size()));
        cull(shaft, memory.view(), kept);
        return kept;
      };
      CompiledShaft shaft = compile(input.a, input.b, Contact::open);
      set_contact(shaft, Contact::closed);
      EXPECT_EQ(bits(shaft), bits(compile(input.a, input.b))) << source_text(input);
      set_contact(shaft, Contact::open);
      EXPECT_EQ(bits(shaft), bits(compile(input.a, input.b, Contact::open))) << source_text(input);
    }
  });
}

/// Bounds on a lattice, some shafts, nearly all of which touch many of them, and what the oracle keeps.
struct Lattice {
  std::vector<Box> boxes;
  std::vector<Sphere> spheres;
  std::vector<CompiledShaft> shafts;
  std::vector<std::vector<std::uint32_t>> kept_boxes;  // of each shaft, ascending
  std::vector<std::vector<std::uint32_t>> kept_spheres;

  Lattice() {
    Random random(16);
    for (int i = 0; i != 1500; ++i) {
      boxes.push_back(lattice_box(random, 12));
      spheres.push_back({boxes.back().lo, random.integer(0, 1)});
    }
    for (int i = 0; i != 12; ++i) {
      const ShaftInput input = i % 4 == 0 ? ShaftInput{{{0, 0, 2}, {3, 4, 2}}, {{2, 2, 2}, {9, 9, 2}}}  // in a plane
                                          : lattice_shaft(random, 12);
      shafts.push_back(compile(input.a, input.b, Contact::open));
      const oracle::OpenHull hull(input);
      const auto kept = [&](const auto& bounds) {
        std::vector<std::uint32_t> indices;
        for (std::uint32_t k = 0; k != bounds.size(); ++k) {
          if (hull.answer(bounds[k]) != Answer::outside) indices.push_back(k);
        }
        return indices;
      };
      kept_boxes.push_back(kept(boxes));
      kept_spheres.push_back(kept(spheres));
    }
  }
};

class OpenContactVerbs : public testing::Test {
 protected:
  static const Lattice& lattice() {
    static const Lattice lattice;
    return lattice;
  }
  const std::vector<Box>& boxes_ = lattice().boxes;
  const std::vector<Sphere>& spheres_ = lattice().spheres;
  const std::vector<CompiledShaft>& shafts_ = lattice().shafts;
  const std::vector<std::vector<std::uint32_t>>& kept_boxes_ = lattice().kept_boxes;
  const std::vector<std::vector<std::uint32_t>>& kept_spheres_ = lattice().kept_spheres;

  void expect_all(const Bounds& bounds, const std::vector<std::vector<std::uint32_t>>& kept) {
    std::vector<std::uint32_t> list_of_one;
    std::vector<std::uint32_t> candidates;
    for (std::uint32_t i = 0; i < boxes_.size(); i += 3) candidates.push_back(i);
    std::vector<std::uint64_t> any_bits(bit_words(shafts_.size()));
    any_many(shafts_, bounds, any_bits);
    std::vector<std::uint64_t> counts(shafts_.size());
    count_many(shafts_, bounds, counts);
    IndexLists lists;
    list_many(shafts_, bounds, lists);
    IndexLists of_candidates;
    list_many(shafts_, bounds, of_candidates, {.only = candidates});
    for (std::size_t s = 0; s != shafts_.size(); ++s) {
      SCOPED_TRACE("shaft " + std::to_string(s));
      const std::vector<std::uint32_t>& right = kept[s];
      const auto sorted = [](std::vector<std::uint32_t> indices) {
        std::sort(indices.begin(), indices.end());
        return indices;
      };
      const auto vector = [](const auto& span) { return std::vector<std::uint32_t>(span.begin(), span.end()); };
      EXPECT_EQ(count(shafts_[s], bounds), right.size());
      EXPECT_EQ(counts[s], right.size());
      EXPECT_EQ(any(shafts_[s], bounds), !right.empty());
      EXPECT_EQ((any_bits[s / 64] >> s % 64 & 1U) != 0, !right.empty());
      EXPECT_EQ(count(shafts_[s], bounds, {.limit = 5}), std::min<std::size_t>(5, right.size()));
      EXPECT_EQ(list(shafts_[s], bounds, list_of_one), right.size());
      EXPECT_EQ(sorted(list_of_one), right);
      EXPECT_EQ(sorted(vector(lists[s])), right);
      std::vector<std::uint32_t> some;
      std::set_intersection(right.begin(), right.end(), candidates.begin(), candidates.end(), std::back_inserter(some));
      EXPECT_EQ(list(shafts_[s], bounds, list_of_one, {.only = candidates}), some.size());
      EXPECT_EQ(list_of_one, some);
      EXPECT_EQ(vector(of_candidates[s]), some);
    }
  }

  /// Times are those of closed contact, and first is the first of those that are kept.
  template <class View>
  void expect_first_of_kept(const View& bounds, const std::vector<std::vector<std::uint32_t>>& kept) {
    const BoundsTree<std::remove_cvref_t<decltype(bounds[0])>> tree(bounds);
    std::vector<FirstContact> of_tree(shafts_.size());
    first_contact_many(shafts_, tree, of_tree);
    std::vector<std::uint32_t> all(bounds.count);
    for (std::uint32_t i = 0; i != all.size(); ++i) all[i] = i;
    std::vector<float> times(all.size());
    std::vector<float> closed_times(all.size());
    for (std::size_t s = 0; s != shafts_.size(); ++s) {
      entry_times(shafts_[s], bounds, std::span<const std::uint32_t>(all), times);
      CompiledShaft closed = shafts_[s];
      set_contact(closed, Contact::closed);
      entry_times(closed, bounds, std::span<const std::uint32_t>(all), closed_times);
      float least = infinity;
      for (std::uint32_t i = 0; i != all.size(); ++i) {
        const bool is_kept = std::binary_search(kept[s].begin(), kept[s].end(), i);
        EXPECT_EQ(times[i], is_kept ? closed_times[i] : infinity);
        least = std::min(least, times[i]);
      }
      EXPECT_EQ(first_contact(shafts_[s], bounds).time, least);
      const FirstContact first = first_contact(shafts_[s], tree);
      EXPECT_EQ(first.time, least);
      EXPECT_EQ(of_tree[s], first);
      if (first) {
        EXPECT_EQ(times[first.index], least);
      }
    }
  }
};

TEST_F(OpenContactVerbs, OfViewsAndTreesKeepWhatReachesIntoTheShaft) {
  on_each_instruction_set([&] {
    const BoxStream boxes(boxes_);
    const SphereStream spheres(spheres_);
    expect_all(boxes.view(), kept_boxes_);
    expect_all(spheres.view(), kept_spheres_);
    expect_all(BoxTree(boxes.view()), kept_boxes_);
    expect_all(SphereTree(spheres.view()), kept_spheres_);
  });
}

TEST_F(OpenContactVerbs, FirstContactIsThatOfWhatIsKept) {
  on_each_instruction_set([&] {
    expect_first_of_kept(BoxStream(boxes_).view(), kept_boxes_);
    expect_first_of_kept(SphereStream(spheres_).view(), kept_spheres_);
  });
}

/// A flat box in a face of its node, whose interior a flat shaft does not meet.
TEST(OpenContact, NodesOfATreeAreTestedClosed) {
  on_each_instruction_set([] {
    std::vector<Box> boxes(64, Box{{0, 0, 1}, {1, 1, 2}});
    boxes[5] = {{0.25F, 0.25F, 0}, {0.75F, 0.75F, 0}};
    for (int i = 0; i != 64; ++i) boxes.push_back({{9, 9, 9}, {10, 10, 10}});
    const BoxTree tree{std::span<const Box>(boxes)};
    const CompiledShaft shaft = compile(Box{{-1, 0, 0}, {-1, 1, 0}}, Box{{2, 0, 0}, {2, 1, 0}}, Contact::open);
    std::vector<std::uint32_t> kept(boxes.size());
    kept.resize(list(shaft, tree, std::span(kept)));
    EXPECT_EQ(kept, std::vector<std::uint32_t>{5});
  });
}

/// A node that is in the shaft, and leaves of it in the shaft's surface.
TEST(OpenContact, FlatLeavesInTheSurfaceOfTheShaftAreOutside) {
  on_each_instruction_set([] {
    std::vector<Box> boxes(200, Box{{1, 1, 1}, {2, 2, 2}});
    for (std::size_t i = 0; i < boxes.size(); i += 3) boxes[i].lo[0] = boxes[i].hi[0] = 0;
    const BoxTree tree{std::span<const Box>(boxes)};
    const CompiledShaft shaft = compile(Box{{0, 0, 0}, {3, 3, 3}}, Box{{0, 0, 5}, {3, 3, 8}}, Contact::open);
    const KeptCounts counts = count_classified(shaft, tree);
    EXPECT_EQ(counts.inside, 133U);
    EXPECT_EQ(counts.overlap, 0U);
    EXPECT_EQ(count(shaft, tree), 133U);
  });
}

}  // namespace
}  // namespace shaftcull
