// SPDX-License-Identifier: MIT
/// Triangles with shared vertices, each edge with the triangle across it, and the connected parts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "exact/orientation.hpp"
#include "shaftcull/bounds.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::kernel {

/// A face of the region in which all patches lie.
struct RegionFace {
  unsigned axis;
  bool is_hi;
  float coordinate;

  /// Whether a point is on the face or beyond it.
  [[nodiscard]] bool excludes(const Vec3& point) const noexcept {
    return is_hi ? point[axis] >= coordinate : point[axis] <= coordinate;
  }
};

/// The six faces of a region.
[[nodiscard]] std::vector<RegionFace> faces_of(const Box& region);

/// Triangle t has the edges 3 t, 3 t + 1 and 3 t + 2: edge 3 t + i leads from its vertex i to the next one.
class WeldedMesh {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// Consecutive triangles that are connected across edges.
  struct Part {
    std::uint32_t first;
    std::uint32_t end;
    Box box;
    /// Whether every edge has another one across, or lies on or beyond one face of the region. Then the part and a
    /// surface beyond that face bound a solid.
    bool is_closed;
    std::optional<RegionFace> open_at;  ///< that face, if the part has such edges
  };

  /// Welds vertices at the same position, −0 and 0 being the same. Leaves out triangles that repeat a vertex, and those
  /// that repeat a triangle. Triangles on or beyond one face of the region, the ground, are left out, too: segments
  /// within the region do not pass through them. Of the faces on which most triangles stand, it is the one that gives
  /// the most closed parts. All coordinates are finite, and there are fewer than 2³⁰ triangles. O(n log n).
  WeldedMesh(const TriangleView& triangles, const Box& region);

  [[nodiscard]] std::span<const Part> parts() const noexcept { return parts_; }
  [[nodiscard]] std::size_t edges() const noexcept { return 3 * corner_.size(); }
  [[nodiscard]] std::uint32_t vertex(std::uint32_t edge) const noexcept { return corner_[edge / 3][edge % 3]; }
  [[nodiscard]] const Vec3& position(std::uint32_t vertex) const noexcept { return position_[vertex]; }
  /// Where an edge starts.
  [[nodiscard]] const Vec3& start(std::uint32_t edge) const noexcept { return position_[vertex(edge)]; }
  [[nodiscard]] static std::uint32_t next(std::uint32_t edge) noexcept { return edge % 3 == 2 ? edge - 2 : edge + 1; }
  /// The same edge of another triangle, in the other direction; `none` if there is no such triangle, or if it is
  /// unclear which one of several is meant.
  [[nodiscard]] std::uint32_t across(std::uint32_t edge) const noexcept { return across_[edge]; }
  /// The plane of a triangle. Its front is where the vertices run counterclockwise.
  [[nodiscard]] SpannedPlane plane(std::uint32_t triangle) const noexcept;
  /// Whether the three vertices are on one line.
  [[nodiscard]] bool is_degenerate(std::uint32_t triangle) const noexcept;

 private:
  std::vector<std::uint32_t> weld(const TriangleView& triangles);
  [[nodiscard]] std::ptrdiff_t excluded(const RegionFace& face, const std::array<std::uint32_t, 3>& corner) const;
  [[nodiscard]] std::vector<RegionFace> grounds_in(const Box& region) const;
  [[nodiscard]] std::ptrdiff_t closed_parts() const;
  void connect();
  void pair_crowded(std::span<const std::uint32_t> edges);
  void part_at_faces(std::span<const RegionFace> faces, const std::vector<bool>& is_of_ground);
  void sort_into_parts(const Box& region, const std::optional<RegionFace>& ground);

  std::vector<Vec3> position_;
  std::vector<std::array<std::uint32_t, 3>> corner_;  ///< of each triangle, in the order of the parts
  std::vector<std::uint32_t> across_;
  std::vector<Part> parts_;
};

}  // namespace shaftcull::kernel
