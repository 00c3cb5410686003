// SPDX-License-Identifier: MIT
/// sees/dense/GROUPS: all pairs of patches in a room with a body of many small triangles, each of which is a patch. An
/// item is a pair. GROUPS: `near`, the library forms groups of triangles that are near each other, and compares their
/// triangles with pairs; `one`, all triangles are one group, which is compared by its box; `near_octagons`, as `near`,
/// with walls of octagons in place of squares.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "families/sees_scene.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::bench {
namespace {

constexpr Vec3 room{10, 8, 3.5F};
constexpr unsigned belts = 20;  // of the body, from top to bottom
constexpr unsigned pieces = 2 * belts;
constexpr float patch_edge = 0.25F;

/// A point of the body, which is a sphere with bumps.
Vec3 on_body(unsigned belt, unsigned piece) {
  const double polar = std::numbers::pi * belt / belts;
  const double around = 2 * std::numbers::pi * (piece % pieces) / pieces;
  const double radius = 1 + 0.15 * std::sin(9 * polar) * std::cos(7 * around);
  const double across = radius * std::sin(polar);
  return {static_cast<float>(room[0] / 2 + across * std::cos(around)),
          static_cast<float>(room[1] / 2 + across * std::sin(around)),
          static_cast<float>(room[2] / 2 + radius * std::cos(polar))};
}

/// They face outwards.
std::vector<Triangle> body() {
  std::vector<Triangle> triangles;
  for (unsigned belt = 0; belt != belts; ++belt) {
    for (unsigned piece = 0; piece != pieces; ++piece) {
      const Vec3 above[] = {on_body(belt, piece), on_body(belt, piece + 1)};
      const Vec3 below[] = {on_body(belt + 1, piece), on_body(belt + 1, piece + 1)};
      if (belt + 1 != belts) triangles.push_back({{above[0], below[0], below[1]}});
      if (belt != 0) triangles.push_back({{above[0], below[1], above[1]}});
    }
  }
  return triangles;
}

/// The corners of a patch in a square of edge 1, counter-clockwise.
using Shape = std::vector<std::array<float, 2>>;
const Shape square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
const Shape octagon{{0.25F, 0}, {0.75F, 0}, {1, 0.25F}, {1, 0.75F}, {0.75F, 1}, {0.25F, 1}, {0, 0.75F}, {0, 0.25F}};

/// Adds patches of a wall, which face into the room.
void cut_wall(std::size_t axis, bool high, const Shape& shape, std::vector<Vec3>& corners,
              std::vector<std::size_t>& first) {
  const std::size_t across = (axis + (high ? 2 : 1)) % 3;
  const std::size_t up = (axis + (high ? 1 : 2)) % 3;
  const auto steps = [](std::size_t k) { return static_cast<unsigned>(room[k] / patch_edge); };
  for (unsigned i = 0; i != steps(across); ++i) {
    for (unsigned j = 0; j != steps(up); ++j) {
      for (const auto& [u, v] : shape) {
        Vec3& corner = corners.emplace_back();
        corner[axis] = high ? room[axis] : 0;
        corner[across] = patch_edge * (static_cast<float>(i) + u);
        corner[up] = patch_edge * (static_cast<float>(j) + v);
      }
      first.push_back(corners.size());
    }
  }
}

PatchSet patches_of(std::span<const Triangle> body, const Shape& of_walls) {
  std::vector<Vec3> corners;
  std::vector<std::size_t> first{0};
  for (const Triangle& triangle : body) {
    corners.insert(corners.end(), triangle.vertex.begin(), triangle.vertex.end());
    first.push_back(corners.size());
  }
  for (std::size_t axis = 0; axis != 3; ++axis) {
    for (const bool high : {false, true}) cut_wall(axis, high, of_walls, corners, first);
  }
  return PatchSet(corners, first);
}

}  // namespace

void declare_dense(Suite& suite) {
  for (const std::string name : {"near", "near_octagons", "one"}) {
    const std::string row = "sees/dense/" + name;
    suite.add(row, "",
              [=, &suite, noted = std::make_shared<bool>(false)](benchmark::State& state) {
                select_isa(measured_isa());
                const std::vector<Triangle> triangles = body();
                const PatchSet patches = patches_of(triangles, name == "near_octagons" ? octagon : square);
                Occluders occluders;
                const std::vector<std::size_t> all{0, triangles.size()};
                occluders.add_triangles(
                    TriangleStream(std::span<const Triangle>(triangles)),
                    name == "one" ? std::span<const std::size_t>(all) : std::span<const std::size_t>());
                SightCounts counts;
                for (auto _ : state) counts = count_visibility(patches, occluders, {.candidates = false});
                state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(counts.total()));
                if (!std::exchange(*noted, true)) {
                  suite.note(fmt::format("{}: {} triangles, {} patches, {} M pairs: {}", row, triangles.size(),
                                         patches.size(), counts.total() / 1'000'000, shares_text(counts)));
                }
              },
              {.once = true});
  }
}

}  // namespace shaftcull::bench
