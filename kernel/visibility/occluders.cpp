// SPDX-License-Identifier: MIT
#include "visibility/occluders.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "exact/polygon_cone.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/visibility.hpp"
#include "solids/bodies.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "visibility/corner_lists.hpp"
#include "visibility/triangle_groups.hpp"

namespace shaftcull {
namespace {

/// Grows by points.
struct PointBox {
  Box box{{std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
           std::numeric_limits<float>::infinity()},
          {-std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
           -std::numeric_limits<float>::infinity()}};

  void add(const Vec3& point) noexcept {
    for (std::size_t k = 0; k != 3; ++k) {
      box.lo[k] = std::min(box.lo[k], point[k]);
      box.hi[k] = std::max(box.hi[k], point[k]);
    }
  }
};

/// What is added; nothing of it stays unless it is kept at the end.
class Addition {
 public:
  explicit Addition(kernel::OccluderData& data)
      : data_(data),
        size_(data.size()),
        points_(data.points.size()),
        triangles_(data.triangles.size()),
        solids_(data.solids.size()),
        inner_boxes_(data.inner_boxes.size()),
        hulls_(data.hulls.size()),
        polygons_(data.polygons.size()),
        polygon_corners_(data.polygon_corners.size()),
        largest_coordinate_(data.largest_coordinate),
        had_parts_(data.have_parts) {}
  Addition(const Addition&) = delete;
  Addition& operator=(const Addition&) = delete;
  ~Addition() {
    if (is_kept_) return;
    shorten(data_.boxes, size_);
    shorten(data_.first_point, size_ + 1);
    shorten(data_.first_triangle, size_ + 1);
    shorten(data_.points, points_);
    shorten(data_.kinds, size_);
    shorten(data_.triangles, triangles_);
    shorten(data_.triangle_boxes, triangles_);
    shorten(data_.triangle_vertices, triangles_);
    shorten(data_.solids, solids_);
    shorten(data_.inner_boxes, inner_boxes_);
    shorten(data_.hulls, hulls_);
    shorten(data_.hull_boxes, hulls_);
    shorten(data_.polygons, polygons_);
    shorten(data_.polygon_is_flat, polygons_);
    shorten(data_.polygon_corners, polygon_corners_);
    shorten(data_.first_polygon_corner, polygons_ + 1);
    data_.largest_coordinate = largest_coordinate_;
    data_.have_parts = had_parts_;
  }

  /// An occluder; its points and triangles were added before.
  void add(const Box& box, kernel::OccluderKind kind) {
    if (data_.boxes.size() == std::numeric_limits<std::uint32_t>::max()) {
      kernel::fail(InvalidArgument("there are 2^32 - 1 occluders already; no more can be numbered"));
    }
    data_.boxes.push_back(row_of(box));
    data_.first_point.push_back(data_.points.size());
    data_.first_triangle.push_back(data_.triangles.size());
    data_.kinds.push_back(kind);
    data_.have_parts = data_.have_parts || data_.parts_of(data_.size() - 1) != 0;
  }
  void add_point(const Vec3& point) { data_.points.push_back(point); }
  void add_points(std::span<const Vec3> points) {
    data_.points.insert(data_.points.end(), points.begin(), points.end());
  }
  void add_triangle(std::uint32_t number, const Triangle& triangle) {
    PointBox around;
    for (const Vec3& vertex : triangle.vertex) around.add(vertex);
    data_.triangles.push_back(number);
    data_.triangle_boxes.push_back(row_of(around.box));
    data_.triangle_vertices.push_back(triangle.vertex);
  }
  /// A polygon that makes pairs occluded; it may be an occluder or not.
  void add_polygon(const Box& box, std::span<const Vec3> corners) {
    if (data_.polygons.size() == std::numeric_limits<std::uint32_t>::max()) {
      kernel::fail(InvalidArgument("there are 2^32 - 1 polygons already; no more can be numbered"));
    }
    data_.polygons.push_back(row_of(box));
    data_.polygon_is_flat.push_back(kernel::is_flat(corners) ? 1 : 0);
    data_.polygon_corners.insert(data_.polygon_corners.end(), corners.begin(), corners.end());
    data_.first_polygon_corner.push_back(data_.polygon_corners.size());
  }
  /// A solid box, likewise.
  void add_solid(const Box& solid) {
    note(solid);
    data_.solids.push_back(solid);
  }
  /// A box inside a solid that has other faces, likewise.
  void add_inner_box(const Box& box) {
    note(box);
    data_.inner_boxes.push_back(box);
  }
  /// A solid hull, likewise, and the box inside it: this may be a part of a larger box, and hides whole groups quickly.
  void add_solid_hull(const Box& around, std::span<const Vec3> corners) {
    const Box inside = inscribed_box(kernel::spread_points(corners, ConvexHull::max_vertices));
    if (inside == around) return add_solid(inside);
    add_inner_box(inside);
    kernel::HullMesh mesh(corners);
    if (!mesh.has_interior()) return;
    data_.hulls.push_back(std::move(mesh));
    data_.hull_boxes.push_back(row_of(around));
  }

  /// Returns the number of the first one that was added.
  std::size_t keep() noexcept {
    is_kept_ = true;
    const bool has_hulls = data_.hulls.size() != hulls_;
    const bool has_solids = has_hulls || data_.solids.size() != solids_;
    if (has_solids) data_.surface_rows.forget();
    if (has_solids || data_.inner_boxes.size() != inner_boxes_) data_.solid_rows.forget();
    if (data_.size() != size_) {
      data_.clumps.forget();
      data_.ray_shapes.forget();
    }
    if (data_.polygons.size() != polygons_) data_.polygon_clumps.forget();
    return size_;
  }

 private:
  void note(const Box& box) noexcept {
    for (const Vec3* corner : {&box.lo, &box.hi}) {
      for (const float x : *corner) data_.largest_coordinate = std::max(data_.largest_coordinate, std::fabs(x));
    }
  }
  kernel::BoxRow row_of(const Box& box) noexcept {
    note(box);
    return {{box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2], 0, 0}};
  }
  template <class T>
  static void shorten(std::vector<T>& list, std::size_t size) noexcept {
    if (size < list.size()) list.erase(list.begin() + static_cast<std::ptrdiff_t>(size), list.end());
  }

  kernel::OccluderData& data_;
  std::size_t size_;
  std::size_t points_;
  std::size_t triangles_;
  std::size_t solids_;
  std::size_t inner_boxes_;
  std::size_t hulls_;
  std::size_t polygons_;
  std::size_t polygon_corners_;
  float largest_coordinate_;
  bool had_parts_;
  bool is_kept_ = false;
};

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
    PointBox around;
    for (const Vec3& corner : part) {
      around.add(corner);
    }
    add(around.box, part);
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
    Addition addition(own());
    for (const Box& box : usable_boxes(boxes, "box")) addition.add(box, kernel::OccluderKind::box);
    return addition.keep();
  });
}

std::size_t Occluders::add_boxes(const BoxView& boxes) {
  return kernel::in_float_environment([&] { return add_boxes(std::span<const Box>(usable_boxes(boxes, "box"))); });
}

std::size_t Occluders::add_solids(std::span<const Box> boxes) {
  return kernel::in_float_environment([&] {
    Addition addition(own());
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
    Addition addition(own());
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
    Addition addition(own());
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
    Addition addition(own());
    add_parts(found.hull_corners, found.first_hull_corner, "hull", 4, kernel::any_number,
              [&](const Box& box, std::span<const Vec3> hull) { addition.add_solid_hull(box, hull); });
    add_parts(found.polygon_corners, found.first_polygon_corner, "polygon", 3, kernel::any_number,
              [&](const Box& box, std::span<const Vec3> polygon) { addition.add_polygon(box, polygon); });
    for (const Box& box : usable_boxes(found.inner_boxes, "box")) addition.add_inner_box(box);
    addition.keep();
  });
}

std::size_t Occluders::add_triangles(const TriangleView& triangles, std::span<const std::size_t> first_triangle) {
  return kernel::in_float_environment([&] {
    kernel::require_view(triangles);
    kernel::require_memory("first_triangle", first_triangle, "positions");
    if (triangles.count > std::numeric_limits<std::uint32_t>::max()) {
      kernel::fail(InvalidArgument(std::to_string(triangles.count) + " triangles; at most 2^32 - 1 can be numbered"));
    }
    for (std::size_t i = 0; i != triangles.count; ++i) {
      for (const Vec3& vertex : triangles[i].vertex) {
        if (!kernel::is_finite(vertex)) kernel::refuse_bound("triangle", i, "is not finite");
      }
    }
    kernel::TriangleGroups found;
    if (first_triangle.empty()) {
      found = kernel::triangle_groups(triangles);
      first_triangle = found.first;
    } else {
      kernel::require_parts(first_triangle, triangles.count, "first_triangle", "triangles");
      for (std::size_t i = 0; i + 1 < first_triangle.size(); ++i) {
        if (first_triangle[i] != first_triangle[i + 1]) continue;
        kernel::fail(InvalidArgument("group " + std::to_string(i) + " of triangles is empty"));
      }
    }
    Addition addition(own());
    for (std::size_t g = 0; g + 1 < first_triangle.size(); ++g) {
      PointBox around;
      std::vector<Vec3> vertices;
      for (std::size_t i = first_triangle[g]; i != first_triangle[g + 1]; ++i) {
        const std::size_t triangle = found.order.empty() ? i : found.order[i];
        addition.add_triangle(static_cast<std::uint32_t>(triangle), triangles[triangle]);
        for (const Vec3& vertex : triangles[triangle].vertex) {
          around.add(vertex);
          vertices.push_back(vertex);
        }
      }
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
      put_extremes_first(vertices);
      for (const Vec3& vertex : vertices) addition.add_point(vertex);
      addition.add(around.box, kernel::OccluderKind::triangles);
    }
    return addition.keep();
  });
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
