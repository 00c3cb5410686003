// SPDX-License-Identifier: MIT
#include "patches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "shaftcull/error.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

constexpr double patches_across = 32;

double distance_squared(const Point3& p, const Point3& q) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) sum += (p[axis] - q[axis]) * (p[axis] - q[axis]);
  return sum;
}

/// Adds what a patch is split into.
void split_patch(const MeshPatch& patch, double size, std::vector<MeshPatch>& patches) {
  std::size_t longest = 0;
  double length = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double edge = distance_squared(patch.corner[i], patch.corner[(i + 1) % 3]);
    if (edge > length) {
      longest = i;
      length = edge;
    }
  }
  if (length <= size * size) {
    if (patches.size() == most_patches) {
      throw InvalidArgument(fmt::format("--patches {}: there would be more than {} patches; give a larger size", size,
                                        grouped(most_patches)));
    }
    patches.push_back(patch);
    return;
  }
  const std::size_t next = (longest + 1) % 3;
  Point3 middle{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    middle[axis] = patch.corner[longest][axis] / 2 + patch.corner[next][axis] / 2;
  }
  MeshPatch half = patch;
  half.corner[next] = middle;
  split_patch(half, size, patches);
  half = patch;
  half.corner[longest] = middle;
  split_patch(half, size, patches);
}

float rounded_down(double x) {
  const auto near = static_cast<float>(x);
  return near <= x ? near : std::nextafter(near, -std::numeric_limits<float>::infinity());
}

float rounded_up(double x) { return -rounded_down(-x); }

}  // namespace

double usual_patch_size(const MeshScene& scene) {
  Box all = scene.boxes.front();
  double longest = 0;
  for (const Box& box : scene.boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all.lo[axis] = std::min(all.lo[axis], box.lo[axis]);
      all.hi[axis] = std::max(all.hi[axis], box.hi[axis]);
      longest = std::max(longest, double{all.hi[axis]} - double{all.lo[axis]});
    }
  }
  return longest / patches_across;
}

std::vector<MeshPatch> split_into_patches(std::span<const MeshTriangle> triangles, double size) {
  std::vector<MeshPatch> patches;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (normal_of(triangles[i]) == Point3{}) continue;
    MeshPatch whole{{}, static_cast<std::uint32_t>(i)};
    for (std::size_t v = 0; v < 3; ++v) whole.corner[v] = in_doubles(triangles[i].vertex[v]);
    split_patch(whole, size, patches);
  }
  return patches;
}

Box box_of(const MeshPatch& patch) {
  Box box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [least, most] = std::minmax({patch.corner[0][axis], patch.corner[1][axis], patch.corner[2][axis]});
    box.lo[axis] = rounded_down(least);
    box.hi[axis] = rounded_up(most);
  }
  return box;
}

Point3 normal_of(const MeshTriangle& triangle) {
  std::array<Point3, 2> edge{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < 2; ++i) {
      edge[i][axis] = double{triangle.vertex[i + 1][axis]} - double{triangle.vertex[0][axis]};
    }
  }
  Point3 normal{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t p = (axis + 1) % 3;
    const std::size_t q = (axis + 2) % 3;
    normal[axis] = edge[0][p] * edge[1][q] - edge[0][q] * edge[1][p];
  }
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  if (length == 0) return {};
  for (double& x : normal) x = x / length + 0.0;
  return normal;
}

Plane plane_of(const MeshTriangle& triangle) {
  const Point3 normal = normal_of(triangle);
  Plane plane{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (triangle.box.lo[axis] != triangle.box.hi[axis]) continue;
    plane.normal[axis] = normal[axis] < 0 ? -1.0F : 1.0F;
    plane.offset = plane.normal[axis] * triangle.box.lo[axis];
    return plane;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) plane.normal[axis] = static_cast<float>(normal[axis]);
  double offset = -std::numeric_limits<double>::infinity();
  double size = 0;
  for (const Vec3& vertex : triangle.vertex) {
    double at = 0;
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double term = double{plane.normal[axis]} * double{vertex[axis]};
      at += term;
      sum += std::abs(term);
    }
    offset = std::max(offset, at);
    size = std::max(size, sum);
  }
  // Vertices of neighbours in the same plane are rounded to floats, too.
  offset += 0x1p-22 * size;
  constexpr double largest = std::numeric_limits<float>::max();
  plane.offset = rounded_up(std::clamp(offset, -largest, largest));
  return plane;
}

}  // namespace shaftcull::cli
