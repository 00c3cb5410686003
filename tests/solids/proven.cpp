// SPDX-License-Identifier: MIT
/// Segments that found solids hide cross a triangle, in rational arithmetic: of random meshes with every fault.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "oracle/blocking.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/occluded.hpp"
#include "shaftcull/solids.hpp"
#include "solids/crossing.hpp"
#include "solids/meshes.hpp"

namespace shaftcull {
namespace {

/// Bodies, rooms and sheets that touch and cut each other, with faults.
class RandomMesh {
 public:
  explicit RandomMesh(Random& random) : random_(random) {}

  std::vector<Triangle> make() {
    for (unsigned left = 1 + random_.below(5); left != 0; --left) add_something();
    if (random_.one_in(2)) mesh_.turn(double{random_.uniform(0, 3)}, random_.one_in(2) ? 0 : 0.7);
    if (!random_.one_in(3)) {
      for (unsigned left = random_.below(6); left != 0; --left) break_something();
    }
    return std::move(mesh_.triangles);
  }

 private:
  float at(int low, int high) { return random_.integer(low, high); }

  void add_something() {
    Polygons one;
    switch (random_.below(6)) {
      case 0:
      case 1:
        one.add_box(random_.grid_box(0, 5));  // flat ones, too
        break;
      case 2:
        one.add_column(at(0, 5), at(0, 5), at(1, 2), 3 + random_.below(9), at(0, 1), at(2, 4));
        break;
      case 3:
        one.add_l_block(at(0, 3), at(0, 3), at(0, 1), at(2, 4));
        break;
      case 4:
        add_grid(one);
        break;
      default: {
        std::vector<Vec3> corners;
        for (unsigned i = 0; i != 4; ++i) corners.push_back({at(0, 5), at(0, 5), at(0, 5)});
        one.add({corners[0], corners[1], corners[2]});
        one.add({corners[0], corners[2], corners[3]});
        one.add({corners[0], corners[3], corners[1]});
        one.add({corners[3], corners[2], corners[1]});
      }
    }
    if (random_.one_in(3)) one.flip();
    mesh_.triangles.insert(mesh_.triangles.end(), one.triangles.begin(), one.triangles.end());
  }

  /// Part of a floor, square by square.
  void add_grid(Polygons& to) {
    const float height = at(0, 4);
    for (int x = 0; x != 4; ++x) {
      for (int y = 0; y != 4; ++y) {
        if (random_.one_in(6)) continue;
        const auto at_x = static_cast<float>(x);
        const auto at_y = static_cast<float>(y);
        std::vector<Vec3> square{
            {at_x, at_y, height}, {at_x + 1, at_y, height}, {at_x + 1, at_y + 1, height}, {at_x, at_y + 1, height}};
        std::rotate(square.begin(), square.begin() + static_cast<std::ptrdiff_t>(random_.below(4)), square.end());
        to.add(square);
      }
    }
  }

  void break_something() {
    std::vector<Triangle>& triangles = mesh_.triangles;
    if (triangles.empty()) return;
    const std::size_t i = random_.below(static_cast<unsigned>(triangles.size()));
    Triangle one = triangles[i];
    switch (random_.below(8)) {
      case 0:
        triangles.erase(triangles.begin() + static_cast<std::ptrdiff_t>(i));
        break;
      case 1:
        triangles.push_back(one);
        break;
      case 2:
        std::swap(triangles[i].vertex[0], triangles[i].vertex[1]);
        break;
      case 3:
        std::swap(one.vertex[0], one.vertex[1]);  // on both sides
        triangles.push_back(one);
        break;
      case 4:
        one.vertex[random_.below(3)] = one.vertex[random_.below(3)];
        triangles.push_back(one);
        break;
      case 5:  // a corner of all triangles that have it, or of one
        move_vertex(one.vertex[0], random_.one_in(2) ? triangles.size() : 1);
        break;
      case 6: {  // split, so that there is a T-junction
        Vec3 middle{};
        for (std::size_t k = 0; k != 3; ++k) middle[k] = (one.vertex[0][k] + one.vertex[1][k]) / 2;
        triangles[i].vertex[1] = middle;
        one.vertex[0] = middle;
        triangles.push_back(one);
        break;
      }
      default:
        for (float& x : one.vertex[2]) x = random_.uniform(-1, 6);
        triangles.push_back(one);
    }
  }

  void move_vertex(Vec3 vertex, std::size_t most) {
    Vec3 moved = vertex;
    for (float& x : moved) x = random_.one_in(2) ? random_.nudge(x) : random_.one_in(4) ? x + at(-1, 1) : x;
    for (Triangle& triangle : mesh_.triangles) {
      for (Vec3& v : triangle.vertex) {
        if (v != vertex || most == 0) continue;
        v = moved;
        --most;
      }
    }
  }

  Random& random_;
  Polygons mesh_;
};

/// A point between others, each with a positive weight.
RationalPoint between(Random& random, std::span<const Vec3> points) {
  RationalPoint sum;
  mpq_class weights = 0;
  for (const Vec3& point : points) {
    const mpq_class weight = random.one_in(3) ? 1 + random.below(1000) : 1;
    const RationalPoint p = exactly(point);
    for (std::size_t k = 0; k != 3; ++k) sum[k] += weight * p[k];
    weights += weight;
  }
  for (mpq_class& x : sum) x /= weights;
  return sum;
}

bool are_in_one_plane(std::span<const Vec3> points) {
  std::vector<RationalPoint> exact;
  for (const Vec3& point : points) exact.push_back(exactly(point));
  for (std::size_t i = 1; i < exact.size(); ++i) {
    for (std::size_t j = i + 1; j < exact.size(); ++j) {
      for (std::size_t k = j + 1; k < exact.size(); ++k) {
        if (orientation(exact[0], exact[i], exact[j], exact[k]) != 0) return false;
      }
    }
  }
  return true;
}

std::vector<Vec3> corners_of(const Box& box) {
  std::vector<Vec3> corners;
  for (unsigned c = 0; c != 8; ++c) {
    Vec3 corner{};
    for (unsigned k = 0; k != 3; ++k) corner[k] = (c >> k & 1U) != 0 ? box.hi[k] : box.lo[k];
    corners.push_back(corner);
  }
  return corners;
}

/// A region that is bounded on some sides, but never on both sides of an axis.
Box random_region(Random& random, std::span<const Triangle> triangles) {
  Box region = SolidSearch{}.region;
  for (std::size_t k = 0; k != 3; ++k) {
    if (!random.one_in(4)) continue;
    const float at = random.integer(0, 5);
    (at < 3 ? region.lo : region.hi)[k] = at;
  }
  if (triangles.empty()) return region;
  // Often, a body stands on one of its faces: the triangle looks out of the region.
  const auto& [p, q, r] = triangles[random.below(static_cast<unsigned>(triangles.size()))].vertex;
  for (std::size_t k = 0; k != 3; ++k) {
    if (p[k] != q[k] || q[k] != r[k]) continue;
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    const float normal = (q[i] - p[i]) * (r[j] - p[j]) - (q[j] - p[j]) * (r[i] - p[i]);
    region = SolidSearch{}.region;
    (normal < 0 ? region.lo : region.hi)[k] = p[k];
  }
  return region;
}

bool is_within(const RationalPoint& point, const Box& region) {
  for (std::size_t k = 0; k != 3; ++k) {
    if (point[k] < std::max(region.lo[k], -1e30F) || point[k] > std::min(region.hi[k], 1e30F)) return false;
  }
  return true;
}

class ProvenSolids {
 public:
  explicit ProvenSolids(std::uint64_t seed)
      : random_(seed),
        triangles_(RandomMesh(random_).make()),
        region_(random_.one_in(2) ? random_region(random_, triangles_) : SolidSearch{}.region) {
    // What lies on the faces of the region: bodies are open there.
    if (random_.one_in(2)) std::erase_if(triangles_, [&](const Triangle& triangle) { return is_on_face(triangle); });
  }

  /// Returns whether more bodies are found than without a region.
  bool check() {
    const TriangleStream stream{std::span<const Triangle>(triangles_)};
    const FoundSolids found = find_solids(stream, {.region = region_});
    for (std::size_t i = 0; i != found.hulls(); ++i) {
      check_body(part(found.hull_corners, found.first_hull_corner, i));
    }
    for (const Box& box : found.inner_boxes) check_body(corners_of(box));
    for (std::size_t i = 0; i != found.polygons(); ++i) {
      const std::vector<Vec3> front = part(found.polygon_corners, found.first_polygon_corner, i);
      check_polygon(front,
                    found.back_corners.empty() ? front : part(found.back_corners, found.first_polygon_corner, i));
    }
    const FoundSolids anywhere = find_solids(stream);
    return found.hulls() + found.inner_boxes.size() > anywhere.hulls() + anywhere.inner_boxes.size();
  }

 private:
  static std::vector<Vec3> part(const std::vector<Vec3>& corners, const std::vector<std::size_t>& first,
                                std::size_t i) {
    return {corners.begin() + static_cast<std::ptrdiff_t>(first[i]),
            corners.begin() + static_cast<std::ptrdiff_t>(first[i + 1])};
  }

  bool is_on_face(const Triangle& triangle) const {
    for (std::size_t k = 0; k != 3; ++k) {
      for (const float face : {region_.lo[k], region_.hi[k]}) {
        if (std::all_of(triangle.vertex.begin(), triangle.vertex.end(), [&](const Vec3& v) { return v[k] == face; })) {
          return true;
        }
      }
    }
    return false;
  }

  /// A point of the region that is far away along the y axis, and may be on a face of the region.
  RationalPoint far_away() {
    Vec3 point{random_.uniform(-100, 100), random_.uniform(100, 200), random_.one_in(2) ? 150.37F : -99.1F};
    for (std::size_t k = 0; k != 3; ++k) {
      const float way = k != 1 && random_.one_in(4) ? 0 : random_.uniform(100, 200);
      if (point[k] < region_.lo[k]) point[k] = region_.lo[k] + way;
      if (point[k] > region_.hi[k]) point[k] = region_.hi[k] - way;
    }
    return exactly(point);
  }

  /// Nothing within the region gets out of a body without crossing a triangle.
  void check_body(const std::vector<Vec3>& corners) {
    if (are_in_one_plane(corners)) return;  // nothing passes through its interior
    for (int i = 0; i != 6; ++i) {
      const RationalPoint inside = between(random_, corners);
      if (!is_within(inside, region_)) continue;
      EXPECT_TRUE(crosses(inside, far_away(), triangles_));
    }
  }

  /// What the polygon hides, a triangle hides.
  void check_polygon(const std::vector<Vec3>& corners, const std::vector<Vec3>& back) {
    ASSERT_GE(corners.size(), 3U);
    const bool is_flat = are_in_one_plane(corners);
    std::vector<RationalPoint> exact;
    for (const Vec3& corner : corners) exact.push_back(exactly(corner));
    for (int i = 0; i != 6; ++i) {
      const RationalPoint on = between(random_, corners);
      const Vec3 away = random_.vec3(-1, 1);
      const float far = random_.one_in(2) ? 3.0F : 1e-5F;
      Vec3 from{};
      Vec3 to{};
      for (std::size_t k = 0; k != 3; ++k) {
        from[k] = static_cast<float>(on[k].get_d()) + far * away[k];
        to[k] = static_cast<float>(on[k].get_d()) - far * away[k];
      }
      const CompiledShaft segment = compile(Box{from, from}, Box{to, to});
      const bool is_hidden = occluded(segment, corners) && (back == corners || occluded(segment, back));
      if (is_flat && back == corners) {
        EXPECT_EQ(is_hidden, oracle::passes_through(exactly(from), exactly(to), exact));
      }
      if (is_hidden && is_within(exactly(from), region_) && is_within(exactly(to), region_)) {
        EXPECT_TRUE(crosses(exactly(from), exactly(to), triangles_));
      }
      hidden_ += is_hidden ? 1 : 0;
    }
  }

  Random random_;
  std::vector<Triangle> triangles_;
  Box region_;
  std::size_t hidden_ = 0;
};

TEST(ProvenSolids, HideNothingThatNoTriangleHides) {
  // One scene in fourteen has open bodies; builds that try few scenes go on until there were three.
  constexpr std::uint64_t fewest_with_open_bodies = 3;
  constexpr std::uint64_t most = 500;
  const std::uint64_t cases = random_cases(120);
  std::uint64_t with_open_bodies = 0;
  for (std::uint64_t seed = 1; seed <= cases || (with_open_bodies < fewest_with_open_bodies && seed <= most); ++seed) {
    SCOPED_TRACE(seed);
    with_open_bodies += ProvenSolids(seed).check() ? 1 : 0;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GE(with_open_bodies, fewest_with_open_bodies);
}

}  // namespace
}  // namespace shaftcull
