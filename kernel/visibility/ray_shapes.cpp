// SPDX-License-Identifier: MIT
#include "visibility/ray_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "exact/hull_mesh.hpp"
#include "shaftcull/bounds.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/geometry.hpp"
#include "support/double3.hpp"
#include "support/fail.hpp"
#include "visibility/corner_lists.hpp"
#include "visibility/occluders.hpp"
#include "visibility/patch_outline.hpp"
#include "visibility/patch_tree.hpp"
#include "visibility/ray_trees.hpp"

namespace shaftcull::kernel {
namespace {

void set(float (&to)[3], const Double3& from, double divisor = 1) noexcept {
  for (std::size_t k = 0; k != 3; ++k) to[k] = static_cast<float>(from[k] / divisor);
}
void set(float (&to)[3], const Vec3& from) noexcept { std::copy(from.begin(), from.end(), to); }

}  // namespace

/// Makes the shapes of occluders one after the other.
class RayShapes::Growing {
 public:
  Growing(RayShapes& shapes, const OccluderData& occluders) : shapes_(shapes), occluders_(occluders) {}

  Shape shape_of(std::size_t occluder) {
    switch (occluders_.kinds[occluder]) {
      case OccluderKind::box: {
        const float(&face)[8] = occluders_.boxes[occluder].face;
        const bool is_flat = face[0] == face[3] || face[1] == face[4] || face[2] == face[5];
        if (!is_flat) return {Kind::box, 0, 0};
        const PatchCorners corners = outline_of_flat_box({{face[0], face[1], face[2]}, {face[3], face[4], face[5]}}, 1);
        return polygon(corners.all());
      }
      case OccluderKind::hull:
        return body(HullMesh(occluders_.points_of(occluder)));
      case OccluderKind::polygon:
        return polygon(occluders_.points_of(occluder));
      case OccluderKind::triangles: {
        const auto first = occluders_.triangle_vertices.begin();
        const auto at = [&](std::size_t i) { return first + static_cast<std::ptrdiff_t>(i); };
        some_.assign(at(occluders_.first_triangle[occluder]), at(occluders_.first_triangle[occluder + 1]));
        return tree();
      }
    }
    return {Kind::nothing, 0, 0};
  }

 private:
  static constexpr std::size_t most_in_leaf = 8;
  static constexpr std::size_t most_in_tree = 512;

  Shape body(const HullMesh& hull) {
    const auto first = static_cast<std::uint32_t>(shapes_.planes.size());
    for (const NearPlane& face : hull.faces()) {
      const std::array<Vec3, 3>& at = face.points();
      const Double3 normal = cross(between(at[0], at[1]), between(at[0], at[2]));
      RayPlane& plane = shapes_.planes.emplace_back();
      set(plane.point, at[0]);
      set(plane.normal, normal, length(normal));
    }
    const auto count = static_cast<std::uint32_t>(shapes_.planes.size()) - first;
    return {count == 0 ? Kind::nothing : Kind::body, first, count};
  }

  Shape polygon(std::span<const Vec3> corners) {
    some_.clear();
    for (std::size_t i = 2; i < corners.size(); ++i) some_.push_back({corners[0], corners[i - 1], corners[i]});
    return tree();
  }

  /// Of the triangles at hand.
  Shape tree() {
    RayTriangle unused{};
    std::erase_if(some_, [&](const TriangleVertices& vertices) { return !make_ray_triangle(vertices, unused); });
    if (some_.empty()) return {Kind::nothing, 0, 0};
    if (some_.size() > most_in_tree) return {Kind::large_group, shapes_.large_groups.add(some_), 1};
    const auto root = static_cast<std::uint32_t>(shapes_.nodes.size());
    shapes_.nodes.emplace_back();
    fill(root, some_);
    return {Kind::tree, root, 1};
  }

  void fill(std::uint32_t node, std::span<TriangleVertices> some) {
    const BoxRow box = box_around(some);
    if (some.size() <= most_in_leaf) {
      const auto first = static_cast<std::uint32_t>(shapes_.triangles.size());
      for (const TriangleVertices& vertices : some) (void)make_ray_triangle(vertices, shapes_.triangles.emplace_back());
      shapes_.nodes[node] = {box, first, static_cast<std::uint32_t>(some.size())};
      return;
    }
    const std::size_t half = some.size() / 2;
    cut_in_two(some, box, half);
    const auto children = static_cast<std::uint32_t>(shapes_.nodes.size());
    shapes_.nodes.resize(children + 2);
    shapes_.nodes[node] = {box, children, 0};
    fill(children, some.first(half));
    fill(children + 1, some.subspan(half));
  }

  RayShapes& shapes_;
  const OccluderData& occluders_;
  std::vector<TriangleVertices> some_;
};

RayShapes::RayShapes(const OccluderData& occluders) {
  Growing growing(*this, occluders);
  shapes.reserve(occluders.size());
  for (std::size_t i = 0; i != occluders.size(); ++i) {
    shapes.push_back(growing.shape_of(i));
    const float(&face)[8] = occluders.boxes[i].face;
    around = joined(around, Box{{face[0], face[1], face[2]}, {face[3], face[4], face[5]}});
  }
}

namespace {

/// Whether four corners are those of a parallelogram, but for what no ray notices.
bool is_parallelogram(std::span<const Vec3> corners) noexcept {
  if (corners.size() != 4) return false;
  const Double3 diagonal[2] = {between(corners[0], corners[2]), between(corners[1], corners[3])};
  double apart = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    apart = std::max(apart,
                     std::fabs(double{corners[0][k]} + corners[2][k] - double{corners[1][k]} - double{corners[3][k]}));
  }
  return apart * apart <= 1e-12 * (dot(diagonal[0], diagonal[0]) + dot(diagonal[1], diagonal[1]));
}

RayPatch ray_patch(std::span<const Vec3> corners, bool is_seen_from_both_sides) noexcept {
  RayPatch patch{};
  if (is_seen_from_both_sides) patch.least_rise = -HUGE_VALF;
  set(patch.corner, corners[0]);
  Double3 normal{};
  std::array<double, most_patch_corners> area{};
  double all = 0;
  for (std::size_t i = 2; i != corners.size(); ++i) {
    const Double3 of_triangle = cross(between(corners[0], corners[i - 1]), between(corners[0], corners[i]));
    for (std::size_t k = 0; k != 3; ++k) normal[k] += of_triangle[k];
    area[i - 2] = length(of_triangle);
    all += area[i - 2];
  }
  const double size = length(normal);
  if (size > 0) set(patch.normal, normal, size);
  if (is_parallelogram(corners)) {
    set(patch.edge[0], between(corners[0], corners[1]));
    set(patch.edge[1], between(corners[0], corners[3]));
    return patch;
  }
  patch.triangles = static_cast<unsigned>(corners.size() - 2);
  double before = 0;
  for (std::size_t i = 1; i != corners.size(); ++i) set(patch.edge[i - 1], between(corners[0], corners[i]));
  for (std::size_t i = 0; i != patch.triangles; ++i) {
    patch.first[i] = all > 0 ? static_cast<float>(before / all) : 0;
    patch.inverse[i] = area[i] > 0 ? static_cast<float>(all / area[i]) : 0;
    before += area[i];
  }
  return patch;
}

}  // namespace

RayPatches::RayPatches(const PatchTree& tree) : patches(tree.order().size()) {
  const bool are_seen_from_both_sides = !tree.has_planes();
  for (std::size_t position = 0; position != patches.size(); ++position) {
    const PatchCorners outline = outline_of(tree, position);
    patches[tree.order()[position]] = ray_patch(outline.all(), are_seen_from_both_sides);
    around = joined(around, box_around_corners(outline.all()));
  }
}

std::shared_ptr<const RayPatches> PatchTree::ray_patches() const {
  if (!ray_patches_) return std::make_shared<const RayPatches>(*this);
  return ray_patches_->of([&] { return RayPatches(*this); });
}

}  // namespace shaftcull::kernel
