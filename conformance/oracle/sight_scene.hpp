// SPDX-License-Identifier: MIT
/// Random patches and what stands between them, the same on every machine for the same seed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "oracle/random.hpp"
#include "oracle/sight.hpp"
#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/triangles.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull {

/// How coordinates of a scene are chosen.
enum class SightScenery : unsigned char {
  lattice,     ///< small integers times a factor: much touches, much is in one plane
  points,      ///< likewise, and patches are points
  flat,        ///< likewise, and all is flat
  nested,      ///< boxes in boxes around one middle
  room,        ///< facets of walls, floor and ceiling, and furniture
  uniform,     ///< random floats
  nudged,      ///< integers, and the floats beside them
  near_edges,  ///< occluders that touch the faces of shafts, nearly
  wild,        ///< of any magnitude
  tiny,        ///< denormals
  huge,        ///< up to where floats end
};
inline constexpr unsigned sight_sceneries = 11;

/// Its name.
const char* name(SightScenery scenery);

/// Patches and occluders, as calls take them.
struct SightScene {
  SightScenery scenery;
  bool is_of_one_set;
  std::vector<Box> a;
  std::vector<Plane> a_planes;
  std::vector<Box> b;  ///< none if it is of one set
  std::vector<Plane> b_planes;
  std::vector<std::vector<Vec3>> a_corners{};  ///< if there are any, patches are polygons, and boxes are around them
  std::vector<std::vector<Vec3>> b_corners{};
  PatchSides sides = PatchSides::front;  ///< of these
  std::vector<Box> boxes;
  std::vector<Box> solids;
  std::vector<Vec3> hull_corners;
  std::vector<std::size_t> first_hull{0};
  std::vector<Vec3> polygon_corners;
  std::vector<std::size_t> first_polygon{0};
  std::vector<Triangle> triangles;
  std::vector<std::size_t> first_triangle;  ///< none if the library makes the groups
  FoundSolids found{};                      ///< blockers that are no occluders
  Contact contact = Contact::open;
  bool solids_around_ends = true;
  float tolerance = 0;
};

/// What polygons a set has.
enum class PolygonMix : unsigned char {
  any,           ///< of all kinds
  sides_beside,  ///< on one side of a plane sides of boxes, on the other such sides and other polygons
};

/// The scene with polygons in place of the patches of one set or of both.
SightScene with_corners(SightScene scene, std::uint64_t seed, PolygonMix mix = PolygonMix::any);

/// A scene of up to `most_patches` in each set.
SightScene random_sight_scene(SightScenery scenery, std::uint64_t seed, unsigned most_patches);

// What follows calls the library, in headers, as the oracle itself does not link it.

inline PatchSet patch_set(const std::vector<Box>& boxes, const std::vector<Plane>& planes,
                          const std::vector<std::vector<Vec3>>& polygons, PatchSides sides) {
  if (polygons.empty()) return PatchSet(std::span<const Box>(boxes), std::span<const Plane>(planes));
  std::vector<Vec3> corners;
  std::vector<std::size_t> first{0};
  for (const std::vector<Vec3>& polygon : polygons) {
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    first.push_back(corners.size());
  }
  return PatchSet(std::span<const Vec3>(corners), std::span<const std::size_t>(first), sides);
}
inline PatchSet first_set(const SightScene& scene) {
  return patch_set(scene.a, scene.a_planes, scene.a_corners, scene.sides);
}
inline PatchSet second_set(const SightScene& scene) {
  return scene.is_of_one_set ? first_set(scene) : patch_set(scene.b, scene.b_planes, scene.b_corners, scene.sides);
}

/// In the order boxes, solids, hulls, polygons, triangles.
inline Occluders occluders_of(const SightScene& scene) {
  Occluders occluders;
  occluders.add_boxes(std::span<const Box>(scene.boxes));
  occluders.add_solids(std::span<const Box>(scene.solids));
  occluders.add_solid_hulls(scene.hull_corners, scene.first_hull);
  occluders.add_polygons(scene.polygon_corners, scene.first_polygon);
  const TriangleStream triangles{std::span<const Triangle>(scene.triangles)};
  occluders.add_triangles(triangles.view(), scene.first_triangle);
  occluders.add_found(scene.found);
  return occluders;
}

/// What the oracle is to be asked. Of the library it takes which solids make a larger one, which box is inside a hull,
/// and which triangles are a group: these have tests of their own.
inline oracle::SightQuestion question_of(const SightScene& scene, const Occluders& occluders) {
  oracle::SightQuestion question;
  question.a = scene.a;
  question.a_planes = scene.a_planes;
  question.b = scene.is_of_one_set ? scene.a : scene.b;
  question.b_planes = scene.is_of_one_set ? scene.a_planes : scene.b_planes;
  question.a_corners = scene.a_corners;
  question.b_corners = scene.is_of_one_set ? scene.a_corners : scene.b_corners;
  question.both_sides = scene.sides == PatchSides::both;
  question.tolerance = scene.tolerance;
  question.contact = scene.contact;
  question.solids_around_ends = scene.solids_around_ends;
  const auto around = [](const std::vector<Vec3>& corners) {
    Box box{corners.front(), corners.front()};
    for (const Vec3& corner : corners) {
      for (std::size_t k = 0; k != 3; ++k) {
        box.lo[k] = std::min(box.lo[k], corner[k]);
        box.hi[k] = std::max(box.hi[k], corner[k]);
      }
    }
    return box;
  };
  for (const Box& box : scene.boxes) question.occluders.push_back({box, {}});
  for (const Box& box : scene.solids) question.occluders.push_back({box, {}});
  const auto for_each_part = [](const std::vector<Vec3>& corners, const std::vector<std::size_t>& first,
                                const auto& visit) {
    for (std::size_t i = 0; i + 1 < first.size(); ++i) {
      visit(std::vector<Vec3>(corners.begin() + static_cast<std::ptrdiff_t>(first[i]),
                              corners.begin() + static_cast<std::ptrdiff_t>(first[i + 1])));
    }
  };
  question.solids = scene.solids;
  const auto add_hull = [&](const std::vector<Vec3>& hull) {
    const Box inside = inscribed_box(hull);
    if (scene.solids_around_ends || inside == around(hull)) question.solids.push_back(inside);
    question.hulls.push_back(hull);
  };
  for_each_part(scene.hull_corners, scene.first_hull, [&](const std::vector<Vec3>& hull) {
    question.occluders.push_back({around(hull), hull});
    add_hull(hull);
  });
  for_each_part(scene.found.hull_corners, scene.found.first_hull_corner, add_hull);
  if (scene.solids_around_ends) {
    question.solids.insert(question.solids.end(), scene.found.inner_boxes.begin(), scene.found.inner_boxes.end());
  }
  // Each alone, and what they are together.
  const std::vector<Box> together = merged_boxes(question.solids);
  question.solids.insert(question.solids.end(), together.begin(), together.end());
  for_each_part(scene.polygon_corners, scene.first_polygon, [&](const std::vector<Vec3>& polygon) {
    question.occluders.push_back({around(polygon), polygon});
    question.polygons.push_back(polygon);
  });
  question.backs.resize(question.polygons.size());
  for_each_part(scene.found.polygon_corners, scene.found.first_polygon_corner,
                [&](const std::vector<Vec3>& polygon) { question.polygons.push_back(polygon); });
  if (!scene.found.back_corners.empty()) {
    for_each_part(scene.found.back_corners, scene.found.first_polygon_corner,
                  [&](const std::vector<Vec3>& back) { question.backs.push_back(back); });
  }
  question.backs.resize(question.polygons.size());
  for (std::size_t i = question.occluders.size(); i != occluders.size(); ++i) {
    std::vector<Vec3> vertices;
    std::vector<std::array<Vec3, 3>> looked_at;
    for (const std::uint32_t triangle : occluders.triangles(i)) {
      if (occluders.triangles(i).size() <= 64) looked_at.push_back(scene.triangles.at(triangle).vertex);
      for (const Vec3& vertex : scene.triangles.at(triangle).vertex) vertices.push_back(vertex);
    }
    question.occluders.push_back({around(vertices), vertices, looked_at});
  }
  return question;
}

}  // namespace shaftcull
