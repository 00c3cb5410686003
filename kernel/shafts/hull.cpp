// SPDX-License-Identifier: MIT
#include "shaftcull/hull.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "compiled/hull_data.hpp"
#include "compiled/shaft_data.hpp"
#include "exact/hull_planes.hpp"
#include "shaftcull/error.hpp"
#include "shafts/view.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"

namespace shaftcull {
namespace {

using kernel::HullData;

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

/// Forms a hull of the vertices that it has: its box and its planes.
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
    const kernel::SpannedPlane plane = kernel::plane_through(hull_, {vertex(p), vertex(q), vertex(r)});
    const Sides sides = sides_of(hull_, [&](unsigned v) {
      const kernel::Step to[3] = {step_between(hull_, p, v, 0), step_between(hull_, p, v, 1),
                                  step_between(hull_, p, v, 2)};
      return v == p ? 0 : plane.sign_along(to);
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
    const kernel::ProjectedLine line(hull_, axis, p, q);
    const double normal[2] = {line.along[1].rounded(), -line.along[0].rounded()};
    if (normal[0] == 0 || normal[1] == 0) return;  // a point, or a face of the box
    const Sides sides = sides_of(hull_, [&](unsigned v) {
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

struct ConvexHull::Parts {
  HullData data;
  std::array<Vec3, HullData::most_vertices> vertex;  ///< as given, points first; `data` has each of them once
  std::size_t points;
  std::size_t vertices;
};

namespace {

void require_finite(const char* what, std::size_t i, const Vec3& v) {
  for (std::size_t k = 0; k != 3; ++k) {
    if (std::isfinite(v[k])) continue;
    kernel::fail(InvalidArgument(std::string("ConvexHull: ") + what + " " + std::to_string(i) + ": " + "xyz"[k] +
                                 " = " + kernel::text(v[k]) + " is not finite"));
  }
}

void require_vertices(std::span<const Vec3> points, std::span<const Vec3> directions) {
  kernel::require_memory("points", points, "points");
  kernel::require_memory("directions", directions, "directions");
  if (points.empty()) kernel::fail(InvalidArgument("ConvexHull: there is no point; a hull needs one or more"));
  constexpr std::size_t most = ConvexHull::max_vertices;
  if (points.size() > most || directions.size() > most - points.size()) {
    kernel::fail(InvalidArgument("ConvexHull: " + std::to_string(points.size()) + " points and " +
                                 std::to_string(directions.size()) + " directions; together there can be " +
                                 std::to_string(most)));
  }
  for (std::size_t i = 0; i != points.size(); ++i) require_finite("point", i, points[i]);
  for (std::size_t i = 0; i != directions.size(); ++i) {
    require_finite("direction", i, directions[i]);
    if (directions[i] == Vec3{0, 0, 0}) {
      kernel::fail(InvalidArgument("ConvexHull: direction " + std::to_string(i) + " is zero"));
    }
  }
}

/// Writes each of some vertices once, behind those that the hull has.
void add_different(HullData& hull, std::span<const Vec3> vertices) noexcept {
  for (auto vertex = vertices.begin(); vertex != vertices.end(); ++vertex) {
    if (std::find(vertices.begin(), vertex, *vertex) != vertex) continue;
    std::copy_n(vertex->data(), 3, hull.vertex[hull.vertices++]);
  }
}

/// The vertices of a hull: points first, and none twice.
void fill(HullData& hull, std::span<const Vec3> points, std::span<const Vec3> directions) noexcept {
  add_different(hull, points);
  hull.points = hull.vertices;
  add_different(hull, directions);
}

/// A compiled shaft that has all its answers from a hull.
CompiledShaft referring_to(const HullData& hull) noexcept {
  CompiledShaft compiled;
  kernel::ShaftData& data = kernel::data_of(compiled);
  data.slab_form = kernel::ShaftData::SlabForm::hull;
  data.slab_uppers = 0;
  data.kind = kernel::ShaftData::Kind::hull;
  data.hull = &hull;
  data.largest_coordinate = std::numeric_limits<float>::infinity();  // no grid has a place for it
  for (unsigned f = 0; f < 6; ++f) data.a[f] = data.b[f] = data.face[f] = hull.box[f];
  data.joining_count = 0;
  data.added_count = 0;
  data.answers_outside = data.answers_inside = data.answers_spheres = true;
  data.contact = Contact::closed;
  data.still_faces = 0;
  return compiled;
}

}  // namespace

ConvexHull::ConvexHull(std::span<const Vec3> points, std::span<const Vec3> directions) {
  kernel::in_float_environment([&] {
    require_vertices(points, directions);
    parts_ = std::make_unique<Parts>();
    parts_->points = points.size();
    parts_->vertices = points.size() + directions.size();
    std::copy(directions.begin(), directions.end(), std::copy(points.begin(), points.end(), parts_->vertex.begin()));
    fill(parts_->data, this->points(), this->directions());
    HullFormation{parts_->data};
  });
  compiled_ = referring_to(parts_->data);
}

ConvexHull::ConvexHull(const ConvexHull& other)
    : parts_(other.parts_ ? std::make_unique<Parts>(*other.parts_) : nullptr) {
  if (parts_) compiled_ = referring_to(parts_->data);
}

ConvexHull& ConvexHull::operator=(const ConvexHull& other) { return *this = ConvexHull(other); }

ConvexHull::ConvexHull(ConvexHull&& other) noexcept
    : parts_(std::move(other.parts_)), compiled_(std::exchange(other.compiled_, CompiledShaft())) {}

ConvexHull& ConvexHull::operator=(ConvexHull&& other) noexcept {
  parts_ = std::move(other.parts_);
  compiled_ = std::exchange(other.compiled_, CompiledShaft());
  return *this;
}

ConvexHull::~ConvexHull() = default;

Box ConvexHull::box() const noexcept { return compiled_.a(); }

std::span<const Vec3> ConvexHull::points() const noexcept {
  if (!parts_) return {};
  return {parts_->vertex.data(), parts_->points};
}

std::span<const Vec3> ConvexHull::directions() const noexcept {
  if (!parts_) return {};
  return {parts_->vertex.data() + parts_->points, parts_->vertices - parts_->points};
}

namespace {

using Matrix = std::array<std::array<double, 4>, 4>;

/// Solves matrix · result = columns, by elimination with the largest pivots. Returns false for a matrix that is not
/// invertible.
bool invert(Matrix matrix, Matrix& inverse) noexcept {
  inverse = {};
  for (std::size_t i = 0; i != 4; ++i) inverse[i][i] = 1;
  for (std::size_t c = 0; c != 4; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r != 4; ++r) {
      if (std::fabs(matrix[r][c]) > std::fabs(matrix[pivot][c])) pivot = r;
    }
    if (matrix[pivot][c] == 0) return false;
    std::swap(matrix[c], matrix[pivot]);
    std::swap(inverse[c], inverse[pivot]);
    const double scale = 1 / matrix[c][c];
    for (std::size_t k = 0; k != 4; ++k) {
      matrix[c][k] *= scale;
      inverse[c][k] *= scale;
    }
    for (std::size_t r = 0; r != 4; ++r) {
      if (r == c) continue;
      const double factor = matrix[r][c];
      for (std::size_t k = 0; k != 4; ++k) {
        matrix[r][k] -= factor * matrix[c][k];
        inverse[r][k] -= factor * inverse[c][k];
      }
    }
  }
  return true;
}

/// The coefficients of x, y, z and 1 in `z_share` · z + w_share · w of clip space.
std::array<double, 4> combined(const Matrix& matrix, double z_share, double w_share) noexcept {
  std::array<double, 4> sum{};
  for (std::size_t c = 0; c != 4; ++c) sum[c] = z_share * matrix[2][c] + w_share * matrix[3][c];
  return sum;
}

/// The four corners of a view at one depth of clip space: directions if it has no end there, else points.
std::array<Vec3, 4> corners_at(const Matrix& inverse, double depth, bool are_directions) {
  std::array<Vec3, 4> corners{};
  for (std::size_t i = 0; i != 4; ++i) {
    const std::array<double, 4> clip = {i % 2 == 0 ? -1.0 : 1.0, i / 2 == 0 ? -1.0 : 1.0, depth, 1};
    std::array<double, 4> world{};
    for (std::size_t r = 0; r != 4; ++r) {
      for (std::size_t c = 0; c != 4; ++c) world[r] += inverse[r][c] * clip[c];
    }
    if (!are_directions && !(world[3] > 0))
      kernel::fail(InvalidArgument("frustum: a corner is not in front of the eye"));
    const double length = std::max({std::fabs(world[0]), std::fabs(world[1]), std::fabs(world[2])});
    const double scale = are_directions ? length : world[3];
    for (std::size_t k = 0; k != 3; ++k) {
      corners[i][k] = static_cast<float>(world[k] / scale);
      if (!std::isfinite(corners[i][k])) kernel::fail(InvalidArgument("frustum: a corner is beyond all floats"));
    }
  }
  return corners;
}

ConvexHull frustum_of(std::span<const float, 16> floats, ClipDepth depth) {
  Matrix matrix{};
  for (std::size_t i = 0; i != 16; ++i) matrix[i / 4][i % 4] = floats[i];
  Matrix inverse{};
  if (!invert(matrix, inverse)) kernel::fail(InvalidArgument("frustum: the matrix is not invertible"));
  struct End {
    double depth;
    std::array<double, 4> plane;  // that cuts the view off there
  };
  const double least = depth == ClipDepth::zero_to_one ? 0 : -1;
  const End ends[2] = {{least, combined(matrix, 1, -least)}, {1, combined(matrix, -1, 1)}};
  std::array<Vec3, 8> vertex{};
  std::size_t points = 0;
  for (const bool are_directions : {false, true}) {  // points first
    for (const End& end : ends) {
      const bool is_open = end.plane[0] == 0 && end.plane[1] == 0 && end.plane[2] == 0;
      if (is_open != are_directions) continue;
      const std::array<Vec3, 4> corners = corners_at(inverse, end.depth, are_directions);
      std::copy(corners.begin(), corners.end(), vertex.data() + (are_directions ? 4 : points));
      if (!are_directions) points += 4;
    }
  }
  if (points == 0) kernel::fail(InvalidArgument("frustum: the view has no end, neither near nor far"));
  return ConvexHull(std::span(vertex).first(points), std::span(vertex).subspan(points));
}

/// Throws unless a call can add a vertex, the light or the direction called `what`, to a view.
void require_extensible(const char* call, const ConvexHull& view, const char* what, const Vec3& added) {
  const auto refuse = [&](const std::string& why) { kernel::fail(InvalidArgument(std::string(call) + ": " + why)); };
  if (view.points().empty()) refuse("the view was never formed, or was moved from");
  for (std::size_t k = 0; k != 3; ++k) {
    if (!std::isfinite(added[k]))
      refuse(std::string(what) + "." + "xyz"[k] + " = " + kernel::text(added[k]) + " is not finite");
  }
  const std::size_t vertices = view.points().size() + view.directions().size();
  if (vertices == ConvexHull::max_vertices) {
    refuse("the view has " + std::to_string(vertices) + " points and directions, and with " + what +
           " one more than a hull can have");
  }
}

/// A hull of a view and one more vertex.
ConvexHull extended(const ConvexHull& view, const Vec3* point, const Vec3* direction) {
  std::array<Vec3, ConvexHull::max_vertices + 1> vertex{};
  auto end = std::copy(view.points().begin(), view.points().end(), vertex.begin());
  if (point != nullptr) *end++ = *point;
  const auto points = static_cast<std::size_t>(end - vertex.begin());
  end = std::copy(view.directions().begin(), view.directions().end(), end);
  if (direction != nullptr) *end++ = *direction;
  return ConvexHull(std::span(vertex).first(points),
                    std::span(vertex).subspan(points, static_cast<std::size_t>(end - vertex.begin()) - points));
}

}  // namespace

ConvexHull frustum(std::span<const float, 16> matrix, ClipDepth depth) {
  static_cast<void>(kernel::planes_of_view("frustum", matrix, depth));  // throws unless the matrix shows anything
  return kernel::in_float_environment([&] { return frustum_of(matrix, depth); });
}

ConvexHull casters(const ConvexHull& view, const Vec3& light) {
  require_extensible("casters", view, "light", light);
  return extended(view, &light, nullptr);
}

ConvexHull casters_towards(const ConvexHull& view, const Vec3& towards_sun) {
  require_extensible("casters_towards", view, "towards_sun", towards_sun);
  kernel::in_float_environment([&] {  // where denormals are not 0
    if (towards_sun == Vec3{0, 0, 0}) {
      kernel::fail(InvalidArgument("casters_towards: towards_sun is zero; it must be a direction"));
    }
  });
  return extended(view, nullptr, &towards_sun);
}

}  // namespace shaftcull
