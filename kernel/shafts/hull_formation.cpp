// SPDX-License-Identifier: MIT
#include "shafts/hull_formation.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "exact/hull_planes.hpp"
#include "exact/small_hull.hpp"
#include "shafts/hull_plane_writer.hpp"
#include "shafts/hull_search.hpp"
#include "shafts/plane_groups.hpp"

namespace shaftcull::kernel {
namespace {

unsigned first_of(VertexSet vertices) noexcept { return static_cast<unsigned>(std::countr_zero(vertices)); }
VertexSet without_first(VertexSet vertices) noexcept { return vertices & (vertices - 1); }

/// Writes the planes of a hull by its triangles, in the order of search_hull_planes().
class PlanesOfTriangles {
 public:
  PlanesOfTriangles(HullData& hull, const SmallHull& mesh) noexcept : hull_(hull), mesh_(mesh), writer_(hull) {
    face_[no_face].along = face_[no_face].against = 0;
    for (unsigned t = 0; t < mesh_.count(); ++t) {
      face_of_[t] = no_face;
      if (!mesh_.is_at_infinity(t)) take_face(t);
    }
    hull_.creases = 0;
    for (unsigned t = 0; t < mesh_.count(); ++t) take_edges(t);
    write_facets();
    write_faces();
    for (unsigned axis = 0; axis < 3; ++axis) write_edges(axis);
    writer_.finish();
  }

 private:
  struct Face {
    std::uint8_t vertex[3];
    std::int8_t sign;  ///< 1 if the normal, theirs, points outwards
    double normal[3];
    unsigned along;  ///< bit k if component k of the normal is positive outwards
    unsigned against;

    [[nodiscard]] std::uint32_t place() const noexcept {
      return std::uint32_t{vertex[0]} << 10U | std::uint32_t{vertex[1]} << 5U | vertex[2];
    }
  };

  /// Edges along an axis from a vertex to those of a set, which have larger numbers.
  struct Edges {
    VertexSet to = 0;
    VertexSet positive = 0;  ///< of `to`, those whose edge has sign 1
    VertexSet is_face = 0;
  };

  void take_face(unsigned t) noexcept {
    const SmallHull::Triangle& triangle = mesh_[t];
    const bool is_alone = without_first(without_first(without_first(triangle.in_plane))) == 0;
    if (!is_alone) {
      const unsigned same = first_with(triangle.in_plane, t);
      if (same != t) {
        face_of_[t] = face_of_[same];
        return;
      }
    }
    const auto number = static_cast<std::uint8_t>(faces_++);
    face_of_[t] = number;
    Face& face = face_[number];
    if (is_alone) {
      for (unsigned i = 0; i < 3; ++i) face.vertex[i] = triangle.vertex[i];
      face.sign = triangle.sign;
      for (unsigned k = 0; k < 3; ++k) face.normal[k] = mesh_.normal(t, k);
    } else {
      span(triangle.in_plane, t, face);
    }
    unsigned positive = 0;
    unsigned negative = 0;
    for (unsigned k = 0; k < 3; ++k) {
      positive |= static_cast<unsigned>(face.normal[k] > 0) << k;
      negative |= static_cast<unsigned>(face.normal[k] < 0) << k;
    }
    face.along = face.sign > 0 ? positive : negative;
    face.against = face.sign > 0 ? negative : positive;
    const unsigned oblique = face.along | face.against;
    if (oblique == 7) return;
    for (unsigned k = 0; k < 3; ++k) {
      if ((oblique | 1U << k) == 7) take_face_along(face, triangle.in_plane, k);  // else a face of the box
    }
  }

  /// The first triangle, up to t, that has these vertices in its plane.
  [[nodiscard]] unsigned first_with(VertexSet in_plane, unsigned t) const noexcept {
    unsigned same = 0;
    while (same != t && (mesh_.is_at_infinity(same) || mesh_[same].in_plane != in_plane)) ++same;
    return same;
  }

  /// Takes the least vertices of a set that are not on a line, and which side of theirs is outside, as a triangle in
  /// their plane knows it.
  void span(VertexSet in_plane, unsigned t, Face& face) const noexcept {
    const auto vertex = [](unsigned v) { return static_cast<std::uint8_t>(v); };
    face.vertex[0] = vertex(first_of(in_plane));
    VertexSet others = without_first(in_plane);
    face.vertex[1] = vertex(first_of(others));
    do {
      others = without_first(others);
      face.vertex[2] = vertex(first_of(others));
      const SpannedPlane plane = plane_through(hull_, face.vertex);
      for (unsigned k = 0; k < 3; ++k) face.normal[k] = plane.normal(k);
    } while (face.normal[0] == 0 && face.normal[1] == 0 && face.normal[2] == 0);
    // Both normals are of one plane, and known well.
    double cosine = 0;
    for (unsigned k = 0; k < 3; ++k) cosine += face.normal[k] * mesh_.normal(t, k);
    face.sign = static_cast<std::int8_t>(cosine > 0 ? mesh_[t].sign : -mesh_[t].sign);
  }

  /// A face that contains a line along an axis is an edge. Its normal has no other component that is 0.
  void take_face_along(const Face& face, VertexSet in_plane, unsigned axis) noexcept {
    const unsigned i = (axis + 1) % 3;
    const unsigned j = (axis + 2) % 3;
    const unsigned p = first_of(in_plane);
    for (VertexSet others = without_first(in_plane); others != 0; others = without_first(others)) {
      const unsigned q = first_of(others);
      const double across = step_between(hull_, p, q, j).rounded();
      if (across == 0) continue;  // along the axis
      take_edge(axis, p, q, (across > 0) == ((face.along >> i & 1U) != 0), true);
      return;
    }
  }

  /// Edges of a triangle from a vertex to one with a larger number, so each edge of the hull once.
  void take_edges(unsigned t) noexcept {
    const SmallHull::Triangle& triangle = mesh_[t];
    const auto& [a, b, c] = triangle.vertex;  // in order
    if (triangle.sign > 0) {
      take_edge_of(t, a, b);
      take_edge_of(t, b, c);
    } else {
      take_edge_of(t, a, c);
    }
  }

  /// An edge that runs counterclockwise around a triangle. It is an outline along an axis if the triangle faces along
  /// that and the one across against it, or the other way round.
  void take_edge_of(unsigned t, unsigned p, unsigned q) noexcept {
    if (p >= hull_.points) return;  // it is no line
    const unsigned across = mesh_.left_of(q, p);
    const unsigned here = face_of_[t];
    const unsigned there = face_of_[across];
    if (here == there) return;
    hull_.crease[hull_.creases++] = {static_cast<std::uint8_t>(p), static_cast<std::uint8_t>(q), face_of_[t],
                                     face_of_[across]};
    const unsigned positive = face_[here].along & face_[there].against;
    const unsigned negative = face_[here].against & face_[there].along;
    const VertexSet on_line = mesh_[t].in_plane & mesh_[across].in_plane;
    if (without_first(without_first(on_line)) != 0) [[unlikely]] {
      for (unsigned axis = 0; axis < 3; ++axis) {
        if (((positive | negative) >> axis & 1U) != 0) take_outline(axis, on_line);
      }
      return;
    }
    // No branches: which edges are outlines is hard to foresee. Seen against the axis, the triangle is to the left.
    for (unsigned axis = 0; axis < 3; ++axis) {
      edges_[axis][p].to |= VertexSet{(positive | negative) >> axis & 1U} << q;
      edges_[axis][p].positive |= VertexSet{positive >> axis & 1U} << q;
    }
  }

  /// Takes an outline with more than two vertices. It may have been taken.
  void take_outline(unsigned axis, VertexSet on_line) noexcept {
    const unsigned p = first_of(on_line);
    const unsigned q = first_of(without_first(on_line));
    const ProjectedLine line(hull_, axis, p, q);
    take_edge(axis, p, q, line.side_of(hull_, first_beside(line, on_line)) < 0, false);
  }

  /// The first vertex that is not on a line, whose vertices are among some.
  [[nodiscard]] unsigned first_beside(const ProjectedLine& line, VertexSet on_line) const noexcept {
    VertexSet others = ~on_line;
    while (line.side_of(hull_, first_of(others)) == 0) others = without_first(others);
    return first_of(others);
  }

  void take_edge(unsigned axis, unsigned p, unsigned q, bool is_positive, bool is_face) noexcept {
    Edges& edges = edges_[axis][p];
    const VertexSet bit = VertexSet{1} << q;
    edges.to |= bit;
    if (is_positive) edges.positive |= bit;
    if (is_face) edges.is_face |= bit;
  }

  void write_facets() noexcept {
    hull_.facets = static_cast<std::uint8_t>(faces_);
    for (unsigned f = 0; f < faces_; ++f) {
      const Face& face = face_[f];
      const double scale =
          face.sign *
          scale_of(std::max({std::fabs(face.normal[0]), std::fabs(face.normal[1]), std::fabs(face.normal[2])}));
      for (unsigned k = 0; k < 3; ++k) hull_.facet[f][k] = static_cast<float>(face.normal[k] * scale);
    }
  }

  /// The power of 2 by which a number becomes one from 1 to 2. It is no denormal.
  static double scale_of(double largest) noexcept {
    constexpr std::uint64_t exponents = 0x7ffU;
    const std::uint64_t exponent = std::bit_cast<std::uint64_t>(largest) >> 52 & exponents;
    return std::bit_cast<double>((2 * std::uint64_t{1023} - exponent) << 52);
  }

  void write_faces() noexcept {
    std::uint32_t order[SmallHull::most_triangles];  // by vertices, then the number
    unsigned count = 0;
    for (unsigned f = 0; f < faces_; ++f) {
      if ((face_[f].along | face_[f].against) == 7) order[count++] = face_[f].place() << 6U | f;
    }
    std::sort(order, order + count);
    for (unsigned i = 0; i < count; ++i) {
      const Face& face = face_[order[i] & 63U];
      writer_.add_face(face.vertex, face.normal, face.sign);
    }
  }

  void write_edges(unsigned axis) noexcept {
    for (unsigned p = 0; p < hull_.points; ++p) {
      const Edges& edges = edges_[axis][p];
      for (VertexSet others = edges.to; others != 0; others = without_first(others)) {
        const unsigned q = first_of(others);
        const ProjectedLine line(hull_, axis, p, q);
        if (!line.is_oblique()) continue;  // a face of the box
        writer_.add_edge(line, axis, p, q, (edges.positive >> q & 1U) != 0 ? 1 : -1, (edges.is_face >> q & 1U) != 0);
      }
    }
  }

  HullData& hull_;
  const SmallHull& mesh_;
  HullPlaneWriter writer_;
  unsigned faces_ = 0;
  static constexpr std::uint8_t no_face = SmallHull::most_triangles;  ///< of triangles at infinity
  Face face_[SmallHull::most_triangles + 1];
  std::uint8_t face_of_[SmallHull::most_triangles];
  Edges edges_[3][HullData::most_vertices];
};

/// Finds the box around a hull that has no planes yet.
void begin(HullData& hull) noexcept {
  hull.is_bounded = hull.points == hull.vertices;
  hull.faces = hull.edges = hull.face_edges = hull.creases = hull.facets = 0;
  for (unsigned k = 0; k < 3; ++k) {
    hull.box[k] = std::numeric_limits<float>::infinity();
    hull.box[k + 3] = -std::numeric_limits<float>::infinity();
    for (unsigned v = 0; v < hull.points; ++v) {
      hull.box[k] = std::min(hull.box[k], hull.vertex[v][k]);
      hull.box[k + 3] = std::max(hull.box[k + 3], hull.vertex[v][k]);
    }
    for (unsigned v = hull.points; v < hull.vertices; ++v) {
      if (hull.vertex[v][k] < 0) hull.box[k] = -std::numeric_limits<float>::infinity();
      if (hull.vertex[v][k] > 0) hull.box[k + 3] = std::numeric_limits<float>::infinity();
    }
  }
}

bool are_nearly_parallel(const HullData::Plane& one, const HullData::Plane& other) noexcept {
  double cosine = 0;
  for (unsigned k = 0; k < 3; ++k) cosine += static_cast<double>(one.inward[k]) * other.inward[k];
  constexpr double least = 1 - 0x1p-16;  // a third of a degree
  return cosine > least * one.length * other.length;
}

/// Corners that were rounded, as those of views are, are seldom in one plane: then what is meant to be one face is
/// two, or more. Nearly all boxes that are beyond one of these are beyond the other.
void put_parallel_faces_last(HullData& hull) noexcept {
  hull.apart = 0;
  for (unsigned f = 0; f < hull.faces; ++f) {
    const bool is_apart = std::none_of(hull.plane, hull.plane + hull.apart, [&](const HullData::Plane& other) {
      return are_nearly_parallel(hull.plane[f], other);
    });
    if (is_apart) std::swap(hull.plane[f], hull.plane[hull.apart++]);
  }
}

/// Whether a face of the hull lies in one of its box, or there are too few others for a solid. A conservative hull may
/// be culled by its box in any case, so it does not matter that three vertices in a face may be in line.
bool has_faces_in_box(const HullData& hull) noexcept {
  if (hull.apart + hull.face_edges < 4) return true;
  for (unsigned f = 0; f < 6; ++f) {
    const auto is_in_face = [&](unsigned v) { return hull.vertex[v][f % 3] == (v < hull.points ? hull.box[f] : 0.0F); };
    unsigned in_face = 0;
    for (unsigned v = 0; v < hull.vertices; ++v) in_face += is_in_face(v) ? 1 : 0;
    if (in_face >= 3) return true;
  }
  return false;
}

/// All planes are written.
void end(HullData& hull) noexcept {
  put_parallel_faces_last(hull);
  hull.culls_by_box = !hull.is_conservative || has_faces_in_box(hull);
  write_plane_groups(hull);
}

void form_by_triangles(HullData& hull, const SmallHull& triangles) noexcept {
  begin(hull);
  PlanesOfTriangles(hull, triangles);
  end(hull);
}

/// Copies all that was found of the vertices of `from`, to a hull that has these and more: HullData but for vertices,
/// the choice of a test, and what belongs to a hull between two ends.
void copy_planes(HullData& hull, const HullData& from) noexcept {
  std::copy_n(from.box, 6, hull.box);
  hull.farthest = from.farthest;
  hull.is_bounded = from.is_bounded;
  hull.suits_floats = from.suits_floats;
  hull.culls_by_box = from.culls_by_box;
  hull.faces = from.faces;
  hull.apart = from.apart;
  hull.edges = from.edges;
  hull.face_edges = from.face_edges;
  hull.culling_lanes = from.culling_lanes;
  hull.lanes = from.lanes;
  std::copy_n(from.plane, from.faces + from.edges, hull.plane);
  constexpr unsigned planes = HullData::PlaneGroup::planes;
  std::copy_n(from.group, (from.lanes + planes - 1) / planes, hull.group);
  hull.creases = from.creases;
  hull.facets = from.facets;
  std::copy_n(from.crease, from.creases, hull.crease);
  for (unsigned f = 0; f != from.facets; ++f) std::copy_n(from.facet[f], 3, hull.facet[f]);
}

}  // namespace

void form_hull(HullData& hull, SmallHull& triangles) noexcept {
  std::construct_at(&triangles, hull);
  if (!triangles.has_triangles()) return form_hull_by_search(hull);
  form_by_triangles(hull, triangles);
}

void form_extended_hull(HullData& hull, SmallHull& triangles, const HullData& view,
                        const SmallHull& triangles_of_view) noexcept {
  if (!triangles_of_view.has_triangles()) return form_hull(hull, triangles);
  std::construct_at(&triangles, hull, triangles_of_view);
  if (!triangles.is_in_plane(hull.vertices - 1U)) return copy_planes(hull, view);  // it is within the view
  form_by_triangles(hull, triangles);
}

void form_hull_by_search(HullData& hull) noexcept {
  begin(hull);
  search_hull_planes(hull);
  end(hull);
}

}  // namespace shaftcull::kernel
