// SPDX-License-Identifier: MIT
#include "patches.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "shaftcull/error.hpp"
#include "shaftcull/geometry.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

constexpr double patches_across = 32;
/// By which patches grow until there are few enough: about a third fewer each time.
constexpr double growth = 1.2;

double distance_squared(const Point3& p, const Point3& q) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) sum += (p[axis] - q[axis]) * (p[axis] - q[axis]);
  return sum;
}

/// Calls take(patch) of each patch that one is split into, until it returns false. Then returns false.
template <class Take>
bool split_patch(const MeshPatch& patch, double size, const Take& take) {
  std::size_t longest = 0;
  double length = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double edge = distance_squared(patch.corner[i], patch.corner[(i + 1) % 3]);
    if (edge > length) {
      longest = i;
      length = edge;
    }
  }
  if (length <= size * size) return take(patch);
  const std::size_t next = (longest + 1) % 3;
  Point3 middle{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    middle[axis] = patch.corner[longest][axis] / 2 + patch.corner[next][axis] / 2;
  }
  MeshPatch half = patch;
  half.corner[next] = middle;
  if (!split_patch(half, size, take)) return false;
  half = patch;
  half.corner[longest] = middle;
  return split_patch(half, size, take);
}

/// Likewise of all triangles that have an area.
template <class Take>
void split_triangles(std::span<const MeshTriangle> triangles, double size, const Take& take) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (normal_of(triangles[i]) == Point3{}) continue;
    MeshPatch whole{{}, static_cast<std::uint32_t>(i)};
    for (std::size_t v = 0; v < 3; ++v) whole.corner[v] = in_doubles(triangles[i].vertex[v]);
    if (!split_patch(whole, size, take)) return;
  }
}

/// The least number of four significant digits that is not below `x`, above 0.
double rounded_up_to_digits(double x) {
  const double unit = std::pow(10, std::floor(std::log10(x)) - 3);
  // Through text, where 7143 units of 0.0001 are 0.7143.
  const double rounded = std::strtod(fmt::format("{:.3e}", std::ceil(x / unit) * unit).c_str(), nullptr);
  return std::isfinite(rounded) && rounded >= x ? rounded : x;
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
    all = joined(all, box);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      longest = std::max(longest, double{all.hi[axis]} - double{all.lo[axis]});
    }
  }
  if (longest == 0) return 1;
  double size = longest / patches_across;
  // No edge is twice as long as the scene.
  while (size < 2 * longest && count_patches(scene.triangles, size, most_usual_patches + 1) > most_usual_patches) {
    size *= growth;
  }
  return rounded_up_to_digits(size);
}

std::size_t count_patches(std::span<const MeshTriangle> triangles, double size, std::size_t most) {
  std::size_t count = 0;
  split_triangles(triangles, size, [&](const MeshPatch&) { return ++count < most; });
  return count;
}

std::vector<MeshPatch> split_into_patches(std::span<const MeshTriangle> triangles, double size) {
  std::vector<MeshPatch> patches;
  split_triangles(triangles, size, [&](const MeshPatch& patch) {
    if (patches.size() == most_patches) {
      throw InvalidArgument(fmt::format("--patches {}: there would be more than {} patches; give a larger size", size,
                                        grouped(most_patches)));
    }
    patches.push_back(patch);
    return true;
  });
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
