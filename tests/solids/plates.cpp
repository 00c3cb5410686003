// SPDX-License-Identifier: MIT
/// Walls of many triangles that rounding has moved out of one plane: the plates found in them, in rational arithmetic.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "caught.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/occluded.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/visibility.hpp"
#include "solids/crossing.hpp"
#include "solids/found_in.hpp"

namespace shaftcull {
namespace {

using Point = std::array<double, 3>;

Point scaled_sum(const Point& origin, const Point& u, double x, const Point& v, double y) {
  Point point;
  for (std::size_t k = 0; k != 3; ++k) point[k] = origin[k] + x * u[k] + y * v[k];
  return point;
}

Vec3 rounded(const Point& point) {
  return {static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2])};
}

double distance_of(const Vec3& p, const Vec3& q) {
  return std::hypot(double{p[0]} - q[0], double{p[1]} - q[1], double{p[2]} - q[2]);
}

/// Squares of a grid in a plane, each two triangles, with common corners that are rounded to floats.
struct Sheet {
  Point origin{};
  Point u{1, 0, 0};  ///< from one column to the next
  Point v{0, 1, 0};

  [[nodiscard]] Vec3 corner(std::size_t i, std::size_t j) const {
    return rounded(scaled_sum(origin, u, static_cast<double>(i), v, static_cast<double>(j)));
  }
  /// Adds the squares for which has(i, j).
  template <class Has>
  void add_to(Polygons& mesh, std::size_t columns, std::size_t rows, const Has& has) const {
    for (std::size_t i = 0; i != columns; ++i) {
      for (std::size_t j = 0; j != rows; ++j) {
        if (has(i, j)) mesh.add({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
      }
    }
  }
};

/// A plane that is turned about the axis (1, 2, 3).
Sheet turned(double angle, const Point& origin = {}) {
  const Point axis{1 / std::sqrt(14.0), 2 / std::sqrt(14.0), 3 / std::sqrt(14.0)};
  const auto turn = [&](const Point& p) {
    const double along = axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
    Point result;
    for (std::size_t k = 0; k != 3; ++k) {
      const std::size_t i = (k + 1) % 3;
      const std::size_t j = (k + 2) % 3;
      result[k] = p[k] * std::cos(angle) + (axis[i] * p[j] - axis[j] * p[i]) * std::sin(angle) +
                  axis[k] * along * (1 - std::cos(angle));
    }
    return result;
  };
  return {origin, turn({1, 0, 0}), turn({0, 0, 1})};
}

std::span<const Vec3> part(const std::vector<Vec3>& corners, const FoundSolids& found, std::size_t i) {
  return std::span(corners).subspan(found.first_polygon_corner[i],
                                    found.first_polygon_corner[i + 1] - found.first_polygon_corner[i]);
}

bool is_plate(const FoundSolids& found, std::size_t i) {
  if (found.back_corners.empty()) return false;
  return !std::ranges::equal(part(found.polygon_corners, found, i), part(found.back_corners, found, i));
}

std::size_t plates(const FoundSolids& found) {
  std::size_t count = 0;
  for (std::size_t i = 0; i != found.polygons(); ++i) count += is_plate(found, i) ? 1 : 0;
  return count;
}

bool hides(const FoundSolids& found, std::size_t i, const Vec3& from, const Vec3& to) {
  const CompiledShaft segment = compile(Box{from, from}, Box{to, to});
  return occluded(segment, part(found.polygon_corners, found, i)) &&
         (found.back_corners.empty() || occluded(segment, part(found.back_corners, found, i)));
}

bool hide(const FoundSolids& found, const Vec3& from, const Vec3& to) {
  for (std::size_t i = 0; i != found.polygons(); ++i) {
    if (hides(found, i, from, to)) return true;
  }
  return false;
}

TEST(Plates, ATurnedWallIsOnePlateAlmostAsLargeAsItself) {
  for (const double distance : {0.0, 100.0, 1000.0}) {
    const Sheet wall = turned(0.5, {distance, -2 * distance, 3});
    Polygons mesh;
    wall.add_to(mesh, 24, 10, [](auto, auto) { return true; });
    const FoundSolids found = found_in(mesh);
    ASSERT_EQ(counts(found), (Counts{0, 1, 0})) << distance;
    ASSERT_EQ(plates(found), 1U);
    ASSERT_EQ(found.polygon_corners.size(), 4U);
    // Each corner is near one of the wall, and both polygons are a few float steps apart.
    const std::array<Vec3, 4> corners{wall.corner(0, 0), wall.corner(24, 0), wall.corner(24, 10), wall.corner(0, 10)};
    const double step = std::max(2.0, 2 * distance) * 0x1p-23;
    for (std::size_t c = 0; c != 4; ++c) {
      const Vec3& front = found.polygon_corners[c];
      double nearest = 1e9;
      for (const Vec3& corner : corners) {
        nearest = std::min(nearest, distance_of(front, corner));
      }
      EXPECT_LE(nearest, 0.01 + 64 * step);
      const Vec3& back = found.back_corners[c];
      EXPECT_LE(distance_of(front, back), 32 * step);
    }
    // From either side through the middle; not past an edge.
    const auto beside = [&](double x, double y, double off) {
      const Point on = scaled_sum(wall.origin, wall.u, x, wall.v, y);
      Point normal;
      for (std::size_t k = 0; k != 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        normal[k] = wall.u[i] * wall.v[j] - wall.u[j] * wall.v[i];
      }
      return rounded(scaled_sum(on, normal, off, normal, 0));
    };
    for (const double x : {0.3, 12.0, 23.7}) {
      EXPECT_TRUE(hides(found, 0, beside(x, 5, 2), beside(x, 5, -2)));
      EXPECT_TRUE(hides(found, 0, beside(x, 5, -2), beside(x, 5, 2)));
    }
    EXPECT_FALSE(hides(found, 0, beside(24.3, 5, 2), beside(24.3, 5, -2)));
    EXPECT_FALSE(hides(found, 0, beside(12, 5, 2), beside(12, 5, 1)));
  }
}

TEST(Plates, WallsWithWindowsAndFloorsWithCornersAreAFewPlates) {
  const Sheet wall = turned(-0.7, {1, 2, 3});
  Polygons with_window;
  const auto is_wall = [](std::size_t i, std::size_t j) { return i < 8 || i >= 12 || j < 4 || j >= 8; };
  wall.add_to(with_window, 20, 12, is_wall);
  const FoundSolids found = found_in(with_window);
  EXPECT_GE(plates(found), 4U);
  EXPECT_LE(found.polygons(), 12U);
  const auto through = [&](double x, double y) {
    const Point on = scaled_sum(wall.origin, wall.u, x, wall.v, y);
    const Vec3 from{static_cast<float>(on[0] + 0.9), static_cast<float>(on[1] + 1.7), static_cast<float>(on[2] - 0.4)};
    const Vec3 to{static_cast<float>(on[0] - 0.9), static_cast<float>(on[1] - 1.7), static_cast<float>(on[2] + 0.4)};
    return hide(found, from, to);
  };
  for (std::size_t i = 0; i != 20; ++i) {
    for (std::size_t j = 0; j != 12; ++j) {
      const double x = static_cast<double>(i) + 0.5;
      const double y = static_cast<double>(j) + 0.5;
      EXPECT_EQ(through(x, y), is_wall(i, j)) << i << ' ' << j;
    }
  }
  Polygons floor;
  wall.add_to(floor, 16, 16, [](std::size_t i, std::size_t j) { return i < 8 || j < 8; });
  EXPECT_LE(found_in(floor).polygons(), 4U);
  EXPECT_GE(plates(found_in(floor)), 2U);
}

TEST(Plates, AreNoneWhereTrianglesAreInOnePlaneOrInNone) {
  Polygons flat;
  Sheet{}.add_to(flat, 6, 6, [](auto, auto) { return true; });
  EXPECT_EQ(counts(found_in(flat)), (Counts{0, 1, 0}));
  EXPECT_TRUE(found_in(flat).back_corners.empty());
  // A slope that grows: neighbours are nearly in one plane, the whole is not.
  Polygons bent;
  for (int i = 0; i != 40; ++i) {
    const auto at = [](int x, float y) {
      return Vec3{static_cast<float>(x), y, 2e-4F * static_cast<float>(x) * static_cast<float>(x)};
    };
    bent.add({at(i, 0), at(i + 1, 0), at(i + 1, 1), at(i, 1)});
  }
  EXPECT_EQ(plates(found_in(bent)), 0U);
  EXPECT_EQ(found_in(bent).polygons(), 40U);
}

// Rooms of a building as a finite-element mesh has them.
TEST(Plates, HideBehindTheCornerOfATurnedRoomWhatItsWallsHide) {
  const auto counts_of = [](double angle) {
    constexpr std::size_t n = 8;
    const Sheet axes = turned(angle);
    const auto at = [&](double x, double y, double z) {
      // The third axis is that of the plane's normal.
      Point normal;
      for (std::size_t k = 0; k != 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        normal[k] = axes.v[i] * axes.u[j] - axes.v[j] * axes.u[i];
      }
      return scaled_sum(scaled_sum({}, axes.u, x, normal, y), axes.v, z, axes.v, 0);
    };
    constexpr double outline[6][2] = {{0, 0}, {8, 0}, {8, 4}, {4, 4}, {4, 8}, {0, 8}};
    Polygons mesh;
    std::vector<Vec3> corners;
    std::vector<std::size_t> first{0};
    for (std::size_t w = 0; w != 6; ++w) {
      const auto& [x, y] = outline[(w + 1) % 6];
      const auto& [to_x, to_y] = outline[w];
      Sheet wall{at(x, y, 0), {}, {}};
      const Point along = at(to_x, to_y, 0);
      const Point up = at(x, y, 4);
      for (std::size_t k = 0; k != 3; ++k) {
        wall.u[k] = (along[k] - wall.origin[k]) / n;
        wall.v[k] = (up[k] - wall.origin[k]) / n;
      }
      wall.add_to(mesh, n, n, [&](std::size_t i, std::size_t j) {
        for (const Vec3& corner :
             {wall.corner(i, j), wall.corner(i + 1, j), wall.corner(i + 1, j + 1), wall.corner(i, j + 1)}) {
          corners.push_back(corner);
        }
        first.push_back(corners.size());
        return true;
      });
    }
    Occluders occluders;
    occluders.add_mesh(TriangleStream(std::span<const Triangle>(mesh.triangles)));
    return count_visibility(PatchSet(std::span<const Vec3>(corners), std::span<const std::size_t>(first)), occluders,
                            {.tolerance = 1e-4F});
  };
  const SightCounts straight = counts_of(0);
  const SightCounts slanted = counts_of(0.5);
  EXPECT_GE(straight.occluded, 1000U);
  EXPECT_GE(static_cast<double>(slanted.occluded), 0.8 * static_cast<double>(straight.occluded));
  EXPECT_LE(slanted.occluded, straight.occluded);
  EXPECT_GE(static_cast<double>(slanted.clear), 0.95 * static_cast<double>(straight.clear));
}

/// A sheet in a random place and with random holes, of which some vertices are moved by float steps.
Polygons random_sheet(Random& random) {
  Sheet sheet = turned(random.uniform(-3, 3));
  const float far = random.one_in(3) ? 0.0F : random.one_in(2) ? 30.0F : 3000.0F;
  for (double& x : sheet.origin) x = random.uniform(-far, far);
  Polygons mesh;
  const std::size_t columns = 2 + random.below(5);
  const std::size_t rows = 2 + random.below(5);
  const bool has_holes = random.one_in(2);
  sheet.add_to(mesh, columns, rows, [&](auto, auto) { return !has_holes || !random.one_in(5); });
  if (random.one_in(2)) {
    for (Triangle& triangle : mesh.triangles) {
      for (const Vec3 vertex : triangle.vertex) {
        if (!random.one_in(20)) continue;
        Vec3 moved = vertex;
        for (float& x : moved) x = random.nudge(x);
        for (Triangle& other : mesh.triangles) std::ranges::replace(other.vertex, vertex, moved);
      }
    }
  }
  return mesh;
}

TEST(Plates, HideNothingThatNoTriangleHides) {
  Random random(3);
  std::size_t hidden = 0;
  std::size_t found_plates = 0;
  for (std::uint64_t i = 0; i != random_cases(150); ++i) {
    const Polygons mesh = random_sheet(random);
    const FoundSolids found = found_in(mesh);
    for (std::size_t p = 0; p != found.polygons(); ++p) {
      if (!is_plate(found, p)) continue;
      ++found_plates;
      const std::span<const Vec3> corners = part(found.polygon_corners, found, p);
      for (int left = 12; left != 0; --left) {
        // Through a point of the plate, often one near its edge, at any angle; from near and from far.
        const Vec3& a = corners[random.below(static_cast<unsigned>(corners.size()))];
        const Vec3& b = corners[random.below(static_cast<unsigned>(corners.size()))];
        const Vec3& c = corners[random.below(static_cast<unsigned>(corners.size()))];
        const float s = random.uniform(0, 1);
        const float t = random.one_in(2) ? 1e-5F : random.uniform(0, 1);
        const Vec3 away = random.vec3(-1, 1);
        const float far = random.one_in(2) ? 5.0F : 1e-3F;
        Vec3 from{};
        Vec3 to{};
        for (std::size_t k = 0; k != 3; ++k) {
          const float on = (a[k] + s * (b[k] - a[k])) * (1 - t) + t * c[k];
          from[k] = on + far * away[k];
          to[k] = on - far * away[k];
        }
        if (!hides(found, p, from, to)) continue;
        ++hidden;
        ASSERT_TRUE(crosses(exactly(from), exactly(to), mesh.triangles)) << "sheet " << i;
      }
    }
  }
  EXPECT_GE(found_plates, 10U);
  EXPECT_GE(hidden, 4 * found_plates);
}

TEST(Plates, ThatAreBrokenAddNothing) {
  Polygons mesh;
  turned(0.5).add_to(mesh, 4, 4, [](auto, auto) { return true; });
  const FoundSolids good = found_in(mesh);
  ASSERT_EQ(plates(good), 1U);
  const std::vector<Box> two{{{2, 5, 2}, {2, 5, 2}}, {{2, -5, 2}, {2, -5, 2}}};
  Occluders occluders;
  FoundSolids broken = good;
  broken.back_corners.pop_back();
  EXPECT_THROW(occluders.add_found(broken), InvalidArgument);
  broken = good;
  broken.back_corners[2][1] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(occluders.add_found(broken), BadBound);
  if (!failed_calls_undo) return;
  EXPECT_EQ(count_visibility(PatchSet(two), occluders).occluded, 0U);
  occluders.add_found(good);
  EXPECT_EQ(count_visibility(PatchSet(two), occluders).occluded, 1U);
}

}  // namespace
}  // namespace shaftcull
