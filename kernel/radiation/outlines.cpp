// SPDX-License-Identifier: MIT
#include "radiation/outlines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "radiation/gauss.hpp"
#include "support/elementary.hpp"

namespace shaftcull::kernel {
namespace {

/// An edge of a polygon, on its way around.
struct Edge {
  Double3 from;
  Double3 along;  ///< of length 1
  double length;

  Edge(const Double3& p, const Double3& q) noexcept : from(p), along(q - p), length(kernel::length(along)) {
    for (double& x : along) x = length == 0 ? 0 : x / length;
  }
  [[nodiscard]] Double3 at(double s) const noexcept {
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
    const Double3 turn = cross(outer.along, inner.along);
    const Double3 start = cross(outer.from - inner.from, inner.along);
    const double sine_square = dot(turn, turn);
    is_parallel_ = sine_square < 1e-20;
    if (is_parallel_) return;
    nearest_ = -dot(turn, start) / sine_square;
    const Double3 nearest{start[0] + nearest_ * turn[0], start[1] + nearest_ * turn[1], start[2] + nearest_ * turn[2]};
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
    const unsigned nodes = relative < 4 ? 8 : relative < 16 ? 5 : 3;
    double sum = 0;
    for (unsigned i = 0; i != nodes; ++i) {
      const GaussNode node = gauss_node(nodes, i);
      sum += node.weight * over_inner(outer_.at(middle + half * node.at));
    }
    return sum * half;
  }

  /// How far the integrand's singularities are in the complex plane: where the distance from an end of the inner edge
  /// is 0, and, beside the edge, that from its line.
  [[nodiscard]] double distance_of_singularities(double middle, double half) const noexcept {
    const Double3 offset = outer_.at(middle) - inner_.from;
    const double beside = dot(offset, inner_.along);
    const Double3 from_end = outer_.at(middle) - inner_.at(inner_.length);
    double least = std::min(dot(offset, offset), dot(from_end, from_end));
    if (!is_parallel_ && beside > -half && beside < inner_.length + half) {
      const double away = middle - nearest_;
      least = std::min(least, away * away + depth_square_);
    }
    return std::sqrt(least);
  }

  /// The integral of ln r over the inner edge, r being the distance from a point.
  [[nodiscard]] double over_inner(const Double3& point) const noexcept {
    const Double3 offset = point - inner_.from;
    const Double3 away = cross(offset, inner_.along);
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

}  // namespace

double exchange_by_outlines(const Polygon& a, const Polygon& b) noexcept {
  double sum = 0;
  const auto edge_of = [](std::span<const Double3> corners, std::size_t i) {
    return Edge(corners[i], corners[i + 1 == corners.size() ? 0 : i + 1]);
  };
  for (std::size_t i = 0; i != a.corners().size(); ++i) {
    const Edge outer = edge_of(a.corners(), i);
    for (std::size_t j = 0; j != b.corners().size(); ++j) {
      const Edge inner = edge_of(b.corners(), j);
      if (outer.length == 0 || inner.length == 0) continue;  // a corner that is there twice
      sum += LogarithmOfDistance(outer, inner).get();
    }
  }
  return sum / (2 * pi);
}

}  // namespace shaftcull::kernel
