// SPDX-License-Identifier: MIT
/// Bounds around a shaft: random ones, and those that touch it or miss touching it by an ulp or two, where rounding
/// would decide.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "oracle/quick_hull.hpp"
#include "oracle/random.hpp"
#include "oracle/shaft_input.hpp"
#include "shaftcull/paper.hpp"

namespace shaftcull {

inline Box random_box(Random& random) {
  return random.one_in(2) ? random.box(-6, 6, 0.01F, 0.5F) : random.box(-6, 6, 0.5F, 4.0F);
}

/// A point around the shaft, as often in it as not.
inline Vec3 random_centre(Random& random, const ShaftInput& input, float distance = 0.7F) {
  const float t = random.uniform(0.0F, 1.0F);
  Vec3 centre{};
  for (std::size_t k = 0; k != 3; ++k) {
    const float from = random.uniform(input.a.lo[k], input.a.hi[k]);
    const float to = random.uniform(input.b.lo[k], input.b.hi[k]);
    centre[k] = from + t * (to - from) + random.uniform(-distance, distance);
  }
  return centre;
}

inline Sphere random_sphere(Random& random, const ShaftInput& input) {
  const Vec3 centre = random_centre(random, input);
  return {centre, random.one_in(8) ? 0.0F : random.uniform(0.0F, random.one_in(4) ? 3.0F : 0.4F)};
}

/// A box around a point near the shaft, wherever that is.
inline Box nearby_box(Random& random, const ShaftInput& input) {
  const Vec3 centre = random_centre(random, input, 2.0F);
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    const float half = random.uniform(0.01F, 2.0F);
    box.lo[k] = centre[k] - half;
    box.hi[k] = centre[k] + half;
  }
  return box;
}

/// A box with a corner, edge or face on the path of a corner of the moving box, which is where the shaft's edges
/// are; it extends outwards, or inwards, or lies across.
inline Box touching_box(Random& random, const ShaftInput& input) {
  const float t = random.one_in(4) ? random.integer(0, 1) : random.uniform(0.0F, 1.0F);
  const bool inwards = random.one_in(3);
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    const bool hi = random.one_in(2);
    const double from = static_cast<double>(hi ? input.a.hi[k] : input.a.lo[k]);
    const double to = static_cast<double>(hi ? input.b.hi[k] : input.b.lo[k]);
    const float point = random.nudge(static_cast<float>(from + static_cast<double>(t) * (to - from)));
    const double extent =
        random.one_in(4) ? 0.0 : static_cast<double>(random.uniform(0.0F, 0.3F)) * std::max(std::abs(from), 1e-3);
    const auto beyond = [&](double distance) {
      return static_cast<float>(std::clamp(static_cast<double>(point) + distance, -3e38, 3e38));
    };
    const bool across = random.one_in(5);
    const bool upwards = hi != inwards;
    box.lo[k] = across || !upwards ? std::min(point, beyond(-extent)) : point;
    box.hi[k] = across || upwards ? std::max(point, beyond(extent)) : point;
  }
  return box;
}

/// A touching_box() of a far_sweep_shaft() that is cut short: the sweep ends 2⁻¹⁰ to 2⁷ from where it starts, so that
/// boxes touch it near its start.
inline Box touching_far_sweep(Random& random, const ShaftInput& input) {
  const auto largest_coordinate = [](const Box& box) {
    double largest = 0;
    for (std::size_t k = 0; k != 3; ++k) {
      largest = std::max({largest, static_cast<double>(std::abs(box.lo[k])), static_cast<double>(std::abs(box.hi[k]))});
    }
    return largest;
  };
  const bool starts_at_a = largest_coordinate(input.a) <= largest_coordinate(input.b);
  const Box& near = starts_at_a ? input.a : input.b;
  const Box& far = starts_at_a ? input.b : input.a;
  const double t =
      random.one_in(8) ? 0.0 : std::exp2(static_cast<double>(random.uniform(-10, 7))) / largest_coordinate(far);
  Box box{};
  const bool inwards = random.one_in(3);
  for (std::size_t k = 0; k != 3; ++k) {
    const bool hi = random.one_in(2);
    const double from = static_cast<double>(hi ? near.hi[k] : near.lo[k]);
    const double to = static_cast<double>(hi ? far.hi[k] : far.lo[k]);
    const float point = random.nudge(static_cast<float>(from + t * (to - from)));
    const float extent = random.one_in(4) ? 0.0F : random.uniform(0.0F, 0.5F);
    const bool across = random.one_in(5);
    const bool upwards = hi != inwards;
    box.lo[k] = across || !upwards ? point - extent : point;
    box.hi[k] = across || upwards ? point + extent : point;
  }
  return box;
}

/// A box that blocks the shaft or, by an ulp or two, does not: on the way from a to b it holds the whole moving box, or
/// its faces are beyond, but for one or two axes on which it is as thin as a screen.
inline Box blocking_box(Random& random, const ShaftInput& input) {
  const float middle = random.one_in(4) ? random.integer(1, 3) / 4 : random.uniform(0.0F, 1.0F);
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    const auto on_the_way = [&](const Vec3& from, const Vec3& to, float t) {
      const auto p = static_cast<double>(from[k]);
      return static_cast<float>(p + static_cast<double>(t) * (static_cast<double>(to[k]) - p));
    };
    const auto beyond = [&](float x, float sign) {
      if (random.one_in(2)) return random.nudge(x);
      const float extent = std::max(std::abs(x), 0x1p-140F) * random.uniform(0.0F, 1.0F);
      return std::clamp(x + sign * extent, -3e38F, 3e38F);
    };
    const float t = random.one_in(4) ? random.uniform(0.0F, 1.0F) : middle;
    const float lo = on_the_way(input.a.lo, input.b.lo, t);
    const float hi = on_the_way(input.a.hi, input.b.hi, random.one_in(4) ? random.uniform(0.0F, 1.0F) : t);
    if (random.one_in(4)) {  // a screen
      box.lo[k] = box.hi[k] = random.nudge(random.one_in(2) ? lo : hi);
      if (random.one_in(2)) box.hi[k] = random.nudge(std::max(lo, hi));
    } else {
      box.lo[k] = beyond(lo, -1);
      box.hi[k] = beyond(hi, 1);
    }
  }
  return Random::sorted(box.lo, box.hi);
}

/// A sphere around `centre` whose radius is, to an ulp or two, its distance from the shaft, or its depth in it.
inline Sphere touching_sphere(Random& random, const oracle::QuickHull& hull, const Vec3& centre) {
  return {centre, std::max(0.0F, random.nudge(static_cast<float>(std::min(hull.distance_to_surface(centre), 3e38))))};
}

/// A sphere of a few ulps, or none, beside the path of a corner of the moving box: rounding errors are as large as its
/// radius.
inline Sphere tiny_sphere(Random& random, const ShaftInput& input, const oracle::QuickHull& hull) {
  const float t = random.one_in(3) ? random.integer(0, 1) : random.uniform(random.one_in(2) ? 0.9F : 0.0F, 1.0F);
  const unsigned most_steps = random.one_in(2) ? 5 : 1;
  Vec3 centre{};
  for (std::size_t k = 0; k != 3; ++k) {
    const bool hi = random.one_in(2);
    const double from = static_cast<double>(hi ? input.a.hi[k] : input.a.lo[k]);
    const double to = static_cast<double>(hi ? input.b.hi[k] : input.b.lo[k]);
    centre[k] = static_cast<float>(from + static_cast<double>(t) * (to - from));
    const float away = hi != random.one_in(3) ? INFINITY : -INFINITY;
    for (unsigned steps = random.below(most_steps + 1); steps != 0; --steps)
      centre[k] = std::nextafter(centre[k], away);
  }
  return random.one_in(3) ? Sphere{centre, 0.0F} : touching_sphere(random, hull, centre);
}

/// A sphere that rests on a joining plane, if the shaft has any: of any size, up to ten thousand times the shaft's.
inline Sphere resting_sphere(Random& random, const ShaftInput& input, const oracle::QuickHull& hull) {
  const Shaft shaft(input.a, input.b);
  const auto planes = shaft.joining_planes();
  Vec3 centre = random_centre(random, input, 0.0F);
  if (planes.empty()) return touching_sphere(random, hull, centre);
  const JoiningPlane& joining = planes[random.below(static_cast<unsigned>(planes.size()))];
  const float t = random.uniform(0.0F, 1.0F);
  const Vec3& normal = joining.plane.normal;
  const double length = std::hypot(double{normal[0]}, double{normal[1]}, double{normal[2]});
  const auto distance = static_cast<float>(std::pow(10.0F, random.uniform(-2.0F, 4.0F)) / length);
  for (const Face face : {joining.red, joining.blue}) {
    const auto on = [&](const Box& box) { return face < 3 ? box.lo[face] : box.hi[face - 3]; };
    centre[face % 3] = on(input.a) + t * (on(input.b) - on(input.a)) + distance * normal[face % 3];
  }
  return touching_sphere(random, hull, centre);
}

/// A sphere with whole steps of 2^exponent as centre and radius, in and around a pythagorean_shaft(); a point as
/// often as not. Now and then one of its numbers is an ulp or two off.
inline Sphere whole_sphere(Random& random, int exponent = 0) {
  float number[4];
  for (float& x : number) x = std::ldexp(random.integer(-12, 24), exponent);
  number[3] = random.one_in(2) ? 0.0F : std::ldexp(random.integer(1, 5), exponent);
  if (random.one_in(4)) {
    float& off = number[random.below(4)];
    off = random.nudge(off);
  }
  return {{number[0], number[1], number[2]}, std::max(0.0F, number[3])};
}

/// Likewise, with as radius the distance from the shaft, which is whole as often as not.
inline Sphere whole_touching_sphere(Random& random, const oracle::QuickHull& hull, int exponent = 0) {
  Sphere sphere = whole_sphere(random, exponent);
  const float radius = static_cast<float>(hull.distance_to_surface(sphere.centre));
  const float whole = std::ldexp(std::round(std::ldexp(radius, -exponent)), exponent);
  sphere.radius = std::max(0.0F, random.one_in(2) ? whole : random.nudge(radius));
  return sphere;
}

/// A sphere of 2⁴⁴ to 2⁶⁰ beside a huge_shaft(), not far from where it starts.
inline Sphere sphere_beside_huge(Random& random, const ShaftInput& input, const oracle::QuickHull& hull) {
  const auto power = [&](float low, float high) { return std::exp2(random.uniform(low, high)); };
  const float radius = random.one_in(2) ? 0x1p60F : power(44, 60);
  std::size_t along = 0;
  for (std::size_t k = 1; k != 3; ++k) {
    const auto travel = [&](std::size_t axis) { return std::abs(input.b.lo[axis] - input.a.lo[axis]); };
    if (travel(k) > travel(along)) along = k;
  }
  const float passed = power(60, 64);
  Vec3 centre = input.a.lo;
  for (std::size_t k = 0; k != 3; ++k) {
    const float travel = input.b.lo[k] - input.a.lo[k];
    if (k == along) {
      centre[k] += travel > 0 ? passed : -passed;
    } else {
      const float beside = power(-4, 0) * radius;
      centre[k] += random.one_in(2) ? beside : -beside;
    }
  }
  return random.one_in(3) ? touching_sphere(random, hull, centre) : Sphere{centre, radius};
}

/// A box with one corner on an added plane, as nearly as can be.
inline Box box_at_plane(Random& random, const ShaftInput& input) {
  const Plane& plane = input.added[random.below(static_cast<unsigned>(input.added.size()))];
  Box box = nearby_box(random, input);
  Vec3 corner{};
  for (std::size_t k = 0; k != 3; ++k) corner[k] = random.one_in(2) ? box.lo[k] : box.hi[k];
  std::size_t axis = 0;
  for (std::size_t k = 1; k != 3; ++k) {
    if (std::abs(plane.normal[k]) > std::abs(plane.normal[axis])) axis = k;
  }
  double rest = static_cast<double>(plane.offset);
  for (std::size_t k = 0; k != 3; ++k) {
    if (k != axis) rest -= static_cast<double>(plane.normal[k]) * static_cast<double>(corner[k]);
  }
  const float x = random.nudge(static_cast<float>(rest / static_cast<double>(plane.normal[axis])));
  const float size = box.hi[axis] - box.lo[axis];
  box.lo[axis] = random.one_in(2) ? x : x - size;
  box.hi[axis] = std::max(box.lo[axis] == x ? x + size : x, box.lo[axis]);
  return box;
}

/// A sphere whose radius is, to an ulp or two, the distance of its centre from an added plane.
inline Sphere sphere_at_plane(Random& random, const ShaftInput& input, const Vec3& centre) {
  const Plane& plane = input.added[random.below(static_cast<unsigned>(input.added.size()))];
  double height = -static_cast<double>(plane.offset);
  double squared = 0;
  for (std::size_t k = 0; k != 3; ++k) {
    height += static_cast<double>(plane.normal[k]) * static_cast<double>(centre[k]);
    squared += static_cast<double>(plane.normal[k]) * static_cast<double>(plane.normal[k]);
  }
  const double radius = std::min(std::abs(height) / std::sqrt(squared), 3e38);
  return {centre, std::max(0.0F, random.nudge(static_cast<float>(radius)))};
}

inline Sphere sphere_at_plane(Random& random, const ShaftInput& input) {
  return sphere_at_plane(random, input, random_centre(random, input, 2.0F));
}

/// A point whose coordinates have magnitudes from 2^low to 2^high.
inline Vec3 wild_point(Random& random, int low = -149, int high = 127) {
  return {random.wild(low, high), random.wild(low, high), random.wild(low, high)};
}

/// A point of any magnitude, with coordinates of about the same one as often as not.
inline Vec3 boundless_point(Random& random) {
  if (random.one_in(2)) return wild_point(random);
  const int exponent = static_cast<int>(random.integer(-140, 127));
  return wild_point(random, exponent - 4, exponent);
}

/// A box of any magnitude.
inline Box boundless_box(Random& random) {
  const Vec3 p = boundless_point(random);
  return Random::sorted(p, boundless_point(random));
}

/// A sphere of any magnitude, touching the shaft or an added plane as often as not.
inline Sphere boundless_sphere(Random& random, const ShaftInput& input, const oracle::QuickHull& hull) {
  const Vec3 centre = boundless_point(random);
  if (random.one_in(3)) return {centre, std::abs(random.wild())};
  if (random.one_in(2) && !input.added.empty()) return sphere_at_plane(random, input, centre);
  return touching_sphere(random, hull, centre);
}

}  // namespace shaftcull
