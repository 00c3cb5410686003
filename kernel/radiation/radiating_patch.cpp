// SPDX-License-Identifier: MIT
#include "radiation/radiating_patch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "radiation/gauss.hpp"
#include "radiation/outlines.hpp"
#include "support/elementary.hpp"

namespace shaftcull::kernel {
namespace {

/// Nodes of a polygon, in fours. Those that fill up the last four have no weight.
struct Nodes {
  static constexpr std::size_t most = most_gauss_nodes * most_gauss_nodes;  // of the quadrilaterals of nine corners
  FourNodes four[most];
  std::size_t count = 0;  ///< of fours
};

/// `order` nodes along each side of the quadrilaterals that the first corner forms with the others, which may be
/// triangles. Weights add up to the area.
void find_nodes(const RadiatingPatch& patch, unsigned order, Nodes& nodes) noexcept {
  std::size_t count = 0;
  const auto add = [&](const Double3& at, double weight) {
    FourNodes& four = nodes.four[count / 4];
    for (std::size_t k = 0; k != 3; ++k) four.at[k][count % 4] = at[k];
    four.weight[count++ % 4] = weight;
  };
  const std::span<const Double3> corners = patch.outline.corners();
  for (std::size_t i = 1; i + 1 < corners.size(); i += 2) {
    const Double3 p = corners[0] - patch.centre;
    const Double3 q = corners[i] - patch.centre;
    const Double3 r = corners[i + 1] - patch.centre;
    const Double3 s = i + 2 < corners.size() ? corners[i + 2] - patch.centre : r;
    for (unsigned row = 0; row != order; ++row) {
      const GaussNode u = gauss_node(order, row);
      Double3 from{};
      Double3 to{};
      Double3 along_u{};
      Double3 across_u{};
      for (std::size_t k = 0; k != 3; ++k) {
        from[k] = (p[k] * (1 - u.at) + q[k] * (1 + u.at)) / 2;
        to[k] = (s[k] * (1 - u.at) + r[k] * (1 + u.at)) / 2;
        along_u[k] = (q[k] - p[k]) / 2;
        across_u[k] = (r[k] - s[k]) / 2;
      }
      for (unsigned column = 0; column != order; ++column) {
        const GaussNode v = gauss_node(order, column);
        Double3 at{};
        Double3 along{};
        Double3 up{};
        for (std::size_t k = 0; k != 3; ++k) {
          at[k] = (from[k] * (1 - v.at) + to[k] * (1 + v.at)) / 2;
          along[k] = (along_u[k] * (1 - v.at) + across_u[k] * (1 + v.at)) / 2;
          up[k] = (to[k] - from[k]) / 2;
        }
        add(at, u.weight * v.weight * dot(cross(along, up), patch.normal));
      }
    }
  }
  while (count % 4 != 0) add(Double3{}, 0);
  nodes.count = count / 4;
}

/// Nodes of a patch that are kept, or worked out anew.
class NodesOf {
 public:
  NodesOf(const RadiatingPatch& patch, unsigned order) noexcept {
    find_nodes(patch, order, own_);
    nodes_ = {own_.four, own_.count};
  }
  explicit NodesOf(std::span<const FourNodes> kept) noexcept : nodes_(kept) {}
  NodesOf(const NodesOf&) = delete;
  NodesOf& operator=(const NodesOf&) = delete;

  [[nodiscard]] std::span<const FourNodes> get() const noexcept { return nodes_; }

 private:
  Nodes own_;
  std::span<const FourNodes> nodes_;
};

/// Nodes from the centre of another patch, with weights by their heights above its plane, or of it above theirs.
void place(std::span<const FourNodes> nodes, const Double3& centre, const Double3& normal, const Double3& on_plane,
           Nodes& placed) noexcept {
  placed.count = nodes.size();
  const Double3 from_plane = centre - on_plane;
  for (std::size_t i = 0; i != nodes.size(); ++i) {
    FourNodes& four = placed.four[i];
    for (std::size_t lane = 0; lane != 4; ++lane) {
      const double x = nodes[i].at[0][lane];
      const double y = nodes[i].at[1][lane];
      const double z = nodes[i].at[2][lane];
      four.at[0][lane] = centre[0] + x;
      four.at[1][lane] = centre[1] + y;
      four.at[2][lane] = centre[2] + z;
      four.weight[lane] = nodes[i].weight[lane] * (normal[0] * (from_plane[0] + x) + normal[1] * (from_plane[1] + y) +
                                                   normal[2] * (from_plane[2] + z));
    }
  }
}

/// By nodes of both areas. Of flat patches, cos θ r is the height of a point above the other's plane.
double by_nodes(const RadiatingPatch& a, const RadiatingPatch& b, std::span<const FourNodes> nodes_a,
                std::span<const FourNodes> nodes_b) noexcept {
  const Double3 between = b.centre - a.centre;
  Nodes of_a;
  Nodes of_b;
  place(nodes_a, Double3{}, b.normal, between, of_a);
  place(nodes_b, between, a.normal, Double3{}, of_b);
  double sum = 0;
  for (std::size_t i = 0; i != 4 * of_a.count; ++i) {
    const FourNodes& four = of_a.four[i / 4];
    const std::size_t of_four = i % 4;
    if (four.weight[of_four] == 0) continue;
    double lanes[4] = {0, 0, 0, 0};
    for (std::size_t j = 0; j != of_b.count; ++j) {
      const FourNodes& other = of_b.four[j];
      for (std::size_t lane = 0; lane != 4; ++lane) {
        const double x = other.at[0][lane] - four.at[0][of_four];
        const double y = other.at[1][lane] - four.at[1][of_four];
        const double z = other.at[2][lane] - four.at[2][of_four];
        const double square = x * x + y * y + z * z;
        lanes[lane] += other.weight[lane] / (square * square);
      }
    }
    sum += four.weight[of_four] * ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3]));
  }
  return sum / pi;
}

/// By outlines, of coordinates about 1.
double by_outlines(const RadiatingPatch& a, const RadiatingPatch& b, const Polygon& of_a,
                   const Polygon& of_b) noexcept {
  if (b.radius < a.radius) return by_outlines(b, a, of_b, of_a);
  const double size = length(b.centre - a.centre) + a.radius + b.radius;
  const double scale = std::ldexp(1.0, -std::ilogb(size));
  return exchange_by_outlines(of_a.moved(a.centre, scale), of_b.moved(a.centre, scale)) / (scale * scale);
}

/// How many nodes along a side keep the error small, by the other patch's distance in radii; 0 if too many would be
/// needed. docs/view-factors.md says how this was measured.
unsigned order_for(double distance, Accuracy accuracy) noexcept {
  constexpr double least[2][most_gauss_nodes - 1] = {{32, 9, 4.6, 3.2, 2.4, 2, 1.7},
                                                     {100, 18, 7.5, 4.7, 3.4, 2.7, 2.2}};
  const double(&of)[most_gauss_nodes - 1] = least[static_cast<unsigned>(accuracy)];
  for (unsigned order = 2; order <= most_gauss_nodes; ++order) {
    if (distance >= of[order - 2]) return order;
  }
  return 0;
}

/// On which sides of a patch's plane another one is, but for rounding.
struct Sides {
  bool front = false;
  bool back = false;

  Sides(const RadiatingPatch& of, const RadiatingPatch& other) noexcept {
    const Double3 between = other.centre - of.centre;
    const double height = dot(of.normal, between);
    const double rounding = 1e-12 * (length(between) + of.radius);
    front = height + other.radius > rounding;
    back = height - other.radius < -rounding;
    if (!front || !back) return;
    front = back = false;
    for (const Double3& corner : other.outline.corners()) {
      const double of_corner = dot(of.normal, corner - of.centre);
      front = front || of_corner > rounding;
      back = back || of_corner < -rounding;
    }
  }
};

}  // namespace

RadiatingPatch::RadiatingPatch(std::span<const Vec3> corners) noexcept
    : outline(corners, Double3{}, 1), centre{}, radius(0), normal(outline.normal()), area(length(normal) / 2) {
  for (double& x : normal) x = area > 0 ? x / (2 * area) : 0;
  for (const Double3& corner : outline.corners()) {
    for (std::size_t k = 0; k != 3; ++k) centre[k] += corner[k] / static_cast<double>(corners.size());
  }
  for (const Double3& corner : outline.corners()) radius = std::max(radius, length(corner - centre));
}

namespace {

/// Calls by_orders(a, b, order of a, order of b) where points of the areas will do. Patches in a row are in an order
/// that depends on themselves alone.
template <class ByOrders>
double exchange(const RadiatingPatch& a, const RadiatingPatch& b, Accuracy accuracy,
                const ByOrders& by_orders) noexcept {
  if (!(a.area > 0) || !(b.area > 0)) return 0;
  const Sides of_b(a, b);
  const Sides of_a(b, a);
  if (!of_b.front || !of_a.front) return 0;
  // Outlines of patches whose corners are rounded may say a little less than nothing.
  const auto possible = [&](double exchanged) { return std::clamp(exchanged, 0.0, std::min(a.area, b.area)); };
  if (of_b.back || of_a.back) {
    return possible(by_outlines(a, b, a.outline.in_front_of(b.outline), b.outline.in_front_of(a.outline)));
  }
  const double distance = length(b.centre - a.centre);
  const unsigned order_a = order_for((distance - b.radius) / a.radius, accuracy);
  const unsigned order_b = order_for((distance - a.radius) / b.radius, accuracy);
  return possible(order_a == 0 || order_b == 0 ? by_outlines(a, b, a.outline, b.outline) : by_orders(order_a, order_b));
}

bool comes_before(const RadiatingPatch& a, const RadiatingPatch& b) noexcept {
  const std::span<const Double3> of_a = a.outline.corners();
  const std::span<const Double3> of_b = b.outline.corners();
  return std::lexicographical_compare(of_a.begin(), of_a.end(), of_b.begin(), of_b.end());
}

}  // namespace

double exchange_between(const RadiatingPatch& a, const RadiatingPatch& b, Accuracy accuracy) noexcept {
  if (comes_before(b, a)) return exchange_between(b, a, accuracy);
  return exchange(a, b, accuracy, [&](unsigned order_a, unsigned order_b) {
    return by_nodes(a, b, NodesOf(a, order_a).get(), NodesOf(b, order_b).get());
  });
}

RadiatingPatches::RadiatingPatches(std::size_t count) {
  patches_.reserve(count);
  for (unsigned order = 2; order <= most_kept_order; ++order) {
    nodes_[order - 2].reserve(count * ((order * order + 3) / 4));
    end_[order - 2].reserve(count);
  }
}

void RadiatingPatches::add(std::span<const Vec3> corners) {
  const RadiatingPatch& patch = patches_.emplace_back(corners);
  Nodes nodes;
  for (unsigned order = 2; order <= most_kept_order; ++order) {
    find_nodes(patch, order, nodes);
    nodes_[order - 2].insert(nodes_[order - 2].end(), nodes.four, nodes.four + nodes.count);
    end_[order - 2].push_back(nodes_[order - 2].size());
  }
}

std::span<const FourNodes> RadiatingPatches::kept_nodes(std::size_t i, unsigned order) const noexcept {
  const std::vector<std::size_t>& end = end_[order - 2];
  const std::size_t first = i == 0 ? 0 : end[i - 1];
  return std::span(nodes_[order - 2]).subspan(first, end[i] - first);
}

double RadiatingPatches::exchange_between(std::size_t a, std::size_t b) const noexcept {
  if (comes_before(patches_[b], patches_[a])) std::swap(a, b);
  return exchange(patches_[a], patches_[b], Accuracy::six_digits, [&](unsigned order_a, unsigned order_b) {
    const auto nodes_of = [&](std::size_t i, unsigned order) {
      return order <= most_kept_order ? NodesOf(kept_nodes(i, order)) : NodesOf(patches_[i], order);
    };
    return by_nodes(patches_[a], patches_[b], nodes_of(a, order_a).get(), nodes_of(b, order_b).get());
  });
}

}  // namespace shaftcull::kernel
