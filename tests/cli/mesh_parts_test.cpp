// SPDX-License-Identifier: MIT
/// Parts of meshes.
#include "mesh_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>
#include <vector>

#include "oracle/random.hpp"

namespace shaftcull::cli {
namespace {

MeshTriangle at(float x, float y, float z, std::uint32_t object = 0) {
  return {{{x, y, z}, {x + 1, y + 1, z + 1}}, object, 0, 0};
}

/// Triangles of objects with so many each, anywhere.
std::vector<MeshTriangle> scattered(const std::vector<int>& counts) {
  Random random(7);
  std::vector<MeshTriangle> triangles;
  for (std::uint32_t object = 0; object < counts.size(); ++object) {
    for (int i = 0; i < counts[object]; ++i) {
      const auto coordinate = [&] { return static_cast<float>(random.below(1000)); };
      const float x = coordinate();
      const float y = coordinate();
      triangles.push_back(at(x, y, coordinate(), object));
    }
  }
  return triangles;
}

TEST(CliMeshParts, HoldEveryTriangleOnceAndNoneOfAnotherObject) {
  std::vector<MeshTriangle> triangles = scattered({1, 7, 100, 13});
  const std::vector<MeshPart> parts = divide_into_parts(triangles, 10);
  std::vector<int> size(parts.size());
  for (const MeshTriangle& triangle : triangles) {
    ASSERT_LT(triangle.part, parts.size());
    EXPECT_EQ(parts[triangle.part].object, triangle.object);
    ++size[triangle.part];
  }
  EXPECT_LE(*std::max_element(size.begin(), size.end()), 10);
  EXPECT_GE(*std::min_element(size.begin(), size.end()), 1);
}

TEST(CliMeshParts, AreNumberedFromOneInEachObject) {
  std::vector<MeshTriangle> triangles = scattered({25, 3});
  const std::vector<MeshPart> parts = divide_into_parts(triangles, 10);
  ASSERT_EQ(parts.size(), 5U);
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(parts[i].number, i + 1);
  EXPECT_EQ(parts[4].object, 1U);
  EXPECT_EQ(parts[4].number, 1U);
}

TEST(CliMeshParts, HaveTheBoxOfTheirTriangles) {
  std::vector<MeshTriangle> triangles = scattered({50});
  const std::vector<MeshPart> parts = divide_into_parts(triangles, 8);
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Box box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    for (const MeshTriangle& triangle : triangles) {
      if (triangle.part != p) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.lo[axis] = std::min(box.lo[axis], triangle.box.lo[axis]);
        box.hi[axis] = std::max(box.hi[axis], triangle.box.hi[axis]);
      }
    }
    EXPECT_EQ(parts[p].box, box);
  }
}

TEST(CliMeshParts, AreHalvesAlongTheWidestAxis) {
  // A row along y, in another order than along it.
  std::vector<MeshTriangle> row;
  for (const int y : {5, 2, 7, 0, 3, 6, 1, 4}) row.push_back(at(0, static_cast<float>(10 * y), static_cast<float>(y)));
  const std::vector<MeshPart> parts = divide_into_parts(row, 2);
  ASSERT_EQ(parts.size(), 4U);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    EXPECT_EQ(parts[p].box.lo[1], static_cast<float>(20 * p));
    EXPECT_EQ(parts[p].box.hi[1], static_cast<float>(20 * p + 11));
  }
}

TEST(CliMeshParts, EqualTrianglesGoByTheirOrder) {
  std::vector<MeshTriangle> equal(8, at(1, 2, 3));
  EXPECT_EQ(divide_into_parts(equal, 3).size(), 4U);
  for (std::uint32_t i = 0; i < equal.size(); ++i) EXPECT_EQ(equal[i].part, i / 2);
}

TEST(CliMeshParts, LastDownToOneTriangle) {
  std::vector<MeshTriangle> triangles = scattered({9});
  EXPECT_EQ(divide_into_parts(triangles, 1).size(), 9U);
  std::set<std::uint32_t> used;
  for (const MeshTriangle& triangle : triangles) used.insert(triangle.part);
  EXPECT_EQ(used.size(), 9U);
}

TEST(CliMeshParts, TakeCoordinatesAtTheEndsOfFloats) {
  constexpr float huge = std::numeric_limits<float>::max();
  std::vector<MeshTriangle> triangles{{{{huge, 0, 0}, {huge, 0, 0}}, 0, 0, 0},
                                      {{{-huge, 0, 0}, {-huge, 0, 0}}, 0, 0, 0}};
  const std::vector<MeshPart> parts = divide_into_parts(triangles, 1);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].box.lo[0], -huge);
  EXPECT_EQ(parts[1].box.lo[0], huge);
}

}  // namespace
}  // namespace shaftcull::cli
