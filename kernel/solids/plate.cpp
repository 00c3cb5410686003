// SPDX-License-Identifier: MIT
#include "solids/plate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "exact/orientation.hpp"
#include "support/double3.hpp"

namespace shaftcull::kernel {
namespace {

constexpr std::size_t most_plate_corners = 64;
constexpr std::size_t most_plates = 16;
constexpr std::size_t most_looks = std::size_t{1} << 19;  ///< at edges of the boundary, for one set of triangles
/// Vertices of a wall may be so far out of its plane, and its edges so far from straight, in parts of the largest
/// coordinate: some float steps.
constexpr double rounding = 0x1p-20;
/// By how much a polygon is made smaller, in parts of itself, until it lies within the boundary.
constexpr double least_shrinking = 0x1p-21;
constexpr double most_shrinking = 0x1p-8;

/// A point in the plane of a view.
struct FlatPoint {
  double x;
  double y;

  [[nodiscard]] double dot(const FlatPoint& other) const noexcept { return x * other.x + y * other.y; }
  [[nodiscard]] double length() const noexcept { return std::sqrt(dot(*this)); }
  /// The way to another point.
  [[nodiscard]] FlatPoint to(const FlatPoint& other) const noexcept { return {other.x - x, other.y - y}; }
};

/// The half-plane to the left of a line.
struct HalfPlane {
  FlatPoint inwards;  ///< of length 1
  double offset;      ///< inwards · p on the line

  [[nodiscard]] double depth(const FlatPoint& p) const noexcept { return inwards.dot(p) - offset; }
};

/// To the left of the line from p to q.
HalfPlane left_of(const FlatPoint& p, const FlatPoint& q) noexcept {
  const FlatPoint along = p.to(q);
  const FlatPoint inwards{-along.y / along.length(), along.x / along.length()};
  return {inwards, inwards.dot(p)};
}

/// Looks at points along the axis that a normal is nearest to, from its front, so that polygons that are
/// counterclockwise there are so here.
class View {
 public:
  explicit View(const Double3& normal) noexcept {
    for (unsigned k = 0; k != 3; ++k) {
      if (std::fabs(normal[k]) > std::fabs(normal[axis_])) axis_ = k;
    }
    is_mirrored_ = normal[axis_] < 0;
  }

  [[nodiscard]] unsigned axis() const noexcept { return axis_; }
  [[nodiscard]] bool is_mirrored() const noexcept { return is_mirrored_; }
  [[nodiscard]] float x(const Vec3& p) const noexcept { return p[(axis_ + (is_mirrored_ ? 2 : 1)) % 3]; }
  [[nodiscard]] float y(const Vec3& p) const noexcept { return p[(axis_ + (is_mirrored_ ? 1 : 2)) % 3]; }

  /// 1 if `r` is to the left of the line from p to q, −1 to the right, 0 on it. Exact.
  [[nodiscard]] int side(const Vec3& p, const Vec3& q, const Vec3& r) const noexcept {
    return determinant_sign({x(q), x(p)}, {y(q), y(p)}, {x(r), x(p)}, {y(r), y(p)});
  }
  [[nodiscard]] FlatPoint point(const Vec3& p) const noexcept { return {double{x(p)}, double{y(p)}}; }
  /// The other way round, with 0 along the axis.
  [[nodiscard]] Vec3 vector(const FlatPoint& p) const noexcept {
    Vec3 result{};
    result[(axis_ + (is_mirrored_ ? 2 : 1)) % 3] = static_cast<float>(p.x);
    result[(axis_ + (is_mirrored_ ? 1 : 2)) % 3] = static_cast<float>(p.y);
    return result;
  }

 private:
  unsigned axis_ = 0;
  bool is_mirrored_ = false;
};

/// An edge that the triangles are to the left of.
struct BoundaryEdge {
  Vec3 start;
  Vec3 end;
};

/// A convex polygon in the plane of a view, in doubles: what is still to be proven.
class ConvexPart {
 public:
  /// The convex hull of points.
  explicit ConvexPart(std::vector<FlatPoint> points) {
    std::sort(points.begin(), points.end(),
              [](const FlatPoint& p, const FlatPoint& q) { return p.x < q.x || (p.x == q.x && p.y < q.y); });
    for (const bool is_upper : {false, true}) {  // counterclockwise: the lower part, then the upper one
      const std::size_t begin = corner_.size();
      const auto add = [&](const FlatPoint& point) {
        while (corner_.size() >= begin + 2 && turn(corner_[corner_.size() - 2], corner_.back(), point) <= 0) {
          corner_.pop_back();
        }
        corner_.push_back(point);
      };
      if (is_upper) std::reverse(points.begin(), points.end());
      for (const FlatPoint& point : points) add(point);
      corner_.pop_back();  // which begins the other part
    }
    find_sides();
  }

  [[nodiscard]] std::span<const FlatPoint> corners() const noexcept { return corner_; }

  /// Leaves out corners that stick out by no more than the tolerance.
  void simplify(double tolerance) {
    while (corner_.size() > 3) {
      const std::size_t count = corner_.size();
      std::size_t least = 0;
      double sticking = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i != count; ++i) {
        const double out = -left_of(corner_[(i + count - 1) % count], corner_[(i + 1) % count]).depth(corner_[i]);
        if (out < sticking) {
          sticking = out;
          least = i;
        }
      }
      if (sticking > tolerance) break;
      corner_.erase(corner_.begin() + static_cast<std::ptrdiff_t>(least));
    }
    find_sides();
  }

  /// Whether the way from p to q comes further than the tolerance into the polygon.
  [[nodiscard]] bool is_reached(const FlatPoint& p, const FlatPoint& q, double tolerance) const noexcept {
    double enters = 0;
    double leaves = 1;
    for (const HalfPlane& side : side_) {
      const double from = side.depth(p) - tolerance;
      const double to = side.depth(q) - tolerance;
      if (from <= 0 && to <= 0) return false;
      if (from < 0) enters = std::max(enters, from / (from - to));
      if (to < 0) leaves = std::min(leaves, from / (from - to));
    }
    return enters < leaves;
  }

  /// Whether a point is no further than the tolerance outside.
  [[nodiscard]] bool holds(const FlatPoint& p, double tolerance) const noexcept {
    return std::ranges::all_of(side_, [&](const HalfPlane& side) { return side.depth(p) >= -tolerance; });
  }

  void cut(const HalfPlane& kept) {
    std::vector<FlatPoint> left;
    for (std::size_t i = 0; i != corner_.size(); ++i) {
      const FlatPoint& p = corner_[i];
      const FlatPoint& q = corner_[i + 1 == corner_.size() ? 0 : i + 1];
      const double of_p = kept.depth(p);
      const double of_q = kept.depth(q);
      if (of_p >= 0) left.push_back(p);
      if ((of_p > 0 && of_q < 0) || (of_p < 0 && of_q > 0)) {
        const double t = of_p / (of_p - of_q);
        left.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
      }
    }
    corner_ = std::move(left);
    find_sides();
  }

 private:
  static double turn(const FlatPoint& p, const FlatPoint& q, const FlatPoint& r) noexcept {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  }

  void find_sides() {
    side_.clear();
    for (std::size_t i = 0; i != corner_.size(); ++i) {
      side_.push_back(left_of(corner_[i], corner_[i + 1 == corner_.size() ? 0 : i + 1]));
    }
  }

  std::vector<FlatPoint> corner_;
  std::vector<HalfPlane> side_;  ///< of the edge from each corner
};

/// Cuts a polygon until no edge comes into it, and a point stays in it: at the line of an edge, if the point is to the
/// left of the edge, or else across the way to the edge; far edges first. False if that takes too many looks at edges.
bool cut_free(ConvexPart& part, std::span<const BoundaryEdge> boundary, const View& view, const FlatPoint& inner,
              double tolerance, std::size_t& looks) {
  while (looks < most_looks) {
    looks += boundary.size();
    HalfPlane farthest{};
    double distance = 0;
    for (const BoundaryEdge& edge : boundary) {
      const FlatPoint p = view.point(edge.start);
      const FlatPoint q = view.point(edge.end);
      if (!part.is_reached(p, q, tolerance)) continue;
      HalfPlane side = left_of(p, q);
      if (side.depth(inner) <= tolerance) {
        const FlatPoint along = p.to(q);
        const double t = std::clamp(p.to(inner).dot(along) / along.dot(along), 0.0, 1.0);
        const FlatPoint nearest{p.x + t * along.x, p.y + t * along.y};
        const FlatPoint way = nearest.to(inner);
        if (way.length() <= tolerance) return false;
        side.inwards = {way.x / way.length(), way.y / way.length()};
        side.offset = side.inwards.dot(nearest);
      }
      if (side.depth(inner) <= distance) continue;
      farthest = side;
      distance = side.depth(inner);
    }
    if (distance == 0) return true;
    part.cut(farthest);
    if (part.corners().size() < 3) return false;
  }
  return false;
}

/// Whether corners form a convex polygon, counterclockwise, that no edge of the boundary reaches into, and that the
/// boundary goes around. Exact.
bool lies_within(std::span<const Vec3> corners, std::span<const BoundaryEdge> boundary, const View& view) {
  const std::size_t count = corners.size();
  if (count < 3) return false;
  const auto corner = [&](std::size_t i) -> const Vec3& { return corners[i % count]; };
  for (std::size_t i = 0; i != count; ++i) {
    for (std::size_t j = 2; j != count; ++j) {  // all others are to the left of each edge
      if (view.side(corner(i), corner(i + 1), corner(i + j)) <= 0) return false;
    }
  }
  Vec3 inner{};
  for (std::size_t k = 0; k != 3; ++k) inner[k] = (corner(0)[k] + corner(1)[k]) / 2 * 0.5F + corner(2)[k] * 0.5F;
  for (std::size_t i = 0; i != count; ++i) {
    if (view.side(corner(i), corner(i + 1), inner) <= 0) return false;
  }
  int around = 0;  // where the boundary passes the height of the inner point, to the right of it
  for (const auto& [p, q] : boundary) {
    bool is_outside = false;
    for (std::size_t i = 0; i != count && !is_outside; ++i) {
      is_outside = view.side(corner(i), corner(i + 1), p) <= 0 && view.side(corner(i), corner(i + 1), q) <= 0;
    }
    if (!is_outside) return false;
    const bool p_is_above = view.y(p) > view.y(inner);
    const bool q_is_above = view.y(q) > view.y(inner);
    if (p_is_above == q_is_above) continue;
    if (q_is_above && view.side(p, q, inner) > 0) ++around;
    if (p_is_above && view.side(p, q, inner) < 0) --around;
  }
  return around > 0;
}

/// The planes in front of and behind all vertices of triangles, with one normal. It is 1 along the axis of the view.
class Slab {
 public:
  Slab(const Double3& normal, const View& view) noexcept : axis_(view.axis()) {
    for (unsigned k = 0; k != 3; ++k) normal_[k] = static_cast<float>(normal[k] / std::fabs(normal[axis_]));
  }

  void add(const Vec3& point) noexcept {
    const Value value = at(point);
    highest_ = std::max(highest_, value.rounded + value.error);
    lowest_ = std::min(lowest_, value.rounded - value.error);
  }

  [[nodiscard]] double thickness() const noexcept { return highest_ - lowest_; }

  /// Moves a point along the axis until it is in front of the slab, or behind it, for certain; by few floats.
  [[nodiscard]] bool put(Vec3& point, bool is_in_front) const noexcept {
    point[axis_] = 0;
    const double wanted = is_in_front ? highest_ : lowest_;
    const double sign = normal_[axis_] < 0 ? -1 : 1;
    point[axis_] = static_cast<float>(sign * (wanted - at(point).rounded));
    const float outwards =
        (sign > 0) == is_in_front ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity();
    for (int step = 0; step != 4; ++step) {
      const Value value = at(point);
      if (!std::isfinite(point[axis_])) return false;
      if (is_in_front ? value.rounded - value.error >= highest_ : value.rounded + value.error <= lowest_) return true;
      point[axis_] = std::nextafter(point[axis_], outwards);
    }
    return false;
  }

 private:
  struct Value {
    double rounded;
    double error;
  };
  /// Products of two floats are exact; two sums round.
  [[nodiscard]] Value at(const Vec3& point) const noexcept {
    double sum = 0;
    double magnitude = 0;
    for (unsigned k = 0; k != 3; ++k) {
      const double term = double{normal_[k]} * double{point[k]};
      sum += term;
      magnitude += std::fabs(term);
    }
    return {sum, 0x1p-50 * magnitude};
  }

  unsigned axis_;
  Vec3 normal_{};
  double highest_ = -std::numeric_limits<double>::infinity();
  double lowest_ = std::numeric_limits<double>::infinity();
};

/// The plate of a part, made a little smaller until it is proven. Null if it cannot be.
std::optional<Plate> plate_of(const ConvexPart& part, std::span<const BoundaryEdge> boundary, const View& view,
                              const Slab& slab, std::size_t& looks) {
  const std::span<const FlatPoint> corners = part.corners();
  if (corners.size() > most_plate_corners) return std::nullopt;
  FlatPoint middle{};
  for (const FlatPoint& corner : corners) {
    middle.x += corner.x / static_cast<double>(corners.size());
    middle.y += corner.y / static_cast<double>(corners.size());
  }
  for (double shrinking = least_shrinking; shrinking <= most_shrinking && looks < most_looks; shrinking *= 2) {
    looks += boundary.size();
    Plate plate;
    for (const FlatPoint& corner : corners) {
      plate.front.push_back(
          view.vector({corner.x + shrinking * (middle.x - corner.x), corner.y + shrinking * (middle.y - corner.y)}));
    }
    if (!lies_within(plate.front, boundary, view)) continue;
    plate.back = plate.front;
    for (std::size_t i = 0; i != corners.size(); ++i) {
      if (!slab.put(plate.front[i], true) || !slab.put(plate.back[i], false)) return std::nullopt;
    }
    return plate;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Plate> plates_of(const WeldedMesh& mesh, std::span<const std::uint32_t> triangles,
                             std::span<const std::uint32_t> boundary, std::vector<bool>& is_covered) {
  Double3 normal{};
  for (const std::uint32_t t : triangles) {
    const Vec3& p = mesh.start(3 * t);
    const Double3 area = cross(between(p, mesh.start(3 * t + 1)), between(p, mesh.start(3 * t + 2)));
    for (std::size_t k = 0; k != 3; ++k) normal[k] += area[k];
  }
  std::vector<Plate> plates;
  const View view(normal);
  if (normal[view.axis()] == 0 || !std::isfinite(normal[view.axis()])) return plates;
  Slab slab(normal, view);
  double largest = 0;
  for (const std::uint32_t t : triangles) {
    if (view.side(mesh.start(3 * t), mesh.start(3 * t + 1), mesh.start(3 * t + 2)) <= 0) return plates;
    for (std::uint32_t i = 0; i != 3; ++i) {
      const Vec3& vertex = mesh.start(3 * t + i);
      slab.add(vertex);
      for (const float x : vertex) largest = std::max(largest, std::fabs(double{x}));
    }
  }
  const double tolerance = rounding * largest;
  if (!(slab.thickness() <= tolerance)) return plates;

  std::vector<BoundaryEdge> edges;
  std::vector<FlatPoint> ends;
  for (const std::uint32_t edge : boundary) {
    edges.push_back({mesh.start(edge), mesh.start(WeldedMesh::next(edge))});
    ends.push_back(view.point(mesh.start(edge)));
  }
  ConvexPart hull(std::move(ends));
  hull.simplify(tolerance);
  std::size_t next = 0;
  std::size_t looks = 0;
  for (std::size_t tries = 0; tries != most_plates; ++tries) {
    while (next != triangles.size() && is_covered[next]) ++next;
    if (next == triangles.size()) break;
    const auto vertex = [&](std::size_t i, std::uint32_t corner) {
      return view.point(mesh.start(3 * triangles[i] + corner));
    };
    FlatPoint inner{};
    for (std::uint32_t corner = 0; corner != 3; ++corner) {
      inner.x += vertex(next, corner).x / 3;
      inner.y += vertex(next, corner).y / 3;
    }
    ConvexPart part = hull;
    ++next;
    if (!cut_free(part, edges, view, inner, tolerance, looks)) continue;
    part.simplify(tolerance);
    std::optional<Plate> plate = plate_of(part, edges, view, slab, looks);
    if (!plate) continue;
    plates.push_back(*std::move(plate));
    for (std::size_t i = 0; i != triangles.size(); ++i) {
      is_covered[i] = is_covered[i] || (part.holds(vertex(i, 0), tolerance) && part.holds(vertex(i, 1), tolerance) &&
                                        part.holds(vertex(i, 2), tolerance));
    }
  }
  return plates;
}

}  // namespace shaftcull::kernel
