// SPDX-License-Identifier: MIT
/// Shafts of moving boxes of every family that exactness is tested on, and bounds that touch them or miss touching them
/// by an ulp or two.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "oracle/cases/shafts.hpp"
#include "oracle/moving_hull.hpp"
#include "oracle/random.hpp"
#include "oracle/shaft_input.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/volumes.hpp"

namespace shaftcull {

using MovingKind = MovingInput::Kind;
inline constexpr MovingKind moving_kinds[] = {MovingKind::swept, MovingKind::swept_infinite, MovingKind::shadow,
                                              MovingKind::shadow_without_end};

/// What the input describes, by the call of its kind.
inline CompiledShaft shaft_of(const MovingInput& input) {
  CompiledShaft shaft = input.kind == MovingKind::swept ? swept(input.box, input.displacement, input.added)
                        : input.kind == MovingKind::swept_infinite
                            ? swept_infinite(input.box, input.displacement, input.added)
                        : input.kind == MovingKind::shadow ? shadow(input.light, input.box, input.reach, input.added)
                                                           : shadow(input.light, input.box, input.added);
  set_contact(shaft, input.contact);
  return shaft;
}

/// A face of the moving box on an axis: where it starts and how far it goes in a unit of t, roughly. t is from 0 to 1
/// for a body, to the reach − 1 for a shadow.
struct FacePath {
  double start;
  double slope;

  FacePath(const MovingInput& input, std::size_t k, bool hi) {
    const auto at = [&](const Box& box, bool of_hi) { return static_cast<double>(of_hi ? box.hi[k] : box.lo[k]); };
    start = at(input.box, hi);
    slope = input.is_shadow() ? start - at(input.light, !hi) : static_cast<double>(input.displacement[k]);
  }
};

inline double random_time(Random& random, const MovingInput& input) {
  const double end = input.kind == MovingKind::shadow ? static_cast<double>(input.reach) - 1 : 1;
  if (input.is_endless() && random.one_in(2)) return std::exp2(static_cast<double>(random.uniform(-3, 12)));
  if (random.one_in(4)) return end * static_cast<double>(random.integer(0, 1));
  return end * static_cast<double>(random.uniform(0, 1));
}

inline float as_finite_float(double x) { return static_cast<float>(std::clamp(x, -3e38, 3e38)); }

/// A box with a corner on the path of a corner of the moving box, but for an ulp or two; it extends outwards, inwards,
/// or lies across.
inline Box touching_box(Random& random, const MovingInput& input) {
  const double t = random_time(random, input);
  const bool inwards = random.one_in(3);
  const double size = static_cast<double>(random.uniform(0, random.one_in(3) ? 3.0F : 0.3F));
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    const bool hi = random.one_in(2);
    const FacePath on(input, k, hi);
    const float point = random.nudge(as_finite_float(on.start + t * on.slope));
    const double extent =
        random.one_in(4) ? 0 : size * std::max({std::abs(on.start), std::abs(on.slope), std::abs(double{point}) / 64});
    const bool across = random.one_in(5);
    const bool upwards = hi != inwards;
    box.lo[k] = across || !upwards ? std::min(point, as_finite_float(double{point} - extent)) : point;
    box.hi[k] = across || upwards ? std::max(point, as_finite_float(double{point} + extent)) : point;
  }
  return box;
}

inline Vec3 nearby_point(Random& random, const MovingInput& input) {
  const double t = random_time(random, input);
  Vec3 point{};
  for (std::size_t k = 0; k != 3; ++k) {
    const FacePath lo(input, k, false);
    const FacePath hi(input, k, true);
    const auto at = static_cast<double>(random.uniform(-0.7F, 1.7F));
    point[k] = as_finite_float((1 - at) * (lo.start + t * lo.slope) + at * (hi.start + t * hi.slope) +
                               0.2 * static_cast<double>(random.uniform(-1, 1)) * std::abs(lo.slope));
  }
  return point;
}

/// A box that touches the shaft, one between two points near it, or one around the origin.
inline Box random_box(Random& random, const MovingInput& input) {
  if (random.one_in(2)) return touching_box(random, input);
  if (random.one_in(2)) return random.box(-6, 6, 0.01F, 2.0F);
  const Vec3 p = nearby_point(random, input);
  return Random::sorted(p, random.one_in(2) ? p : nearby_point(random, input));
}

/// A sphere, as often as not one that touches the shaft from outside or inside, but for an ulp or two.
inline Sphere nearby_sphere(Random& random, const MovingInput& input, const oracle::MovingHull& hull) {
  const Vec3 centre = nearby_point(random, input);
  if (random.one_in(3)) {
    const double size = std::abs(FacePath(input, random.below(3), false).slope);
    return {centre, random.one_in(4) ? 0.0F : as_finite_float(size * static_cast<double>(random.uniform(0, 1)))};
  }
  const mpq_class distance = hull.squared_distance(centre);
  const mpq_class square = distance > 0 ? distance : hull.squared_depth(centre);
  return {centre, std::max(0.0F, random.nudge(as_finite_float(std::sqrt(mpf_class(square, 256).get_d()))))};
}

/// A shaft between two of the places where the moving box is, for cases that need one.
inline ShaftInput part_of(Random& random, const MovingInput& input) {
  const double t = random_time(random, input);
  ShaftInput part{input.box, input.box};
  for (std::size_t k = 0; k != 3; ++k) {
    const FacePath lo(input, k, false);
    const FacePath hi(input, k, true);
    part.b.lo[k] = as_finite_float(lo.start + t * lo.slope);
    part.b.hi[k] = as_finite_float(hi.start + t * hi.slope);
  }
  return part;
}

inline bool are_apart(const Box& light, const Box& occluder) {
  for (std::size_t k = 0; k != 3; ++k) {
    if (light.hi[k] < occluder.lo[k] || occluder.hi[k] < light.lo[k]) return true;
  }
  return false;
}

/// An input of boxes and displacements that `box` and `vector` make, with a reach of every size.
template <class MakeBox, class MakeVector>
MovingInput moving_input(Random& random, MovingKind kind, const MakeBox& box, const MakeVector& vector) {
  MovingInput input{kind, box()};
  do {
    input.displacement = vector();
  } while (input.displacement == Vec3{0, 0, 0});
  do {
    input.light = box();
    if (random.one_in(4)) input.light.hi = input.light.lo;  // a point light
    if (!are_apart(input.light, input.box)) input.box = box();
  } while (!are_apart(input.light, input.box));
  constexpr float reaches[] = {1.0F, 1.5F, 2.0F, 10.0F};
  input.reach = random.one_in(2) ? reaches[random.below(4)] : 1 + std::exp2(random.uniform(-12, 6));
  return input;
}

inline MovingInput random_movement(Random& random, MovingKind kind) {
  const float size = random.one_in(2) ? 5.0F : 1.0F;
  return moving_input(
      random, kind, [&] { return random.box(-5, 5, 0.05F, 1.0F); }, [&] { return random.vec3(-size, size); });
}

inline MovingInput grid_movement(Random& random, MovingKind kind) {
  MovingInput input = moving_input(
      random, kind, [&] { return random.grid_box(0, 8); },
      [&] {
        return Vec3{random.integer(-4, 4), random.integer(-4, 4), random.integer(-4, 4)};
      });
  input.reach = random.integer(1, 4);
  return input;
}

/// Along an axis or in a plane.
inline MovingInput straight_movement(Random& random, MovingKind kind) {
  return moving_input(
      random, kind, [&] { return random.one_in(2) ? random.grid_box(0, 3) : random.box(-3, 3, 0.1F, 1.0F); },
      [&] {
        Vec3 d = random.vec3(-3, 3);
        d[random.below(3)] = 0;
        if (random.one_in(2)) d[random.below(3)] = -0.0F;
        return d;
      });
}

/// By a few ulps, or less, on some axes.
inline MovingInput tiny_movement(Random& random, MovingKind kind) {
  return moving_input(
      random, kind, [&] { return random.box(-5, 5, 0.05F, 1.0F); },
      [&] {
        Vec3 d{};
        for (float& x : d) x = std::ldexp(random.uniform(-1, 1), static_cast<int>(random.integer(-40, 1)));
        return d;
      });
}

inline MovingInput distant_movement(Random& random, MovingKind kind) {
  const float distance = std::pow(10.0F, random.uniform(1, 7));
  return moving_input(
      random, kind,
      [&] {
        Box box = random.box(-5, 5, 0.05F, 1.0F);
        for (std::size_t k = 0; k != 3; ++k) {
          box.lo[k] += distance;
          box.hi[k] += distance;
        }
        return box;
      },
      [&] { return random.vec3(-5, 5); });
}

/// That ends far beyond the scene.
inline MovingInput far_movement(Random& random, MovingKind kind) {
  MovingInput input = moving_input(
      random, kind, [&] { return random.box(-5, 5, 0.05F, 1.0F); },
      [&] {
        const int exponent = static_cast<int>(random.integer(15, 125));
        Vec3 d{};
        for (float& x : d) x = std::ldexp(random.uniform(-1, 1), exponent - static_cast<int>(random.integer(0, 20)));
        return d;
      });
  input.reach = std::exp2(random.uniform(10, 120));
  return input;
}

/// Of any magnitude, from denormals to 10³⁸, as often as not one for all coordinates.
inline MovingInput wild_movement(Random& random, MovingKind kind) {
  const bool mixed = random.one_in(3);
  const int low = mixed ? -149 : static_cast<int>(random.integer(-149, 122));
  const int high = mixed ? 127 : low + 5;
  const auto vector = [&] { return Vec3{random.wild(low, high), random.wild(low, high), random.wild(low, high)}; };
  return moving_input(
      random, kind,
      [&] {
        const Vec3 p = vector();
        return Random::sorted(p, vector());
      },
      vector);
}

/// Nearly all bounds of the lattice touch it, and half of the extents are 0.
inline MovingInput lattice_movement(Random& random, MovingKind kind) {
  MovingInput input = moving_input(
      random, kind, [&] { return lattice_box(random); },
      [&] {
        return Vec3{random.integer(-2, 2), random.integer(-2, 2), random.integer(-2, 2)};
      });
  input.reach = random.integer(1, 3);
  if (random.one_in(3)) input.added.push_back(plane_through(random, input.box.lo, true));
  return input;
}

/// A box on the lattice of lattice_movement(), or beside it.
inline Box lattice_bound(Random& random) {
  Box box = lattice_box(random, 5);
  const Vec3 by{random.integer(-3, 0), random.integer(-3, 0), random.integer(-3, 0)};
  for (std::size_t k = 0; k != 3; ++k) {
    box.lo[k] += by[k];
    box.hi[k] += by[k];
  }
  return box;
}

inline MovingInput movement_with_planes(Random& random, MovingKind kind) {
  MovingInput input = random_movement(random, kind);
  for (unsigned planes = 1 + random.below(3); planes != 0; --planes) {
    const Vec3 p = nearby_point(random, input);
    const Vec3 n = random.vec3(-1, 1);
    input.added.push_back({n, n[0] * p[0] + n[1] * p[1] + n[2] * p[2]});
  }
  return input;
}

/// Shafts of moving boxes, and the bounds that are asked of them.
struct MovingFamily {
  const char* name;
  MovingInput (*input)(Random& random, MovingKind kind);
  Box (*box)(Random& random, const MovingInput& input);
  Sphere (*sphere)(Random& random, const MovingInput& input, const oracle::MovingHull& hull);
};

inline constexpr MovingFamily moving_families[] = {
    {"random", random_movement, random_box, nearby_sphere},
    {"grid", grid_movement,
     [](Random& random, const MovingInput& input) {
       return random.one_in(2) ? random.grid_box(-12, 24) : touching_box(random, input);
     },
     nearby_sphere},
    {"along an axis or a plane", straight_movement, random_box, nearby_sphere},
    {"a few ulps", tiny_movement, random_box, nearby_sphere},
    {"far from origin", distant_movement, touching_box, nearby_sphere},
    {"far beyond", far_movement, random_box, nearby_sphere},
    {"any magnitude", wild_movement, touching_box, nearby_sphere},
    {"lattice", lattice_movement, [](Random& random, const MovingInput&) { return lattice_bound(random); },
     [](Random& random, const MovingInput&, const oracle::MovingHull&) {
       return Sphere{lattice_bound(random).lo, random.integer(0, 2)};
     }},
    {"added planes", movement_with_planes, random_box, nearby_sphere},
};

}  // namespace shaftcull
