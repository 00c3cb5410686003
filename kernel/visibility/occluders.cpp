// SPDX-License-Identifier: MIT
#include "visibility/occluders.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shaftcull/solids.hpp"
#include "shaftcull/triangles.hpp"
#include "shaftcull/visibility.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "visibility/corner_lists.hpp"
#include "visibility/occluder_addition.hpp"
#include "visibility/triangle_groups.hpp"

namespace shaftcull {
namespace {

/// The boxes of a view, all of which are usable.
std::vector<Box> usable_boxes(const BoxView& view, const char* noun) {
  kernel::require_view(view);
  std::vector<Box> boxes(view.count);
  for (std::size_t i = 0; i != view.count; ++i) {
    boxes[i] = view[i];
    kernel::require_usable_box(boxes[i], noun, i);
  }
  return boxes;
}

std::vector<Box> usable_boxes(std::span<const Box> boxes, const char* noun) {
  kernel::require_memory(noun, boxes, "boxes");
  for (std::size_t i = 0; i != boxes.size(); ++i) kernel::require_usable_box(boxes[i], noun, i);
  return {boxes.begin(), boxes.end()};
}

/// Calls add(box around them, corners) for the corners of part after part.
template <class Add>
void add_parts(std::span<const Vec3> corners, std::span<const std::size_t> first, const char* noun, std::size_t fewest,
               std::size_t most, const Add& add) {
  kernel::require_corner_lists(corners, first, noun, fewest, most);
  for (std::size_t i = 0; i + 1 < first.size(); ++i) {
    const std::span<const Vec3> part = corners.subspan(first[i], first[i + 1] - first[i]);
    add(kernel::box_around_corners(part), part);
  }
}

/// The vertices farthest in 26 directions come first: one of them is in front of most planes that any is in front of.
void put_extremes_first(std::vector<Vec3>& vertices) {
  std::size_t put = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (put == vertices.size() || (x == 0 && y == 0 && z == 0)) continue;
        const auto along = [&](const Vec3& p) { return double{p[0]} * x + double{p[1]} * y + double{p[2]} * z; };
        const auto farthest = std::max_element(vertices.begin(), vertices.end(),
                                               [&](const Vec3& a, const Vec3& b) { return along(a) < along(b); });
        if (farthest >= vertices.begin() + static_cast<std::ptrdiff_t>(put)) std::swap(vertices[put++], *farthest);
      }
    }
  }
}

void add_found_solids(kernel::OccluderAddition& addition, const FoundSolids& found) {
  add_parts(found.hull_corners, found.first_hull_corner, "hull", 4, kernel::any_number,
            [&](const Box& box, std::span<const Vec3> hull) { addition.add_solid_hull(box, hull); });
  const std::vector<Vec3>& backs = found.back_corners;
  if (!backs.empty() && backs.size() != found.polygon_corners.size()) {
    kernel::fail(InvalidArgument("there are " + std::to_string(backs.size()) + " back_corners and " +
                                 std::to_string(found.polygon_corners.size()) +
                                 " polygon_corners; there must be as many, or none"));
  }
  if (!backs.empty()) {
    kernel::require_corner_lists(backs, found.first_polygon_corner, "back polygon", 3, kernel::any_number);
  }
  std::size_t first = 0;
  add_parts(found.polygon_corners, found.first_polygon_corner, "polygon", 3, kernel::any_number,
            [&](const Box& box, std::span<const Vec3> polygon) {
              std::span<const Vec3> back = backs.empty() ? polygon : std::span(backs).subspan(first, polygon.size());
              first += polygon.size();
              if (std::ranges::equal(polygon, back)) back = {};
              addition.add_polygon(box, polygon, back);
            });
  for (const Box& box : usable_boxes(found.inner_boxes, "box")) addition.add_inner_box(box);
}

void require_triangles(const TriangleView& triangles) {
  kernel::require_view(triangles);
  if (triangles.count > std::numeric_limits<std::uint32_t>::max()) {
    kernel::fail(InvalidArgument(std::to_string(triangles.count) + " triangles; at most 2^32 - 1 can be numbered"));
  }
  for (std::size_t i = 0; i != triangles.count; ++i) {
    for (const Vec3& vertex : triangles[i].vertex) {
      if (!kernel::is_finite(vertex)) kernel::refuse_bound("triangle", i, "is not finite");
    }
  }
}

/// Adds a group: triangles with these numbers.
void add_group(kernel::OccluderAddition& addition, const TriangleView& triangles,
               std::span<const std::uint32_t> numbers) {
  std::vector<Vec3> vertices;
  for (const std::uint32_t number : numbers) {
    addition.add_triangle(number, triangles[number]);
    for (const Vec3& vertex : triangles[number].vertex) vertices.push_back(vertex);
  }
  const Box around = kernel::box_around_corners(vertices);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  put_extremes_first(vertices);
  for (const Vec3& vertex : vertices) addition.add_point(vertex);
  addition.add(around, kernel::OccluderKind::triangles);
}

void add_groups(kernel::OccluderAddition& addition, const TriangleView& triangles,
                const kernel::TriangleGroups& groups) {
  for (std::size_t g = 0; g + 1 < groups.first.size(); ++g) {
    add_group(addition, triangles,
              std::span(groups.order).subspan(groups.first[g], groups.first[g + 1] - groups.first[g]));
  }
}

}  // namespace

kernel::MadeOnce<kernel::SolidRows>::Shared kernel::solid_rows_of(const OccluderData& occluders,
                                                                  bool solids_around_ends) {
  if (!solids_around_ends) {
    return occluders.surface_rows.of(
        [&] { return in_float_environment([&] { return surface_rows(occluders.solids, occluders.hull_boxes); }); });
  }
  return occluders.solid_rows.of([&] {
    std::vector<Box> boxes = occluders.solids;
    boxes.insert(boxes.end(), occluders.inner_boxes.begin(), occluders.inner_boxes.end());
    return in_float_environment([&] { return solid_rows(boxes, occluders.hull_boxes); });
  });
}

kernel::MadeOnce<kernel::BoxClumps>::Shared kernel::clumps_of(const OccluderData& occluders) {
  return occluders.clumps.of([&] { return box_clumps(occluders.boxes); });
}

kernel::MadeOnce<kernel::BoxClumps>::Shared kernel::polygon_clumps_of(const OccluderData& occluders) {
  return occluders.polygon_clumps.of([&] { return box_clumps(occluders.polygons); });
}

Occluders::Occluders() : data_(std::make_unique<kernel::OccluderData>()) {}
Occluders::Occluders(const Occluders& other) : data_(std::make_unique<kernel::OccluderData>(other.data())) {}
Occluders::Occluders(Occluders&& other) noexcept = default;
Occluders& Occluders::operator=(Occluders other) noexcept {
  std::swap(data_, other.data_);
  return *this;
}
Occluders::~Occluders() = default;

const kernel::OccluderData& Occluders::data() const {
  if (data_) return *data_;
  static const kernel::OccluderData none;
  return none;
}

kernel::OccluderData& Occluders::own() {
  if (!data_) data_ = std::make_unique<kernel::OccluderData>();
  return *data_;
}

// Boxes are compared and joined in modes in which denormals are what they are.

std::size_t Occluders::add_boxes(std::span<const Box> boxes) {
  return kernel::in_float_environment([&] {
    kernel::OccluderAddition addition(own());
    for (const Box& box : usable_boxes(boxes, "box")) addition.add(box, kernel::OccluderKind::box);
    return addition.keep();
  });
}

std::size_t Occluders::add_boxes(const BoxView& boxes) {
  return kernel::in_float_environment([&] { return add_boxes(std::span<const Box>(usable_boxes(boxes, "box"))); });
}

std::size_t Occluders::add_solids(std::span<const Box> boxes) {
  return kernel::in_float_environment([&] {
    kernel::OccluderAddition addition(own());
    for (const Box& solid : usable_boxes(boxes, "solid")) {
      addition.add(solid, kernel::OccluderKind::box);
      addition.add_solid(solid);
    }
    return addition.keep();
  });
}

std::size_t Occluders::add_solids(const BoxView& boxes) {
  return kernel::in_float_environment([&] { return add_solids(std::span<const Box>(usable_boxes(boxes, "solid"))); });
}

std::size_t Occluders::add_solid_hulls(std::span<const Vec3> corners, std::span<const std::size_t> first_corner) {
  return kernel::in_float_environment([&] {
    kernel::OccluderAddition addition(own());
    add_parts(corners, first_corner, "hull", 4, kernel::any_number, [&](const Box& box, std::span<const Vec3> hull) {
      addition.add_points(hull);
      addition.add(box, kernel::OccluderKind::hull);
      addition.add_solid_hull(box, hull);
    });
    return addition.keep();
  });
}

std::size_t Occluders::add_polygons(std::span<const Vec3> corners, std::span<const std::size_t> first_corner) {
  return kernel::in_float_environment([&] {
    kernel::OccluderAddition addition(own());
    add_parts(corners, first_corner, "polygon", 3, kernel::any_number,
              [&](const Box& box, std::span<const Vec3> polygon) {
                addition.add_points(polygon);
                addition.add(box, kernel::OccluderKind::polygon);
                addition.add_polygon(box, polygon);
              });
    return addition.keep();
  });
}

void Occluders::add_found(const FoundSolids& found) {
  kernel::in_float_environment([&] {
    kernel::OccluderAddition addition(own());
    add_found_solids(addition, found);
    addition.keep();
  });
}

std::size_t Occluders::add_triangles(const TriangleView& triangles, std::span<const std::size_t> first_triangle) {
  return kernel::in_float_environment([&] {
    require_triangles(triangles);
    kernel::require_memory("first_triangle", first_triangle, "positions");
    kernel::TriangleGroups groups;
    if (first_triangle.empty()) {
      groups = kernel::triangle_groups(triangles);
    } else {
      kernel::require_parts(first_triangle, triangles.count, "first_triangle", "triangles");
      for (std::size_t i = 0; i + 1 < first_triangle.size(); ++i) {
        if (first_triangle[i] != first_triangle[i + 1]) continue;
        kernel::fail(InvalidArgument("group " + std::to_string(i) + " of triangles is empty"));
      }
      groups.first.assign(first_triangle.begin(), first_triangle.end());
      groups.order.resize(triangles.count);
      std::iota(groups.order.begin(), groups.order.end(), 0U);
    }
    kernel::OccluderAddition addition(own());
    add_groups(addition, triangles, groups);
    return addition.keep();
  });
}

std::size_t Occluders::add_mesh(const TriangleView& triangles, const SolidSearch& search, FoundSolids* found) {
  return kernel::in_float_environment([&] {
    require_triangles(triangles);
    FoundSolids solids = find_solids(triangles, search);
    FoundSolids as_found;
    if (found != nullptr) as_found = solids;
    const FoundBoxes boxes = take_boxes(solids, triangles);
    std::vector<std::uint32_t> numbers;
    std::vector<Triangle> others;
    for (std::uint32_t i = 0; i != triangles.count; ++i) {
      if (boxes.box_of_triangle[i] != FoundBoxes::none) continue;
      numbers.push_back(i);
      others.push_back(triangles[i]);
    }
    kernel::TriangleGroups groups = kernel::triangle_groups(TriangleStream(others).view());
    for (std::uint32_t& number : groups.order) number = numbers[number];
    kernel::OccluderAddition addition(own());
    add_groups(addition, triangles, groups);
    for (const Box& box : boxes.boxes) {
      addition.add(box, kernel::OccluderKind::box);
      addition.add_solid(box);
    }
    add_found_solids(addition, solids);
    if (found != nullptr) *found = std::move(as_found);
    return addition.keep();
  });
}

std::size_t Occluders::add_mesh(const MeshView& mesh, const SolidSearch& search, FoundSolids* found) {
  return add_mesh(TriangleStream(mesh), search, found);
}

std::size_t Occluders::size() const noexcept { return data_ ? data_->size() : 0; }

Box Occluders::box(std::size_t i) const noexcept {
  const float(&face)[8] = data_->boxes[i].face;
  return {{face[0], face[1], face[2]}, {face[3], face[4], face[5]}};
}

std::span<const std::uint32_t> Occluders::triangles(std::size_t i) const noexcept {
  return {data_->triangles.data() + data_->first_triangle[i], data_->first_triangle[i + 1] - data_->first_triangle[i]};
}

}  // namespace shaftcull
