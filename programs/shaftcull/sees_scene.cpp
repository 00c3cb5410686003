// SPDX-License-Identifier: MIT
#include "sees_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "sees_occluders.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

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
  add_occluders(scene, choice, source);
  return scene;
}

}  // namespace shaftcull::cli
