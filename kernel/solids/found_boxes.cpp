// SPDX-License-Identifier: MIT
/// Found bodies that are upright boxes, and the triangles that lie on them.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/geometry.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/tree.hpp"
#include "shaftcull/triangles.hpp"
#include "support/arguments.hpp"
#include "support/float_environment.hpp"

namespace shaftcull {
namespace {

/// The box that a body is, if it is one.
std::optional<Box> as_box(std::span<const Vec3> corners) {
  const Box box = box_around(corners);
  std::vector<Vec3> sorted(corners.begin(), corners.end());
  std::sort(sorted.begin(), sorted.end());
  std::vector<Vec3> of_box;
  for (const float x : {box.lo[0], box.hi[0]}) {
    for (const float y : {box.lo[1], box.hi[1]}) {
      for (const float z : {box.lo[2], box.hi[2]}) of_box.push_back({x, y, z});
    }
  }
  return sorted == of_box ? std::optional(box) : std::nullopt;
}

}  // namespace

FoundBoxes take_boxes(FoundSolids& found, const TriangleView& triangles) {
  kernel::require_view(triangles);
  return kernel::in_float_environment([&] {
    FoundBoxes taken;
    std::vector<Vec3> hull_corners;
    std::vector<std::size_t> first_hull_corner{0};
    const TriangleTree all(triangles);
    const auto is_free = [&](const Box& box) {
      return !any(compile(box, box, Contact::open), all, {.triangle_test = TriangleTest::exact});
    };
    for (std::size_t i = 0; i != found.hulls(); ++i) {
      const std::size_t first = found.first_hull_corner[i];
      const std::span<const Vec3> corners =
          std::span(found.hull_corners).subspan(first, found.first_hull_corner[i + 1] - first);
      if (const std::optional<Box> box = as_box(corners); box && is_free(*box)) {
        taken.boxes.push_back(*box);
      } else {
        hull_corners.insert(hull_corners.end(), corners.begin(), corners.end());
        first_hull_corner.push_back(hull_corners.size());
      }
    }
    taken.box_of_triangle.assign(triangles.count, FoundBoxes::none);
    const BoxTree boxes{std::span<const Box>(taken.boxes)};
    std::vector<std::uint32_t> candidates;
    for (std::size_t i = 0; i != triangles.count; ++i) {
      const Box around = box_around(triangles[i].vertex);
      list(compile(around, around), boxes, candidates);
      const auto holds = [&](std::uint32_t box) { return joined(taken.boxes[box], around) == taken.boxes[box]; };
      const auto holder = std::find_if(candidates.begin(), candidates.end(), holds);
      if (holder != candidates.end()) taken.box_of_triangle[i] = *holder;
    }
    found.hull_corners = std::move(hull_corners);
    found.first_hull_corner = std::move(first_hull_corner);
    return taken;
  });
}

}  // namespace shaftcull
