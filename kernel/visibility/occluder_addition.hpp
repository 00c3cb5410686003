// SPDX-License-Identifier: MIT
/// Adds to the contents of Occluders, all or nothing.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "exact/polygon_cone.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/solids.hpp"
#include "solids/bodies.hpp"
#include "support/fail.hpp"
#include "visibility/corner_lists.hpp"
#include "visibility/occluders.hpp"

namespace shaftcull::kernel {

/// What is added; nothing of it stays unless it is kept at the end.
class OccluderAddition {
 public:
  explicit OccluderAddition(OccluderData& data)
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
  OccluderAddition(const OccluderAddition&) = delete;
  OccluderAddition& operator=(const OccluderAddition&) = delete;
  ~OccluderAddition() {
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
    shorten(data_.polygon_is_plate, polygons_);
    shorten(data_.polygon_corners, polygon_corners_);
    shorten(data_.first_polygon_corner, polygons_ + 1);
    data_.largest_coordinate = largest_coordinate_;
    data_.have_parts = had_parts_;
  }

  /// An occluder; its points and triangles were added before.
  void add(const Box& box, OccluderKind kind) {
    if (data_.boxes.size() == std::numeric_limits<std::uint32_t>::max()) {
      fail(InvalidArgument("there are 2^32 - 1 occluders already; no more can be numbered"));
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
    data_.triangles.push_back(number);
    data_.triangle_boxes.push_back(row_of(box_around_corners(triangle.vertex)));
    data_.triangle_vertices.push_back(triangle.vertex);
  }
  /// A polygon that makes pairs occluded; it may be an occluder or not. With a back polygon, it is a plate.
  void add_polygon(const Box& box, std::span<const Vec3> corners, std::span<const Vec3> back = {}) {
    if (data_.polygons.size() == std::numeric_limits<std::uint32_t>::max()) {
      fail(InvalidArgument("there are 2^32 - 1 polygons already; no more can be numbered"));
    }
    data_.polygons.push_back(row_of(box));
    // Lanes decide about flat polygons without the back.
    data_.polygon_is_flat.push_back(back.empty() && is_flat(corners) ? 1 : 0);
    data_.polygon_is_plate.push_back(back.empty() ? 0 : 1);
    data_.polygon_corners.insert(data_.polygon_corners.end(), corners.begin(), corners.end());
    data_.polygon_corners.insert(data_.polygon_corners.end(), back.begin(), back.end());
    data_.first_polygon_corner.push_back(data_.polygon_corners.size());
  }
  /// A solid box that makes pairs occluded; it may be an occluder or not.
  void add_solid(const Box& solid) {
    note(solid);
    data_.solids.push_back(solid);
  }
  /// A box inside a solid that has other faces: it makes pairs occluded, and is no occluder.
  void add_inner_box(const Box& box) {
    note(box);
    data_.inner_boxes.push_back(box);
  }
  /// A solid hull that makes pairs occluded, and the box inside it: this may be a part of a larger box, and hides whole
  /// groups quickly.
  void add_solid_hull(const Box& around, std::span<const Vec3> corners) {
    const Box inside = inscribed_box(spread_points(corners, ConvexHull::max_vertices));
    if (inside == around) return add_solid(inside);
    add_inner_box(inside);
    HullMesh mesh(corners);
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
  BoxRow row_of(const Box& box) noexcept {
    note(box);
    return {{box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2], 0, 0}};
  }
  template <class T>
  static void shorten(std::vector<T>& list, std::size_t size) noexcept {
    if (size < list.size()) list.erase(list.begin() + static_cast<std::ptrdiff_t>(size), list.end());
  }

  OccluderData& data_;
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

}  // namespace shaftcull::kernel
