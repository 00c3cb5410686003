// SPDX-License-Identifier: MIT
/// Shafts of every family that exactness is tested on.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "oracle/random.hpp"
#include "oracle/shaft_input.hpp"

namespace shaftcull {

inline ShaftInput random_shaft(Random& random) {
  return {random.box(-5, 5, 0.2F, 1.0F), random.box(-5, 5, 0.2F, 1.0F)};
}

inline ShaftInput grid_shaft(Random& random, int size = 8) {
  return {random.grid_box(0, size), random.grid_box(0, size)};
}

/// A box with integer corners; half of its extents are 0.
inline Box lattice_box(Random& random, int size = 3) {
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    box.lo[k] = random.integer(0, size);
    box.hi[k] = random.one_in(2) ? box.lo[k] : box.lo[k] + random.integer(1, 2);
  }
  return box;
}

/// A shaft between two of them: nearly all that is near it touches it.
inline ShaftInput lattice_shaft(Random& random, int size = 3) {
  const Box a = lattice_box(random, size);
  return {a, lattice_box(random, size)};
}

/// A box that moves by whole steps of 2^exponent, on two of its axes by 3 k and 4 k steps: joining planes whose normals
/// have a length of 5 k, so that spheres with whole centres and radii touch them. Its size may change, on any axis by
/// up to two steps.
inline ShaftInput pythagorean_shaft(Random& random, int exponent = 0) {
  ShaftInput input{};
  const std::size_t first = random.below(3);
  const int steps = static_cast<int>(random.integer(1, 4));
  for (std::size_t i = 0; i != 3; ++i) {
    const std::size_t k = (first + i) % 3;
    int travel = i == 2 ? static_cast<int>(random.integer(-6, 6)) : (3 + static_cast<int>(i)) * steps;
    if (random.one_in(2)) travel = -travel;
    const auto at = [&](int x) { return std::ldexp(static_cast<float>(x), exponent); };
    const int lo = static_cast<int>(random.integer(0, 8));
    const int hi = lo + static_cast<int>(random.integer(0, 4));
    const int less = random.one_in(4) ? static_cast<int>(random.integer(0, 2)) : 0;
    const int more = random.one_in(4) ? static_cast<int>(random.integer(0, 2)) : 0;
    input.a.lo[k] = at(lo);
    input.a.hi[k] = at(hi);
    input.b.lo[k] = at(lo + travel - less);
    input.b.hi[k] = at(hi + travel + more);
  }
  return input;
}

/// Two boxes of which the second is made from the first: equal, nested, touching, sharing faces, flat, or points.
inline ShaftInput degenerate_shaft(Random& random) {
  const Box a = random.box(-2, 2, 0.1F, 1.0F);
  Box b = a;
  switch (random.below(6)) {
    case 0:
      break;
    case 1:
      for (std::size_t k = 0; k != 3; ++k) {
        b.lo[k] = a.lo[k] + (a.hi[k] - a.lo[k]) * 0.25F * random.integer(0, 1);
        b.hi[k] = a.hi[k] - (a.hi[k] - a.lo[k]) * 0.25F * random.integer(0, 1);
      }
      break;
    case 2: {
      const std::size_t axis = random.below(3);
      b.lo[axis] = a.hi[axis];
      b.hi[axis] = a.hi[axis] + 1.0F;
      break;
    }
    case 3:
      b = {a.hi, a.hi};
      break;
    case 4: {
      const Vec3 p = random.vec3(-2, 2);
      b = {p, p};
      b.hi[random.below(3)] += random.integer(0, 1);
      break;
    }
    default: {
      const Vec3 p = random.vec3(-2, 2);
      const Vec3 q = random.one_in(4) ? p : random.vec3(-2, 2);
      return {{p, p}, {q, q}};
    }
  }
  return random.one_in(2) ? ShaftInput{a, b} : ShaftInput{b, a};
}

/// A random shaft moved by about `distance` along the axes in the set `axes` (bit k for axis k), or along any.
inline ShaftInput distant_shaft(Random& random, float distance, unsigned axes = 0) {
  ShaftInput input = random_shaft(random);
  if (axes == 0) axes = 1 + random.below(7);
  for (std::size_t k = 0; k != 3; ++k) {
    if ((axes >> k & 1U) == 0) continue;
    const float shift = random.one_in(2) ? distance : -distance;
    for (Box* box : {&input.a, &input.b}) {
      box->lo[k] += shift;
      box->hi[k] += shift;
    }
  }
  return input;
}

/// A shaft from one corner of a cube to the opposite one, around the origin or about `distance` from it on each axis:
/// steep slopes, coordinates and slopes just above powers of 2, where rounding is relatively worst. As often as not all
/// axes are alike, which makes the coefficients of the slab form cancel, and its margins tightest.
inline ShaftInput long_shaft(Random& random, bool distant = false) {
  const float distance =
      distant ? std::ldexp(random.uniform(1.05F, 1.2F), static_cast<int>(random.integer(5, 14))) : 0.0F;
  const bool alike = random.one_in(2);
  const auto sign = [&] { return random.one_in(2) ? 1.0F : -1.0F; };
  float side = sign();
  float shift = sign() * distance;
  ShaftInput input{};
  for (std::size_t k = 0; k != 3; ++k) {
    if (!alike) {
      side = sign();
      shift = sign() * distance;
    }
    for (Box* box : {&input.a, &input.b}) {
      const float centre = shift + (box == &input.a ? side : -side) * random.uniform(4.1F, 4.3F);
      const float half = random.one_in(4) ? 0.0F : random.uniform(0.0F, 0.08F);
      box->lo[k] = centre - half;
      box->hi[k] = centre + half;
    }
  }
  return input;
}

/// Faces that coincide but for an ulp or two.
inline ShaftInput nearly_equal_shaft(Random& random) {
  ShaftInput input{random.box(-5, 5, 0.2F, 1.0F), {}};
  input.b = input.a;
  for (std::size_t k = 0; k != 3; ++k) {
    if (random.one_in(2)) input.b.lo[k] = std::min(random.nudge(input.a.lo[k]), input.b.hi[k]);
    if (random.one_in(2)) input.b.hi[k] = std::max(random.nudge(input.a.hi[k]), input.b.lo[k]);
  }
  const std::size_t axis = random.below(3);
  if (random.one_in(2)) input.b.lo[axis] = input.b.hi[axis] = input.a.hi[axis] + 2.0F;
  return random.one_in(2) ? input : ShaftInput{input.b, input.a};
}

/// A box whose coordinates have magnitudes from 2^low to 2^high.
inline Box wild_box(Random& random, int low = -149, int high = 127) {
  const auto corner = [&] { return Vec3{random.wild(low, high), random.wild(low, high), random.wild(low, high)}; };
  const Vec3 p = corner();
  return Random::sorted(p, corner());
}

inline ShaftInput wild_shaft(Random& random, int low = -149, int high = 127) {
  const Box a = wild_box(random, low, high);
  return {a, wild_box(random, low, high)};
}

/// A point, now and then with an extent, that moves 2⁶⁷ to 2⁷⁵ along one axis and about 2⁶⁸ along another: products of
/// what it moves and of distances that a sphere of ordinary size has from it are near the largest float.
inline ShaftInput huge_shaft(Random& random) {
  const auto power = [&](float low, float high) { return std::exp2(random.uniform(low, high)); };
  const std::size_t along = random.below(3);
  const std::size_t across = (along + 1 + random.below(2)) % 3;
  ShaftInput input{};
  input.a.lo[along] = power(66, 74.5F);
  input.b.lo[along] = -input.a.lo[along];
  input.b.lo[across] = power(67, 70);
  if (random.one_in(2)) std::swap(input.a.lo[along], input.b.lo[along]);
  input.a.hi = input.a.lo;
  input.b.hi = input.b.lo;
  for (std::size_t k = 0; k != 3; ++k) {
    if (random.one_in(4)) input.a.hi[k] += power(40, 60);
    if (random.one_in(4)) input.b.hi[k] += power(40, 60);
  }
  return input;
}

/// A box near the origin that is swept 2²¹ to 2¹²⁶ far, at any angle or along an axis or two; now and then it comes
/// from there.
inline ShaftInput far_sweep_shaft(Random& random) {
  ShaftInput input{random.box(-5, 5, 0.05F, 1.0F), {}};
  const float length = std::ldexp(random.uniform(1.0F, 2.0F), static_cast<int>(random.integer(21, 125)));
  const bool alike = random.one_in(3);
  for (std::size_t k = 0; k != 3; ++k) {
    float travel = random.one_in(4) ? 0.0F : length * (alike ? 1.0F : std::exp2(-random.uniform(0.0F, 12.0F)));
    if (random.one_in(2)) travel = -travel;
    input.b.lo[k] = input.a.lo[k] + travel;
    input.b.hi[k] = input.a.hi[k] + travel + (random.one_in(4) ? std::abs(travel) * random.uniform(0.0F, 1.0F) : 0.0F);
  }
  return random.one_in(4) ? ShaftInput{input.b, input.a} : input;
}

/// Number of ways to colour six faces red, blue or purple.
inline constexpr unsigned colourings = 729;

/// The shaft whose faces have colouring number `colouring`, on a grid of 0 … 4.
inline ShaftInput coloured_shaft(unsigned colouring) {
  constexpr float lo[3][2] = {{0, 1}, {1, 0}, {1, 1}};  // red, blue, purple
  constexpr float hi[3][2] = {{4, 3}, {3, 4}, {3, 3}};
  ShaftInput input{};
  for (std::size_t k = 0; k != 3; ++k) {
    input.a.lo[k] = lo[colouring % 3][0];
    input.b.lo[k] = lo[colouring % 3][1];
    input.a.hi[k] = hi[colouring / 3 % 3][0];
    input.b.hi[k] = hi[colouring / 3 % 3][1];
    colouring /= 9;
  }
  return input;
}

/// A plane through `point`, as nearly as its offset can be rounded; through it exactly on a grid.
inline Plane plane_through(Random& random, const Vec3& point, bool grid) {
  Plane plane{};
  do {
    for (float& n : plane.normal) n = grid ? random.integer(-3, 3) : random.one_in(4) ? 0.0F : random.uniform(-2, 2);
  } while (plane.normal == Vec3{0, 0, 0});
  double offset = 0;
  for (std::size_t k = 0; k != 3; ++k) offset += static_cast<double>(plane.normal[k]) * static_cast<double>(point[k]);
  plane.offset = static_cast<float>(offset);
  if (!grid) plane.offset = random.nudge(plane.offset);
  return plane;
}

/// `input` with up to 16 planes added, all through its corners.
inline ShaftInput with_planes(Random& random, ShaftInput input, bool grid) {
  const unsigned planes = 1 + random.below(random.one_in(4) ? 16 : 2);
  for (unsigned i = 0; i != planes; ++i) {
    input.added.push_back(plane_through(random, random.one_in(2) ? input.a.lo : input.b.hi, grid));
  }
  return input;
}

/// `input` with a few planes added whose coefficients have any magnitude, as often as not the same one.
inline ShaftInput with_wild_planes(Random& random, ShaftInput input) {
  for (unsigned planes = 1 + random.below(2); planes != 0; --planes) {
    const int high = random.one_in(2) ? 127 : static_cast<int>(random.integer(-140, 127));
    const int low = high == 127 ? -149 : high - 9;
    const auto coefficient = [&] { return random.wild(low, high); };
    input.added.push_back(
        {{coefficient(), coefficient(), coefficient()}, random.one_in(2) ? coefficient() : random.wild()});
  }
  return input;
}

}  // namespace shaftcull
