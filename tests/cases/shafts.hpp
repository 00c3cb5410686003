/// Shafts of every family that exactness is tested on.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "dice.hpp"
#include "subject.hpp"

namespace shaftcull {

inline Subject random_subject(Dice& dice) { return {dice.box(-5, 5, 0.2F, 1.0F), dice.box(-5, 5, 0.2F, 1.0F)}; }

inline Subject grid_subject(Dice& dice, int size = 8) { return {dice.grid_box(0, size), dice.grid_box(0, size)}; }

/// A box that moves by whole steps of 2^exponent, on two of its axes by 3 k and 4 k steps: joining planes whose normals
/// have a length of 5 k, so that spheres with whole centres and radii touch them. Its size may change, on any axis by
/// up to two steps.
inline Subject pythagorean_subject(Dice& dice, int exponent = 0) {
  Subject subject{};
  const std::size_t first = dice.below(3);
  const int steps = static_cast<int>(dice.integer(1, 4));
  for (std::size_t i = 0; i != 3; ++i) {
    const std::size_t k = (first + i) % 3;
    int way = i == 2 ? static_cast<int>(dice.integer(-6, 6)) : (3 + static_cast<int>(i)) * steps;
    if (dice.one_in(2)) way = -way;
    const auto at = [&](int x) { return std::ldexp(static_cast<float>(x), exponent); };
    const int lo = static_cast<int>(dice.integer(0, 8));
    const int hi = lo + static_cast<int>(dice.integer(0, 4));
    const int less = dice.one_in(4) ? static_cast<int>(dice.integer(0, 2)) : 0;
    const int more = dice.one_in(4) ? static_cast<int>(dice.integer(0, 2)) : 0;
    subject.a.lo[k] = at(lo);
    subject.a.hi[k] = at(hi);
    subject.b.lo[k] = at(lo + way - less);
    subject.b.hi[k] = at(hi + way + more);
  }
  return subject;
}

/// Two boxes of which the second is made from the first: equal, nested, touching, sharing faces, flat, or points.
inline Subject degenerate_subject(Dice& dice) {
  const Box a = dice.box(-2, 2, 0.1F, 1.0F);
  Box b = a;
  switch (dice.below(6)) {
    case 0:
      break;
    case 1:
      for (std::size_t k = 0; k != 3; ++k) {
        b.lo[k] = a.lo[k] + (a.hi[k] - a.lo[k]) * 0.25F * dice.integer(0, 1);
        b.hi[k] = a.hi[k] - (a.hi[k] - a.lo[k]) * 0.25F * dice.integer(0, 1);
      }
      break;
    case 2: {
      const std::size_t axis = dice.below(3);
      b.lo[axis] = a.hi[axis];
      b.hi[axis] = a.hi[axis] + 1.0F;
      break;
    }
    case 3:
      b = {a.hi, a.hi};
      break;
    case 4: {
      const Vec3 p = dice.vec3(-2, 2);
      b = {p, p};
      b.hi[dice.below(3)] += dice.integer(0, 1);
      break;
    }
    default: {
      const Vec3 p = dice.vec3(-2, 2);
      const Vec3 q = dice.one_in(4) ? p : dice.vec3(-2, 2);
      return {{p, p}, {q, q}};
    }
  }
  return dice.one_in(2) ? Subject{a, b} : Subject{b, a};
}

/// A random shaft moved by about `distance` along the axes in the set `axes` (bit k for axis k), or along any.
inline Subject distant_subject(Dice& dice, float distance, unsigned axes = 0) {
  Subject subject = random_subject(dice);
  if (axes == 0) axes = 1 + dice.below(7);
  for (std::size_t k = 0; k != 3; ++k) {
    if ((axes >> k & 1U) == 0) continue;
    const float shift = dice.one_in(2) ? distance : -distance;
    for (Box* box : {&subject.a, &subject.b}) {
      box->lo[k] += shift;
      box->hi[k] += shift;
    }
  }
  return subject;
}

/// A shaft from one corner of a cube to the opposite one, around the origin or about `distance` from it on each axis:
/// steep slopes, coordinates and slopes just above powers of 2, where rounding is relatively worst. As often as not all
/// axes are alike, which makes the coefficients of the slab form cancel, and its margins tightest.
inline Subject long_subject(Dice& dice, bool distant = false) {
  const float distance = distant ? std::ldexp(dice.uniform(1.05F, 1.2F), static_cast<int>(dice.integer(5, 14))) : 0.0F;
  const bool alike = dice.one_in(2);
  const auto sign = [&] { return dice.one_in(2) ? 1.0F : -1.0F; };
  float side = sign();
  float shift = sign() * distance;
  Subject subject{};
  for (std::size_t k = 0; k != 3; ++k) {
    if (!alike) {
      side = sign();
      shift = sign() * distance;
    }
    for (Box* box : {&subject.a, &subject.b}) {
      const float centre = shift + (box == &subject.a ? side : -side) * dice.uniform(4.1F, 4.3F);
      const float half = dice.one_in(4) ? 0.0F : dice.uniform(0.0F, 0.08F);
      box->lo[k] = centre - half;
      box->hi[k] = centre + half;
    }
  }
  return subject;
}

/// Faces that coincide but for an ulp or two.
inline Subject nearly_equal_subject(Dice& dice) {
  Subject subject{dice.box(-5, 5, 0.2F, 1.0F), {}};
  subject.b = subject.a;
  for (std::size_t k = 0; k != 3; ++k) {
    if (dice.one_in(2)) subject.b.lo[k] = std::min(dice.nudge(subject.a.lo[k]), subject.b.hi[k]);
    if (dice.one_in(2)) subject.b.hi[k] = std::max(dice.nudge(subject.a.hi[k]), subject.b.lo[k]);
  }
  const std::size_t axis = dice.below(3);
  if (dice.one_in(2)) subject.b.lo[axis] = subject.b.hi[axis] = subject.a.hi[axis] + 2.0F;
  return dice.one_in(2) ? subject : Subject{subject.b, subject.a};
}

/// A box whose coordinates have magnitudes from 2^low to 2^high.
inline Box wild_box(Dice& dice, int low = -149, int high = 127) {
  const auto corner = [&] { return Vec3{dice.wild(low, high), dice.wild(low, high), dice.wild(low, high)}; };
  const Vec3 p = corner();
  return Dice::sorted(p, corner());
}

inline Subject wild_subject(Dice& dice, int low = -149, int high = 127) {
  const Box a = wild_box(dice, low, high);
  return {a, wild_box(dice, low, high)};
}

/// A point, now and then with an extent, that moves 2⁶⁷ to 2⁷⁵ along one axis and about 2⁶⁸ along another: products of
/// what it moves and of distances that a sphere of ordinary size has from it are near the largest float.
inline Subject huge_subject(Dice& dice) {
  const auto power = [&](float low, float high) { return std::exp2(dice.uniform(low, high)); };
  const std::size_t along = dice.below(3);
  const std::size_t across = (along + 1 + dice.below(2)) % 3;
  Subject subject{};
  subject.a.lo[along] = power(66, 74.5F);
  subject.b.lo[along] = -subject.a.lo[along];
  subject.b.lo[across] = power(67, 70);
  if (dice.one_in(2)) std::swap(subject.a.lo[along], subject.b.lo[along]);
  subject.a.hi = subject.a.lo;
  subject.b.hi = subject.b.lo;
  for (std::size_t k = 0; k != 3; ++k) {
    if (dice.one_in(4)) subject.a.hi[k] += power(40, 60);
    if (dice.one_in(4)) subject.b.hi[k] += power(40, 60);
  }
  return subject;
}

/// A box near the origin that is swept 2²¹ to 2¹²⁶ far, at any angle or along an axis or two; now and then it comes
/// from there.
inline Subject far_sweep_subject(Dice& dice) {
  Subject subject{dice.box(-5, 5, 0.05F, 1.0F), {}};
  const float length = std::ldexp(dice.uniform(1.0F, 2.0F), static_cast<int>(dice.integer(21, 125)));
  const bool alike = dice.one_in(3);
  for (std::size_t k = 0; k != 3; ++k) {
    float way = dice.one_in(4) ? 0.0F : length * (alike ? 1.0F : std::exp2(-dice.uniform(0.0F, 12.0F)));
    if (dice.one_in(2)) way = -way;
    subject.b.lo[k] = subject.a.lo[k] + way;
    subject.b.hi[k] = subject.a.hi[k] + way + (dice.one_in(4) ? std::abs(way) * dice.uniform(0.0F, 1.0F) : 0.0F);
  }
  return dice.one_in(4) ? Subject{subject.b, subject.a} : subject;
}

/// Number of ways to colour six faces red, blue or purple.
inline constexpr unsigned colourings = 729;

/// The shaft whose faces have colouring number `colouring`, on a grid of 0 … 4.
inline Subject coloured_subject(unsigned colouring) {
  constexpr float lo[3][2] = {{0, 1}, {1, 0}, {1, 1}};  // red, blue, purple
  constexpr float hi[3][2] = {{4, 3}, {3, 4}, {3, 3}};
  Subject subject{};
  for (std::size_t k = 0; k != 3; ++k) {
    subject.a.lo[k] = lo[colouring % 3][0];
    subject.b.lo[k] = lo[colouring % 3][1];
    subject.a.hi[k] = hi[colouring / 3 % 3][0];
    subject.b.hi[k] = hi[colouring / 3 % 3][1];
    colouring /= 9;
  }
  return subject;
}

/// A plane through `point`, as nearly as its offset can be rounded; through it exactly on a grid.
inline Plane plane_through(Dice& dice, const Vec3& point, bool grid) {
  Plane plane{};
  do {
    for (float& n : plane.normal) n = grid ? dice.integer(-3, 3) : dice.one_in(4) ? 0.0F : dice.uniform(-2, 2);
  } while (plane.normal == Vec3{0, 0, 0});
  double offset = 0;
  for (std::size_t k = 0; k != 3; ++k) offset += static_cast<double>(plane.normal[k]) * static_cast<double>(point[k]);
  plane.offset = static_cast<float>(offset);
  if (!grid) plane.offset = dice.nudge(plane.offset);
  return plane;
}

/// `subject` with up to 16 planes added, all through its corners.
inline Subject with_planes(Dice& dice, Subject subject, bool grid) {
  const unsigned planes = 1 + dice.below(dice.one_in(4) ? 16 : 2);
  for (unsigned i = 0; i != planes; ++i) {
    subject.added.push_back(plane_through(dice, dice.one_in(2) ? subject.a.lo : subject.b.hi, grid));
  }
  return subject;
}

/// `subject` with a few planes added whose coefficients have any magnitude, as often as not the same one.
inline Subject with_wild_planes(Dice& dice, Subject subject) {
  for (unsigned planes = 1 + dice.below(2); planes != 0; --planes) {
    const int high = dice.one_in(2) ? 127 : static_cast<int>(dice.integer(-140, 127));
    const int low = high == 127 ? -149 : high - 9;
    const auto coefficient = [&] { return dice.wild(low, high); };
    subject.added.push_back(
        {{coefficient(), coefficient(), coefficient()}, dice.one_in(2) ? coefficient() : dice.wild()});
  }
  return subject;
}

}  // namespace shaftcull
