// SPDX-License-Identifier: MIT
#include "solids/bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "support/double3.hpp"

namespace shaftcull::kernel {
namespace {

/// More corners than this are thinned out: each is compared with each triangle.
constexpr std::size_t most_corners = 256;

double squared_distance(const Vec3& p, const Vec3& q) noexcept {
  double sum = 0;
  for (std::size_t k = 0; k != 3; ++k) sum += (double{p[k]} - q[k]) * (double{p[k]} - q[k]);
  return sum;
}

/// The normal of a triangle, of length 1 nearly; zero if it is too small.
Double3 unit_normal(const WeldedMesh& mesh, std::uint32_t triangle) {
  const SpannedPlane plane = mesh.plane(triangle);
  Double3 normal{plane.normal(0), plane.normal(1), plane.normal(2)};
  const double largest = std::max({std::fabs(normal[0]), std::fabs(normal[1]), std::fabs(normal[2])});
  if (largest == 0) return normal;
  for (double& x : normal) x /= largest;
  const double size = length(normal);
  for (double& x : normal) x /= size;
  return normal;
}

/// Whether the normals around a vertex are those of three faces at least, nearly.
bool is_corner(std::span<const Double3> normals) {
  constexpr double flat = 1e-3;
  const Double3& first = normals.front();
  Double3 edge{};
  double longest = 0;
  for (const Double3& normal : normals) {
    const Double3 along = cross(first, normal);
    const double size = length(along);
    if (size <= longest) continue;
    longest = size;
    edge = along;
  }
  return longest > flat && std::any_of(normals.begin(), normals.end(), [&](const Double3& normal) {
           return std::fabs(dot(edge, normal)) > flat * longest;
         });
}

/// The corners of a part: vertices within its edges and faces are left out.
std::vector<Vec3> corners_of(const WeldedMesh& mesh, const WeldedMesh::Part& part) {
  std::vector<std::pair<std::uint32_t, Double3>> normals;  // of each vertex
  for (std::uint32_t triangle = part.first; triangle != part.end; ++triangle) {
    const Double3 normal = unit_normal(mesh, triangle);
    if (normal == Double3{}) continue;
    for (std::uint32_t edge = 3 * triangle; edge != 3 * triangle + 3; ++edge) {
      normals.emplace_back(mesh.vertex(edge), normal);
      if (part.open_at && part.open_at->excludes(mesh.start(edge))) {
        Double3 outwards{};
        outwards[part.open_at->axis] = part.open_at->is_hi ? 1 : -1;
        normals.emplace_back(mesh.vertex(edge), outwards);
      }
    }
  }
  std::sort(normals.begin(), normals.end());
  std::vector<Vec3> corners;
  std::vector<Double3> around;
  for (auto it = normals.begin(); it != normals.end();) {
    const std::uint32_t vertex = it->first;
    around.clear();
    for (; it != normals.end() && it->first == vertex; ++it) around.push_back(it->second);
    if (is_corner(around)) corners.push_back(mesh.position(vertex));
  }
  return corners;
}

/// Whether all points are on or behind the planes of all triangles, and one is behind one of them.
bool are_behind(const WeldedMesh& mesh, const WeldedMesh::Part& part, std::span<const Vec3> points) {
  bool any_behind = false;
  for (std::uint32_t triangle = part.first; triangle != part.end; ++triangle) {
    if (mesh.is_degenerate(triangle)) continue;  // nothing is hidden by it, and nothing seen
    const SpannedPlane plane = mesh.plane(triangle);
    for (const Vec3& point : points) {
      const int side = side_of(plane, point);
      if (side > 0) return false;
      any_behind |= side < 0;
    }
  }
  return any_behind;
}

/// All points moved towards `middle`, on some axes.
std::vector<Vec3> moved_towards(const Double3& middle, std::span<const Vec3> points, double share, unsigned axes) {
  std::vector<Vec3> moved(points.begin(), points.end());
  for (Vec3& point : moved) {
    for (unsigned k = 0; k != 3; ++k) {
      if ((axes >> k & 1U) != 0) point[k] = static_cast<float>(point[k] + share * (middle[k] - point[k]));
    }
  }
  return moved;
}

/// Where a line from `point` to `end` meets a triangle: 1 if it passes from its front to its back, −1 the other way,
/// 0 not at all; nothing if it meets an edge, or if the point is on the triangle.
std::optional<int> crossing(const WeldedMesh& mesh, std::uint32_t triangle, const Vec3& point, const Vec3& end) {
  const Vec3& a = mesh.start(3 * triangle);
  const Vec3& b = mesh.start(3 * triangle + 1);
  const Vec3& c = mesh.start(3 * triangle + 2);
  for (unsigned k = 0; k != 3; ++k) {  // most triangles are beside the line, or beyond its ends
    const auto [lo, hi] = std::minmax(point[k], end[k]);
    if (std::max({a[k], b[k], c[k]}) < lo || std::min({a[k], b[k], c[k]}) > hi) return 0;
  }
  if (mesh.is_degenerate(triangle)) return 0;
  const SpannedPlane plane = mesh.plane(triangle);
  const int of_point = side_of(plane, point);
  const int of_end = side_of(plane, end);
  if (of_point == of_end && of_point != 0) return 0;
  const int past_a = side_of(plane_of(point, end, a), b);
  const int past_b = side_of(plane_of(point, end, b), c);
  const int past_c = side_of(plane_of(point, end, c), a);
  const auto [least, most] = std::minmax({past_a, past_b, past_c});
  if (least < 0 && most > 0) return 0;
  if (least == 0 || most == 0 || of_point == 0 || of_end == 0) return std::nullopt;
  return of_point;
}

/// Whether a part lies within the closed part around it: no vertex is outside, and one is inside. A vertex that may be
/// on the surface may be either.
bool is_within(const WeldedMesh& mesh, const WeldedMesh::Part& part, const WeldedMesh::Part& around) {
  bool any_inside = false;
  for (std::uint32_t edge = 3 * part.first; edge != 3 * part.end; ++edge) {
    const std::optional<int> turns = winding(mesh, around, mesh.start(edge));
    if (turns == 0) return false;
    any_inside |= turns.has_value();
  }
  return any_inside;
}

}  // namespace

std::vector<Vec3> spread_points(std::span<const Vec3> points, std::size_t count) {
  if (points.size() <= count) return {points.begin(), points.end()};
  std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
  std::vector<Vec3> spread;
  std::size_t at = 0;
  while (spread.size() != count) {
    spread.push_back(points[at]);
    for (std::size_t i = 0; i != points.size(); ++i) {
      distance[i] = std::min(distance[i], squared_distance(points[i], spread.back()));
    }
    at = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
  }
  return spread;
}

std::optional<std::vector<Vec3>> convex_body(const WeldedMesh& mesh, const WeldedMesh::Part& part) {
  const std::vector<Vec3> corners = spread_points(corners_of(mesh, part), most_corners);
  constexpr std::size_t fewest_corners = 4;
  if (!part.is_closed || corners.size() < fewest_corners) return std::nullopt;
  if (are_behind(mesh, part, corners)) return corners;
  Double3 middle{};
  for (const Vec3& corner : corners) {
    for (std::size_t k = 0; k != 3; ++k) middle[k] += corner[k] / static_cast<double>(corners.size());
  }
  for (int exponent = -22; exponent <= -8; exponent += 2) {
    const double share = std::ldexp(1.0, exponent);
    // A body that is turned about one axis keeps its place along it.
    for (const unsigned axes : {0b011U, 0b101U, 0b110U, 0b111U}) {
      std::vector<Vec3> moved = moved_towards(middle, corners, share, axes);
      if (are_behind(mesh, part, moved)) return moved;
    }
  }
  return std::nullopt;
}

std::optional<int> winding(const WeldedMesh& mesh, const WeldedMesh::Part& part, const Vec3& point) {
  bool is_excluded = false;
  for (std::size_t k = 0; k != 3; ++k) {
    if (part.open_at && part.open_at->axis == k && part.open_at->excludes(point)) {
      is_excluded = true;  // on or beyond the open side
    } else if (point[k] < part.box.lo[k] || point[k] > part.box.hi[k]) {
      return 0;
    }
  }
  if (is_excluded) return std::nullopt;
  // Lines aslant, so that they seldom meet an edge; and away from the open side, so that they do not pass through that.
  const unsigned axis = part.open_at ? part.open_at->axis : 0;
  const bool is_up = !part.open_at || !part.open_at->is_hi;
  const float from_end = is_up ? part.box.hi[axis] - point[axis] : point[axis] - part.box.lo[axis];
  const float way = 2 * from_end + 1e-3F * (part.box.hi[axis] - part.box.lo[axis]);
  constexpr std::array<std::array<float, 2>, 4> slopes{
      {{0.0137F, 0.00731F}, {-0.0291F, 0.0173F}, {0.0613F, -0.0437F}, {-0.1171F, -0.0893F}}};
  for (const auto& slope : slopes) {
    Vec3 end = point;
    end[axis] += is_up ? way : -way;
    for (unsigned i = 0; i != 2; ++i) end[(axis + 1 + i) % 3] += slope[i] * way;
    const bool is_beyond = is_up ? end[axis] > part.box.hi[axis] : end[axis] < part.box.lo[axis];
    if (!is_beyond || !std::isfinite(end[0]) || !std::isfinite(end[1]) || !std::isfinite(end[2])) return std::nullopt;
    std::optional<int> turns = 0;
    for (std::uint32_t triangle = part.first; triangle != part.end && turns; ++triangle) {
      const std::optional<int> crossed = crossing(mesh, triangle, point, end);
      turns = crossed ? std::optional(*turns - *crossed) : std::nullopt;
    }
    if (turns) return turns;
  }
  return std::nullopt;
}

std::vector<bool> shells(const WeldedMesh& mesh) {
  const std::span<const WeldedMesh::Part> parts = mesh.parts();
  std::vector<std::uint32_t> order(parts.size());
  for (std::uint32_t i = 0; i != order.size(); ++i) order[i] = i;
  const auto lowest = [&](std::uint32_t i) { return parts[i].box.lo[0]; };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return std::pair(lowest(a), a) < std::pair(lowest(b), b); });
  const auto is_open = [](const WeldedMesh::Part& part, std::size_t k, bool is_hi) {
    return part.open_at && part.open_at->axis == k && part.open_at->is_hi == is_hi;
  };
  const auto holds = [&](const WeldedMesh::Part& outer, const Box& inner) {
    for (std::size_t k = 0; k != 3; ++k) {
      if (inner.lo[k] < outer.box.lo[k] && !is_open(outer, k, false)) return false;
      if (inner.hi[k] > outer.box.hi[k] && !is_open(outer, k, true)) return false;
    }
    return true;
  };
  std::vector<bool> is_shell(parts.size(), false);
  for (std::uint32_t i = 0; i != parts.size(); ++i) {
    if (!parts[i].is_closed) continue;
    const auto first = is_open(parts[i], 0, false)
                           ? order.begin()
                           : std::lower_bound(order.begin(), order.end(), lowest(i),
                                              [&](std::uint32_t j, float lo) { return lowest(j) < lo; });
    is_shell[i] = std::any_of(
        first,
        std::partition_point(first, order.end(), [&](std::uint32_t j) { return lowest(j) <= parts[i].box.hi[0]; }),
        [&](std::uint32_t j) {
          return j != i && holds(parts[i], parts[j].box) && is_within(mesh, parts[j], parts[i]);
        });
  }
  return is_shell;
}

}  // namespace shaftcull::kernel
