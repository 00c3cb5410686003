// SPDX-License-Identifier: MIT
/// First contact: which bound the moving box of a shaft reaches first, and when.
///
/// A shaft between boxes a and b is what a box sweeps over that moves from a, at time 0, to b, at time 1; each of its
/// six faces has a speed of its own. Of a body that is swept (volumes.hpp) time is the share of the displacement, or a
/// multiple of the direction if there is no end; of a shadow it is 0 at the occluder, 1 where things are twice as far
/// from the light, and goes up to `reach` − 1. The *entry time* of a box or sphere that the shaft keeps is the first
/// time at which the moving box touches it: 0 if it touches where that starts. First contact is the bound with the
/// least entry time of those that the shaft keeps, and of several with the same time the one with the lowest index.
///
/// A body that is among the bounds is reached at time 0, before all else: leave it out, `{.exclude = {me}}`. The floor
/// that a body stands on is reached at 0, too; with open contact what the body only slides along is left out.
///
/// Planes that were added to the shaft leave
/// out bounds that are beyond them, as they do in every query, and open contact (set_contact()) leaves out bounds that
/// the moving box only touches; times of the others do not depend on either. A coordinate that is infinite or NaN, of a
/// bound that is kept, puts no constraint on its time, and a sphere whose radius is either is reached at time 0.
///
/// Times are compared exactly, as real numbers, so which bound comes first is the same on every instruction set, in
/// views and in trees. The time that is written is the exact one rounded down to a float that is finite: the moving box
/// touches nothing before it. Times of spheres are irrational in general: roots of quadratic polynomials, which are
/// compared as such.
///
/// Bounds are boxes or spheres; triangles are refused. Options, errors, threads and stack: query.hpp and many.hpp. A
/// convex hull (hull.hpp), in which nothing moves, is refused with InvalidArgument, too. Nothing is allocated but task
/// memory of oneTBB by calls for many shafts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "shaftcull/compiled.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/query.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// What a shaft reaches first. False if that is nothing: `if (const auto contact = first_contact(shaft, tree))`.
struct FirstContact {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();  ///< no bound

  std::uint32_t index = none;  ///< of the bound: its position in a view, the user's index in a tree; `none` for nothing
  float time = std::numeric_limits<float>::infinity();  ///< rounded down; +∞ for nothing

  /// Whether there is a contact.
  constexpr explicit operator bool() const noexcept { return index != none; }
  friend bool operator==(const FirstContact&, const FirstContact&) = default;
};

/// First contact among the bounds. A tree visits near nodes first and no node that is reached later than the first
/// bound found so far, so it mostly looks at bounds that touch the start, or at few more than the first. Throws
/// InvalidArgument for a view of more than 2³² − 1 bounds.
[[nodiscard]] SHAFTCULL_EXPORT FirstContact first_contact(const CompiledShaft& shaft, const Bounds& bounds,
                                                          const Query& query = no_options);

/// contacts[s] becomes first_contact(shafts[s], …). One for each shaft. Throws InvalidArgument if there are more or
/// fewer.
SHAFTCULL_EXPORT void first_contact_many(std::span<const CompiledShaft> shafts, const Bounds& bounds,
                                         std::span<FirstContact> contacts, const Query& query = no_options);

/// Entry times of bounds that a list names: times[i] becomes that of bound indices[i], rounded down, or +∞ if the shaft
/// does not keep it. O(indices.size()), about 50 ns for a box and 400 ns for a sphere. Throws InvalidArgument for an
/// index not below the number of bounds, unless there are as many times as indices, if the two share memory, or as
/// first_contact(), and NeedsRefit for a tree that needs a refit. Allocates nothing, except for a tree the leaf of
/// every index at the first call, as Query::only says.
SHAFTCULL_EXPORT void entry_times(const CompiledShaft& shaft, const Bounds& bounds,
                                  std::span<const std::uint32_t> indices, std::span<float> times);

}  // namespace shaftcull
