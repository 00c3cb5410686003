// SPDX-License-Identifier: MIT
// Rays through large groups of triangles, by Embree. They meet what rays meet of the same triangles in groups that are
// too small for it, but for rays that pass an edge within rounding.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <span>
#include <thread>
#include <vector>

#include <shaftcull/shaftcull.hpp>

namespace {

using shaftcull::Triangle;
using shaftcull::Vec3;

int faults = 0;

void expect(bool is_right, const char* what, double value = 0) {
  if (is_right) return;
  std::printf("%s (%g)\n", what, value);
  ++faults;
}

class Random {
 public:
  /// From `lo` to below `hi`.
  float uniform(float lo, float hi) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return lo + (hi - lo) * static_cast<float>(state_ >> 40U) * 0x1p-24F;
  }
  Vec3 point() {
    const float x = uniform(0, 1);
    const float y = uniform(0, 1);
    return {x, y, uniform(0, 1)};
  }

 private:
  std::uint64_t state_ = 11;
};

/// A wavy sheet between z = 0.3 and z = 0.7, of 2 · side² triangles.
std::vector<Triangle> sheet(int side) {
  std::vector<Triangle> triangles;
  const auto at = [&](int i, int j) {
    const float x = static_cast<float>(i) / static_cast<float>(side);
    const float y = static_cast<float>(j) / static_cast<float>(side);
    return Vec3{x, y, 0.5F + 0.1F * std::sin(9 * x) + 0.1F * std::cos(7 * y)};
  };
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      triangles.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
      triangles.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    }
  }
  return triangles;
}

std::vector<Triangle> with_holes(std::vector<Triangle> triangles, Random& random) {
  std::erase_if(triangles, [&](const Triangle&) { return random.uniform(0, 1) < 0.3F; });
  return triangles;
}

std::vector<Triangle> soup(std::size_t count, Random& random) {
  std::vector<Triangle> triangles(count);
  for (Triangle& triangle : triangles) {
    const Vec3 middle = random.point();
    const float size = std::ldexp(1.0F, -1 - static_cast<int>(random.uniform(0, 8)));
    for (Vec3& vertex : triangle.vertex) {
      for (std::size_t k = 0; k < 3; ++k) vertex[k] = middle[k] + random.uniform(-size, size);
    }
  }
  return triangles;
}

/// Where a scene is, and how large.
struct Place {
  float scale;
  float moved;

  [[nodiscard]] Vec3 operator()(Vec3 point) const {
    for (float& x : point) x = x * scale + moved;
    return point;
  }
};

/// Squares, each in a plane z = 0 or z = 1, which face each other.
shaftcull::PatchSet squares(const Place& place, Random& random) {
  std::vector<Vec3> corners;
  std::vector<std::size_t> first{0};
  for (int i = 0; i < 40; ++i) {
    const float size = std::ldexp(0.5F, -i / 8);
    const float x = random.uniform(0, 1 - size);
    const float y = random.uniform(0, 1 - size);
    const float z = i % 2 == 0 ? 0.0F : 1.0F;
    for (const Vec3& corner :
         {Vec3{x, y, z}, Vec3{x + size, y, z}, Vec3{x + size, y + size, z}, Vec3{x, y + size, z}}) {
      corners.push_back(place(corner));
    }
    first.push_back(corners.size());
  }
  return shaftcull::PatchSet(corners, first, shaftcull::PatchSides::both);
}

shaftcull::Occluders in_groups_of(std::size_t size, std::span<const Triangle> triangles) {
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < triangles.size(); i += size) first.push_back(i);
  first.push_back(triangles.size());
  shaftcull::Occluders occluders;
  occluders.add_triangles(shaftcull::TriangleStream(triangles), first);
  return occluders;
}

/// Of all pairs of an even and an odd patch, with all occluders as candidates.
std::vector<float> fractions(const shaftcull::PatchSet& patches, const shaftcull::Occluders& occluders,
                             const shaftcull::RayOptions& options) {
  std::vector<shaftcull::PatchPair> pairs;
  std::vector<std::size_t> first{0};
  std::vector<std::uint32_t> candidates;
  for (std::uint32_t i = 0; i < patches.size(); i += 2) {
    for (std::uint32_t j = 1; j < patches.size(); j += 2) {
      pairs.push_back({i, j});
      for (std::uint32_t c = 0; c < occluders.size(); ++c) candidates.push_back(c);
      first.push_back(candidates.size());
    }
  }
  std::vector<float> result(pairs.size());
  visible_fractions(patches, patches, occluders, {pairs, first, candidates}, result, options);
  return result;
}

constexpr std::size_t small_group = 500;

void compare(std::vector<Triangle> triangles, const Place& place, Random& random) {
  for (Triangle& triangle : triangles) {
    for (Vec3& vertex : triangle.vertex) vertex = place(vertex);
  }
  const shaftcull::PatchSet patches = squares(place, random);
  const shaftcull::Occluders by_us = in_groups_of(small_group, triangles);
  const shaftcull::Occluders by_embree = in_groups_of(triangles.size(), triangles);
  const std::vector<Vec3> lights{{0, 0, 1}, {0.3F, 0.2F, 1}, {0.001F, 0, -1}, {1, 0.5F, 0.7F}};
  for (const shaftcull::RayOptions& options :
       {shaftcull::RayOptions{.rays = 256}, shaftcull::RayOptions{.rays = 256, .tolerance = 0.1F * place.scale}}) {
    std::vector<float> right = fractions(patches, by_us, options);
    std::vector<float> found = fractions(patches, by_embree, options);
    std::vector<float> lit(patches.size() * lights.size());
    lit_fractions(patches, by_us, lights, lit, options);
    right.insert(right.end(), lit.begin(), lit.end());
    lit_fractions(patches, by_embree, lights, lit, options);
    found.insert(found.end(), lit.begin(), lit.end());
    double apart = 0;
    double most = 0;
    std::size_t partly = 0;
    for (std::size_t i = 0; i < right.size(); ++i) {
      const double by = std::fabs(double{right[i]} - found[i]);
      apart += by;
      most = std::max(most, by);
      if (right[i] > 0 && right[i] < 1) ++partly;
    }
    expect(most <= 2.0 / 256, "Embree's rays of a pair differ", most);
    expect(apart <= 2e-4 * static_cast<double>(right.size()), "Embree's rays differ", apart);
    expect(partly > 20, "few pairs are partly visible", static_cast<double>(partly));
  }
}

void close_sheets() {
  const Place here{1, 0};
  Random random;
  const shaftcull::PatchSet patches = squares(here, random);
  const std::vector<float> seen = fractions(patches, in_groups_of(1U << 20U, sheet(40)), {.rays = 1024});
  expect(*std::max_element(seen.begin(), seen.end()) == 0, "rays pass a sheet without holes");
}

/// A floor of many triangles hides what is below it from what is above, and nothing from a patch that lies on it.
void look_from_a_floor() {
  std::vector<Triangle> floor = sheet(20);
  for (Triangle& triangle : floor) {
    for (Vec3& vertex : triangle.vertex) vertex[2] = 0.25F;
  }
  std::vector<Vec3> corners;
  for (const float z : {0.25F, 1.0F, 0.0F, 0.25F}) {
    for (const Vec3& corner : {Vec3{0.2F, 0.2F, z}, Vec3{0.8F, 0.2F, z}, Vec3{0.8F, 0.8F, z}, Vec3{0.2F, 0.8F, z}}) {
      corners.push_back(corner);
    }
  }
  const shaftcull::PatchSet patches(corners, std::vector<std::size_t>{0, 4, 8, 12, 16}, shaftcull::PatchSides::both);
  const std::vector<float> seen = fractions(patches, in_groups_of(floor.size(), floor), {});
  expect(seen[0] == 1, "the floor hides what is above a patch on it", seen[0]);
  expect(seen[3] == 1, "the floor hides what is below a patch on it", seen[3]);
  expect(seen[2] == 0, "the floor lets rays through", seen[2]);
}

/// Embree's numbers overflow where a group is tiny beside rays.
void look_past_tiny_groups(Random& random) {
  for (const float size : {1e-15F, 1e-17F, 1e-20F, 1e-25F, 1e-35F}) {
    std::vector<Triangle> triangles = soup(800, random);
    for (Triangle& triangle : triangles) {
      for (Vec3& vertex : triangle.vertex) vertex = {vertex[0] * size, vertex[1] * size, vertex[2] * size + 0.5F};
    }
    const std::vector<float> seen = fractions(squares({1, 0}, random), in_groups_of(triangles.size(), triangles), {});
    expect(*std::min_element(seen.begin(), seen.end()) == 1, "a group that is tiny hides something", size);
  }
}

/// A wall of small triangles, in one group with a triangle far away.
void keep_details_of_large_groups() {
  for (const float far : {10.0F, 1e3F, 1e5F, 1e6F}) {
    std::vector<Triangle> triangles = sheet(20);
    for (Triangle& triangle : triangles) {
      for (Vec3& vertex : triangle.vertex) vertex = {0.002F * (vertex[0] - 0.5F), 0.002F * (vertex[1] - 0.5F), 0};
    }
    triangles.push_back({{Vec3{far, far, 0}, {far + 1, far, 0}, {far, far + 1, 1}}});
    std::vector<Vec3> corners;
    for (const float z : {-0.001F, 0.001F}) {
      for (const Vec3& corner : {Vec3{-1, -1, z}, Vec3{1, -1, z}, Vec3{1, 1, z}, Vec3{-1, 1, z}}) {
        corners.push_back({0.0005F * corner[0], 0.0005F * corner[1], z});
      }
    }
    const shaftcull::PatchSet patches(corners, std::vector<std::size_t>{0, 4, 8}, shaftcull::PatchSides::both);
    const std::vector<float> by_us = fractions(patches, in_groups_of(small_group, triangles), {});
    const std::vector<float> by_embree = fractions(patches, in_groups_of(triangles.size(), triangles), {});
    expect(std::fabs(by_us[0] - by_embree[0]) < 0.02F, "a detail of a large group is lost", far);
  }
}

/// The tree is built by the first of some threads.
void ask_on_threads() {
  Random random;
  const shaftcull::PatchSet patches = squares({1, 0}, random);
  const std::vector<Triangle> triangles = soup(20000, random);
  const shaftcull::Occluders occluders = in_groups_of(triangles.size(), triangles);
  std::vector<std::vector<float>> found(4);
  std::vector<std::thread> threads;
  for (std::vector<float>& result : found) {
    threads.emplace_back([&] { result = fractions(patches, occluders, {.rays = 16}); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<float>& result : found) expect(result == found[0], "threads find other fractions");
}

}  // namespace

int main() {
  Random random;
  for (const Place& place : {Place{1, 0}, {0x1p-100F, 0}, {0x1p100F, 0}, {10, 1000}, {0x1p-100F, -0x1p-99F}}) {
    compare(with_holes(sheet(30), random), place, random);
    compare(soup(3000, random), place, random);
  }
  close_sheets();
  look_past_tiny_groups(random);
  keep_details_of_large_groups();
  look_from_a_floor();
  ask_on_threads();
  std::printf(faults == 0 ? "rays: as expected\n" : "%d faults\n", faults);
  return faults == 0 ? 0 : 1;
}
