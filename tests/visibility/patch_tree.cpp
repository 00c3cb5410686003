// SPDX-License-Identifier: MIT
/// How patches are put into groups, by what the definition of a group asks for.
#include "visibility/patch_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "shaftcull/streams.hpp"
#include "support/float_environment.hpp"
#include "visibility/patch_halving.hpp"
#include "visibility/sight_set.hpp"

namespace shaftcull::test {
namespace {

using kernel::PatchGroup;
using kernel::PatchTree;

struct Patches {
  std::vector<Box> boxes;
  std::vector<Plane> planes;
};

/// Patches of a kind, all finite, with normals that are not zero.
Patches patches_of(const std::string& kind, std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  const float largest = std::numeric_limits<float>::max();
  const float smallest = std::numeric_limits<float>::denorm_min();
  const float scale = kind == "huge" ? largest : kind == "tiny" ? 100 * smallest : 10;
  std::uniform_real_distribution<float> some(-1, 1);
  Patches patches;
  for (std::size_t i = 0; i != count; ++i) {
    Box box{};
    Plane plane{};
    for (std::size_t k = 0; k != 3; ++k) {
      const float a = kind == "alike" ? 1 : scale * some(random);
      const float b = kind == "alike" ? 2 : kind == "huge" ? scale * some(random) : a + 0.1F * scale * some(random);
      box.lo[k] = std::min(a, b);
      box.hi[k] = std::max(a, b);
      plane.normal[k] = kind == "alike" ? 1 : some(random) + (k == 2 ? 2 : 0);
    }
    if (kind == "lattice") {
      for (std::size_t k = 0; k != 3; ++k) {
        box.lo[k] = std::round(box.lo[k] / 5);
        box.hi[k] = std::round(box.hi[k] / 5);
        plane.normal[k] = k == i % 3 ? (i % 2 == 0 ? 1.0F : -1.0F) : 0;
      }
    }
    plane.offset = 0;
    patches.boxes.push_back(box);
    patches.planes.push_back(plane);
  }
  return patches;
}

PatchTree tree_of(const Patches& patches) {
  return kernel::in_float_environment([&] { return PatchTree(BoxStream(patches.boxes).view(), patches.planes); });
}

class PatchTreeOf : public testing::TestWithParam<const char*> {};

TEST_P(PatchTreeOf, HasEachPatchInOneGroupAndBoundsThatAreTight) {
  for (const bool with_planes : {true, false}) {
    for (const std::size_t count : {1U, 2U, 63U, 64U, 65U, 129U, 1000U, 5000U}) {
      SCOPED_TRACE(std::to_string(count) + (with_planes ? " patches with planes" : " patches"));
      Patches patches = patches_of(GetParam(), count, static_cast<std::uint32_t>(count));
      if (!with_planes) patches.planes.clear();
      const PatchTree tree = tree_of(patches);
      std::vector<std::uint32_t> all(tree.order().begin(), tree.order().end());
      std::ranges::sort(all);
      for (std::size_t i = 0; i != count; ++i) ASSERT_EQ(all[i], i);

      const std::vector<PatchGroup>& groups = tree.groups();
      ASSERT_EQ(groups[0].first, 0U);
      ASSERT_EQ(groups[0].count, count);
      for (std::size_t g = 0; g != groups.size(); ++g) {
        const PatchGroup& group = groups[g];
        ASSERT_GT(group.count, 0U);
        if (group.has_patches) {
          ASSERT_LE(group.count, PatchTree::most_patches);
          ASSERT_EQ(group.first_child, group.first);
          ASSERT_EQ(group.children, group.count);
        } else {
          ASSERT_GT(group.children, 1U);
          ASSERT_LE(group.children, PatchTree::most_children);
          std::uint32_t next = group.first;
          for (std::uint32_t c = group.first_child; c != group.first_child + group.children; ++c) {
            ASSERT_GT(c, g);
            ASSERT_EQ(groups[c].first, next);
            next += groups[c].count;
          }
          ASSERT_EQ(next, group.first + group.count);
        }
        // Bounds are the least and the largest of what the patches have.
        const auto expect_best = [&](std::size_t stream, const auto& value, bool largest) {
          float best = value(tree.order()[group.first]);
          for (std::uint32_t p = group.first; p != group.first + group.count; ++p) {
            const float other = value(tree.order()[p]);
            best = largest ? std::max(best, other) : std::min(best, other);
          }
          ASSERT_EQ(tree.group_streams().stream(stream)[g], best) << "group " << g << ", stream " << stream;
        };
        for (std::size_t k = 0; k != 3; ++k) {
          expect_best(
              k, [&](std::uint32_t i) { return patches.boxes[i].lo[k]; }, false);
          expect_best(
              k + 3, [&](std::uint32_t i) { return patches.boxes[i].hi[k]; }, true);
          // A face is left out unless a patch is flat and lies in it.
          bool has_lo = false;
          bool has_hi = false;
          const float lo = tree.group_streams().stream(k)[g];
          const float hi = tree.group_streams().stream(k + 3)[g];
          for (const std::uint32_t i : tree.order().subspan(group.first, group.count)) {
            const Box& box = patches.boxes[i];
            has_lo |= box.lo[k] == box.hi[k] && box.lo[k] == lo;
            has_hi |= box.lo[k] == box.hi[k] && box.hi[k] == hi;
          }
          ASSERT_EQ(tree.group_inward(k)[g], has_lo ? lo : hi) << "group " << g;
          ASSERT_EQ(tree.group_inward(k + 3)[g], has_hi ? hi : lo) << "group " << g;
          if (!with_planes) continue;
          expect_best(
              k + 6, [&](std::uint32_t i) { return patches.planes[i].normal[k]; }, false);
          expect_best(
              k + 9, [&](std::uint32_t i) { return patches.planes[i].normal[k]; }, true);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, PatchTreeOf, testing::Values("spread", "lattice", "alike", "huge", "tiny"),
                         [](const testing::TestParamInfo<const char*>& kind) { return kind.param; });

/// How many of the first half have an odd index, and how many of the second an even one, or the other way round: 0 if
/// the halves are the odd and the even ones.
std::size_t misplaced(const Patches& patches) {
  std::vector<kernel::PatchItem> items;
  for (std::size_t i = 0; i != patches.boxes.size(); ++i) {
    const auto& [lo, hi] = patches.boxes[i];
    const Vec3& n = patches.planes[i].normal;
    items.push_back(
        {{kernel::FourFloats::of(-lo[0], -lo[1], -lo[2], -n[0]), kernel::FourFloats::of(hi[0], hi[1], hi[2], n[0]),
          kernel::FourFloats::of(n[1], n[2], -n[1], -n[2])},
         static_cast<std::uint32_t>(i)});
  }
  kernel::PatchHalving halving(items.size(), true);
  const std::size_t half = halving.halve(items, kernel::PatchCosts(kernel::extent_of(items)));
  const auto odd =
      static_cast<std::size_t>(std::count_if(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half),
                                             [](const auto& i) { return i.index % 2 == 1; }));
  const std::size_t odd_behind = items.size() / 2 - odd;
  return std::min(odd + (items.size() - half - odd_behind), half - odd + odd_behind);
}

TEST(PatchHalving, CutsWhereThereIsAGapOnAnyAxis) {
  for (const std::size_t count : {2U, 10U, 100U, 255U * 2, 3000U}) {
    for (std::size_t axis = 0; axis != 3; ++axis) {
      SCOPED_TRACE(std::to_string(count) + " patches, axis " + std::to_string(axis));
      Patches patches = patches_of("alike", count, 0);
      std::mt19937 random(7);
      std::uniform_real_distribution<float> some(0, 1);
      for (std::size_t i = 0; i != count; ++i) {
        const float at = (i % 2 == 1 ? 100.0F : 0.0F) + some(random);
        patches.boxes[i].lo[axis] = at;
        patches.boxes[i].hi[axis] = at + 1;
      }
      EXPECT_EQ(misplaced(patches), 0U);
    }
  }
}

TEST(PatchHalving, CutsWhereNormalsPart) {
  for (std::size_t axis = 0; axis != 3; ++axis) {
    SCOPED_TRACE("axis " + std::to_string(axis));
    Patches patches = patches_of("alike", 500, 0);
    for (std::size_t i = 0; i != patches.planes.size(); ++i) {
      patches.planes[i].normal = {0, 0, 0};
      patches.planes[i].normal[axis] = i % 2 == 1 ? 1.0F : -1.0F;
    }
    EXPECT_EQ(misplaced(patches), 0U);
  }
}

/// Patches that face along axes, but for some.
Patches patches_along_axes(std::size_t count, std::size_t aslant) {
  Patches patches = patches_of("uniform", count, 3);
  for (std::size_t i = aslant; i != count; ++i) {
    patches.planes[i].normal = {0, 0, 0};
    patches.planes[i].normal[i % 3] = i % 2 == 1 ? 1.0F : -1.0F;
  }
  return patches;
}

TEST(PatchTree, GroupsByFacingBeforePlaceIfMostPatchesFaceFewWays) {
  const PatchTree tree = tree_of(patches_along_axes(5000, 500));
  const std::vector<PatchGroup>& groups = tree.groups();
  ASSERT_EQ(groups[0].children, 7U);
  for (std::uint32_t g = 1; g != 7; ++g) {
    for (std::size_t k = 6; k != 9; ++k) {
      EXPECT_EQ(tree.group_streams().stream(k)[g], tree.group_streams().stream(k + 3)[g]) << "group " << g;
    }
  }
  EXPECT_EQ(groups[7].count, 500U);
}

TEST(PatchTree, GroupsByPlaceIfPatchesFaceManyWaysOrAreFew) {
  const auto faces_one_way = [](const PatchTree& tree, std::uint32_t g) {
    bool is_one = true;
    for (std::size_t k = 6; k != 9; ++k) {
      is_one = is_one && tree.group_streams().stream(k)[g] == tree.group_streams().stream(k + 3)[g];
    }
    return is_one;
  };
  for (const auto& [count, aslant] : {std::pair{5000U, 2000U}, std::pair{500U, 0U}}) {
    const PatchTree tree = tree_of(patches_along_axes(count, aslant));
    EXPECT_FALSE(faces_one_way(tree, 1)) << count << " patches";
  }
}

// What a tree keeps from one job to the next belongs to the tolerance and the largest coordinate of the job.
TEST(SightSets, HavePlanesOfTheirOwnJob) {
  const Patches patches = patches_of("random", 200, 7);
  const BoxStream boxes(patches.boxes);
  const PatchTree used(boxes.view(), patches.planes);
  std::vector<std::vector<float>> errors;
  for (const auto& [tolerance, coordinate] :
       {std::pair(0.0F, 10.0F), {0.0F, 1e6F}, {0.25F, 1e6F}, {0.25F, 10.0F}, {0.0F, 10.0F}}) {
    const PatchTree fresh(boxes.view(), patches.planes);
    const kernel::SightSet of_used = sight_set(used, tolerance, coordinate);
    const kernel::SightSet of_fresh = sight_set(fresh, tolerance, coordinate);
    EXPECT_EQ(of_used.planes->patches.offset, of_fresh.planes->patches.offset);
    EXPECT_EQ(of_used.planes->patches.error, of_fresh.planes->patches.error);
    EXPECT_EQ(of_used.planes->groups.error, of_fresh.planes->groups.error);
    EXPECT_EQ(sight_set(used, tolerance, coordinate).planes, of_used.planes);
    errors.push_back(of_used.planes->patches.error);
  }
  EXPECT_NE(errors[0], errors[1]);
  EXPECT_NE(errors[2], errors[3]);
}

}  // namespace
}  // namespace shaftcull::test
