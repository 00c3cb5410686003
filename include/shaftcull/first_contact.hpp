// SPDX-License-Identifier: MIT
/// First contact: the bound that the moving box of a shaft reaches first, the time of the contact, and its normal.
///
/// A shaft between boxes a and b is the volume that a box sweeps over when it moves from a, at time 0, to b, at time 1.
/// Each of the six faces of the box has its own speed. For a swept body (volumes.hpp), time is the fraction of the
/// displacement or, if the shaft has no end, the multiple of the direction. For a shadow, time is 0 at the occluder, 1
/// at twice its distance from the light, and at most `reach` − 1. The *entry time* of a box or sphere that the shaft
/// keeps is the first time at which the moving box touches it: 0 if the box touches it at the start. *First contact* is
/// the kept bound with the least entry time; among several with the same time, it is the bound with the lowest index.
///
/// If the moving body is itself among the bounds, it is reached at time 0, before all others: leave it out with
/// `{.exclude = {me}}`. The floor on which a body stands is also reached at time 0.
///
/// With `{.skip_overlapping = true}` (Query), first contact leaves out each bound that the moving box overlaps at the
/// start: the shaft's box a(), the body, or the occluder. With closed contact, these are the bounds that have a point
/// in common with that box: the bounds whose entry time is 0, including bounds that only touch the box. With open
/// contact, they are the bounds whose relative interiors have a point in common with the relative interior of the box.
/// So use open contact for bodies that slide along walls: a wall that the box touches at the start, and moves into, is
/// reached at time 0, and the floor on which the box stands, and along which it moves, is left out. A point is its own
/// relative interior. If the radius of a sphere is infinite or NaN, or a coordinate of a bound is NaN, this value puts
/// no constraint on the overlap, as it puts none on the entry time (below).
///
/// There is no option for a *skin*, a distance that counts as touching. Instead, cast a body that is larger by the
/// skin: swept(inflated(body, skin), travel). It reaches the bounds that come as near as the skin on every axis, at the
/// time when they do.
///
/// Planes added to the shaft leave out bounds beyond them, as in every query. Open contact (set_contact()) leaves out
/// bounds that the moving box only touches, such as a floor along which a body slides. Neither changes the times of
/// other bounds. If a coordinate of a kept bound is infinite or NaN, it puts no constraint on the entry time; if the
/// radius of a kept sphere is infinite or NaN, the entry time is 0.
///
/// Times are compared exactly, as real numbers, so first contact is the same on every instruction set, in views and in
/// trees. The written time is the exact time rounded down to a finite float: the moving box does not touch the bound
/// before it. Entry times of spheres are irrational in general: they are roots of quadratic polynomials, and are
/// compared as such.
///
/// The *normal of contact* has unit length and points from the bound towards the moving box. For a box it is one of
/// ±x, ±y and ±z: the normal of the pair of faces that meet last, at the exact entry time. If several pairs meet at
/// that time, as at an edge or a corner, the normal is along the lowest axis. For a sphere it points from the centre to
/// the nearest point of the moving box at the exact entry time; each component is the real number rounded to the
/// nearest float. A sphere of radius 0 is a box that is a point. The normal is zero if the bound overlaps the moving
/// box at the start, or touches the box at the start without the box moving into it: then the box runs into no face and
/// no nearest point. To slide along the bound, remove from the displacement its component along the normal
/// (docs/recipes/sliding.md).
///
/// Bounds are boxes or spheres. Triangles are refused with InvalidArgument, and so are convex hulls (hull.hpp), in
/// which no box moves. Options, errors, threads and stack: query.hpp and many.hpp. Calls for many shafts allocate only
/// task memory of oneTBB.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/query.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// The first contact of a shaft. Converts to false if there is no contact:
/// `if (const auto contact = first_contact(shaft, tree))`.
struct FirstContact {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();  ///< no bound

  std::uint32_t index = none;  ///< position in a view, the user's index in a tree; `none` without a contact
  float time = std::numeric_limits<float>::infinity();  ///< entry time, rounded down; +∞ without a contact
  Vec3 normal{};  ///< of contact, from the bound towards the moving box; zero if the start overlaps, or without a
                  ///< contact

  /// Whether there is a contact.
  constexpr explicit operator bool() const noexcept { return index != none; }
  friend bool operator==(const FirstContact&, const FirstContact&) = default;
};

/// Returns the first contact among the bounds. In a tree, the query visits near nodes first, and skips nodes that are
/// reached later than the first bound found so far. So it tests mostly bounds that touch the box at the start, or few
/// more than the first contact. Throws InvalidArgument for a view of more than 2³² − 1 bounds.
[[nodiscard]] SHAFTCULL_EXPORT FirstContact first_contact(const CompiledShaft& shaft, const Bounds& bounds,
                                                          const Query& query = no_options);

/// Writes first_contact(shafts[s], …) to contacts[s]. Throws InvalidArgument unless there is exactly one contact per
/// shaft.
SHAFTCULL_EXPORT void first_contact_many(std::span<const CompiledShaft> shafts, const Bounds& bounds,
                                         std::span<FirstContact> contacts, const Query& query = no_options);

/// Writes the entry time of bound indices[i] to times[i], rounded down, or +∞ if the shaft does not keep the bound.
/// O(indices.size()), about 50 ns per box and 400 ns per sphere. Throws InvalidArgument as first_contact() does, for an
/// index that is not below the number of bounds, unless there are as many times as indices, and if `indices` and
/// `times` share memory. Throws NeedsRefit for a tree that needs a refit. Allocates nothing, except that the first call
/// for a tree may store the leaf of every index (Query::only).
SHAFTCULL_EXPORT void entry_times(const CompiledShaft& shaft, const Bounds& bounds,
                                  std::span<const std::uint32_t> indices, std::span<float> times);

}  // namespace shaftcull
