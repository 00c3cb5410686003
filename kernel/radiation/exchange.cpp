// SPDX-License-Identifier: MIT
#include "radiation/exchange.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "support/elementary.hpp"

namespace shaftcull::kernel {
namespace {

constexpr double pi = 3.14159265358979324;

double length(const Point& p) noexcept { return std::sqrt(dot(p, p)); }

/// An abscissa from −1 to 1, and its weight.
struct Node {
  double at;
  double weight;
};
// Gauss and Legendre's rules, of 3, 5 and 8 nodes.
constexpr Node three[] = {{-0.7745966692414833770, 5.0 / 9}, {0, 8.0 / 9}, {0.7745966692414833770, 5.0 / 9}};
constexpr Node five[] = {{-0.9061798459386639928, 0.2369268850561890875},
                         {-0.5384693101056830910, 0.4786286704993664680},
                         {0, 0.5688888888888888889},
                         {0.5384693101056830910, 0.4786286704993664680},
                         {0.9061798459386639928, 0.2369268850561890875}};
constexpr Node eight[] = {
    {-0.9602898564975362317, 0.1012285362903762591}, {-0.7966664774136267396, 0.2223810344533744705},
    {-0.5255324099163289858, 0.3137066458778872873}, {-0.1834346424956498049, 0.3626837833783619830},
    {0.1834346424956498049, 0.3626837833783619830},  {0.5255324099163289858, 0.3137066458778872873},
    {0.7966664774136267396, 0.2223810344533744705},  {0.9602898564975362317, 0.1012285362903762591}};

/// An edge of a polygon, on its way around.
struct Edge {
  Point from;
  Point along;  ///< of length 1
  double length;

  Edge(const Point& p, const Point& q) noexcept : from(p), along(q - p), length(kernel::length(along)) {
    for (double& x : along) x = length == 0 ? 0 : x / length;
  }
  [[nodiscard]] Point at(double s) const noexcept {
    return {from[0] + s * along[0], from[1] + s * along[1], from[2] + s * along[2]};
  }
};

/// The integral of ln r over both edges, r being the distance of their points. Over one of them it is known. Over the
/// other one it is summed piece by piece: each is short against the distance of what is not smooth, where the pieces
/// get shorter by halves.
class LogarithmOfDistance {
 public:
  LogarithmOfDistance(const Edge& outer, const Edge& inner) noexcept
      : outer_(outer), inner_(inner), cosine_(dot(outer.along, inner.along)) {
    constexpr double error = 1e-13;  // of the lengths' product
    shortest_ = std::sqrt(outer.length * inner.length * error / std::max(error, std::fabs(cosine_)));
    // Squared, the distance of a point of the outer edge from the inner one's line is δ² + sin² α (s − s₀)².
    const Point turn = cross(outer.along, inner.along);
    const Point start = cross(outer.from - inner.from, inner.along);
    const double sine_square = dot(turn, turn);
    is_parallel_ = sine_square < 1e-20;
    if (is_parallel_) return;
    nearest_ = -dot(turn, start) / sine_square;
    const Point nearest{start[0] + nearest_ * turn[0], start[1] + nearest_ * turn[1], start[2] + nearest_ * turn[2]};
    depth_square_ = dot(nearest, nearest) / sine_square;
  }

  /// That integral, times the cosine of the angle between the edges.
  [[nodiscard]] double get() const noexcept { return cosine_ * over(0, outer_.length); }

 private:
  [[nodiscard]] double over(double first, double last) const noexcept {
    const double half = (last - first) / 2;
    const double middle = first + half;
    const double relative = distance_of_singularities(middle, half) / half;
    if (relative < 2 && half > shortest_) return over(first, middle) + over(middle, last);
    const std::span<const Node> nodes = relative < 4    ? std::span<const Node>(eight)
                                        : relative < 16 ? std::span<const Node>(five)
                                                        : std::span<const Node>(three);
    double sum = 0;
    for (const Node& node : nodes) sum += node.weight * over_inner(outer_.at(middle + half * node.at));
    return sum * half;
  }

  /// How far the integrand's singularities are in the complex plane: where the distance from an end of the inner edge
  /// is 0, and, beside the edge, that from its line.
  [[nodiscard]] double distance_of_singularities(double middle, double half) const noexcept {
    const Point offset = outer_.at(middle) - inner_.from;
    const double beside = dot(offset, inner_.along);
    const Point from_end = outer_.at(middle) - inner_.at(inner_.length);
    double least = std::min(dot(offset, offset), dot(from_end, from_end));
    if (!is_parallel_ && beside > -half && beside < inner_.length + half) {
      const double away = middle - nearest_;
      least = std::min(least, away * away + depth_square_);
    }
    return std::sqrt(least);
  }

  /// The integral of ln r over the inner edge, r being the distance from a point.
  [[nodiscard]] double over_inner(const Point& point) const noexcept {
    const Point offset = point - inner_.from;
    const Point away = cross(offset, inner_.along);
    const double height_square = dot(away, away);
    const double height = std::sqrt(height_square);
    const double first = -dot(offset, inner_.along);
    const double last = inner_.length + first;
    const auto term = [&](double x) {
      const double square = x * x + height_square;
      return square < 1e-290 ? 0.0 : x * logarithm(square) / 2;
    };
    return term(last) - term(first) - inner_.length +
           height * angle_of(height * inner_.length, height_square + first * last);
  }

  const Edge& outer_;
  const Edge& inner_;
  double cosine_;
  double shortest_;  ///< half of a piece that need not be halved, whatever is near
  bool is_parallel_ = false;
  double nearest_ = 0;       ///< s₀
  double depth_square_ = 0;  ///< (δ / sin α)²
};

/// By the integral over both outlines (Sparrow 1963): ∮∮ ln r ds₁·ds₂ / 2π.
double by_outlines(const Polygon& a, const Polygon& b) noexcept {
  double sum = 0;
  const auto edge_of = [](std::span<const Point> corners, std::size_t i) {
    return Edge(corners[i], corners[i + 1 == corners.size() ? 0 : i + 1]);
  };
  for (std::size_t i = 0; i != a.corners().size(); ++i) {
    const Edge outer = edge_of(a.corners(), i);
    for (std::size_t j = 0; j != b.corners().size(); ++j) {
      const Edge inner = edge_of(b.corners(), j);
      sum += LogarithmOfDistance(outer, inner).get();
    }
  }
  return sum / (2 * pi);
}

/// Points of a triangle by shares of two of its edges, and their weights, exact for polynomials of degree 5 (Radon
/// 1948).
struct TriangleNode {
  double u;
  double v;
  double weight;
};
constexpr TriangleNode seven[] = {
    {1.0 / 3, 1.0 / 3, 0.225},
    {0.4701420641051150898, 0.4701420641051150898, 0.1323941527885061807},
    {0.4701420641051150898, 0.0597158717897698205, 0.1323941527885061807},
    {0.0597158717897698205, 0.4701420641051150898, 0.1323941527885061807},
    {0.1012865073234563389, 0.1012865073234563389, 0.1259391805448271526},
    {0.1012865073234563389, 0.7974269853530873223, 0.1259391805448271526},
    {0.7974269853530873223, 0.1012865073234563389, 0.1259391805448271526},
};

/// visit(point, weight) for points of a polygon.
template <class Visit>
void for_each_node(const Polygon& polygon, const Visit& visit) noexcept {
  const std::span<const Point> corners = polygon.corners();
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Point first = corners[i - 1] - corners[0];
    const Point second = corners[i] - corners[0];
    const double area = length(cross(first, second)) / 2;
    for (const TriangleNode& node : seven) {
      Point point{};
      for (std::size_t k = 0; k != 3; ++k) point[k] = corners[0][k] + node.u * first[k] + node.v * second[k];
      visit(point, area * node.weight);
    }
  }
}

/// By points of both areas: for polygons that are far from each other, of which outlines nearly cancel.
double by_areas(const Polygon& a, const Polygon& b) noexcept {
  const Point normal_a = a.normal();
  const Point normal_b = b.normal();
  double sum = 0;
  for_each_node(a, [&](const Point& p, double weight_p) {
    double of_point = 0;
    for_each_node(b, [&](const Point& q, double weight_q) {
      const Point way = q - p;
      const double square = dot(way, way);
      of_point -= weight_q * dot(normal_a, way) * dot(normal_b, way) / (square * square);
    });
    sum += weight_p * of_point;
  });
  return sum / (pi * length(normal_a) * length(normal_b));
}

/// A ball around a polygon.
struct Ball {
  Point centre{};
  double radius = 0;

  explicit Ball(const Polygon& polygon) noexcept {
    const std::span<const Point> corners = polygon.corners();
    for (const Point& p : corners) {
      for (std::size_t k = 0; k != 3; ++k) centre[k] += p[k] / static_cast<double>(corners.size());
    }
    for (const Point& p : corners) radius = std::max(radius, length(p - centre));
  }
};

}  // namespace

double exchange_area(const Polygon& a, const Polygon& b) noexcept {
  if (a.corners().empty() || b.corners().empty()) return 0;
  if (std::lexicographical_compare(b.corners().begin(), b.corners().end(), a.corners().begin(), a.corners().end())) {
    return exchange_area(b, a);
  }
  constexpr double far = 40;  // radii
  const Ball of_a(a);
  const Ball of_b(b);
  const bool are_far = length(of_a.centre - of_b.centre) > far * std::max(of_a.radius, of_b.radius);
  const double exchanged = are_far ? by_areas(a, b) : by_outlines(a, b);
  const double least_area = std::min(length(a.normal()), length(b.normal())) / 2;
  return std::clamp(exchanged, 0.0, least_area);
}

}  // namespace shaftcull::kernel
