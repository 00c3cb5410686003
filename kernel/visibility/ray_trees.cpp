// SPDX-License-Identifier: MIT
#include "visibility/ray_trees.hpp"

#include <algorithm>
#include <cmath>

#include "support/double3.hpp"

namespace shaftcull::kernel {
namespace {

void write(float (&to)[3], const Double3& from, double divisor) noexcept {
  for (std::size_t k = 0; k != 3; ++k) to[k] = static_cast<float>(from[k] / divisor);
}

/// Some triangles, and the box around them.
struct TriangleRange {
  std::span<TriangleVertices> triangles;
  BoxRow box;

  explicit TriangleRange(std::span<TriangleVertices> some) noexcept : triangles(some), box(box_around(some)) {}

  [[nodiscard]] bool fills_more_than_a_leaf() const noexcept { return triangles.size() > tree_lanes; }
  /// Of the box.
  [[nodiscard]] double area() const noexcept {
    double extent[3];
    for (std::size_t k = 0; k != 3; ++k) extent[k] = double{box.face[k + 3]} - box.face[k];
    return extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0];
  }
};

/// Cuts the largest parts in two, until there are as many as a node has children.
std::vector<TriangleRange> children_of(std::span<TriangleVertices> triangles) {
  std::vector<TriangleRange> parts{TriangleRange(triangles)};
  parts.reserve(tree_lanes);
  while (parts.size() != tree_lanes) {
    TriangleRange* largest = nullptr;
    for (TriangleRange& part : parts) {
      if (!part.fills_more_than_a_leaf()) continue;
      if (largest == nullptr || part.area() > largest->area()) largest = &part;
    }
    if (largest == nullptr) break;
    // So that leaves are full, and nodes above them as well.
    constexpr std::size_t of_node = std::size_t{tree_lanes} * tree_lanes;
    const std::span<TriangleVertices> some = largest->triangles;
    const std::size_t unit = some.size() > of_node ? of_node : tree_lanes;
    const std::size_t half = ((some.size() + unit - 1) / unit + 1) / 2 * unit;
    cut_in_two(some, largest->box, half);
    *largest = TriangleRange(some.first(half));
    parts.emplace_back(some.subspan(half));
  }
  return parts;
}

}  // namespace

bool make_ray_triangle(const TriangleVertices& vertices, RayTriangle& triangle) noexcept {
  const Double3 u = between(vertices[0], vertices[1]);
  const Double3 v = between(vertices[0], vertices[2]);
  const Double3 normal = cross(u, v);
  const double square = dot(normal, normal);
  if (!(square > 0)) return false;
  std::copy(vertices[0].begin(), vertices[0].end(), triangle.point);
  write(triangle.normal, normal, std::sqrt(square));
  write(triangle.across_u, cross(v, normal), square);
  write(triangle.across_v, cross(normal, u), square);
  return true;
}

BoxRow box_around(std::span<const TriangleVertices> triangles) noexcept {
  BoxRow box{{HUGE_VALF, HUGE_VALF, HUGE_VALF, -HUGE_VALF, -HUGE_VALF, -HUGE_VALF, 0, 0}};
  for (const TriangleVertices& vertices : triangles) {
    for (const Vec3& vertex : vertices) {
      for (std::size_t k = 0; k != 3; ++k) {
        box.face[k] = std::min(box.face[k], vertex[k]);
        box.face[k + 3] = std::max(box.face[k + 3], vertex[k]);
      }
    }
  }
  return box;
}

void cut_in_two(std::span<TriangleVertices> triangles, const BoxRow& box, std::size_t first_part) {
  std::size_t axis = 0;
  const auto extent = [&](std::size_t k) { return box.face[k + 3] - box.face[k]; };
  for (std::size_t k = 1; k != 3; ++k) axis = extent(k) > extent(axis) ? k : axis;
  const auto middle = [axis](const TriangleVertices& of) { return double{of[0][axis]} + of[1][axis] + of[2][axis]; };
  std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(first_part), triangles.end(),
                   [&](const TriangleVertices& a, const TriangleVertices& b) { return middle(a) < middle(b); });
}

std::uint32_t RayTrees::add(std::span<TriangleVertices> triangles) {
  const auto root = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  fill(root, triangles);
  return root;
}

void RayTrees::fill(std::uint32_t node, std::span<TriangleVertices> triangles) {
  const std::vector<TriangleRange> children = children_of(triangles);
  RayTreeNode filled{};
  filled.children = static_cast<std::uint32_t>(children.size());
  for (std::size_t i = 0; i != children.size(); ++i) {
    for (std::size_t k = 0; k != 6; ++k) filled.face[k][i] = children[i].box.face[k];
    if (children[i].fills_more_than_a_leaf()) {
      filled.child[i] = static_cast<std::uint32_t>(nodes_.size());
      nodes_.emplace_back();
    } else {
      filled.child[i] = add_leaf(children[i].triangles);
      filled.triangles[i] = static_cast<std::uint8_t>(children[i].triangles.size());
      filled.leaves |= 1U << i;
    }
  }
  nodes_[node] = filled;
  for (std::size_t i = 0; i != children.size(); ++i) {
    if (children[i].fills_more_than_a_leaf()) fill(filled.child[i], children[i].triangles);
  }
}

std::uint32_t RayTrees::add_leaf(std::span<const TriangleVertices> triangles) {
  RayTreeLeaf leaf{};
  for (std::size_t i = 0; i != triangles.size(); ++i) {
    RayTriangle triangle{};
    (void)make_ray_triangle(triangles[i], triangle);
    for (std::size_t k = 0; k != 3; ++k) {
      leaf.point[k][i] = triangle.point[k];
      leaf.normal[k][i] = triangle.normal[k];
      leaf.across_u[k][i] = triangle.across_u[k];
      leaf.across_v[k][i] = triangle.across_v[k];
    }
  }
  leaves_.push_back(leaf);
  return static_cast<std::uint32_t>(leaves_.size() - 1);
}

}  // namespace shaftcull::kernel
