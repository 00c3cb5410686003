// SPDX-License-Identifier: MIT
/// Shafts of moving boxes: the volume that a body sweeps, and the shadow of an occluder.
///
/// A shaft between two boxes is the volume of a box that moves from one to the other. Here the box moves by a
/// displacement, in a direction without end, or away from a light. These shafts support every query that compile(a, b)
/// supports, exactly for the floats given: no end box is rounded. Joining planes are pending, and contact is closed
/// until set_contact() opens it.
///
/// A box with an infinite corner is never inside: if a shaft without end contains all of it, the answer is *overlap*.
///
/// All calls throw InvalidArgument for a box that is not finite or has lo > hi, for a plane that is not finite or has
/// no normal, and for more than max_added_planes planes. Planes are added as by compile(a, b, planes). A call takes 17
/// to 90 ns, allocates nothing and is safe to call from many threads.
#pragma once

#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/streams.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Returns the volume that a body sweeps when it moves by a displacement: all body + t · displacement, t from 0 to 1. A
/// displacement of 0 gives the body itself. Throws InvalidArgument if `displacement` is not finite.
[[nodiscard]] SHAFTCULL_EXPORT CompiledShaft swept(const Box& body, const Vec3& displacement,
                                                   std::span<const Plane> planes = {});

/// Returns the volume that a body sweeps when it moves in a direction without end: all body + t · direction, t ≥ 0.
/// swept_infinite(receiver, towards_sun) contains everything that can cast the sun's shadow on a receiver;
/// swept_infinite(body, down) contains everything below a falling body. The direction need not have unit length. Throws
/// InvalidArgument if the direction is not finite, or 0.
[[nodiscard]] SHAFTCULL_EXPORT CompiledShaft swept_infinite(const Box& body, const Vec3& direction,
                                                            std::span<const Plane> planes = {});

/// Returns the shadow of an occluder from a light: every point p such that some segment from the light to p meets the
/// occluder. The shadow contains the occluder, and continues behind it without end. If the light, or a viewpoint in its
/// place, is a point, the shadow is the volume that the occluder hides from it. A point is in the shadow if the
/// occluder takes away some of the light. So bounds inside the shadow need not be dark, unless the light is a point;
/// the calls of occluded.hpp find bounds that are dark.
///
/// Throws InvalidArgument unless light and occluder are apart. If they touch, segments from a common point meet the
/// occluder at once, so the shadow is all of space.
[[nodiscard]] SHAFTCULL_EXPORT CompiledShaft shadow(const Box& light, const Box& occluder,
                                                    std::span<const Plane> planes = {});

/// Returns the shadow up to `reach` times the distance of the occluder: every l + s (o − l), s from 1 to reach, for
/// points l of the light and o of the occluder. Also throws InvalidArgument if `reach` is below 1 or not finite.
[[nodiscard]] SHAFTCULL_EXPORT CompiledShaft shadow(const Box& light, const Box& occluder, float reach,
                                                    std::span<const Plane> planes = {});

/// Writes swept(bodies[i], displacements[i]) to out[i]. All bodies have the same number of planes, k = planes.size() /
/// bodies.count: body i has planes k · i to k · i + k − 1.
///
/// This call and those below throw InvalidArgument if sizes differ, if boxes do not have equally many planes, if a
/// shaft would have too many planes, or if a plane is not finite or has no normal. They throw BadBound, with the
/// position i, for the first box, vector or pair that the call for one shaft refuses. A call that throws writes
/// nothing. O(shafts and planes), 18 to 35 ns per shaft, 90 with a reach; no allocation; safe to call from many
/// threads.
SHAFTCULL_EXPORT void swept_batch(const BoxView& bodies, std::span<const Vec3> displacements,
                                  std::span<CompiledShaft> out, std::span<const Plane> planes = {});

/// Writes swept_infinite(bodies[i], directions[i]) to out[i], as swept_batch().
SHAFTCULL_EXPORT void swept_infinite_batch(const BoxView& bodies, std::span<const Vec3> directions,
                                           std::span<CompiledShaft> out, std::span<const Plane> planes = {});

/// Writes shadow(lights[i], occluders[i]) to out[i]. `planes.a` belong to the lights, `planes.b` to the occluders.
SHAFTCULL_EXPORT void shadow_batch(const BoxView& lights, const BoxView& occluders, std::span<CompiledShaft> out,
                                   const BatchPlanes& planes = {});
/// Writes the same shadows up to one `reach` for all. Throws as shadow() if `reach` is below 1 or not finite.
SHAFTCULL_EXPORT void shadow_batch(const BoxView& lights, const BoxView& occluders, float reach,
                                   std::span<CompiledShaft> out, const BatchPlanes& planes = {});

/// Writes shadow(lights[pairs[i].a], occluders[pairs[i].b]) to out[i]. Also throws InvalidArgument for the first pair
/// with an index that is not below the number of boxes. Boxes that no pair names are not checked; all planes are.
SHAFTCULL_EXPORT void shadow_batch(const BoxView& lights, const BoxView& occluders, std::span<const IndexPair> pairs,
                                   std::span<CompiledShaft> out, const BatchPlanes& planes = {});
/// Writes the same shadows up to one `reach` for all.
SHAFTCULL_EXPORT void shadow_batch(const BoxView& lights, const BoxView& occluders, std::span<const IndexPair> pairs,
                                   float reach, std::span<CompiledShaft> out, const BatchPlanes& planes = {});

}  // namespace shaftcull
