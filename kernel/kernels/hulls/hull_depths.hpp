// SPDX-License-Identifier: MIT
/// Bounds against the planes of a convex hull: what the stages of boxes and of spheres share.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "compiled/hull_data.hpp"
#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// The corner of a box whose depth a stage asks for: the one nearest to the hull, or the farthest.
enum class HullCorner : unsigned char { near, far };

/// The margin of planes of a bounded hull, and that of planes of a hull without end, relative to the sum of what a
/// depth is made of.
inline constexpr float hull_margin = 1.0F;
inline constexpr float unbounded_hull_margin = 7 * 0x1p-24F;

/// What a radius is taken for: so much more, or less, is sure to be more or less than what it amounts to.
inline constexpr float hull_radius_slack = 26 * 0x1p-24F;

/// The smallest depth of some vectors of bounds below planes of a hull: what it is at most, and at least.
///
/// most < 0: beyond a plane for certain. least > 0: behind all for certain. Of a depth that is not a number neither is.
template <class L, unsigned vectors, bool bounded>
struct HullDepths {
  using Vector = typename L::Vector;
  Vector most[vectors];
  Vector least[vectors];  ///< of boxes and a bounded hull it is most − 2 margins, and not kept here

  HullDepths() noexcept {
    for (unsigned v = 0; v < vectors; ++v) most[v] = least[v] = L::all(INFINITY);
  }

  /// Takes planes [first, last), of `coordinates` each, into account, for boxes in six streams.
  template <unsigned coordinates, HullCorner corner>
  SHAFTCULL_ALWAYS_INLINE void add_boxes(const HullData& hull, unsigned first, unsigned last,
                                         const float* const* stream, std::size_t at) noexcept {
    for (unsigned p = first; p < last; ++p) {
      const float* x[coordinates];
      for (unsigned i = 0; i < coordinates; ++i) x[i] = stream[box_stream<corner>(hull.plane[p].near[i])] + at;
      const Coefficients<coordinates> plane(hull.plane[p]);
      SHAFTCULL_UNROLL(8)
      for (unsigned v = 0; v < vectors; ++v) {
        const Vector depth = plane.depth(x, v);
        if constexpr (bounded) {
          most[v] = L::minimum(depth, most[v]);
        } else {
          const Vector margin = L::multiply(plane.terms(x, v), L::all(unbounded_hull_margin));
          most[v] = L::minimum(L::add(depth, margin), most[v]);
          least[v] = L::minimum(or_unknown(L::subtract(depth, margin)), least[v]);
        }
      }
    }
  }

  /// The same for spheres in four streams. Their radii count as `radius_for_most` and `radius_for_least`.
  template <unsigned coordinates>
  SHAFTCULL_ALWAYS_INLINE void add_spheres(const HullData& hull, unsigned first, unsigned last,
                                           const float* const* stream, std::size_t at,
                                           const Vector (&radius_for_most)[vectors],
                                           const Vector (&radius_for_least)[vectors]) noexcept {
    for (unsigned p = first; p < last; ++p) {
      const float* x[coordinates];
      for (unsigned i = 0; i < coordinates; ++i) x[i] = stream[hull.plane[p].near[i] % 3] + at;
      const Coefficients<coordinates> plane(hull.plane[p]);
      const Vector length = L::all(hull.plane[p].length);
      for (unsigned v = 0; v < vectors; ++v) {
        const Vector depth = plane.depth(x, v);
        Vector above = depth;
        Vector below = L::subtract(depth, L::all(2 * hull_margin));
        if constexpr (!bounded) {
          const Vector radius = L::load(stream[3] + at + v * L::width);
          const Vector terms = L::multiply_add(L::magnitude(radius), length, plane.terms(x, v));
          const Vector margin = L::multiply(terms, L::all(unbounded_hull_margin));
          above = L::add(depth, margin);
          below = L::subtract(depth, margin);
        }
        most[v] = L::minimum(L::multiply_add(radius_for_most[v], length, above), most[v]);
        const Vector lower = L::multiply_add(radius_for_least[v], length, below);
        least[v] = L::minimum(bounded ? lower : or_unknown(lower), least[v]);
      }
    }
  }

 private:
  /// The least that a depth can be: −∞ if that is not a number, as terms overflowed. minimum() and maximum() pass over
  /// a NaN in their first argument.
  [[nodiscard]] static Vector or_unknown(Vector lower) noexcept { return L::maximum(lower, L::all(-INFINITY)); }

  /// A plane's coefficients in whole vectors.
  template <unsigned coordinates>
  struct Coefficients {
    Vector inward[coordinates];
    Vector offset;
    Vector magnitude;

    explicit Coefficients(const HullData::Plane& plane) noexcept
        : offset(L::all(plane.offset)), magnitude(L::all(plane.magnitude)) {
      for (unsigned i = 0; i < coordinates; ++i) inward[i] = L::all(plane.inward[i]);
    }
    [[nodiscard]] Vector depth(const float* const (&x)[coordinates], unsigned v) const noexcept {
      Vector sum = offset;
      SHAFTCULL_UNROLL(3)
      for (unsigned i = 0; i < coordinates; ++i) sum = L::multiply_add(L::load(x[i] + v * L::width), inward[i], sum);
      return sum;
    }
    /// At least the magnitudes of all terms of the depth, and of those of a vertex.
    [[nodiscard]] Vector terms(const float* const (&x)[coordinates], unsigned v) const noexcept {
      Vector sum = magnitude;
      SHAFTCULL_UNROLL(3)
      for (unsigned i = 0; i < coordinates; ++i) {
        sum = L::add(sum, L::magnitude(L::multiply(L::load(x[i] + v * L::width), inward[i])));
      }
      return sum;
    }
  };

  /// The stream of a corner's coordinate, from that of the near corner.
  template <HullCorner corner>
  [[nodiscard]] static unsigned box_stream(unsigned near) noexcept {
    return corner == HullCorner::near ? near : near < 3 ? near + 3 : near - 3;
  }
};

}  // namespace shaftcull::kernel
