// SPDX-License-Identifier: MIT
#include "shafts/hull_search.hpp"

#include <algorithm>
#include <array>

#include "exact/hull_planes.hpp"
#include "exact/small_hull.hpp"
#include "shafts/hull_plane_writer.hpp"

namespace shaftcull::kernel {
namespace {

/// What a candidate for a plane of the hull has on its two sides.
struct VertexSides {
  VertexSet in_plane = 0;
  bool beyond = false;
  bool behind = false;

  [[nodiscard]] bool is_supporting() const noexcept { return !beyond || !behind; }
  void add(unsigned vertex, int side) noexcept {
    beyond |= side > 0;
    behind |= side < 0;
    if (side == 0) in_plane |= VertexSet{1} << vertex;
  }
};

/// Compares all vertices with a plane until it is known to support the hull, or not to.
template <class Side>
VertexSides sides_of(const HullData& hull, Side side_of_vertex) noexcept {
  VertexSides sides;
  for (unsigned v = 0; v < hull.vertices && sides.is_supporting(); ++v) sides.add(v, side_of_vertex(v));
  return sides;
}

/// Sets of vertices that were found to span a plane of the hull.
class Found {
 public:
  /// Whether these vertices lie in one of the planes.
  [[nodiscard]] bool holds(VertexSet vertices) const noexcept {
    return std::any_of(set_.data(), set_.data() + count_, [&](VertexSet set) { return (vertices & ~set) == 0; });
  }
  void add(VertexSet set) noexcept { set_[count_++] = set; }

 private:
  std::array<VertexSet, HullData::most_faces + 1> set_{};
  std::size_t count_ = 0;
};

class HullSearch {
 public:
  explicit HullSearch(HullData& hull) noexcept : hull_(hull), writer_(hull) {
    find_faces();
    for (unsigned axis = 0; axis < 3; ++axis) find_edges(axis);
    writer_.finish();
  }

 private:
  void find_faces() noexcept {
    Found found;
    for (unsigned p = 0; p < hull_.points; ++p) {
      for (unsigned q = p + 1; q < hull_.vertices; ++q) {
        for (unsigned r = q + 1; r < hull_.vertices; ++r) {
          if (found.holds(VertexSet{1} << p | VertexSet{1} << q | VertexSet{1} << r)) continue;
          try_face(p, q, r, found);
        }
      }
    }
  }

  void try_face(unsigned p, unsigned q, unsigned r, Found& found) noexcept {
    const std::uint8_t vertices[3] = {static_cast<std::uint8_t>(p), static_cast<std::uint8_t>(q),
                                      static_cast<std::uint8_t>(r)};
    const SpannedPlane plane = plane_through(hull_, vertices);
    const VertexSides sides = sides_of(hull_, [&](unsigned v) {
      const Step to[3] = {step_between(hull_, p, v, 0), step_between(hull_, p, v, 1), step_between(hull_, p, v, 2)};
      return v == p || v == q || v == r ? 0 : plane.sign_along(to);
    });
    if (!sides.is_supporting()) return;
    double normal[3];
    for (unsigned k = 0; k < 3; ++k) normal[k] = plane.normal(k);
    if (normal[0] == 0 && normal[1] == 0 && normal[2] == 0) return;  // on a line
    found.add(sides.in_plane);
    if (normal[0] == 0 || normal[1] == 0 || normal[2] == 0) {  // an edge of a projection, or a face of the box
      for (unsigned k = 0; k < 3; ++k) {
        if (normal[k] == 0) faces_along_[k].add(sides.in_plane);
      }
      return;
    }
    if (!sides.beyond) writer_.add_face(vertices, normal, 1);
    if (!sides.behind) writer_.add_face(vertices, normal, -1);
  }

  void find_edges(unsigned axis) noexcept {
    Found found;
    for (unsigned p = 0; p < hull_.points; ++p) {
      for (unsigned q = p + 1; q < hull_.vertices; ++q) {
        if (!found.holds(VertexSet{1} << p | VertexSet{1} << q)) try_edge(axis, p, q, found);
      }
    }
  }

  void try_edge(unsigned axis, unsigned p, unsigned q, Found& found) noexcept {
    const ProjectedLine line(hull_, axis, p, q);
    if (!line.is_oblique()) return;  // a point, or a face of the box
    const VertexSides sides =
        sides_of(hull_, [&](unsigned v) { return v == p || v == q ? 0 : line.side_of(hull_, v); });
    if (!sides.is_supporting()) return;
    found.add(sides.in_plane);
    const bool is_face = faces_along_[axis].holds(sides.in_plane);
    if (!sides.beyond) writer_.add_edge(line, axis, p, q, 1, is_face);
    if (!sides.behind) writer_.add_edge(line, axis, p, q, -1, is_face);
  }

  HullData& hull_;
  HullPlaneWriter writer_;
  Found faces_along_[3];  ///< faces that contain a line along an axis
};

}  // namespace

void search_hull_planes(HullData& hull) noexcept { HullSearch{hull}; }

}  // namespace shaftcull::kernel
