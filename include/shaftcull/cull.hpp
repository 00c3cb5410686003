// SPDX-License-Identifier: MIT
/// Queries of one shaft against bounds, or against one bound.
///
/// Answers are exact for all finite floats, degenerate and huge ones included, and the same bits on every instruction
/// set:
///
/// * A box is outside, overlapping or inside as in real arithmetic for the floats given. A box that touches the shaft
///   is not outside.
/// * Whether a corner is beyond an added plane is decided by the sign of n·p − d in real arithmetic.
/// * A sphere is outside iff its centre is farther than its radius from the shaft, and inside iff every face is at
///   least that far from the centre. For convex hulls, answers for spheres are conservative (hull.hpp).
/// * Triangles: triangles.hpp.
/// * With open contact, a bound that only touches the shaft is outside. set_contact() (compiled.hpp) defines this by
///   relative interiors.
/// * A bound with a NaN is never inside.
///
/// Both forms of a shaft (Form in compiled.hpp) give the same answers.
///
/// Each verb (query.hpp) has one meaning everywhere: cull() and classify() write bits, count() returns a number, list()
/// lists indices, any() returns a bool. Each has a variant for many shafts (many.hpp). Bounds, options, errors and
/// cost: query.hpp.
///
/// A call rounds to nearest, keeps denormals and raises no flag, in any floating-point mode of the calling thread. It
/// leaves the modes and flags of the thread unchanged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shaftcull/compiled.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/query.hpp"
#include "shaftcull/results.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Sets bit i of `kept` (word i / 64, bit i % 64) iff bound i is *not* outside the shaft, and clears it otherwise. Bits
/// past the last bound are zero. `kept` has exactly bit_words(bounds.size()) words. If a shaft keeps a large part of
/// the scene, a scan of a view writes the bits faster than a tree.
SHAFTCULL_EXPORT void cull(const CompiledShaft& shaft, const Bounds& bounds, std::span<std::uint64_t> kept,
                           const Query& query = no_options);

/// Writes `kept` as cull() does, and sets bit i of `inside` iff bound i is entirely inside the shaft and on the inner
/// side of every added plane. So a bound that is outside is not kept, and a bound that overlaps is kept and not inside.
/// *Inside* is always decided by planes, in both forms. Both spans have bit_words(bounds.size()) words. `kept` may be
/// empty: then only `inside` is written.
SHAFTCULL_EXPORT void classify(const CompiledShaft& shaft, const Bounds& bounds, std::span<std::uint64_t> kept,
                               std::span<std::uint64_t> inside, const Query& query = no_options);

/// Returns how many bounds the shaft keeps. With Query::limit, it counts that many at most and stops early. To learn
/// whether there are more than n, use a limit of n + 1.
[[nodiscard]] SHAFTCULL_EXPORT std::size_t count(const CompiledShaft& shaft, const Bounds& bounds,
                                                 const Query& query = no_options);

/// Returns how many bounds overlap the shaft, and how many are inside. A tree tests nothing below a node that is
/// inside.
[[nodiscard]] SHAFTCULL_EXPORT KeptCounts count_classified(const CompiledShaft& shaft, const Bounds& bounds,
                                                           const Query& query = no_options);

/// Writes the indices of the bounds that the shaft keeps, and returns their number, also if they do not fit
/// (results.hpp). With Query::limit, the call stops after that many results. With Query::only, `kept` may begin where
/// the candidates begin; the results then overwrite the candidates. Throws InvalidArgument for a view of more bounds
/// than 32-bit indices can number: list slices of such a view.
[[nodiscard]] SHAFTCULL_EXPORT std::size_t list(const CompiledShaft& shaft, const Bounds& bounds,
                                                std::span<std::uint32_t> kept, const Query& query = no_options);

/// Writes the list to a vector, which becomes as long as the list. The call allocates if the capacity is too small. It
/// queries twice if there are more than 256 results and more results than the vector had elements. A vector that is
/// reused in every frame is seldom too short. The vector may hold the candidates of Query::only, but no other option.
SHAFTCULL_EXPORT std::size_t list(const CompiledShaft& shaft, const Bounds& bounds, std::vector<std::uint32_t>& kept,
                                  const Query& query = no_options);

/// Lists bounds that overlap and bounds inside separately, and returns their numbers. The two spans share no memory.
[[nodiscard]] SHAFTCULL_EXPORT KeptCounts list_classified(const CompiledShaft& shaft, const Bounds& bounds,
                                                          std::span<std::uint32_t> overlap,
                                                          std::span<std::uint32_t> inside,
                                                          const Query& query = no_options);

/// Returns whether the shaft keeps any bound. Stops soon after the first kept bound that it finds.
[[nodiscard]] SHAFTCULL_EXPORT bool any(const CompiledShaft& shaft, const Bounds& bounds,
                                        const Query& query = no_options);

/// Returns whether the shaft keeps one bound: whether the bound is not outside. About 12 ns for a box with AVX2, and
/// 100 ns for a triangle. For many bounds, cull() of a view takes a fiftieth of that per bound. Throws
/// InvalidArgument as other queries do.
[[nodiscard]] SHAFTCULL_EXPORT bool keeps(const CompiledShaft& shaft, const Box& box);
[[nodiscard]] SHAFTCULL_EXPORT bool keeps(const CompiledShaft& shaft, const Sphere& sphere);
[[nodiscard]] SHAFTCULL_EXPORT bool keeps(const CompiledShaft& shaft, const Triangle& triangle,
                                          TriangleTest test = TriangleTest::exact);

/// Returns the answer of the shaft for one bound. About 12 ns for a box with AVX2; 40 to 50 ns for one within the box
/// around a shaft whose joining planes are pending (compiled.hpp). For a sphere there, the answer depends on distances
/// from planes, so each call computes the planes, which takes about 80 ns more: complete() a shaft that classifies many
/// single spheres.
[[nodiscard]] SHAFTCULL_EXPORT Answer classify(const CompiledShaft& shaft, const Box& box);
[[nodiscard]] SHAFTCULL_EXPORT Answer classify(const CompiledShaft& shaft, const Sphere& sphere);

}  // namespace shaftcull
