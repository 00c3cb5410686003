// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "hashes/cases.hpp"
#include "hashes/digest.hpp"
#include "hashes/hashes.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::hashes {
namespace {

/// Triangles between two outlines, and on the first and the last side. Faces look outwards if the outline turns left as
/// seen against `up`.
void add_prism(const std::vector<Vec3>& outline, const Vec3& up, std::vector<Triangle>& to) {
  const auto above = [&](const Vec3& p) { return Vec3{p[0] + up[0], p[1] + up[1], p[2] + up[2]}; };
  for (std::size_t i = 0; i != outline.size(); ++i) {
    const Vec3& p = outline[i];
    const Vec3& q = outline[(i + 1) % outline.size()];
    to.push_back({{p, q, above(q)}});
    to.push_back({{p, above(q), above(p)}});
    if (i < 2) continue;
    to.push_back({{above(outline[0]), above(outline[i - 1]), above(p)}});
    to.push_back({{outline[0], p, outline[i - 1]}});
  }
}

/// A block with four, six or seven sides: upright and with coordinates on a lattice, or turned, or with a dent, or of
/// any floats.
void add_block(Numbers& numbers, std::size_t scene, std::vector<Triangle>& to) {
  const Vec3 at = point(numbers, &Numbers::grid);
  const auto size = static_cast<float>(1 + numbers.below(3));
  constexpr std::array<std::array<float, 2>, 17> outlines{{{0, 0},
                                                           {2, 0},
                                                           {2, 1},
                                                           {0, 1},  // box
                                                           {1, 1},
                                                           {1, 2},
                                                           {0, 2},
                                                           {0, 0},
                                                           {2, 0},
                                                           {2, 1},  // L
                                                           {0, 0},
                                                           {2, -1},
                                                           {3, 0},
                                                           {4, 2},
                                                           {3, 3},
                                                           {1, 3},
                                                           {0, 2}}};
  constexpr std::array<std::size_t, 4> first{0, 4, 10, 17};
  const auto which = static_cast<std::size_t>(numbers.below(3));
  const bool is_turned = numbers.below(2) == 0;
  std::vector<Vec3> outline;
  for (std::size_t i = first[which]; i != first[which + 1]; ++i) {
    const auto [x, y] = outlines[i];
    Vec3 p{at[0] + size * x, at[1] + size * y, at[2]};
    if (is_turned)
      p = {at[0] + 0.75F * size * x - 0.625F * size * y, at[1] + 0.625F * size * x + 0.75F * size * y, at[2]};
    if (numbers.below(12) == 0) p[static_cast<std::size_t>(numbers.below(3))] += 0.25F;
    if (is_wild(scene) && numbers.below(3) == 0) p = point(numbers, &Numbers::any);
    if (scene % 3 == 0) {
      for (float& x_of : p) x_of = numbers.near(x_of);
    }
    outline.push_back(p);
  }
  const std::size_t before = to.size();
  add_prism(outline, {0, 0, size}, to);
  if (numbers.below(4) != 0) return;
  for (std::size_t i = before; i != to.size(); ++i) std::swap(to[i].vertex[0], to[i].vertex[1]);
}

}  // namespace

/// What is found in blocks that touch and cut each other, some of which are no bodies.
std::uint64_t found_solids(std::uint64_t scenes, Way /*way*/) {
  constexpr int most_blocks = 5;
  Numbers numbers;
  Digest digest;
  for (std::uint64_t s = 0; s != scenes; ++s) {
    std::vector<Triangle> triangles;
    for (int left = 1 + numbers.below(most_blocks); left != 0; --left) add_block(numbers, s, triangles);
    for (int left = numbers.below(3); left != 0; --left) {
      triangles.erase(triangles.begin() + numbers.below(static_cast<int>(triangles.size())));
    }
    const TriangleStream stream{std::span<const Triangle>(triangles)};
    const FoundSolids found = find_solids(stream, {.bodies = s % 7 != 0});
    for (const auto* const corners : {&found.hull_corners, &found.polygon_corners}) {
      digest.add(corners->size());
      for (const Vec3& corner : *corners) digest.add_box({corner, corner});
    }
    for (const Vec3& corner : found.back_corners) digest.add_box({corner, corner});
    for (const auto* const first : {&found.first_hull_corner, &found.first_polygon_corner}) {
      for (const std::size_t corner : *first) digest.add(corner);
    }
    for (const Box& box : found.inner_boxes) digest.add_box(box);
  }
  return digest.value();
}

}  // namespace shaftcull::hashes
