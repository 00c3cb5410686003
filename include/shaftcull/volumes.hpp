// SPDX-License-Identifier: MIT
/// Shafts of moving boxes: what a body sweeps over, and what an occluder shadows from a light.
///
/// A shaft between two boxes is a box that moves from one to the other. Here it moves by a displacement, with or
/// without an end, or away from a light. These shafts answer every question that compile(a, b) answers, exactly for the
/// floats given: no end box is rounded. Joining planes are left pending, and contact is closed until set_contact()
/// opens it.
///
/// A box with an infinite corner is never inside: of a shaft without end that holds all of it, it is overlap.
///
/// All calls throw InvalidArgument for a box that is not finite or has lo > hi, for planes that are not finite or have
/// no normal, and if there are more than max_added_planes. Planes are added as Shaft::add_plane() does. A call takes
/// some 0.5 µs, allocates nothing and is safe from many threads.
#pragma once

#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/streams.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// What a body sweeps over that moves by a displacement: all body + t · displacement, t from 0 to 1. A displacement of
/// 0 leaves the body itself. Throws InvalidArgument if `displacement` is not finite.
[[nodiscard]] SHAFTCULL_EXPORT CompiledShaft swept(const Box& body, const Vec3& displacement,
                                                   std::span<const Plane> planes = {});

/// What a body sweeps over that moves in a direction without end: all body + t · direction, t ≥ 0. What can cast the
/// sun's shadow on a receiver is swept_infinite(receiver, towards_sun); what can be below something that falls,
/// swept_infinite(body, down). The direction need not have unit length. Throws InvalidArgument if it is not finite,
/// or 0.
[[nodiscard]] SHAFTCULL_EXPORT CompiledShaft swept_infinite(const Box& body, const Vec3& direction,
                                                            std::span<const Plane> planes = {});

/// All that an occluder can shadow from a light: every point p such that some segment from the light to p meets the
/// occluder. It holds the occluder, and goes on behind it without end. A light, or a viewpoint, may be a point: then it
/// is what the occluder hides from there. A point is in the shadow if the occluder takes some of the light, so bounds
/// inside need not be dark (occluded.hpp says which are), unless the light is a point.
///
/// Throws InvalidArgument unless light and occluder are apart. If they touch, segments from a common point meet the
/// occluder at once, so that all of space is in its shadow.
[[nodiscard]] SHAFTCULL_EXPORT CompiledShaft shadow(const Box& light, const Box& occluder,
                                                    std::span<const Plane> planes = {});

/// The same up to `reach` times the distance of the occluder: every l + s (o − l), s from 1 to reach, for points l of
/// the light and o of the occluder. Throws InvalidArgument if `reach` is below 1 or not finite, too.
[[nodiscard]] SHAFTCULL_EXPORT CompiledShaft shadow(const Box& light, const Box& occluder, float reach,
                                                    std::span<const Plane> planes = {});

/// swept(bodies[i], displacements[i]) into out[i]. Bodies have equally many planes, k = planes.size() / bodies.count
/// each: body i has planes k · i to k · i + k − 1.
///
/// Of this and the calls below: throws InvalidArgument if sizes differ, or if planes are too many, not equally many for
/// each box, not finite or without a normal. Throws BadBound, with the position i, for the first shaft that cannot be
/// formed: a box, vector or pair that the call for one shaft refuses. Nothing is written then. O(shafts and planes),
/// some 0.5 µs a shaft; no allocation; safe to call from many threads.
SHAFTCULL_EXPORT void swept_batch(const BoxView& bodies, std::span<const Vec3> displacements,
                                  std::span<CompiledShaft> out, std::span<const Plane> planes = {});

/// swept_infinite(bodies[i], directions[i]) into out[i], as above.
SHAFTCULL_EXPORT void swept_infinite_batch(const BoxView& bodies, std::span<const Vec3> directions,
                                           std::span<CompiledShaft> out, std::span<const Plane> planes = {});

/// shadow(lights[i], occluders[i]) into out[i]. `planes.a` are those of the lights, `planes.b` those of the occluders.
SHAFTCULL_EXPORT void shadow_batch(const BoxView& lights, const BoxView& occluders, std::span<CompiledShaft> out,
                                   const BatchPlanes& planes = {});
/// The same up to `reach`, one for all; throws as shadow() does if it is below 1 or not finite.
SHAFTCULL_EXPORT void shadow_batch(const BoxView& lights, const BoxView& occluders, float reach,
                                   std::span<CompiledShaft> out, const BatchPlanes& planes = {});

/// shadow(lights[pairs[i].a], occluders[pairs[i].b]) into out[i]. Throws InvalidArgument for the first pair with an
/// index that is not below the number of boxes, too. Boxes that no pair names are not looked at; planes are.
SHAFTCULL_EXPORT void shadow_batch(const BoxView& lights, const BoxView& occluders, std::span<const IndexPair> pairs,
                                   std::span<CompiledShaft> out, const BatchPlanes& planes = {});
/// The same up to a reach, which is one for all.
SHAFTCULL_EXPORT void shadow_batch(const BoxView& lights, const BoxView& occluders, std::span<const IndexPair> pairs,
                                   float reach, std::span<CompiledShaft> out, const BatchPlanes& planes = {});

}  // namespace shaftcull
