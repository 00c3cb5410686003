// SPDX-License-Identifier: MIT
#include "solids/flat_runs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>

#include "support/double3.hpp"

namespace shaftcull::kernel {
namespace {

using Edge = std::uint32_t;

/// Sets whose members are joined.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  [[nodiscard]] std::uint32_t of(std::uint32_t member) {
    while (parent_[member] != member) {
      parent_[member] = parent_[parent_[member]];
      member = parent_[member];
    }
    return member;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[std::max(of(a), of(b))] = std::min(of(a), of(b)); }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Triangles and edges are numbered from the first one of the part on.
class Joining {
 public:
  Joining(const WeldedMesh& mesh, const WeldedMesh::Part& part)
      : mesh_(mesh),
        first_(part.first),
        count_(part.end - part.first),
        normal_(count_),
        next_(3 * std::size_t{count_}),
        previous_(next_.size()),
        planes_(count_),
        sheets_(count_),
        polygons_(count_),
        is_joined_(next_.size(), false),
        rounding_(steps * largest_coordinate(part.box)) {
    for (std::uint32_t t = 0; t != count_; ++t) {
      normal_[t] = normal_of(t);
      for (Edge i = 0; i != 3; ++i) {
        next_[3 * t + i] = 3 * t + (i + 1) % 3;
        previous_[3 * t + i] = 3 * t + (i + 2) % 3;
      }
    }
  }

  std::vector<Plate> run() {
    sort_inner_edges();
    if (!nearly_flat_.empty()) find_plates();
    join_whole_planes();
    for (const Edge edge : flat_) join_across(edge);
    for (const Edge edge : nearly_flat_) join_two(edge);
    write_others();
    return std::move(found_);
  }

 private:
  static constexpr double steps = 0x1p-21;  // two to four float steps

  static double largest_coordinate(const Box& box) {
    double largest = 0;
    for (std::size_t k = 0; k != 3; ++k) {
      largest = std::max({largest, std::fabs(double{box.lo[k]}), std::fabs(double{box.hi[k]})});
    }
    return largest;
  }

  /// The axis that the normal of a triangle is nearest to, and in which direction it points along this axis. 0: there
  /// is no normal.
  struct Normal {
    unsigned axis = 0;
    int sign = 0;
    std::array<double, 3> along{};
  };

  [[nodiscard]] Edge across(Edge edge) const {
    const std::uint32_t other = mesh_.across(edge + 3 * first_);
    return other == WeldedMesh::none ? other : other - 3 * first_;
  }
  [[nodiscard]] const Vec3& start(Edge edge) const { return mesh_.start(edge + 3 * first_); }
  [[nodiscard]] const Vec3& end(Edge edge) const { return mesh_.start(WeldedMesh::next(edge + 3 * first_)); }
  /// The corner of the edge's triangle that is not on the edge.
  [[nodiscard]] const Vec3& far(Edge edge) const {
    return mesh_.start(WeldedMesh::next(WeldedMesh::next(edge + 3 * first_)));
  }
  [[nodiscard]] std::uint32_t start_vertex(Edge edge) const { return mesh_.vertex(edge + 3 * first_); }
  [[nodiscard]] std::uint32_t end_vertex(Edge edge) const { return mesh_.vertex(WeldedMesh::next(edge + 3 * first_)); }
  [[nodiscard]] Double3 along(Edge edge) const { return between(start(edge), end(edge)); }
  [[nodiscard]] double squared_length(Edge edge) const { return dot(along(edge), along(edge)); }

  [[nodiscard]] Normal normal_of(std::uint32_t triangle) const {
    const SpannedPlane plane = mesh_.plane(first_ + triangle);
    Normal normal;
    for (unsigned k = 0; k != 3; ++k) {
      normal.along[k] = plane.normal(k);
      if (std::fabs(normal.along[k]) > std::fabs(normal.along[normal.axis])) normal.axis = k;
    }
    const double largest = normal.along[normal.axis];
    normal.sign = largest > 0 ? 1 : largest < 0 ? -1 : 0;
    for (double& x : normal.along) x = normal.sign == 0 ? 0 : x / std::fabs(largest);
    return normal;
  }

  /// Whether the triangles at an edge face the same way, and are in one plane within a thousandth of a right angle; or,
  /// for triangles of few float steps, within a twentieth and those steps.
  [[nodiscard]] bool are_nearly_flat(Edge edge, Edge other) const {
    const Normal& a = normal_[edge / 3];
    const Normal& b = normal_[other / 3];
    if (a.sign == 0 || b.sign == 0 || b.along[a.axis] * a.sign <= 0) return false;
    constexpr double flat = 1e-3;
    constexpr double almost_flat = 0.05;
    double difference = 0;
    for (std::size_t k = 0; k != 3; ++k) difference = std::max(difference, std::fabs(a.along[k] - b.along[k]));
    if (difference <= flat) return true;
    return difference <= almost_flat && std::fabs(dot(a.along, between(start(edge), far(other)))) <= rounding_;
  }

  /// Edges between triangles in one plane, longest first.
  void sort_inner_edges() {
    for (Edge edge = 0; edge != 3 * count_; ++edge) {
      const Edge other = across(edge);
      if (other == WeldedMesh::none || edge > other || !are_nearly_flat(edge, other)) continue;
      const bool is_exact = side_of(mesh_.plane(first_ + edge / 3), far(other)) == 0;
      (is_exact ? flat_ : nearly_flat_).push_back(edge);
      if (is_exact) planes_.join(edge / 3, other / 3);
      sheets_.join(edge / 3, other / 3);
    }
    for (std::vector<Edge>* const list : {&flat_, &nearly_flat_}) {
      std::sort(list->begin(), list->end(),
                [&](Edge a, Edge b) { return std::pair(-squared_length(a), a) < std::pair(-squared_length(b), b); });
    }
  }

  /// 1 if the way along the edge `from`, and then along the edge `to`, turns left as seen from the front, −1 if it
  /// turns right, 0 if it does not turn. Exact for edges in one plane.
  [[nodiscard]] int turn(Edge from, Edge to) const {
    const Normal& normal = normal_[from / 3];
    const unsigned i = (normal.axis + 1) % 3;
    const unsigned j = (normal.axis + 2) % 3;
    const auto step = [&](Edge edge, unsigned k) { return Step{end(edge)[k], start(edge)[k]}; };
    return normal.sign * determinant_sign(step(from, i), step(from, j), step(to, i), step(to, j));
  }
  [[nodiscard]] bool is_convex(Edge from, Edge to) const {
    const int side = turn(from, to);
    return side > 0 || (side == 0 && dot(along(from), along(to)) > 0);
  }
  /// Which half of all directions an edge has: around a convex polygon, each half comes once.
  [[nodiscard]] bool points_up(Edge edge) const {
    const unsigned axis = normal_[edge / 3].axis;
    const unsigned i = (axis + 1) % 3;
    const unsigned j = (axis + 2) % 3;
    return std::pair(end(edge)[j], end(edge)[i]) > std::pair(start(edge)[j], start(edge)[i]);
  }

  void link(Edge edge, Edge after) {
    next_[edge] = after;
    previous_[after] = edge;
  }

  /// Calls whole(triangles, boundary) for each set of three triangles or more, with the edges that have none of the set
  /// across. Two are joined across their edge.
  template <class Whole>
  void for_each_set(Sets& sets, const Whole& whole) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> members;  // of each set
    for (std::uint32_t t = 0; t != count_; ++t) {
      if (!is_joined_[3 * t]) members.emplace_back(sets.of(t), t);
    }
    std::sort(members.begin(), members.end());
    std::vector<std::uint32_t> triangles;
    std::vector<Edge> boundary;
    for (auto first = members.begin(); first != members.end();) {
      triangles.clear();
      boundary.clear();
      auto last = first;
      for (; last != members.end() && last->first == first->first; ++last) {
        triangles.push_back(last->second);
        for (Edge edge = 3 * last->second; edge != 3 * last->second + 3; ++edge) {
          const Edge other = across(edge);
          if (other == WeldedMesh::none || sets.of(other / 3) != first->first) boundary.push_back(edge);
        }
      }
      if (triangles.size() > 2) whole(triangles, boundary);
      first = last;
    }
  }

  /// Finds plates in place of triangles that are nearly in one plane.
  void find_plates() {
    for_each_set(sheets_, [&](std::span<std::uint32_t> triangles, std::vector<Edge>& boundary) {
      const std::uint32_t plane = planes_.of(triangles.front());
      if (std::ranges::all_of(triangles, [&](std::uint32_t t) { return planes_.of(t) == plane; })) return;
      // From here on with the numbers of the mesh.
      for (std::uint32_t& t : triangles) t += first_;
      for (Edge& edge : boundary) edge += 3 * first_;
      std::vector<bool> is_covered(triangles.size(), false);
      for (Plate& plate : plates_of(mesh_, triangles, boundary, is_covered)) found_.push_back(std::move(plate));
      for (std::size_t i = 0; i != triangles.size(); ++i) {
        if (is_covered[i]) set_joined(triangles[i] - first_, true);
      }
    });
  }

  /// Joins all triangles of a plane that form one convex polygon.
  void join_whole_planes() {
    for_each_set(planes_, [&](std::span<std::uint32_t> triangles, std::vector<Edge>& boundary) {
      if (!is_loop(boundary) || !is_convex(boundary)) return;
      for (const std::uint32_t t : triangles) {
        polygons_.join(triangles.front(), t);
        set_joined(t, true);
      }
      for (std::size_t i = 0; i != boundary.size(); ++i) {
        link(boundary[i], boundary[(i + 1) % boundary.size()]);
        is_joined_[boundary[i]] = false;
      }
    });
  }

  /// Whether the edges form one line around that comes to no vertex twice. Sorts them into its order.
  [[nodiscard]] bool is_loop(std::vector<Edge>& boundary) const {
    if (boundary.empty()) return false;
    const auto by_start = [&](Edge a, Edge b) { return start_vertex(a) < start_vertex(b); };
    std::sort(boundary.begin(), boundary.end(), by_start);
    std::vector<Edge> loop{boundary.front()};
    while (loop.size() <= boundary.size()) {
      const auto after = std::partition_point(boundary.begin(), boundary.end(),
                                              [&](Edge edge) { return start_vertex(edge) < end_vertex(loop.back()); });
      if (after == boundary.end() || start_vertex(*after) != end_vertex(loop.back())) return false;
      if (after + 1 != boundary.end() && start_vertex(*(after + 1)) == start_vertex(*after)) return false;
      if (*after == loop.front()) break;
      loop.push_back(*after);
    }
    if (loop.size() != boundary.size()) return false;
    boundary = std::move(loop);
    return true;
  }

  /// Whether a loop is a convex polygon.
  [[nodiscard]] bool is_convex(std::span<const Edge> loop) const {
    std::size_t tops = 0;
    for (std::size_t i = 0; i != loop.size(); ++i) {
      const Edge after = loop[(i + 1) % loop.size()];
      if (!is_convex(loop[i], after)) return false;
      tops += points_up(loop[i]) && !points_up(after) ? 1U : 0U;
    }
    return tops == 1;
  }

  /// Joins two convex polygons in one plane if they form another one. An edge is common to both, and the edges before
  /// and after it may be.
  void join_across(Edge edge) {
    const Edge other = across(edge);
    if (is_joined_[edge] || is_joined_[other] || polygons_.of(edge / 3) == polygons_.of(other / 3)) return;
    Edge first = edge;  // of the common edges, in the order of this polygon
    while (across(previous_[first]) == next_[across(first)]) first = previous_[first];
    Edge last = edge;
    while (across(next_[last]) == previous_[across(last)]) last = next_[last];
    const Edge before = previous_[first];
    const Edge after = next_[last];
    const Edge other_before = previous_[across(last)];
    const Edge other_after = next_[across(first)];
    if (!is_convex(before, other_after) || !is_convex(other_before, after)) return;
    link(before, other_after);
    link(other_before, after);
    for (Edge common = first;; common = next_[common]) {
      is_joined_[common] = is_joined_[across(common)] = true;
      if (common == last) break;
    }
    link(before, other_after);
    link(other_before, after);
    polygons_.join(edge / 3, other / 3);
  }

  /// Joins two triangles that are not quite in one plane, unless others are joined with them.
  void join_two(Edge edge) {
    const Edge other = across(edge);
    for (const Edge side : {edge, other}) {
      if (is_joined_[side] || next_[next_[next_[side]]] != side || turn(side, next_[side]) == 0) return;
    }
    const auto is_corner = [&](Edge from, Edge to) { return turn(from, to) > 0; };
    if (!is_corner(previous_[edge], next_[other]) || !is_corner(previous_[other], next_[edge])) return;
    found_.push_back({{start(edge), far(other), end(edge), far(edge)}, {}});
    set_joined(edge / 3, true);
    set_joined(other / 3, true);
  }

  void set_joined(std::uint32_t triangle, bool is_joined) {
    for (Edge edge = 3 * triangle; edge != 3 * triangle + 3; ++edge) is_joined_[edge] = is_joined;
  }

  /// Writes the polygons that edges are left of.
  void write_others() {
    for (Edge seed = 0; seed != 3 * count_; ++seed) {
      if (is_joined_[seed] || normal_[seed / 3].sign == 0) continue;
      std::vector<Vec3> corners;
      Edge edge = seed;
      do {
        if (turn(previous_[edge], edge) != 0) corners.push_back(start(edge));
        is_joined_[edge] = true;
        edge = next_[edge];
      } while (edge != seed);
      found_.push_back({std::move(corners), {}});
    }
  }

  const WeldedMesh& mesh_;
  std::uint32_t first_;
  std::uint32_t count_;
  std::vector<Normal> normal_;
  std::vector<Edge> next_;         ///< around each polygon
  std::vector<Edge> previous_;     ///< likewise
  Sets planes_;                    ///< of triangles, exactly
  Sets sheets_;                    ///< of triangles, nearly in one plane
  Sets polygons_;                  ///< of triangles
  std::vector<bool> is_joined_;    ///< of each edge: it is within a polygon, or its polygon is written
  double rounding_;                ///< what rounding moves vertices by, and some more
  std::vector<Edge> flat_;         ///< each between two triangles in one plane, longest first
  std::vector<Edge> nearly_flat_;  ///< likewise, nearly in one plane
  std::vector<Plate> found_;
};

}  // namespace

std::vector<Plate> flat_runs(const WeldedMesh& mesh, const WeldedMesh::Part& part) { return Joining(mesh, part).run(); }

}  // namespace shaftcull::kernel
