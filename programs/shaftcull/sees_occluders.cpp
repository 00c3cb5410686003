// SPDX-License-Identifier: MIT
#include "sees_occluders.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "mesh_parts.hpp"
#include "name_pattern.hpp"
#include "name_search.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/geometry.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/triangles.hpp"
#include "solid_shape.hpp"

namespace shaftcull::cli {
namespace {

constexpr std::size_t triangles_of_a_group = 32;

/// Which objects the names are of: all of that name, or those that match a pattern with * or ?.
std::vector<bool> objects_of(const MeshScene& mesh, std::span<const std::string> names, const std::string& source) {
  std::vector<bool> chosen(mesh.names.size(), false);
  for (const std::string& name : names) {
    const auto same = std::find(mesh.names.begin(), mesh.names.end(), name);
    if (same != mesh.names.end()) {
      chosen[static_cast<std::size_t>(same - mesh.names.begin())] = true;
      continue;
    }
    bool found = false;
    for (std::size_t i = 0; i < mesh.names.size(); ++i) {
      if (!matches(name, mesh.names[i])) continue;
      chosen[i] = true;
      found = true;
    }
    if (found) continue;
    throw InvalidArgument(fmt::format("--solid '{}': there is no object of that name in {}; its object{} {}", name,
                                      source, mesh.names.size() == 1 ? " is" : "s are",
                                      closest_names(name, mesh.names)));
  }
  return chosen;
}

/// The largest extent of a small patch: nine in ten are as large or larger. What is narrower than half of it hides
/// none of these.
float small_patch(std::span<const Box> patches) {
  std::vector<float> extents;
  extents.reserve(patches.size());
  for (const Box& box : patches) {
    extents.push_back(std::max({box.hi[0] - box.lo[0], box.hi[1] - box.lo[1], box.hi[2] - box.lo[2]}));
  }
  const auto small = extents.begin() + static_cast<std::ptrdiff_t>(extents.size() / 10);
  std::nth_element(extents.begin(), small, extents.end());
  return *small;
}

class OccluderMaker {
 public:
  explicit OccluderMaker(SeesScene& scene) : scene_(scene), is_covered_(scene.mesh.triangles.size(), false) {}

  void make(const std::vector<bool>& is_named, const SeesChoice& choice) {
    take_named(is_named);
    if (choice.finds_solids) find_others(choice);
    add_groups();
    add_solids();
  }

 private:
  /// Solids of one kind, each with its triangles, as positions in mesh.triangles.
  template <class Shape>
  struct Solids {
    std::vector<Shape> shapes;
    std::vector<std::vector<std::uint32_t>> triangles;
  };

  /// Takes objects that are named as solid, except for those that cannot be.
  void take_named(const std::vector<bool>& is_named) {
    std::vector<std::vector<std::uint32_t>> of_object(is_named.size());
    for (std::uint32_t i = 0; i != scene_.mesh.triangles.size(); ++i) {
      if (is_named[scene_.mesh.triangles[i].object]) of_object[scene_.mesh.triangles[i].object].push_back(i);
    }
    for (std::size_t object = 0; object < is_named.size(); ++object) {
      if (!is_named[object]) continue;
      std::vector<MeshTriangle> triangles;
      for (const std::uint32_t i : of_object[object]) triangles.push_back(scene_.mesh.triangles[i]);
      const SolidShape shape = solid_shape(triangles);
      if (!shape.refusal.empty()) {
        if (scene_.solids.skipped++ == 0) {
          scene_.solids.skipped_because = fmt::format("'{}': {}", scene_.mesh.names[object], shape.refusal);
        }
        continue;
      }
      ++scene_.solids.named;
      if (shape.is_dented) {  // its own triangles are what stands between patches
        add_hidden_hull(shape.corners);
      } else if (shape.is_box) {
        take(boxes_, scene_.mesh.boxes[object], std::move(of_object[object]));
      } else {
        take(hulls_, shape.corners, std::move(of_object[object]));
      }
    }
  }

  template <class Shape>
  void take(Solids<Shape>& solids, const Shape& shape, std::vector<std::uint32_t> triangles) {
    for (const std::uint32_t i : triangles) is_covered_[i] = true;
    solids.shapes.push_back(shape);
    solids.triangles.push_back(std::move(triangles));
  }

  void add_hidden_hull(const std::vector<Vec3>& corners) {
    FoundSolids hull;
    hull.hull_corners = corners;
    hull.first_hull_corner = {0, corners.size()};
    scene_.occluders.add_found(hull);
  }

  /// Finds solids in all other triangles. They make pairs occluded, but are no occluders, except for boxes, which take
  /// the place of the triangles that lie on them.
  void find_others(const SeesChoice& choice) {
    std::vector<Triangle> all;
    std::vector<Triangle> others;
    for (std::size_t i = 0; i != scene_.mesh.triangles.size(); ++i) {
      all.push_back({scene_.mesh.triangles[i].vertex});
      if (!is_covered_[i]) others.push_back(all.back());
    }
    // Patches that see on both sides have no inside.
    const Box region = std::accumulate(scene_.boxes.begin(), scene_.boxes.end(), scene_.boxes.front(), joined);
    FoundSolids found =
        find_solids(TriangleStream(others),
                    {.least_width = small_patch(scene_.boxes) / 2, .bodies = !choice.two_sided, .region = region});
    scene_.solids.hulls = found.hulls();
    scene_.solids.polygons = found.polygons();
    scene_.solids.inner_boxes = found.inner_boxes.size();
    const FoundBoxes boxes = take_boxes(found, TriangleStream(all));
    std::vector<std::vector<std::uint32_t>> of_box(boxes.boxes.size());
    for (std::uint32_t i = 0; i != all.size(); ++i) {
      const std::uint32_t box = boxes.box_of_triangle[i];
      if (box != FoundBoxes::none && !is_covered_[i]) of_box[box].push_back(i);
    }
    for (std::size_t i = 0; i != of_box.size(); ++i) {
      if (of_box[i].empty()) {  // all of its triangles lie on others, too: it hides, and is no occluder
        found.inner_boxes.push_back(boxes.boxes[i]);
      } else {
        take(boxes_, boxes.boxes[i], std::move(of_box[i]));
      }
    }
    scene_.occluders.add_found(found);
  }

  void add_groups() {
    std::vector<MeshTriangle> parted = scene_.mesh.triangles;
    const std::size_t parts = divide_into_parts(parted, triangles_of_a_group).size();
    std::vector<std::vector<std::uint32_t>> groups(parts);
    for (std::uint32_t i = 0; i != parted.size(); ++i) {
      if (!is_covered_[i]) groups[parted[i].part].push_back(i);
    }
    std::vector<Triangle> triangles;
    std::vector<std::size_t> first{0};
    for (std::vector<std::uint32_t>& group : groups) {
      if (group.empty()) continue;
      for (const std::uint32_t i : group) triangles.push_back({parted[i].vertex});
      first.push_back(triangles.size());
      scene_.occluder_triangles.push_back(std::move(group));
    }
    if (!triangles.empty()) scene_.occluders.add_triangles(TriangleStream(triangles).view(), first);
  }

  void add_solids() {
    std::vector<Vec3> corners;
    std::vector<std::size_t> first{0};
    for (const std::vector<Vec3>& hull : hulls_.shapes) {
      corners.insert(corners.end(), hull.begin(), hull.end());
      first.push_back(corners.size());
    }
    if (!boxes_.shapes.empty()) scene_.occluders.add_solids(boxes_.shapes);
    if (!corners.empty()) scene_.occluders.add_solid_hulls(corners, first);
    for (auto* const list : {&boxes_.triangles, &hulls_.triangles}) {
      for (std::vector<std::uint32_t>& triangles : *list) scene_.occluder_triangles.push_back(std::move(triangles));
    }
  }

  SeesScene& scene_;
  std::vector<bool> is_covered_;  ///< whether a triangle of the mesh lies in a solid
  Solids<Box> boxes_;
  Solids<std::vector<Vec3>> hulls_;
};

}  // namespace

void add_occluders(SeesScene& scene, const SeesChoice& choice, const std::string& source) {
  OccluderMaker(scene).make(objects_of(scene.mesh, choice.solid, source), choice);
}

}  // namespace shaftcull::cli
