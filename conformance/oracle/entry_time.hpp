// SPDX-License-Identifier: MIT
/// When a moving box first touches another box or a sphere, in exact arithmetic, straight from the definition.
#pragma once

#include <gmpxx.h>

#include <compare>
#include <optional>

#include "oracle/moving_hull.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::oracle {

/// The least t in [0, 1] at which box(t) and `box` have a common point, box(t) going from a at 0 to b at 1 with every
/// face at a speed of its own; none if there is no such t.
std::optional<mpq_class> entry_time(const Box& a, const Box& b, const Box& box);

/// The same for a body that is swept and for a shadow, t counting from 0 in displacements, or from the occluder in
/// distances of it from the light: where the box was at t, it was l + (1 + t) (o − l) for points of both.
std::optional<mpq_class> entry_time(const MovingInput& input, const Box& box);

/// A time that a sphere is reached at: whole − √square.
struct RootTime {
  mpq_class whole;
  mpq_class square = 0;  ///< not negative

  friend std::strong_ordering operator<=>(const RootTime& a, const RootTime& b);
  friend bool operator==(const RootTime& a, const RootTime& b) { return std::is_eq(a <=> b); }
};

/// The least t at which the centre of the sphere is no farther than its radius from box(t); likewise. The centre is
/// finite.
std::optional<RootTime> entry_time(const Box& a, const Box& b, const Sphere& sphere);
std::optional<RootTime> entry_time(const MovingInput& input, const Sphere& sphere);

/// The unit vector from `box` towards box(t) at its entry time, along the lowest axis on which the two have a common
/// point from then on and not before; zero if there is no such axis.
Vec3 contact_normal(const Box& a, const Box& b, const Box& box);
Vec3 contact_normal(const MovingInput& input, const Box& box);

/// The unit vector from the centre of the sphere towards the nearest point of box(t) at the entry time, each component
/// rounded to nearest, to even; that of a point if the radius is 0. Zero if the distance is less than the radius then,
/// or does not shrink.
Vec3 contact_normal(const Box& a, const Box& b, const Sphere& sphere);
Vec3 contact_normal(const MovingInput& input, const Sphere& sphere);

/// The largest float that is not larger than a time, which is not negative.
float rounded_down(const mpq_class& time);
float rounded_down(const RootTime& time);

}  // namespace shaftcull::oracle
