// SPDX-License-Identifier: MIT
/// The answers worked out in exact rational arithmetic, straight from the definition. Slow, and shares no code with
/// the library.
///
/// The shaft of boxes a and b is conv(a ∪ b), the union over t in [0, 1] of box(t) with lo(t) = a.lo + t (b.lo − a.lo)
/// and hi(t) likewise, cut by the half-spaces that were added.
#pragma once

#include <gmpxx.h>

#include <array>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/cull.hpp"

namespace shaftcull::oracle {

using Rational = mpq_class;

/// n·p ≤ offset is inside.
struct RationalPlane {
  std::array<Rational, 3> normal;
  Rational offset;
};

class Hull {
 public:
  Hull(const Box& a, const Box& b, const std::vector<Plane>& added = {});

  /// Infinite extents are unbounded boxes; a box with lo > hi meets nothing.
  [[nodiscard]] Answer answer(const Box& box) const;
  /// An infinite radius is all of space; the centre is finite.
  [[nodiscard]] Answer answer(const Sphere& sphere) const;

  /// Whether the bound touches from outside (it meets the shaft, but a plane separates their interiors) or from inside.
  [[nodiscard]] bool touches(const Box& box) const;
  [[nodiscard]] bool touches(const Sphere& sphere) const;

  /// Squared distance of a point from conv(a ∪ b), added planes left out.
  [[nodiscard]] Rational squared_distance(const Vec3& point) const;

 private:
  [[nodiscard]] bool meets(const Box& box) const;
  [[nodiscard]] bool holds(const Box& box) const;

  std::array<Rational, 6> a_;  ///< lo x, y, z, hi x, y, z
  std::array<Rational, 6> b_;
  std::vector<RationalPlane> faces_;  ///< of conv(a ∪ b)
  std::vector<RationalPlane> added_;
};

}  // namespace shaftcull::oracle
