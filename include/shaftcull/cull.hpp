// SPDX-License-Identifier: MIT
/// One shaft against bounds, or against one bound.
///
/// Answers are exact. For all finite floats, degenerate and huge ones included, and on every instruction set the same
/// bits: a box is outside, overlapping or inside as in real arithmetic for the floats given, and touching is not
/// outside; a corner is beyond an added plane by the real sign of n·p − d; a sphere is outside iff its centre is
/// farther than its radius from the shaft, and inside iff every face is at least that far away. Triangles:
/// triangles.hpp. Against a convex hull spheres are answered conservatively: hull.hpp says how. Of a shaft with open
/// contact touching is outside, in the sense of relative interiors: set_contact() in compiled.hpp says it exactly. A
/// bound with a NaN is never inside. Both forms agree, whatever floating-point mode the caller runs in.
///
/// Each verb has one meaning everywhere: cull() and classify() write bits, count() returns a number, list() lists
/// indices, any() returns a bool. Each has a twin for many shafts (many.hpp). Which bounds they take, their options,
/// errors and cost: query.hpp.
///
/// Floating-point modes and flags of the calling thread are as they were when a call returns: it rounds to nearest and
/// keeps denormals whatever the caller does, and raises no flag.
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

/// Culls: sets bit i of `kept` (word i / 64, bit i % 64) iff bound i is *not* outside the shaft, and clears it
/// otherwise. Bits past the last bound are zero. `kept` has exactly bit_words(bounds.size()) words. A scan of a view
/// writes the bits of a shaft that keeps much of the scene faster than a tree.
SHAFTCULL_EXPORT void cull(const CompiledShaft& shaft, const Bounds& bounds, std::span<std::uint64_t> kept,
                           const Query& query = no_options);

/// Classifies: `kept` as cull() writes it, and bit i of `inside` set iff bound i is entirely inside the shaft and on
/// the inner side of every added plane. So outside is not kept, and overlap is kept and not inside. Inside is always
/// decided by planes. Both spans have bit_words(bounds.size()) words. `kept` may be empty: then only `inside` is
/// written, which is the only question that a shaft formed for inside alone answers.
SHAFTCULL_EXPORT void classify(const CompiledShaft& shaft, const Bounds& bounds, std::span<std::uint64_t> kept,
                               std::span<std::uint64_t> inside, const Query& query = no_options);

/// How many bounds the shaft keeps; with Query::limit that many at most, and then it stops early. To learn whether
/// there are more than n, ask with a limit of n + 1.
[[nodiscard]] SHAFTCULL_EXPORT std::size_t count(const CompiledShaft& shaft, const Bounds& bounds,
                                                 const Query& query = no_options);

/// How many bounds overlap the shaft, and how many are inside. A tree tests nothing below a node that is inside.
[[nodiscard]] SHAFTCULL_EXPORT KeptCounts count_classified(const CompiledShaft& shaft, const Bounds& bounds,
                                                           const Query& query = no_options);

/// Writes the indices of the bounds that the shaft keeps, and returns how many there are; results.hpp says what happens
/// if they do not fit. With Query::limit it lists the first that many, and stops there. With Query::only, `kept` may
/// begin where the candidates begin, which overwrites them. Throws InvalidArgument for a view of more bounds than
/// 32-bit indices can tell apart: list slices of it.
[[nodiscard]] SHAFTCULL_EXPORT std::size_t list(const CompiledShaft& shaft, const Bounds& bounds,
                                                std::span<std::uint32_t> kept, const Query& query = no_options);

/// The same into a vector, which becomes as long as the list. It allocates if the capacity is too small, and asks twice
/// if there are more results than 256 and than the vector had: a vector that is used frame after frame is seldom too
/// short. The vector may hold the candidates of Query::only, but no other option.
SHAFTCULL_EXPORT std::size_t list(const CompiledShaft& shaft, const Bounds& bounds, std::vector<std::uint32_t>& kept,
                                  const Query& query = no_options);

/// Lists bounds that overlap and bounds inside apart. The two spans share no memory.
[[nodiscard]] SHAFTCULL_EXPORT KeptCounts list_classified(const CompiledShaft& shaft, const Bounds& bounds,
                                                          std::span<std::uint32_t> overlap,
                                                          std::span<std::uint32_t> inside,
                                                          const Query& query = no_options);

/// Whether the shaft keeps any bound. Stops soon after the first that it finds.
[[nodiscard]] SHAFTCULL_EXPORT bool any(const CompiledShaft& shaft, const Bounds& bounds,
                                        const Query& query = no_options);

/// Whether the shaft keeps this one bound, which is so iff the bound is not outside. About 20 ns for a box with AVX2,
/// half the time of a view of one box, and 100 ns for a triangle. Of many, cull() of a view takes a hundredth of that
/// for each. Throws InvalidArgument as other queries do.
[[nodiscard]] SHAFTCULL_EXPORT bool keeps(const CompiledShaft& shaft, const Box& box);
[[nodiscard]] SHAFTCULL_EXPORT bool keeps(const CompiledShaft& shaft, const Sphere& sphere);
[[nodiscard]] SHAFTCULL_EXPORT bool keeps(const CompiledShaft& shaft, const Triangle& triangle,
                                          TriangleTest test = TriangleTest::exact);

/// The answer of the shaft for this one bound.
[[nodiscard]] SHAFTCULL_EXPORT Answer classify(const CompiledShaft& shaft, const Box& box);
[[nodiscard]] SHAFTCULL_EXPORT Answer classify(const CompiledShaft& shaft, const Sphere& sphere);

}  // namespace shaftcull
