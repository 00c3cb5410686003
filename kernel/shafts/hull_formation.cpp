// SPDX-License-Identifier: MIT
#include "shafts/hull_formation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "exact/hull_planes.hpp"
#include "shafts/plane_groups.hpp"

namespace shaftcull::kernel {
namespace {

/// Which vertices lie in a plane: bit i for vertex i.
using VertexSet = std::uint32_t;
static_assert(HullData::most_vertices <= 32);

/// What a candidate for a plane of the hull has on its two sides.
struct Sides {
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
Sides sides_of(const HullData& hull, Side side_of_vertex) noexcept {
  Sides sides;
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

/// A normal in doubles, outwards, with the axes of its coordinates.
struct Normal {
  unsigned coordinates;
  unsigned axis[3];
  double component[3];
};

/// form_hull(), while it runs.
class HullFormation {
 public:
  explicit HullFormation(HullData& hull) noexcept : hull_(hull) {
    hull_.is_bounded = hull_.points == hull_.vertices;
    hull_.suits_floats = true;
    hull_.farthest = std::numeric_limits<float>::max();
    find_box();
    find_faces();
    put_parallel_faces_last();
    for (unsigned axis = 0; axis < 3; ++axis) find_edges(axis);
  }

 private:
  void find_box() noexcept {
    for (unsigned k = 0; k < 3; ++k) {
      hull_.box[k] = std::numeric_limits<float>::infinity();
      hull_.box[k + 3] = -std::numeric_limits<float>::infinity();
      for (unsigned v = 0; v < hull_.points; ++v) {
        hull_.box[k] = std::min(hull_.box[k], hull_.vertex[v][k]);
        hull_.box[k + 3] = std::max(hull_.box[k + 3], hull_.vertex[v][k]);
      }
      for (unsigned v = hull_.points; v < hull_.vertices; ++v) {
        if (hull_.vertex[v][k] < 0) hull_.box[k] = -std::numeric_limits<float>::infinity();
        if (hull_.vertex[v][k] > 0) hull_.box[k + 3] = std::numeric_limits<float>::infinity();
      }
    }
  }

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
    const auto vertex = [](unsigned v) { return static_cast<std::uint8_t>(v); };
    const SpannedPlane plane = plane_through(hull_, {vertex(p), vertex(q), vertex(r)});
    const Sides sides = sides_of(hull_, [&](unsigned v) {
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
    const Normal outward{3, {0, 1, 2}, {normal[0], normal[1], normal[2]}};
    const auto add = [&](int sign) { add_plane(hull_.faces++, outward, sign, {vertex(p), vertex(q), vertex(r)}, 3); };
    if (!sides.beyond) add(1);
    if (!sides.behind) add(-1);
  }

  /// Corners that were rounded, as those of views are, are seldom in one plane: then what is meant to be one face is
  /// two, or more. Nearly all boxes that are beyond one of these are beyond the other.
  void put_parallel_faces_last() noexcept {
    hull_.apart = 0;
    for (unsigned f = 0; f < hull_.faces; ++f) {
      const bool is_apart = std::none_of(hull_.plane, hull_.plane + hull_.apart, [&](const HullData::Plane& other) {
        return are_nearly_parallel(hull_.plane[f], other);
      });
      if (is_apart) std::swap(hull_.plane[f], hull_.plane[hull_.apart++]);
    }
  }

  static bool are_nearly_parallel(const HullData::Plane& one, const HullData::Plane& other) noexcept {
    double cosine = 0;
    for (unsigned k = 0; k < 3; ++k) cosine += static_cast<double>(one.inward[k]) * other.inward[k];
    constexpr double least = 1 - 0x1p-16;  // a third of a degree
    return cosine > least * one.length * other.length;
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
    const double normal[2] = {line.along[1].rounded(), -line.along[0].rounded()};
    if (normal[0] == 0 || normal[1] == 0) return;  // a point, or a face of the box
    const Sides sides = sides_of(hull_, [&](unsigned v) {
      if (v == p || v == q) return 0;
      const double x = hull_.vertex[v][line.i];
      const double y = hull_.vertex[v][line.j];
      return v < hull_.points ? line.side(x, y) : line.side_of_direction(x, y);
    });
    if (!sides.is_supporting()) return;
    found.add(sides.in_plane);
    const Normal outward{2, {line.i, line.j, 0}, {normal[0], normal[1], 0}};
    const std::uint8_t vertices[3] = {static_cast<std::uint8_t>(p), static_cast<std::uint8_t>(q), 0};
    const bool is_face = faces_along_[axis].holds(sides.in_plane);
    const auto add = [&](int sign) {
      const unsigned number = hull_.faces + hull_.edges++;
      add_plane(number, outward, sign, vertices, axis);
      if (is_face) std::swap(hull_.plane[number], hull_.plane[hull_.faces + hull_.face_edges++]);
    };
    if (!sides.beyond) add(1);
    if (!sides.behind) add(-1);
  }

  /// Writes the plane with this number. Its normal is `outward` for sign 1, and the opposite for −1.
  void add_plane(unsigned number, const Normal& outward, int sign, const std::uint8_t (&vertices)[3],
                 unsigned axis) noexcept {
    HullData::Plane& plane = hull_.plane[number];
    std::copy_n(vertices, 3, plane.vertices);
    plane.axis = static_cast<std::uint8_t>(axis);
    plane.sign = static_cast<std::int8_t>(sign);
    const unsigned n = outward.coordinates;
    double largest = 0;
    for (unsigned i = 0; i < n; ++i) largest = std::max(largest, std::fabs(outward.component[i]));
    // A normal with components between 1 and 2, or below, and what its terms may amount to.
    const double scale = std::ldexp(-sign, -std::ilogb(largest));
    double offset = 0;
    double square = 0;
    double terms = 0;  // of the vertex
    double most = 0;   // terms of any corner of the box
    double widths = 0;
    for (unsigned i = 0; i < n; ++i) {
      const unsigned k = outward.axis[i];
      const auto inward = static_cast<float>(outward.component[i] * scale);
      plane.inward[i] = inward;
      // By the sign of the component itself: as a float it may be 0.
      plane.near[i] = static_cast<std::uint8_t>(sign * outward.component[i] > 0 ? k : k + 3);
      const double magnitude = std::fabs(static_cast<double>(inward));
      hull_.suits_floats = hull_.suits_floats && magnitude >= smallest_component;
      const double term = static_cast<double>(inward) * hull_.vertex[vertices[0]][k];
      offset -= term;
      terms += std::fabs(term);
      square += magnitude * magnitude;
      const double lo = hull_.box[k];
      const double hi = hull_.box[k + 3];
      most += magnitude * std::max(std::fabs(lo), std::fabs(hi));
      widths += magnitude * (hi - lo);
    }
    int exponent = 0;
    double margin = 0;
    if (hull_.is_bounded) {
      margin = 1;
      std::frexp(unit * (17 * widths + 8 * std::fabs(offset) + 5 * most) * 1.02, &exponent);
    }
    hull_.suits_floats = hull_.suits_floats && std::abs(exponent) < most_exponent && terms < largest_terms;
    const double back = std::ldexp(1.0, -exponent);
    for (unsigned i = 0; i < n; ++i) {
      plane.inward[i] = static_cast<float>(plane.inward[i] * back);
      const double farthest = largest_term / std::fabs(static_cast<double>(plane.inward[i]));
      if (farthest < static_cast<double>(hull_.farthest)) hull_.farthest = static_cast<float>(farthest);
    }
    plane.offset = static_cast<float>(offset * back + margin);
    plane.length = static_cast<float>(std::sqrt(square) * back);
    plane.magnitude = static_cast<float>((terms + std::fabs(offset)) * back * (1 + 0x1p-20) + least_magnitude);
  }

  static constexpr double unit = 0x1p-24;  // of a float
  static constexpr double smallest_component = 0x1p-60;
  static constexpr double largest_terms = 0x1p60;
  static constexpr int most_exponent = 60;
  static constexpr double largest_term = 0x1p125;
  /// So that a margin relative to it is more than what products that are denormal are off by.
  static constexpr double least_magnitude = 0x1p-120;

  HullData& hull_;
  Found faces_along_[3];  ///< faces that contain a line along an axis
};

}  // namespace

void form_hull(HullData& hull) noexcept {
  HullFormation{hull};
  write_plane_groups(hull);
}

}  // namespace shaftcull::kernel
