// SPDX-License-Identifier: MIT
/// Convex hulls of every family that exactness is tested on, and bounds next to them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "oracle/convex_hull.hpp"
#include "oracle/random.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull {

/// Up to `most` points, and sometimes a few directions, with what `coordinate` draws.
template <class Coordinate>
HullInput hull_of(Random& random, unsigned most, Coordinate coordinate) {
  HullInput input;
  const unsigned count = 1 + random.below(most);
  for (unsigned i = 0; i != count; ++i) input.points.push_back({coordinate(), coordinate(), coordinate()});
  if (random.one_in(3)) {
    const unsigned directions = 1 + random.below(3);
    while (input.directions.size() != directions) {
      const Vec3 direction = {coordinate(), coordinate(), coordinate()};
      if (direction != Vec3{0, 0, 0}) input.directions.push_back(direction);
    }
  }
  return input;
}

/// A box that is put next to the hull: a corner, or a point of an edge or a face between two of the points.
inline Box near_box(Random& random, const HullInput& input, float size) {
  const Vec3& p = input.points[random.below(static_cast<unsigned>(input.points.size()))];
  const Vec3& q = input.points[random.below(static_cast<unsigned>(input.points.size()))];
  const float share = random.uniform(0, 1);
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    const float between = random.one_in(3) ? p[k] : random.nudge(p[k] + share * (q[k] - p[k]));
    const float x = std::clamp(between, -3e38F, 3e38F);
    const float extent = random.one_in(4) ? 0 : random.uniform(0, size);
    const float far = std::clamp(random.one_in(2) ? x + extent : x - extent, -3e38F, 3e38F);
    box.lo[k] = std::min(x, far);
    box.hi[k] = std::max(x, far);
  }
  return box;
}

/// A sphere that touches a plane of the hull from outside or from inside, but for an ulp or two.
inline Sphere touching_sphere(Random& random, const oracle::ConvexHull& hull, const Vec3& centre) {
  const double radius = std::min(hull.distance_to_surface(centre), 3e38);
  return {centre, std::max(0.0F, random.nudge(static_cast<float>(radius)))};
}

/// A sphere around a point, that touches a plane as often as not.
inline Sphere sphere_around(Random& random, const oracle::ConvexHull& hull, const Vec3& centre, float largest) {
  return random.one_in(2) ? touching_sphere(random, hull, centre) : Sphere{centre, random.uniform(0, largest)};
}

/// Magnitudes as those of the hull.
struct HullMagnitude {
  int low;
  int high;

  explicit HullMagnitude(const HullInput& input) {
    const float x = std::abs(input.points[0][0]);
    high = x == 0 ? 0 : std::ilogb(x);
    low = std::max(-149, high - 6);
  }
  [[nodiscard]] Vec3 point(Random& random) const {
    return {random.wild(low, high), random.wild(low, high), random.wild(low, high)};
  }
};

/// The corners of a view from the origin along z, of sides that differ by an ulp or two, as rounding leaves them.
inline HullInput view_hull(Random& random) {
  const float near = random.uniform(0.5F, 2.0F);
  const float far = near * random.uniform(2.0F, 8.0F);
  const float wide = random.uniform(0.3F, 1.5F);
  const float high = random.uniform(0.3F, 1.5F);
  HullInput input;
  for (const float z : {near, far}) {
    for (unsigned corner = 0; corner != 4; ++corner) {
      const float x = corner % 2 == 0 ? -wide * z : wide * z;
      const float y = corner / 2 == 0 ? -high * z : high * z;
      input.points.push_back({random.nudge(x), random.nudge(y), random.nudge(z)});
    }
  }
  return input;
}

/// A view and a light in the plane of one of its faces, but for an ulp or two, or one that shines along it.
inline HullInput casters_hull(Random& random) {
  HullInput input = view_hull(random);
  const Vec3& p = input.points[random.below(8)];
  const Vec3& q = input.points[random.below(8)];
  const Vec3& r = input.points[random.below(8)];
  Vec3 at{};
  const float u = random.uniform(-3, 3);
  const float v = random.one_in(3) ? 0.0F : random.uniform(-3, 3);
  for (std::size_t k = 0; k != 3; ++k) at[k] = random.nudge(p[k] + u * (q[k] - p[k]) + v * (r[k] - p[k]));
  if (random.one_in(2)) {
    input.points.push_back(at);
    return input;
  }
  for (std::size_t k = 0; k != 3; ++k) at[k] -= p[k];
  if (at != Vec3{0, 0, 0}) input.directions.push_back(at);
  return input;
}

/// Hulls, and the bounds that are asked of them.
struct HullFamily {
  const char* name;
  HullInput (*input)(Random& random);
  Box (*box)(Random& random, const HullInput& input);
  Sphere (*sphere)(Random& random, const HullInput& input, const oracle::ConvexHull& hull);
};

inline constexpr HullFamily hull_families[] = {
    {"random", [](Random& random) { return hull_of(random, 7, [&] { return random.uniform(-5, 5); }); },
     [](Random& random, const HullInput& input) {
       return random.one_in(2) ? random.box(-8, 8, 0, 3) : near_box(random, input, 2);
     },
     [](Random& random, const HullInput&, const oracle::ConvexHull& hull) {
       const float distance = random.one_in(4) ? 2000.0F : 8.0F;  // far ones have radii far above the hull's size
       return sphere_around(random, hull, random.vec3(-distance, distance), distance / 2);
     }},
    {"grid", [](Random& random) { return hull_of(random, 7, [&] { return random.integer(-2, 2); }); },
     [](Random& random, const HullInput&) { return random.grid_box(-4, 4); },
     [](Random& random, const HullInput&, const oracle::ConvexHull& hull) {
       const Vec3 centre = {random.integer(-5, 5), random.integer(-5, 5), random.integer(-5, 5)};
       return random.one_in(2) ? touching_sphere(random, hull, centre) : Sphere{centre, random.integer(0, 4)};
     }},
    {"any magnitude",
     [](Random& random) {
       const int high = random.one_in(3) ? static_cast<int>(random.integer(-148, -120))
                                         : static_cast<int>(random.integer(-140, 127));
       const int low = std::max(-149, high - static_cast<int>(random.below(40)));
       return hull_of(random, 6, [&] { return random.wild(low, high); });
     },
     [](Random& random, const HullInput& input) {
       const HullMagnitude magnitude(input);
       if (random.one_in(2)) return near_box(random, input, std::ldexp(1.0F, magnitude.high));
       const Vec3 p = magnitude.point(random);
       return Random::sorted(p, magnitude.point(random));
     },
     [](Random& random, const HullInput& input, const oracle::ConvexHull& hull) {
       const HullMagnitude magnitude(input);
       const Vec3 centre = magnitude.point(random);
       return random.one_in(2) ? touching_sphere(random, hull, centre)
                               : Sphere{centre, std::abs(random.wild(magnitude.low, magnitude.high))};
     }},
    {"views", view_hull,
     [](Random& random, const HullInput& input) {
       return random.one_in(3) ? random.box(-15, 15, 0, 6) : near_box(random, input, 4);
     },
     [](Random& random, const HullInput&, const oracle::ConvexHull& hull) {
       return sphere_around(random, hull, random.vec3(-15, 15), 5);
     }},
    {"casters", casters_hull,
     [](Random& random, const HullInput& input) {
       return random.one_in(3) ? random.box(-15, 15, 0, 6) : near_box(random, input, 4);
     },
     [](Random& random, const HullInput&, const oracle::ConvexHull& hull) {
       return sphere_around(random, hull, random.vec3(-15, 15), 5);
     }},
};

}  // namespace shaftcull
