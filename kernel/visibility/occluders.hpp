// SPDX-License-Identifier: MIT
/// The contents of Occluders.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "exact/hull_mesh.hpp"
#include "kernels/siblings/siblings.hpp"
#include "shaftcull/bounds.hpp"
#include "support/threads.hpp"
#include "visibility/box_clumps.hpp"
#include "visibility/polygon_sides.hpp"
#include "visibility/solid_rows.hpp"

namespace shaftcull::kernel {

/// Something that is made when it is first asked for, by one thread while others wait. Copies share it.
template <class Made>
class MadeOnce {
 public:
  using Shared = std::shared_ptr<const Made>;

  MadeOnce() = default;
  MadeOnce(const MadeOnce& other) : made_(other.made()) {}
  MadeOnce(MadeOnce&&) = delete;
  MadeOnce& operator=(const MadeOnce&) = delete;
  MadeOnce& operator=(MadeOnce&&) = delete;
  ~MadeOnce() = default;

  /// What make() returns, which must be the same from one call to the next but for forget().
  template <class Make>
  [[nodiscard]] Shared of(const Make& make) const {
    const Lock lock(mutex_);
    if (made_ == nullptr) made_ = std::make_shared<const Made>(make());
    return made_;
  }
  /// It would be another one now. Nobody else may be asking.
  void forget() noexcept { made_.reset(); }

 private:
  [[nodiscard]] Shared made() const {
    const Lock lock(mutex_);
    return made_;
  }

  mutable Mutex mutex_;
  mutable Shared made_;
};

struct OccluderData {
  /// Of each occluder, the box around it.
  std::vector<BoxRow> boxes;
  /// Points that an occluder is the hull of, or lies in the hull of: those of occluder i from first_point[i] on. None
  /// if it is a box.
  std::vector<Vec3> points;
  std::vector<std::size_t> first_point{0};
  /// Triangles, likewise.
  std::vector<std::uint32_t> triangles;
  std::vector<std::size_t> first_triangle{0};

  /// The triangles of groups of at most `most_parts`: such a group reaches into a shaft only where one of them does.
  /// Those of occluder i from first_part[i] on, each with the box around it.
  std::vector<BoxRow> parts;
  std::vector<std::array<Vec3, 3>> part_vertices;
  std::vector<std::size_t> first_part{0};
  static constexpr std::size_t most_parts = 64;

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
  std::vector<PolygonSides> polygon_sides;  ///< of each
  std::vector<Vec3> polygon_corners;
  std::vector<std::size_t> first_polygon_corner{0};
  float largest_coordinate = 0;

  /// Made of the above.
  MadeOnce<SolidRows> solid_rows;
  MadeOnce<SolidRows> surface_rows;
  MadeOnce<BoxClumps> clumps;
  MadeOnce<BoxClumps> polygon_clumps;

  [[nodiscard]] std::size_t size() const noexcept { return boxes.size(); }
  [[nodiscard]] std::span<const Vec3> points_of(std::size_t i) const noexcept {
    return {points.data() + first_point[i], first_point[i + 1] - first_point[i]};
  }
  [[nodiscard]] std::size_t parts_of(std::size_t i) const noexcept { return first_part[i + 1] - first_part[i]; }
  [[nodiscard]] std::span<const Vec3> polygon(std::size_t i) const noexcept {
    return {polygon_corners.data() + first_polygon_corner[i], first_polygon_corner[i + 1] - first_polygon_corner[i]};
  }
};

/// The solids, alone and together, for calls with this option (VisibilityOptions). Threads may ask at the same time.
[[nodiscard]] MadeOnce<SolidRows>::Shared solid_rows_of(const OccluderData& occluders, bool solids_around_ends);
/// Clumps of `occluders.boxes`, likewise.
[[nodiscard]] MadeOnce<BoxClumps>::Shared clumps_of(const OccluderData& occluders);
/// Clumps of `occluders.polygons`, likewise.
[[nodiscard]] MadeOnce<BoxClumps>::Shared polygon_clumps_of(const OccluderData& occluders);

}  // namespace shaftcull::kernel
