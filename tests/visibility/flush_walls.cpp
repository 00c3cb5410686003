// SPDX-License-Identifier: MIT
/// Solids that end flush with patches: they hide what is behind them, in scenes large enough to have groups of groups.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "instruction_sets.hpp"
#include "shaftcull/results.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull {
namespace {

/// Patches with planes.
struct Facets {
  std::vector<Box> boxes;
  std::vector<Plane> planes;

  /// Adds the six sides of a box, each cut into squares of size 1, which face outwards or inwards.
  void add_sides(const Box& box, bool outwards) {
    for (std::size_t axis = 0; axis != 3; ++axis) {
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      for (const bool is_hi : {false, true}) {
        Plane plane{};
        plane.normal[axis] = is_hi == outwards ? 1.0F : -1.0F;
        Box facet{};
        facet.lo[axis] = facet.hi[axis] = is_hi ? box.hi[axis] : box.lo[axis];
        plane.offset = plane.normal[axis] * facet.lo[axis];
        for (float x = box.lo[u]; x != box.hi[u]; ++x) {
          for (float y = box.lo[v]; y != box.hi[v]; ++y) {
            facet.lo[u] = x;
            facet.hi[u] = x + 1;
            facet.lo[v] = y;
            facet.hi[v] = y + 1;
            boxes.push_back(facet);
            planes.push_back(plane);
          }
        }
      }
    }
  }
  [[nodiscard]] PatchSet set() const { return PatchSet(std::span<const Box>(boxes), std::span<const Plane>(planes)); }
};

/// Whether patches i and j have this answer.
bool has(const std::vector<std::uint64_t>& bits, std::size_t count, std::size_t i, std::size_t j) {
  return (bits[i * bit_words(count) + j / 64] >> j % 64 & 1U) != 0;
}

std::vector<std::uint64_t> bits_of(const PatchSet& set, const Occluders& occluders, Sight sight) {
  std::vector<std::uint64_t> bits(set.size() * bit_words(set.size()));
  visibility_bits(set, occluders, sight, bits);
  return bits;
}

TEST(FlushWalls, HideTheNextRoom) {
  Facets facets;
  facets.add_sides({{0, 0, 0}, {6, 5, 3}}, false);
  const std::size_t in_first_room = facets.boxes.size();
  facets.add_sides({{7, 0, 0}, {12, 5, 3}}, false);
  const PatchSet set = facets.set();
  const Box divider{{6, 0, 0}, {7, 5, 3}};
  const Box sheet{{6.5F, 0, 0}, {6.5F, 5, 3}};
  const std::vector<Vec3> polygon = {{6.5F, 0, 0}, {6.5F, 5, 0}, {6.5F, 5, 3}, {6.5F, 0, 3}};
  Occluders of_box;
  of_box.add_solids(std::span(&divider, 1));
  Occluders of_sheet;
  of_sheet.add_solids(std::span(&sheet, 1));
  Occluders of_polygon;
  of_polygon.add_polygons(polygon, std::vector<std::size_t>{0, polygon.size()});
  Occluders too_low;
  const Box low{{6, 0, 0}, {7, 5, 2.75F}};
  too_low.add_solids(std::span(&low, 1));
  on_each_instruction_set([&] {
    for (const Occluders* occluders : {&of_box, &of_sheet, &of_polygon}) {
      EXPECT_EQ(count_visibility(set, *occluders).undecided, 0U);
      const std::vector<std::uint64_t> clear = bits_of(set, *occluders, Sight::clear);
      const std::vector<std::uint64_t> occluded = bits_of(set, *occluders, Sight::occluded);
      std::size_t across = 0;
      for (std::size_t i = 0; i != set.size(); ++i) {
        for (std::size_t j = 0; j != set.size(); ++j) {
          const bool are_in_one_room = (i < in_first_room) == (j < in_first_room);
          ASSERT_FALSE(are_in_one_room ? has(occluded, set.size(), i, j) : has(clear, set.size(), i, j));
          across += has(occluded, set.size(), i, j) ? 1U : 0U;
        }
      }
      EXPECT_GT(across, in_first_room * in_first_room);
    }
    EXPECT_GT(count_visibility(set, too_low).undecided, 0U);
  });
}

TEST(FlushWalls, CubesInARowHideAllButNeighbours) {
  constexpr std::size_t cubes = 60;
  constexpr std::size_t sides = 6;
  Facets facets;
  std::vector<Box> solids;
  for (std::size_t i = 0; i != cubes; ++i) {
    const auto x = static_cast<float>(2 * i);
    solids.push_back({{x, 0, 0}, {x + 1, 1, 1}});
    facets.add_sides(solids.back(), true);
  }
  const PatchSet set = facets.set();
  Occluders occluders;
  occluders.add_solids(std::span<const Box>(solids));
  on_each_instruction_set([&] {
    const std::vector<std::uint64_t> occluded = bits_of(set, occluders, Sight::occluded);
    const std::vector<std::uint64_t> away = bits_of(set, occluders, Sight::facing_away);
    for (std::size_t i = 0; i != set.size(); ++i) {
      for (std::size_t j = 0; j != set.size(); ++j) {
        const std::size_t apart = i / sides < j / sides ? j / sides - i / sides : i / sides - j / sides;
        if (apart < 2) continue;
        ASSERT_TRUE(has(occluded, set.size(), i, j) || has(away, set.size(), i, j)) << i << ", " << j;
      }
    }
  });
}

}  // namespace
}  // namespace shaftcull
