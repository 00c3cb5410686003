// SPDX-License-Identifier: MIT
/// Solids in the triangles of a mesh, which hide only what the triangles hide.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shaftcull/error.hpp"
#include "shaftcull/geometry.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/triangles.hpp"
#include "solids/bodies.hpp"
#include "solids/flat_runs.hpp"
#include "solids/inner_boxes.hpp"
#include "solids/welded_mesh.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/padding.hpp"
#include "support/text.hpp"

namespace shaftcull {
namespace {

/// Most boxes that are kept of one part, the largest ones.
constexpr std::size_t most_inner_boxes = 16;

/// The second largest extent of a box.
double width(const Box& box) {
  std::array<double, 3> extent{};
  for (std::size_t k = 0; k != 3; ++k) extent[k] = double{box.hi[k]} - box.lo[k];
  std::sort(extent.begin(), extent.end());
  return extent[1];
}

/// Area of a polygon by the diagonal of the box around it.
double width(std::span<const Vec3> polygon) {
  std::array<double, 3> normal{};
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const auto from_first = [&](std::size_t corner, std::size_t k) {
      return double{polygon[corner][k]} - polygon[0][k];
    };
    for (std::size_t k = 0; k != 3; ++k) {
      const std::size_t a = (k + 1) % 3;
      const std::size_t b = (k + 2) % 3;
      normal[k] += (from_first(i - 1, a) * from_first(i, b) - from_first(i - 1, b) * from_first(i, a)) / 2;
    }
  }
  const Box box = box_around(polygon);
  double area = 0;
  double diagonal = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    area += normal[k] * normal[k];
    diagonal += (double{box.hi[k]} - box.lo[k]) * (double{box.hi[k]} - box.lo[k]);
  }
  return diagonal == 0 ? 0 : std::sqrt(area / diagonal);
}

class Search {
 public:
  Search(const TriangleView& triangles, const SolidSearch& search)
      : search_(search), mesh_(triangles, search.region), is_shell_(mesh_.parts().size(), false) {
    if (search.bodies) is_shell_ = kernel::shells(mesh_);
  }

  FoundSolids run() {
    const std::span<const kernel::WeldedMesh::Part> parts = mesh_.parts();
    for (std::size_t i = 0; i != parts.size(); ++i) {
      const bool may_be_body = search_.bodies && parts[i].is_closed && !is_shell_[i];
      if (may_be_body && add_body(parts[i])) continue;
      if (may_be_body) add_inner_boxes(parts[i]);
      add_polygons(parts[i]);
    }
    if (found_.back_corners == found_.polygon_corners) found_.back_corners.clear();
    return std::move(found_);
  }

 private:
  bool add_body(const kernel::WeldedMesh::Part& part) {
    const std::optional<std::vector<Vec3>> corners = convex_body(mesh_, part);
    if (!corners) return false;
    if (width(box_around(*corners)) < search_.least_width) return true;
    found_.hull_corners.insert(found_.hull_corners.end(), corners->begin(), corners->end());
    found_.first_hull_corner.push_back(found_.hull_corners.size());
    return true;
  }

  void add_inner_boxes(const kernel::WeldedMesh::Part& part) {
    if (width(part.box) < search_.least_width) return;
    std::size_t left = most_inner_boxes;
    for (const Box& box : inner_boxes(mesh_, part)) {
      if (left == 0) break;
      if (width(box) < search_.least_width) continue;
      found_.inner_boxes.push_back(box);
      --left;
    }
  }

  void add_polygons(const kernel::WeldedMesh::Part& part) {
    for (const auto& [front, back] : flat_runs(mesh_, part)) {
      if (width(front) < search_.least_width) continue;
      const std::vector<Vec3>& behind = back.empty() ? front : back;
      found_.polygon_corners.insert(found_.polygon_corners.end(), front.begin(), front.end());
      found_.back_corners.insert(found_.back_corners.end(), behind.begin(), behind.end());
      found_.first_polygon_corner.push_back(found_.polygon_corners.size());
    }
  }

  SolidSearch search_;
  kernel::WeldedMesh mesh_;
  std::vector<bool> is_shell_;
  FoundSolids found_;
};

/// `triangles` are finite.
FoundSolids find(const TriangleStream& triangles, const SolidSearch& search) {
  constexpr std::size_t most_triangles = std::size_t{1} << 30U;  // three numbers each of 32 bits
  if (triangles.size() >= most_triangles) {
    kernel::fail(InvalidArgument(std::to_string(triangles.size()) + " triangles; find_solids() takes less than 2^30"));
  }
  return kernel::in_float_environment([&] {
    if (!(search.least_width >= 0)) {
      kernel::fail(InvalidArgument("SolidSearch::least_width is " + kernel::text(search.least_width) +
                                   "; it must be 0 or more"));
    }
    for (std::size_t k = 0; k != 3; ++k) {
      const float lo = search.region.lo[k];
      const float hi = search.region.hi[k];
      if (lo <= hi || search.region == kernel::empty_box) continue;
      kernel::fail(InvalidArgument("SolidSearch::region goes from " + kernel::text(lo) + " to " + kernel::text(hi) +
                                   " on axis " + std::to_string(k)));
    }
    return Search(triangles, search).run();
  });
}

}  // namespace

FoundSolids find_solids(const TriangleView& triangles, const SolidSearch& search) {
  return find(TriangleStream(triangles), search);
}

FoundSolids find_solids(const MeshView& mesh, const SolidSearch& search) { return find(TriangleStream(mesh), search); }

}  // namespace shaftcull
