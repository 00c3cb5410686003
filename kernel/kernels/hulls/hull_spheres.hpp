// SPDX-License-Identifier: MIT
/// Spheres against a convex hull, by distances from its planes.
#pragma once

#include "exact/convex_hull.hpp"
#include "kernels/hulls/hull_depths.hpp"
#include "kernels/shared/word.hpp"

namespace shaftcull::kernel {

/// What a vector of spheres is, for certain.
struct SphereLanes {
  std::uint64_t no = 0;
  std::uint64_t yes = 0;
};

/// Which spheres of a vector are outside the hull (`inside` is false) or inside it, by its planes.
template <class L, bool bounded, bool inside>
[[nodiscard]] SphereLanes hull_spheres_vector(const HullData& hull, const float* const* stream,
                                              std::size_t at) noexcept {
  using Vector = typename L::Vector;
  const Vector radius = L::load(stream[3] + at);
  const Vector more = L::multiply(radius, L::all(1 + hull_radius_slack));
  const Vector less = L::multiply(radius, L::all(1 - hull_radius_slack));
  const Vector for_most[1] = {inside ? L::subtract(L::all(0.0F), less) : more};
  const Vector for_least[1] = {inside ? L::subtract(L::all(0.0F), more) : less};
  HullDepths<L, 1, bounded> depths;
  depths.template add_spheres<3>(hull, 0, hull.faces, stream, at, for_most, for_least);
  depths.template add_spheres<2>(hull, hull.faces, hull.faces + hull.edges, stream, at, for_most, for_least);
  // Distances from the faces of the hull's box, of which a rounded one that is not equal to the radius is on the same
  // side of it as the exact one.
  const Vector zero = L::all(0.0F);
  auto beyond = L::less(depths.most[0], zero);
  auto behind = L::less(zero, depths.least[0]);
  if constexpr (bounded) {
    // Where terms overflow, depths say nothing. Those of a hull without end are unknown then: so are their margins.
    const Vector farthest = L::all(hull.farthest);
    auto is_near = L::less_equal(L::magnitude(L::load(stream[0] + at)), farthest);
    for (unsigned k = 1; k < 3; ++k) {
      is_near = L::both(is_near, L::less_equal(L::magnitude(L::load(stream[k] + at)), farthest));
    }
    beyond = L::both(beyond, is_near);
    behind = L::both(behind, is_near);
  }
  for (unsigned k = 0; k < 3; ++k) {
    const Vector centre = L::load(stream[k] + at);
    const Vector above_lo = L::subtract(centre, L::all(hull.box[k]));
    const Vector below_hi = L::subtract(L::all(hull.box[k + 3]), centre);
    for (const Vector within : {above_lo, below_hi}) {
      const Vector distance = inside ? within : L::subtract(zero, within);
      if constexpr (inside) {
        beyond = L::either(beyond, L::less(distance, radius));
        behind = L::both(behind, L::less(radius, distance));
      } else {
        beyond = L::either(beyond, L::less(radius, distance));
        behind = L::both(behind, L::less(distance, radius));
      }
    }
  }
  const auto is_negative = L::less(radius, zero);
  return {L::bits(L::either(beyond, is_negative)), L::bits(behind)};
}

/// Clears the bits of spheres that are outside the hull, or of those that are not inside. What touches is undecided, so
/// contact matters there alone.
template <class L, bool inside>
void hull_spheres_stage(const HullData& hull, Contact contact, const float* const* stream, std::size_t words,
                        std::uint64_t* bits) noexcept {
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t yes = 0;
    for (unsigned lane = 0; lane < word_bits && hull.suits_floats; lane += L::width) {
      if ((bits[w] & lanes_of<L>(lane)) == 0) continue;
      const std::size_t at = w * word_bits + lane;
      const SphereLanes lanes = hull.is_bounded ? hull_spheres_vector<L, true, inside>(hull, stream, at)
                                                : hull_spheres_vector<L, false, inside>(hull, stream, at);
      bits[w] &= ~(lanes.no << lane);
      yes |= lanes.yes << lane;
    }
    const std::uint64_t undecided = bits[w] & ~yes;
    if (undecided != 0) {
      const std::uint64_t decided = decide_lanes<L>(undecided, [&](unsigned lane) {
        const BoundAt<L, 4> sphere(stream, w * word_bits + lane);
        if (inside) return hull_sphere_inside(hull, sphere.value);
        return contact == Contact::open ? hull_sphere_outside_openly(hull, sphere.value)
                                        : hull_sphere_outside(hull, sphere.value);
      });
      bits[w] &= inside ? yes | decided : ~decided;
    }
  }
}

}  // namespace shaftcull::kernel
