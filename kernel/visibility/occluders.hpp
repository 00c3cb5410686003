// SPDX-License-Identifier: MIT
/// The contents of Occluders.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "exact/hull_mesh.hpp"
#include "kernels/siblings/siblings.hpp"
#include "shaftcull/bounds.hpp"
#include "visibility/box_clumps.hpp"
#include "visibility/made_once.hpp"
#include "visibility/ray_shapes.hpp"
#include "visibility/solid_rows.hpp"

namespace shaftcull::kernel {

/// What an occluder was added as.
enum class OccluderKind : std::uint8_t { box, hull, polygon, triangles };

struct OccluderData {
  /// Of each occluder, the box around it.
  std::vector<BoxRow> boxes;
  /// Points that an occluder is the hull of, or lies in the hull of: those of occluder i from first_point[i] on. None
  /// if it is a box.
  std::vector<Vec3> points;
  std::vector<std::size_t> first_point{0};
  /// Of each occluder.
  std::vector<OccluderKind> kinds;
  /// Triangles, as points: their numbers, the boxes around them, and their vertices.
  std::vector<std::uint32_t> triangles;
  std::vector<BoxRow> triangle_boxes;
  std::vector<std::array<Vec3, 3>> triangle_vertices;
  std::vector<std::size_t> first_triangle{0};
  /// A group of at most so many triangles reaches into a shaft only where one of them does. They are its parts.
  static constexpr std::size_t most_parts = 64;
  bool have_parts = false;  ///< some occluders

  // Blockers, numbered apart: what was found in triangles is no occluder itself.

  /// Boxes that are solid: those given, and hulls that are boxes.
  std::vector<Box> solids;
  /// Boxes inside other solids, whose faces are no surfaces of anything.
  std::vector<Box> inner_boxes;
  /// Solid hulls that are no boxes, and the box around each.
  std::vector<HullMesh> hulls;
  std::vector<BoxRow> hull_boxes;
  /// Of each polygon that makes pairs occluded, the box around it.
  std::vector<BoxRow> polygons;
  std::vector<unsigned char> polygon_is_flat;   ///< of each, exactly
  std::vector<unsigned char> polygon_is_plate;  ///< of each: the corners of its back polygon follow its own
  std::vector<Vec3> polygon_corners;
  std::vector<std::size_t> first_polygon_corner{0};
  float largest_coordinate = 0;

  /// Made of the above.
  MadeOnce<SolidRows> solid_rows;
  MadeOnce<SolidRows> surface_rows;
  MadeOnce<BoxClumps> clumps;
  MadeOnce<BoxClumps> polygon_clumps;
  MadeOnce<RayShapes> ray_shapes;

  [[nodiscard]] std::size_t size() const noexcept { return boxes.size(); }
  [[nodiscard]] std::span<const Vec3> points_of(std::size_t i) const noexcept {
    return {points.data() + first_point[i], first_point[i + 1] - first_point[i]};
  }
  [[nodiscard]] std::size_t triangles_of(std::size_t i) const noexcept {
    return first_triangle[i + 1] - first_triangle[i];
  }
  [[nodiscard]] std::size_t parts_of(std::size_t i) const noexcept {
    return triangles_of(i) <= most_parts ? triangles_of(i) : 0;
  }
  [[nodiscard]] std::span<const Vec3> polygon(std::size_t i) const noexcept {
    const std::size_t count = first_polygon_corner[i + 1] - first_polygon_corner[i];
    return {polygon_corners.data() + first_polygon_corner[i], polygon_is_plate[i] != 0 ? count / 2 : count};
  }
  /// The back polygon of a plate; empty if it is none.
  [[nodiscard]] std::span<const Vec3> back_polygon(std::size_t i) const noexcept {
    if (polygon_is_plate[i] == 0) return {};
    const std::span<const Vec3> front = polygon(i);
    return {front.data() + front.size(), front.size()};
  }
};

/// The solids, alone and together, for calls with this option (VisibilityOptions). Threads may ask at the same time.
[[nodiscard]] MadeOnce<SolidRows>::Shared solid_rows_of(const OccluderData& occluders, bool solids_around_ends);
/// Clumps of `occluders.boxes`, likewise.
[[nodiscard]] MadeOnce<BoxClumps>::Shared clumps_of(const OccluderData& occluders);
/// Clumps of `occluders.polygons`, likewise.
[[nodiscard]] MadeOnce<BoxClumps>::Shared polygon_clumps_of(const OccluderData& occluders);

}  // namespace shaftcull::kernel
