// SPDX-License-Identifier: MIT
/// Rows of equal cubes, one cube's width apart: each cube hides all that lies behind it, and there are far more pairs
/// than can be answered one by one.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "instruction_sets.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/triangles.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull {
namespace {

constexpr std::size_t cubes = 1000;

/// The corners of the faces of a cube, counter-clockwise as seen from outside.
constexpr std::array<std::array<std::array<float, 3>, 4>, 6> faces{{{{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}},
                                                                    {{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}},
                                                                    {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}},
                                                                    {{{1, 1, 0}, {0, 1, 0}, {0, 1, 1}, {1, 1, 1}}},
                                                                    {{{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}},
                                                                    {{{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}}}};

struct Row {
  std::vector<Box> solids;
  std::vector<Vec3> corners;
  std::vector<std::size_t> first_corner{0};
  std::vector<Triangle> triangles;
  std::vector<std::size_t> first_triangle{0};

  Row() {
    for (std::size_t i = 0; i != cubes; ++i) {
      const float x = 2 * static_cast<float>(i);
      solids.push_back({{x, 0, 0}, {x + 1, 1, 1}});
      for (const auto& face : faces) {
        std::array<Vec3, 4> corner{};
        for (std::size_t c = 0; c != 4; ++c) corner[c] = {x + face[c][0], face[c][1], face[c][2]};
        corners.insert(corners.end(), corner.begin(), corner.end());
        first_corner.push_back(corners.size());
        triangles.push_back({{corner[0], corner[1], corner[2]}});
        triangles.push_back({{corner[0], corner[2], corner[3]}});
      }
      first_triangle.push_back(triangles.size());
    }
  }
  [[nodiscard]] PatchSet patches() const { return PatchSet(corners, first_corner); }
};

/// Faces see those of the next cube only. What lies behind that is hidden, and all others face away; pairs of them that
/// are hidden, too, may be either.
void expect_neighbours_alone(const SightCounts& counts) {
  EXPECT_EQ(counts.total(), std::uint64_t{6 * cubes} * (6 * cubes - 1) / 2);
  EXPECT_EQ(counts.undecided, 0U);
  EXPECT_EQ(counts.clear, cubes - 1);
  EXPECT_GE(counts.occluded, std::uint64_t{cubes - 1} * (cubes - 2) / 2);
}

TEST(RowsOfCubes, HideAllButNeighboursByNamedSolids) {
  const Row row;
  Occluders occluders;
  occluders.add_solids(row.solids);
  on_each_instruction_set([&] { expect_neighbours_alone(count_visibility(row.patches(), occluders)); });
}

TEST(RowsOfCubes, HideAllButNeighboursByFoundSolids) {
  const Row row;
  const TriangleStream triangles(row.triangles);
  Occluders occluders;
  occluders.add_triangles(triangles, row.first_triangle);
  occluders.add_found(find_solids(triangles));
  on_each_instruction_set([&] { expect_neighbours_alone(count_visibility(row.patches(), occluders)); });
}

TEST(RowsOfCubes, AreAnsweredByGroups) {
  const Row row;
  Occluders occluders;
  occluders.add_solids(row.solids);
  std::size_t blocks = 0;
  visibility(row.patches(), occluders, [&](const SightBatch& batch) { blocks += batch.blocks.size(); });
  EXPECT_LT(blocks, 20 * cubes);  // for 18 million pairs
}

}  // namespace
}  // namespace shaftcull
