// SPDX-License-Identifier: MIT
#include "oracle/quick_hull.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace shaftcull::oracle {
namespace {

std::array<double, 6> coordinates(const Box& box) {
  return {box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]};
}

Interval difference(double x, double y) { return Interval(x) - Interval(y); }

/// Least (side = −1) or greatest (side = +1) value of normal · p − offset for p in the box.
Interval extreme_height(const Plane& plane, const Box& box, int side) {
  Interval sum(-static_cast<double>(plane.offset));
  for (std::size_t k = 0; k != 3; ++k) {
    const double n = plane.normal[k];
    sum = sum + Interval(n) * Interval((n > 0) == (side > 0) ? box.hi[k] : box.lo[k]);
  }
  return sum;
}

Interval squared_length(const Plane& plane) {
  Interval sum(0.0);
  for (const double n : plane.normal) sum = sum + square(Interval(n));
  return sum;
}

}  // namespace

QuickHull::QuickHull(const ShaftInput& input)
    : a_(coordinates(input.a)), b_(coordinates(input.b)), added_(input.added) {
  const auto outer_on_a = [this](std::size_t face) { return (a_[face] > b_[face]) == (face >= 3); };
  for (std::size_t red = 0; red != 6; ++red) {
    for (std::size_t blue = 0; blue != 6; ++blue) {
      const bool edge = red % 3 != blue % 3 && a_[red] != b_[red] && a_[blue] != b_[blue];
      if (!edge || !outer_on_a(red) || outer_on_a(blue)) continue;
      JoiningPlane plane{red % 3, blue % 3, difference(b_[blue], a_[blue]), difference(a_[red], b_[red]),
                         a_[red], a_[blue]};
      // The corner (a[red], b[blue]) of the shaft box is cut off: normal_blue · (b[blue] − a[blue]) is positive there.
      if ((a_[red] > b_[red]) != (b_[blue] > a_[blue])) {
        plane.red_normal = -plane.red_normal;
        plane.blue_normal = -plane.blue_normal;
      }
      joining_.push_back(plane);
    }
  }
}

QuickHull::Truth QuickHull::meets(const Box& box) const {
  Interval lower(0.0);
  Interval upper(1.0);
  // p + t (q − p) ≤ x
  const auto narrow = [&](double p, double q, double x) {
    if (p == q) return p <= x;
    const Interval bound = difference(x, p) / difference(q, p);
    if (q > p) {
      upper = minimum(upper, bound);
    } else {
      lower = maximum(lower, bound);
    }
    return !certainly_less(upper, lower);
  };
  for (std::size_t k = 0; k != 3; ++k) {
    if (!narrow(a_[k], b_[k], box.hi[k]) || !narrow(-a_[k + 3], -b_[k + 3], -box.lo[k])) return Truth::no;
  }
  return certainly_at_most(lower, upper) ? Truth::yes : Truth::unknown;
}

QuickHull::Truth QuickHull::holds(const Box& box) const {
  Truth truth = Truth::yes;
  for (unsigned corner = 0; corner != 8; ++corner) {
    Box point{};
    for (std::size_t k = 0; k != 3; ++k) {
      point.lo[k] = point.hi[k] = (corner >> k & 1U) != 0 ? box.hi[k] : box.lo[k];
    }
    truth = std::min(truth, meets(point));
    if (truth == Truth::no) break;
  }
  return truth;
}

std::optional<Answer> QuickHull::answer(const Box& box) const {
  const Truth hull = meets(box);
  if (hull == Truth::no) return Answer::outside;
  Truth inside = Truth::yes;
  bool sure = hull == Truth::yes;
  for (const Plane& plane : added_) {
    const Interval near = extreme_height(plane, box, -1);
    if (near.lo > 0) return Answer::outside;
    sure = sure && near.hi <= 0;
    const Interval far = extreme_height(plane, box, 1);
    inside = std::min(inside, far.lo > 0 ? Truth::no : far.hi <= 0 ? Truth::yes : Truth::unknown);
  }
  if (!sure) return std::nullopt;
  if (inside != Truth::no) inside = std::min(inside, holds(box));
  if (inside == Truth::unknown) return std::nullopt;
  return inside == Truth::yes ? Answer::inside : Answer::overlap;
}

double QuickHull::nearest_t(const std::array<double, 3>& point) const {
  // The squared distance from box(t) is convex in t: bisects for the sign change of its derivative.
  const auto rises_at = [&](double t) {
    double half_slope = 0;
    for (std::size_t k = 0; k != 3; ++k) {
      const double under = a_[k] - point[k] + t * (b_[k] - a_[k]);
      const double over = point[k] - a_[k + 3] - t * (b_[k + 3] - a_[k + 3]);
      if (under > 0 && under >= over) half_slope += under * (b_[k] - a_[k]);
      if (over > 0 && over > under) half_slope += over * (a_[k + 3] - b_[k + 3]);
    }
    return half_slope > 0;
  };
  double low = 0;
  double high = 1;
  if (rises_at(low)) return low;
  if (!rises_at(high)) return high;
  for (int i = 0; i != 60; ++i) {
    const double middle = 0.5 * (low + high);
    (rises_at(middle) ? high : low) = middle;
  }
  return low;
}

QuickHull::Truth QuickHull::meets(const Sphere& sphere) const {
  const std::array<double, 3> centre{sphere.centre[0], sphere.centre[1], sphere.centre[2]};
  const Interval squared_radius = square(Interval(sphere.radius));
  const double t = nearest_t(centre);
  Interval squared_distance(0.0);         // from box(t), which lies within the shaft
  std::array<double, 3> normal{0, 0, 0};  // about centre − nearest point: any value is good for a proof
  for (std::size_t k = 0; k != 3; ++k) {
    const Interval under = difference(a_[k], centre[k]) + Interval(t) * difference(b_[k], a_[k]);
    const Interval over = difference(centre[k], a_[k + 3]) - Interval(t) * difference(b_[k + 3], a_[k + 3]);
    const Interval gap = maximum(under, over);
    if (gap.hi > 0) squared_distance = squared_distance + square(maximum(gap, Interval(0.0)));
    if (under.lo > 0) normal[k] = -0.5 * (under.lo + under.hi);
    if (over.lo > 0) normal[k] = 0.5 * (over.lo + over.hi);
  }
  if (certainly_at_most(squared_distance, squared_radius)) return Truth::yes;

  // Least value of normal · (centre − p) over the corners of both boxes, hence over their convex hull.
  const auto clearance = [&](const std::array<double, 6>& box) {
    Interval sum(0.0);
    for (std::size_t k = 0; k != 3; ++k) {
      sum = sum + Interval(normal[k]) * difference(centre[k], normal[k] > 0 ? box[k + 3] : box[k]);
    }
    return sum;
  };
  const Interval clear = minimum(clearance(a_), clearance(b_));
  Interval squared_normal(0.0);
  for (const double n : normal) squared_normal = squared_normal + square(Interval(n));
  const bool beyond = clear.lo > 0 && certainly_less(squared_radius * squared_normal, square(clear));
  return beyond ? Truth::no : Truth::unknown;
}

Interval QuickHull::height(const JoiningPlane& plane, const std::array<double, 3>& point) {
  return plane.red_normal * difference(point[plane.red_axis], plane.red_point) +
         plane.blue_normal * difference(point[plane.blue_axis], plane.blue_point);
}

QuickHull::Truth QuickHull::holds(const Sphere& sphere) const {
  const std::array<double, 3> centre{sphere.centre[0], sphere.centre[1], sphere.centre[2]};
  const Interval radius(sphere.radius);
  Truth truth = Truth::yes;
  const auto require_at_most = [&](Interval x, Interval y) {
    if (certainly_less(y, x)) {
      truth = Truth::no;
    } else if (!certainly_at_most(x, y)) {
      truth = std::min(truth, Truth::unknown);
    }
  };
  // height + radius · |normal| ≤ 0
  const auto require_clear = [&](Interval height, Interval squared_normal) {
    require_at_most(height, Interval(0.0));
    if (height.lo < 0) require_at_most(square(radius) * squared_normal, square({height.lo, std::min(height.hi, 0.0)}));
  };
  for (std::size_t k = 0; k != 3; ++k) {
    require_at_most(radius, difference(centre[k], std::min(a_[k], b_[k])));
    require_at_most(radius, difference(std::max(a_[k + 3], b_[k + 3]), centre[k]));
  }
  for (const JoiningPlane& plane : joining_) {
    if (truth == Truth::no) return truth;
    require_clear(height(plane, centre), square(plane.red_normal) + square(plane.blue_normal));
  }
  const Box point{sphere.centre, sphere.centre};
  for (const Plane& plane : added_) require_clear(extreme_height(plane, point, 1), squared_length(plane));
  return truth;
}

std::optional<Answer> QuickHull::answer(const Sphere& sphere) const {
  const Truth hull = meets(sphere);
  if (hull == Truth::no) return Answer::outside;
  bool sure = hull == Truth::yes;
  const Box point{sphere.centre, sphere.centre};
  for (const Plane& plane : added_) {
    const Interval height = extreme_height(plane, point, -1);
    if (height.hi <= 0) continue;
    const Interval reached = square(Interval(sphere.radius)) * squared_length(plane);
    if (height.lo > 0 && certainly_less(reached, square(height))) return Answer::outside;
    sure = sure && certainly_at_most(square({std::max(height.lo, 0.0), height.hi}), reached);
  }
  if (!sure) return std::nullopt;
  const Truth inside = holds(sphere);
  if (inside == Truth::unknown) return std::nullopt;
  return inside == Truth::yes ? Answer::inside : Answer::overlap;
}

double QuickHull::distance_to_surface(const Vec3& point) const {
  const std::array<double, 3> centre{point[0], point[1], point[2]};
  const double t = nearest_t(centre);
  double squared_distance = 0;
  double depth = INFINITY;
  for (std::size_t k = 0; k != 3; ++k) {
    const double under = a_[k] - centre[k] + t * (b_[k] - a_[k]);
    const double over = centre[k] - a_[k + 3] - t * (b_[k + 3] - a_[k + 3]);
    const double gap = std::max({under, over, 0.0});
    squared_distance += gap * gap;
    depth = std::min({depth, centre[k] - std::min(a_[k], b_[k]), std::max(a_[k + 3], b_[k + 3]) - centre[k]});
  }
  if (squared_distance > 0) return std::sqrt(squared_distance);
  for (const JoiningPlane& plane : joining_) {
    const Interval above = height(plane, centre);
    depth = std::min(depth, -0.5 * (above.lo + above.hi) / std::hypot(plane.red_normal.lo, plane.blue_normal.lo));
  }
  return std::max(depth, 0.0);
}

}  // namespace shaftcull::oracle
