// SPDX-License-Identifier: MIT
/// The triangles around the few vertices of a HullData, exactly.
#pragma once

#include <cstdint>

#include "compiled/hull_data.hpp"
#include "exact/hull_planes.hpp"

namespace shaftcull::kernel {

/// Some vertices of a hull: bit i for vertex i.
using VertexSet = std::uint32_t;
static_assert(HullData::most_vertices <= 32);

/// A triangulation of the boundary of a hull that has an interior.
///
/// Vertices are added one by one, as HullMesh does: each takes the place of the triangles that it is in front of, as
/// seen from there. Signs of determinants decide alone. A direction is a point at infinity, so some triangles may have
/// nothing but directions: they close the hull at infinity. Everything is in place: nothing is allocated.
class SmallHull {
 public:
  static constexpr unsigned most_triangles = 2 * HullData::most_vertices - 4;

  struct Triangle {
    std::uint8_t vertex[3];  ///< in order, so the first is a point, if any is
    std::int8_t sign;        ///< 1 if they are counterclockwise as seen from outside, else −1
    VertexSet in_plane;      ///< all vertices of the hull in its plane, so triangles in one plane have the same set

    /// Vertex i of the three, counterclockwise.
    [[nodiscard]] unsigned corner(unsigned i) const noexcept { return vertex[sign > 0 || i == 0 ? i : 3 - i]; }
  };

  SmallHull() noexcept = default;  ///< has no triangles; of no hull
  /// Triangulates a hull by its vertices and points. O(n²).
  explicit SmallHull(const HullData& hull) noexcept;
  /// The same of a hull without directions but for its last vertex, if it has no other vertices than those before that
  /// one, of which there are triangles. O(n).
  SmallHull(const HullData& hull, const SmallHull& of_others) noexcept;

  /// Makes a copy that of another hull, which has the same vertices.
  void refer_to(const HullData& hull) noexcept { hull_ = &hull; }

  /// Whether triangles were found. There are none if all vertices are in one plane. Neither are there unless all
  /// directions are on one side of some plane, as far as a search for it finds one.
  [[nodiscard]] bool has_triangles() const noexcept { return count_ != 0; }
  [[nodiscard]] unsigned count() const noexcept { return count_; }
  [[nodiscard]] const Triangle& operator[](unsigned t) const noexcept { return triangle_[t]; }
  /// Whether a triangle has nothing but directions.
  [[nodiscard]] bool is_at_infinity(unsigned t) const noexcept { return triangle_[t].vertex[0] >= hull_->points; }
  /// Component k of the normal of a triangle that is not at infinity, to its front: outwards for sign 1. As that of
  /// SpannedPlane by its vertices.
  [[nodiscard]] double normal(unsigned t, unsigned k) const noexcept {
    if ((cancelled_[t] >> k & 1U) != 0) return plane_through(*hull_, triangle_[t].vertex).normal(k);
    return triangle_[t].sign * normal_[k][t];
  }
  /// Whether a vertex is in the plane of a triangle. If not, it is within the hull.
  [[nodiscard]] bool is_in_plane(unsigned vertex) const noexcept {
    VertexSet in_planes = 0;
    for (unsigned t = 0; t < count_; ++t) in_planes |= triangle_[t].in_plane;
    return (in_planes >> vertex & 1U) != 0;
  }
  /// The triangle around which the edge runs counterclockwise.
  [[nodiscard]] unsigned left_of(unsigned from, unsigned to) const noexcept { return left_of_[from][to]; }

 private:
  struct HorizonEdge {
    std::uint8_t from;
    std::uint8_t to;
    VertexSet in_plane;  ///< of the triangle from here to the vertex that is added
  };

  [[nodiscard]] bool begin(VertexSet& used) noexcept;
  void take_positions() noexcept;
  void add(unsigned vertex) noexcept;
  [[nodiscard]] std::uint64_t seen_from(unsigned vertex) noexcept;
  [[nodiscard]] int exact_side(unsigned t, unsigned vertex) const noexcept;
  void set(unsigned t, unsigned a, unsigned b, unsigned c, VertexSet in_plane) noexcept;
  void remove(unsigned t) noexcept;

  const HullData* hull_ = nullptr;
  unsigned count_ = 0;
  Triangle triangle_[most_triangles];
  std::uint8_t left_of_[HullData::most_vertices][HullData::most_vertices];
  /// A point less the first one, or a direction, in doubles.
  double position_[HullData::most_vertices][3];
  double extent_[3];  ///< no position is larger
  /// normal · position − offset of triangles, in doubles, and what it may be off by. Normals point outwards.
  double normal_[3][most_triangles];
  double offset_[most_triangles];
  double error_[most_triangles];
  std::uint8_t cancelled_[most_triangles];  ///< bit k if doubles do not say component k of the normal well enough
};

}  // namespace shaftcull::kernel
