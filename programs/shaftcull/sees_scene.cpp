// SPDX-License-Identifier: MIT
#include "sees_scene.hpp"

#include <algorithm>
#include <cmath>
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
  explicit OccluderMaker(SeesScene& scene) : scene_(scene) {}

  void make(std::vector<bool> is_solid, const SeesChoice& choice) {
    const std::vector<SolidShape> shapes = take_shapes(is_solid);
    add_groups(is_solid);
    add_solids(is_solid, shapes);
    if (choice.finds_solids) find_others(is_solid, choice);
  }

 private:
  /// The shapes of objects that are named as solid. Those that cannot be are not solid any more.
  std::vector<SolidShape> take_shapes(std::vector<bool>& is_solid) {
    std::vector<std::vector<MeshTriangle>> of_object(is_solid.size());
    for (const MeshTriangle& triangle : scene_.mesh.triangles) {
      if (is_solid[triangle.object]) of_object[triangle.object].push_back(triangle);
    }
    std::vector<SolidShape> shapes(is_solid.size());
    for (std::size_t object = 0; object < is_solid.size(); ++object) {
      if (!is_solid[object]) continue;
      shapes[object] = solid_shape(of_object[object]);
      if (shapes[object].refusal.empty()) {
        ++scene_.solids.named;
        if (shapes[object].is_dented) {  // its own triangles are what stands between patches
          add_hidden_hull(shapes[object].corners);
          is_solid[object] = false;
        }
        continue;
      }
      is_solid[object] = false;
      if (scene_.solids.skipped++ == 0) {
        scene_.solids.skipped_because = fmt::format("'{}': {}", scene_.mesh.names[object], shapes[object].refusal);
      }
    }
    return shapes;
  }

  void add_hidden_hull(const std::vector<Vec3>& corners) {
    FoundSolids hull;
    hull.hull_corners = corners;
    hull.first_hull_corner = {0, corners.size()};
    scene_.occluders.add_found(hull);
  }

  /// Solids in the triangles of all other objects. They hide, and are no occluders: their triangles are.
  void find_others(const std::vector<bool>& is_solid, const SeesChoice& choice) {
    std::vector<Triangle> triangles;
    for (const MeshTriangle& triangle : scene_.mesh.triangles) {
      if (!is_solid[triangle.object]) triangles.push_back({triangle.vertex});
    }
    // Patches that see on both sides have no inside.
    const FoundSolids found = find_solids(TriangleStream(triangles).view(),
                                          {.least_width = small_patch(scene_.boxes) / 2, .bodies = !choice.two_sided});
    scene_.occluders.add_found(found);
    scene_.solids.hulls = found.hulls();
    scene_.solids.polygons = found.polygons();
    scene_.solids.inner_boxes = found.inner_boxes.size();
  }

  void add_groups(const std::vector<bool>& is_solid) {
    std::vector<MeshTriangle> parted = scene_.mesh.triangles;
    const std::size_t parts = divide_into_parts(parted, triangles_of_a_group).size();
    std::vector<std::vector<std::uint32_t>> groups(parts);
    for (std::size_t i = 0; i < parted.size(); ++i) {
      if (!is_solid[parted[i].object]) groups[parted[i].part].push_back(static_cast<std::uint32_t>(i));
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

  void add_solids(const std::vector<bool>& is_solid, const std::vector<SolidShape>& shapes) {
    std::vector<std::vector<std::uint32_t>> of_object(is_solid.size());
    for (std::size_t i = 0; i < scene_.mesh.triangles.size(); ++i) {
      const std::uint32_t object = scene_.mesh.triangles[i].object;
      if (is_solid[object]) of_object[object].push_back(static_cast<std::uint32_t>(i));
    }
    std::vector<Box> boxes;
    std::vector<Vec3> corners;
    std::vector<std::size_t> first{0};
    std::vector<std::vector<std::uint32_t>> of_boxes;
    std::vector<std::vector<std::uint32_t>> of_hulls;
    for (std::size_t object = 0; object < is_solid.size(); ++object) {
      if (!is_solid[object]) continue;
      const SolidShape& shape = shapes[object];
      if (shape.is_box) {
        boxes.push_back(scene_.mesh.boxes[object]);
        of_boxes.push_back(std::move(of_object[object]));
      } else {
        corners.insert(corners.end(), shape.corners.begin(), shape.corners.end());
        first.push_back(corners.size());
        of_hulls.push_back(std::move(of_object[object]));
      }
    }
    if (!boxes.empty()) scene_.occluders.add_solids(boxes);
    if (!corners.empty()) scene_.occluders.add_solid_hulls(corners, first);
    for (auto* const list : {&of_boxes, &of_hulls}) {
      for (std::vector<std::uint32_t>& triangles : *list) scene_.occluder_triangles.push_back(std::move(triangles));
    }
  }

  SeesScene& scene_;
};

void scale(Box& box, double factor) {
  for (Vec3* corner : {&box.lo, &box.hi}) {
    for (float& x : *corner) x = static_cast<float>(double{x} * factor);
  }
}

/// Throws InvalidArgument if coordinates are no longer finite.
void scale(MeshScene& mesh, double factor) {
  for (double& x : mesh.origin) x *= factor;
  for (MeshTriangle& triangle : mesh.triangles) {
    scale(triangle.box, factor);
    for (Vec3& vertex : triangle.vertex) {
      for (float& x : vertex) x = static_cast<float>(double{x} * factor);
    }
  }
  for (MeshPart& part : mesh.parts) scale(part.box, factor);
  for (Box& box : mesh.boxes) {
    scale(box, factor);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (std::isfinite(box.lo[axis]) && std::isfinite(box.hi[axis])) continue;
      throw InvalidArgument(fmt::format("--scale {}: coordinates would be too large for floats", factor));
    }
  }
}

/// The least height of a triangle.
double width(const MeshPatch& patch) noexcept {
  double longest = 0;
  double normal_square = 0;
  const Point3& p = patch.corner[0];
  for (std::size_t k = 0; k != 3; ++k) {
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    const Point3& q = patch.corner[1];
    const Point3& r = patch.corner[2];
    const double n = (q[i] - p[i]) * (r[j] - p[j]) - (q[j] - p[j]) * (r[i] - p[i]);
    normal_square += n * n;
    const Point3& from = patch.corner[k];
    const Point3& to = patch.corner[i];
    longest = std::max(longest, std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]));
  }
  return std::sqrt(normal_square) / longest;
}

/// The least width of a patch that is aslant, or the size of patches.
double narrowest_slanted(const SeesScene& scene) {
  double narrowest = scene.patch_size;
  for (std::size_t i = 0; i != scene.patches.size(); ++i) {
    const Box& box = scene.boxes[i];
    const bool is_across_axis = box.lo[0] == box.hi[0] || box.lo[1] == box.hi[1] || box.lo[2] == box.hi[2];
    if (!is_across_axis) narrowest = std::min(narrowest, width(scene.patches[i]));
  }
  return narrowest;
}

/// What planes of patches of this width are off by over the whole scene, as their corners are rounded to floats. If
/// that were more than a 64th of the width, it is what planes of somewhat wider patches are off by: those of narrower
/// ones are not reliable.
float rounding_of_planes(std::span<const Box> boxes, double width) {
  Box all = boxes.front();
  float largest = 0;
  float longest = 0;
  for (const Box& box : boxes) all = joined(all, box);
  for (std::size_t k = 0; k != 3; ++k) {
    largest = std::max({largest, std::fabs(all.lo[k]), std::fabs(all.hi[k])});
    longest = std::max(longest, all.hi[k] - all.lo[k]);
  }
  const double step = double{std::nextafter(largest, std::numeric_limits<float>::infinity())} - largest;
  const double reliable = std::sqrt(64 * 2 * step * longest);
  return static_cast<float>(2 * step * std::max(1.0, longest / std::max(width, reliable)));
}

}  // namespace

PatchSet SeesScene::patch_set() const {
  std::vector<std::uint32_t> each(patches.size());
  std::iota(each.begin(), each.end(), 0U);
  return patch_set(each);
}

PatchSet SeesScene::patch_set(std::span<const std::uint32_t> some) const {
  if (!outlines.empty()) return outlines.set_of(some, planes.empty() ? PatchSides::both : PatchSides::front);
  std::vector<Box> some_boxes;
  std::vector<Plane> some_planes;
  for (const std::uint32_t patch : some) {
    some_boxes.push_back(boxes[patch]);
    if (!planes.empty()) some_planes.push_back(planes[patch]);
  }
  return PatchSet{std::span<const Box>(some_boxes), std::span<const Plane>(some_planes)};
}

SeesScene make_sees_scene(MeshScene mesh, const SeesChoice& choice, const std::string& source) {
  SeesScene scene{std::move(mesh), choice.patch_size, {}, {}, {}, {}, 0, {}, {}, {}};
  if (choice.scale != 1) scale(scene.mesh, choice.scale);
  if (choice.flip) {
    for (MeshTriangle& triangle : scene.mesh.triangles) std::swap(triangle.vertex[1], triangle.vertex[2]);
  }
  if (scene.patch_size == 0) scene.patch_size = usual_patch_size(scene.mesh);
  scene.patches = split_into_patches(scene.mesh.triangles, scene.patch_size);
  if (scene.patches.empty()) {
    throw InvalidArgument(fmt::format("{}: no triangle has an area, so there are no patches", source));
  }
  scene.boxes.reserve(scene.patches.size());
  for (const MeshPatch& patch : scene.patches) {
    scene.boxes.push_back(box_of(patch));
    if (!choice.two_sided) scene.planes.push_back(plane_of(scene.mesh.triangles[patch.triangle]));
  }
  scene.outlines = outlines_of(scene.mesh.triangles, scene.patches, scene.boxes);
  if (!scene.outlines.are_boxes) {
    scene.tolerance = rounding_of_planes(scene.boxes, narrowest_slanted(scene));
  } else if (!choice.two_sided) {
    scene.outlines = {};  // boxes with planes are the same, and compared faster
  }
  OccluderMaker(scene).make(objects_of(scene.mesh, choice.solid, source), choice);
  return scene;
}

}  // namespace shaftcull::cli
