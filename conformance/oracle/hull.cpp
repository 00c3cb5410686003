// SPDX-License-Identifier: MIT
#include "oracle/hull.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace shaftcull::oracle {
namespace {

std::array<Rational, 6> coordinates(const Box& box) {
  return {Rational(box.lo[0]), Rational(box.lo[1]), Rational(box.lo[2]),
          Rational(box.hi[0]), Rational(box.hi[1]), Rational(box.hi[2])};
}

/// Narrows [lower, upper] to the t with p + t (q − p) ≤ x; false if there is no such t whatsoever.
bool narrow(const Rational& p, const Rational& q, float x, Rational& lower, Rational& upper) {
  if (std::isinf(x)) return x > 0;
  const Rational slope = q - p;
  const Rational distance = Rational(x) - p;
  if (slope == 0) return distance >= 0;
  const Rational bound = distance / slope;
  if (slope > 0) {
    upper = std::min(upper, bound);
  } else {
    lower = std::max(lower, bound);
  }
  return lower <= upper;
}

/// normal·p − offset at a point.
Rational height(const RationalPlane& plane, const std::array<Rational, 3>& point) {
  return plane.normal[0] * point[0] + plane.normal[1] * point[1] + plane.normal[2] * point[2] - plane.offset;
}

Rational squared_length(const RationalPlane& plane) {
  return plane.normal[0] * plane.normal[0] + plane.normal[1] * plane.normal[1] + plane.normal[2] * plane.normal[2];
}

/// Sign of the least (side = −1) or greatest (side = +1) height of the box's points over a plane.
int extreme_sign(const RationalPlane& plane, const Box& box, int side) {
  Rational sum = -plane.offset;
  for (std::size_t k = 0; k != 3; ++k) {
    const int slope = sgn(plane.normal[k]);
    if (slope == 0) continue;
    const float x = slope == side ? box.hi[k] : box.lo[k];
    if (std::isinf(x)) return side;  // the boxes asked about have no point at infinity on the other side
    sum += plane.normal[k] * Rational(x);
  }
  return sgn(sum);
}

/// The plane over the edges of the two boxes on which a red face and a blue face meet.
RationalPlane joining_plane(const std::array<Rational, 6>& a, const std::array<Rational, 6>& b, std::size_t red,
                            std::size_t blue) {
  const Rational along_red = b[red] - a[red];
  const Rational along_blue = b[blue] - a[blue];
  Rational normal_red = along_blue;
  Rational normal_blue = -along_red;
  // The corner (a[red], b[blue]) of the shaft box is cut off: it must be outside.
  if (normal_blue * along_blue < 0) {
    normal_red = -normal_red;
    normal_blue = -normal_blue;
  }
  RationalPlane plane{{0, 0, 0}, normal_red * a[red] + normal_blue * a[blue]};
  plane.normal[red % 3] = normal_red;
  plane.normal[blue % 3] = normal_blue;
  return plane;
}

}  // namespace

Hull::Hull(const Box& a, const Box& b, const std::vector<Plane>& added) : a_(coordinates(a)), b_(coordinates(b)) {
  enum class Colour { red, blue, purple };
  std::array<Colour, 6> colour{};
  for (std::size_t face = 0; face != 6; ++face) {
    const bool is_hi = face >= 3;
    const int order = cmp(a_[face], b_[face]);
    colour[face] = order == 0 ? Colour::purple : (order > 0) == is_hi ? Colour::red : Colour::blue;
    RationalPlane plane{{0, 0, 0}, is_hi ? std::max(a_[face], b_[face]) : Rational(-std::min(a_[face], b_[face]))};
    plane.normal[face % 3] = is_hi ? 1 : -1;
    faces_.push_back(plane);
  }
  for (std::size_t red = 0; red != 6; ++red) {
    for (std::size_t blue = 0; blue != 6; ++blue) {
      if (red % 3 == blue % 3 || colour[red] != Colour::red || colour[blue] != Colour::blue) continue;
      faces_.push_back(joining_plane(a_, b_, red, blue));
    }
  }
  for (const Plane& plane : added) {
    added_.push_back(
        {{Rational(plane.normal[0]), Rational(plane.normal[1]), Rational(plane.normal[2])}, Rational(plane.offset)});
  }
}

bool Hull::meets(const Box& box) const {
  Rational lower = 0;
  Rational upper = 1;
  for (std::size_t k = 0; k != 3; ++k) {
    if (box.lo[k] > box.hi[k]) return false;
    if (!narrow(a_[k], b_[k], box.hi[k], lower, upper)) return false;             // lo(t) ≤ box.hi
    if (!narrow(-a_[k + 3], -b_[k + 3], -box.lo[k], lower, upper)) return false;  // −hi(t) ≤ −box.lo
  }
  return true;
}

bool Hull::holds(const Box& box) const {
  for (unsigned corner = 0; corner != 8; ++corner) {
    Box point{};
    for (std::size_t k = 0; k != 3; ++k) {
      point.lo[k] = point.hi[k] = (corner >> k & 1U) != 0 ? box.hi[k] : box.lo[k];
    }
    if (!meets(point)) return false;
  }
  return true;
}

Answer Hull::answer(const Box& box) const {
  if (!meets(box)) return Answer::outside;
  bool inside = true;
  for (const RationalPlane& plane : added_) {
    if (extreme_sign(plane, box, -1) > 0) return Answer::outside;
    inside = inside && extreme_sign(plane, box, 1) <= 0;
  }
  return inside && holds(box) ? Answer::inside : Answer::overlap;
}

Rational Hull::squared_distance(const Vec3& point) const {
  // On axis k the distance from box(t) is max(lo(t) − c, c − hi(t), 0): linear between the t at which a face passes c.
  std::vector<Rational> breaks{0, 1};
  for (std::size_t face = 0; face != 6; ++face) {
    const Rational slope = b_[face] - a_[face];
    if (slope == 0) continue;
    const Rational t = (Rational(point[face % 3]) - a_[face]) / slope;
    if (t > 0 && t < 1) breaks.push_back(t);
  }
  std::sort(breaks.begin(), breaks.end());
  const auto squared = [&](const Rational& t, Rational& slope, Rational& bend) {
    Rational sum = 0;
    slope = bend = 0;
    for (std::size_t k = 0; k != 3; ++k) {
      const Rational c(point[k]);
      const Rational under = a_[k] + t * (b_[k] - a_[k]) - c;
      const Rational over = c - a_[k + 3] - t * (b_[k + 3] - a_[k + 3]);
      const bool is_under = under >= over;
      const Rational distance = is_under ? under : over;
      if (distance <= 0) continue;
      const Rational rate = is_under ? Rational(b_[k] - a_[k]) : Rational(a_[k + 3] - b_[k + 3]);
      sum += distance * distance;
      slope += 2 * distance * rate;
      bend += 2 * rate * rate;
    }
    return sum;
  };
  Rational slope;
  Rational bend;
  Rational least = squared(0, slope, bend);
  for (std::size_t i = 1; i != breaks.size(); ++i) {
    least = std::min(least, squared(breaks[i], slope, bend));
    const Rational middle = (breaks[i - 1] + breaks[i]) / 2;
    squared(middle, slope, bend);
    if (bend == 0) continue;
    const Rational lowest = middle - slope / bend;
    if (lowest > breaks[i - 1] && lowest < breaks[i]) least = std::min(least, squared(lowest, slope, bend));
  }
  return least;
}

Answer Hull::answer(const Sphere& sphere) const {
  if (std::isinf(sphere.radius)) return Answer::overlap;
  const std::array<Rational, 3> centre{Rational(sphere.centre[0]), Rational(sphere.centre[1]),
                                       Rational(sphere.centre[2])};
  const Rational radius(sphere.radius);
  const Rational squared_radius = radius * radius;
  if (squared_distance(sphere.centre) > squared_radius) return Answer::outside;
  const auto is_within = [&](const RationalPlane& plane) {
    const Rational h = height(plane, centre);
    return h <= 0 && h * h >= squared_radius * squared_length(plane);
  };
  bool inside = std::all_of(faces_.begin(), faces_.end(), is_within);
  for (const RationalPlane& plane : added_) {
    const Rational h = height(plane, centre);
    if (h > 0 && h * h > squared_radius * squared_length(plane)) return Answer::outside;
    inside = inside && is_within(plane);
  }
  return inside ? Answer::inside : Answer::overlap;
}

bool Hull::touches(const Box& box) const {
  const Answer is = answer(box);
  if (is == Answer::outside) return false;
  const auto touches_plane = [&](const RationalPlane& plane) {
    return extreme_sign(plane, box, -1) == 0 || (is == Answer::inside && extreme_sign(plane, box, 1) == 0);
  };
  return std::any_of(faces_.begin(), faces_.end(), touches_plane) ||
         std::any_of(added_.begin(), added_.end(), touches_plane);
}

bool Hull::touches(const Sphere& sphere) const {
  const Answer is = answer(sphere);
  if (is == Answer::outside || std::isinf(sphere.radius)) return false;
  const std::array<Rational, 3> centre{Rational(sphere.centre[0]), Rational(sphere.centre[1]),
                                       Rational(sphere.centre[2])};
  const Rational radius(sphere.radius);
  const Rational squared_radius = radius * radius;
  const auto touches_plane = [&](const RationalPlane& plane, bool from_outside) {
    const Rational h = height(plane, centre);
    return (h > 0 ? from_outside : is == Answer::inside) && h * h == squared_radius * squared_length(plane);
  };
  return (radius > 0 && squared_distance(sphere.centre) == squared_radius) ||
         std::any_of(faces_.begin(), faces_.end(), [&](const auto& plane) { return touches_plane(plane, false); }) ||
         std::any_of(added_.begin(), added_.end(), [&](const auto& plane) { return touches_plane(plane, true); });
}

}  // namespace shaftcull::oracle
