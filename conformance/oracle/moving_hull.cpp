// SPDX-License-Identifier: MIT
#include "oracle/moving_hull.hpp"

#include <algorithm>
#include <cstddef>

#include "oracle/shaft_input.hpp"

namespace shaftcull {

std::string source_text(const MovingInput& input) {
  std::string planes;
  const char* const contact = input.contact == Contact::open ? ", Contact::open)" : ")";
  for (const Plane& plane : input.added) {
    planes += ", {" + source_text(plane.normal) + ", " + source_text(plane.offset) + "}";
  }
  if (input.is_shadow()) {
    return "shadow(" + source_text(input.light) + ", " + source_text(input.box) +
           (input.is_endless() ? "" : ", " + source_text(input.reach)) + planes + contact;
  }
  return std::string(input.is_endless() ? "swept_infinite(" : "swept(") + source_text(input.box) + ", " +
         source_text(input.displacement) + planes + contact;
}

namespace oracle {
namespace {

/// Narrows [lower, upper] to the s with a + s b ≤ 0; false if there is none whatsoever.
bool narrow(const Rational& a, const Rational& b, Rational& lower, Rational& upper) {
  if (b == 0) return a <= 0;
  const Rational s = -a / b;
  if (b > 0) {
    upper = std::min(upper, s);
  } else {
    lower = std::max(lower, s);
  }
  return lower <= upper;
}

Rational dot(const std::array<Rational, 3>& x, const std::array<Rational, 3>& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// The point of the box that is farthest along a plane's normal (side = 1), or least far (side = −1), over the plane.
Rational extreme_height(const RationalPlane& plane, const Box& box, int side) {
  Rational sum = -plane.offset;
  for (std::size_t k = 0; k != 3; ++k) {
    sum += plane.normal[k] * Rational(sgn(plane.normal[k]) == side ? box.hi[k] : box.lo[k]);
  }
  return sum;
}

/// More than any t that matters: the largest float over the smallest.
Rational no_end() { return Rational(1) << 1000U; }

}  // namespace

MovingHull::MovingHull(const MovingInput& input) : input_(input) {
  for (const Plane& plane : input.added) {
    added_.push_back(
        {{Rational(plane.normal[0]), Rational(plane.normal[1]), Rational(plane.normal[2])}, Rational(plane.offset)});
  }
}

bool MovingHull::meets(const Box& box) const {
  if (input_.is_shadow()) {
    // Some point of the segment from l to p, l + s (p − l), is in the occluder. As s ≥ 0 and 1 − s ≥ 0, the least and
    // the greatest such points, on each axis, are those of the least and greatest l and p.
    Rational lower = input_.is_endless() ? Rational(0) : 1 / Rational(input_.reach);
    Rational upper = 1;
    for (std::size_t k = 0; k != 3; ++k) {
      const Rational l_lo(input_.light.lo[k]);
      const Rational l_hi(input_.light.hi[k]);
      if (!narrow(l_lo - Rational(input_.box.hi[k]), Rational(box.lo[k]) - l_lo, lower, upper)) return false;
      if (!narrow(Rational(input_.box.lo[k]) - l_hi, l_hi - Rational(box.hi[k]), lower, upper)) return false;
    }
    return true;
  }
  // The way from the origin meets the box of all differences of a point of the bound and a point of the body.
  Rational lower = 0;
  Rational upper = input_.is_endless() ? no_end() : Rational(1);
  for (std::size_t k = 0; k != 3; ++k) {
    const Rational d(input_.displacement[k]);
    const Rational least = Rational(box.lo[k]) - Rational(input_.box.hi[k]);
    const Rational most = Rational(box.hi[k]) - Rational(input_.box.lo[k]);
    if (!narrow(least, -d, lower, upper) || !narrow(-most, d, lower, upper)) return false;
  }
  return true;
}

std::array<MovingHull::Point, 2> MovingHull::position(const Rational& t) const {
  std::array<Point, 2> at;
  for (std::size_t k = 0; k != 3; ++k) {
    const Rational lo(input_.box.lo[k]);
    const Rational hi(input_.box.hi[k]);
    if (input_.is_shadow()) {  // l + t (o − l), t ≥ 1
      at[0][k] = t * lo - (t - 1) * Rational(input_.light.hi[k]);
      at[1][k] = t * hi - (t - 1) * Rational(input_.light.lo[k]);
    } else {
      at[0][k] = lo + t * Rational(input_.displacement[k]);
      at[1][k] = hi + t * Rational(input_.displacement[k]);
    }
  }
  return at;
}

void MovingHull::find_facets() const {
  if (has_facets_) return;
  has_facets_ = true;
  std::vector<Vertex> vertices;
  const auto add_corners = [&](const std::array<Point, 2>& box, bool are_directions) {
    for (unsigned corner = 0; corner != 8; ++corner) {
      Vertex vertex{{}, are_directions};
      for (std::size_t k = 0; k != 3; ++k) vertex.at[k] = box[corner >> k & 1U][k];
      vertices.push_back(vertex);
    }
  };
  const Rational start = input_.is_shadow() ? 1 : 0;
  const std::array<Point, 2> first = position(start);
  add_corners(first, false);
  if (!input_.is_endless()) {
    add_corners(position(input_.is_shadow() ? Rational(input_.reach) : Rational(1)), false);
  } else {
    std::array<Point, 2> way = position(start + 1);
    for (std::size_t side = 0; side != 2; ++side) {
      for (std::size_t k = 0; k != 3; ++k) way[side][k] -= first[side][k];
    }
    add_corners(way, true);
  }
  const auto from = [](const Vertex& origin, const Vertex& vertex) {
    Point way = vertex.at;
    for (std::size_t k = 0; k != 3 && !vertex.is_direction; ++k) way[k] -= origin.at[k];
    return way;
  };
  for (std::size_t i = 0; i != vertices.size(); ++i) {
    if (vertices[i].is_direction) continue;
    for (std::size_t j = i + 1; j != vertices.size(); ++j) {
      const Point x = from(vertices[i], vertices[j]);
      for (std::size_t l = j + 1; l != vertices.size(); ++l) {
        const Point y = from(vertices[i], vertices[l]);
        const Point normal{x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
        if (normal == Point{0, 0, 0}) continue;
        bool is_above = false;
        bool is_below = false;
        for (std::size_t v = 0; v != vertices.size() && !(is_above && is_below); ++v) {
          const int side = sgn(dot(normal, from(vertices[i], vertices[v])));
          is_above = is_above || side > 0;
          is_below = is_below || side < 0;
        }
        for (const int side : {-1, 1}) {
          if (side > 0 ? is_above : is_below) continue;
          RationalPlane plane{normal, dot(normal, vertices[i].at)};
          if (side < 0) {
            for (Rational& n : plane.normal) n = -n;
            plane.offset = -plane.offset;
          }
          const auto is_same = [&](const RationalPlane& other) {
            const Rational scale = dot(plane.normal, other.normal);
            const Rational square = dot(plane.normal, plane.normal) * dot(other.normal, other.normal);
            return scale > 0 && scale * scale == square;
          };
          if (std::none_of(facets_.begin(), facets_.end(), is_same)) facets_.push_back(plane);
        }
      }
    }
  }
}

Answer MovingHull::answer(const Box& box) const {
  for (std::size_t k = 0; k != 3; ++k) {
    if (box.lo[k] > box.hi[k]) return Answer::outside;
  }
  if (!meets(box)) return Answer::outside;
  bool inside = true;
  for (const RationalPlane& plane : added_) {
    if (extreme_height(plane, box, -1) > 0) return Answer::outside;
    inside = inside && extreme_height(plane, box, 1) <= 0;
  }
  for (unsigned corner = 0; corner != 8 && inside; ++corner) {
    Vec3 point{};
    for (std::size_t k = 0; k != 3; ++k) point[k] = (corner >> k & 1U) != 0 ? box.hi[k] : box.lo[k];
    inside = meets({point, point});
  }
  return inside ? Answer::inside : Answer::overlap;
}

Rational MovingHull::squared_distance(const Vec3& point) const {
  const Rational start = input_.is_shadow() ? 1 : 0;
  const Rational end = input_.is_endless() ? no_end() : input_.is_shadow() ? Rational(input_.reach) : Rational(1);
  const std::array<Point, 2> first = position(start);
  const std::array<Point, 2> next = position(start + 1);
  // The distance on an axis is linear in t between the t at which a face passes the point.
  std::vector<Rational> breaks{start, end};
  for (std::size_t k = 0; k != 3; ++k) {
    for (std::size_t side = 0; side != 2; ++side) {
      const Rational speed = next[side][k] - first[side][k];
      if (speed == 0) continue;
      const Rational t = start + (Rational(point[k]) - first[side][k]) / speed;
      if (t > start && t < end) breaks.push_back(t);
    }
  }
  std::sort(breaks.begin(), breaks.end());
  const auto squared = [&](const Rational& t, Rational& slope, Rational& bend) {
    const std::array<Point, 2> at = position(t);
    Rational sum = 0;
    slope = bend = 0;
    for (std::size_t k = 0; k != 3; ++k) {
      const Rational c(point[k]);
      const bool is_under = at[0][k] > c;
      const Rational distance = is_under ? Rational(at[0][k] - c) : Rational(c - at[1][k]);
      if (distance <= 0) continue;
      const Rational rate = is_under ? Rational(next[0][k] - first[0][k]) : Rational(first[1][k] - next[1][k]);
      sum += distance * distance;
      slope += 2 * distance * rate;
      bend += 2 * rate * rate;
    }
    return sum;
  };
  Rational slope;
  Rational bend;
  Rational least = squared(start, slope, bend);
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

Rational MovingHull::squared_depth(const Vec3& point) const {
  if (!meets({point, point})) return -1;
  find_facets();
  Rational least = -1;
  for (const RationalPlane& facet : facets_) {
    const Rational height =
        dot(facet.normal, {Rational(point[0]), Rational(point[1]), Rational(point[2])}) - facet.offset;
    const Rational depth = height * height / dot(facet.normal, facet.normal);
    if (least < 0 || depth < least) least = depth;
  }
  return least < 0 ? Rational(0) : least;
}

Answer MovingHull::answer(const Sphere& sphere) const {
  const Rational squared_radius = Rational(sphere.radius) * Rational(sphere.radius);
  if (squared_distance(sphere.centre) > squared_radius) return Answer::outside;
  const Point centre{Rational(sphere.centre[0]), Rational(sphere.centre[1]), Rational(sphere.centre[2])};
  bool inside = squared_depth(sphere.centre) >= squared_radius;
  for (const RationalPlane& plane : added_) {
    const Rational height = dot(plane.normal, centre) - plane.offset;
    const Rational limit = squared_radius * dot(plane.normal, plane.normal);
    if (height > 0 && height * height > limit) return Answer::outside;
    inside = inside && height <= 0 && height * height >= limit;
  }
  return inside ? Answer::inside : Answer::overlap;
}

}  // namespace oracle
}  // namespace shaftcull
