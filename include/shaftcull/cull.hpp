// SPDX-License-Identifier: MIT
/// One shaft against many bounds, or against one.
///
/// Answers are exact. For all finite floats, degenerate and huge ones included, and on every instruction set the same
/// bits: a box is outside, overlapping or inside as in real arithmetic for the floats given, and touching is not
/// outside; a corner is beyond an added plane by the real sign of n·p − d; a sphere is outside iff its centre is
/// farther than its radius from the shaft, and inside iff every face is at least that far away. Against a convex hull
/// spheres are answered conservatively: hull.hpp says how. Of a shaft with open
/// contact touching is outside, in the sense of relative interiors: set_contact() in compiled.hpp says it exactly. A
/// bound with a NaN is never inside. Both forms agree, whatever floating-point mode the caller runs in. many.hpp,
/// query.hpp and refine.hpp promise the same.
///
/// Each verb has one meaning everywhere: cull() and classify() give bits, count() numbers, list() indices, any() a
/// bool; each has a twin for many shafts (many.hpp). All take a view of boxes or spheres, or a stream.
///
/// Floating-point modes and flags of the calling thread are as they were when a call returns: it rounds to nearest and
/// keeps denormals whatever the caller does, and raises no flag. Every call of the library takes at most 64 KiB of the
/// stack in an optimised build, so that small threads and fibers may make it.
///
/// Every call of this header is O(count) and single-threaded, allocates nothing, and is safe to make from many threads.
/// Each throws InvalidArgument if the shaft was never formed or formed without the answer asked for, if a stream or
/// span is null that is not empty, or for what it says itself. Nothing is written then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "shaftcull/compiled.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/results.hpp"
#include "shaftcull/streams.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Culls: sets bit i of `kept` (word i / 64, bit i % 64) iff bound i is *not* outside the shaft. Bits past
/// the last bound in the last word are zero. `kept` must have exactly words_for(count of the view) words.
SHAFTCULL_EXPORT void cull(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint64_t> kept);
SHAFTCULL_EXPORT void cull(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint64_t> kept);

/// Classifies: `kept` as in cull(), and bit i of `inside` set iff bound i is fully inside the shaft (and of
/// every added plane). The three answers are outside = not kept, inside, and overlap = kept and not inside.
/// Inside is always decided by planes. Both spans have words_for(count of the view) words and share no memory.
SHAFTCULL_EXPORT void classify(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint64_t> kept,
                               std::span<std::uint64_t> inside);
SHAFTCULL_EXPORT void classify(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint64_t> kept,
                               std::span<std::uint64_t> inside);

/// Sets bit i of `inside` as classify() does, without deciding which of the others are outside: the only question that
/// a shaft formed for inside alone answers. `inside` has words_for(count of the view) words.
SHAFTCULL_EXPORT void contained(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint64_t> inside);
SHAFTCULL_EXPORT void contained(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint64_t> inside);

/// How many bounds the shaft keeps.
[[nodiscard]] SHAFTCULL_EXPORT std::size_t count(const CompiledShaft& shaft, const BoxView& boxes);
[[nodiscard]] SHAFTCULL_EXPORT std::size_t count(const CompiledShaft& shaft, const SphereView& spheres);

/// How many bounds the shaft keeps, or `most` if that is fewer: stops when it has found so many, as any(). To learn
/// whether there are more than n, ask for n + 1.
[[nodiscard]] SHAFTCULL_EXPORT std::size_t count_at_most(const CompiledShaft& shaft, const BoxView& boxes,
                                                         std::size_t most);
[[nodiscard]] SHAFTCULL_EXPORT std::size_t count_at_most(const CompiledShaft& shaft, const SphereView& spheres,
                                                         std::size_t most);

/// How many bounds overlap the shaft, and how many are inside.
[[nodiscard]] SHAFTCULL_EXPORT KeptCounts count_classified(const CompiledShaft& shaft, const BoxView& boxes);
[[nodiscard]] SHAFTCULL_EXPORT KeptCounts count_classified(const CompiledShaft& shaft, const SphereView& spheres);

/// Writes the indices of the bounds that the shaft keeps, ascending, and returns how many there are; results.hpp says
/// what happens if they do not fit. Throws InvalidArgument if there are more bounds than 32-bit indices can tell apart.
[[nodiscard]] SHAFTCULL_EXPORT std::size_t list(const CompiledShaft& shaft, const BoxView& boxes,
                                                std::span<std::uint32_t> kept);
[[nodiscard]] SHAFTCULL_EXPORT std::size_t list(const CompiledShaft& shaft, const SphereView& spheres,
                                                std::span<std::uint32_t> kept);

/// Writes the first indices that list() would write, until `kept` is full, and returns how many it wrote: it stops
/// there, as any(), and does not say whether there are more. Throws InvalidArgument as list().
[[nodiscard]] SHAFTCULL_EXPORT std::size_t list_at_most(const CompiledShaft& shaft, const BoxView& boxes,
                                                        std::span<std::uint32_t> kept);
[[nodiscard]] SHAFTCULL_EXPORT std::size_t list_at_most(const CompiledShaft& shaft, const SphereView& spheres,
                                                        std::span<std::uint32_t> kept);

/// As list(), but bounds that overlap and bounds inside apart. The two spans share no memory.
[[nodiscard]] SHAFTCULL_EXPORT KeptCounts list_classified(const CompiledShaft& shaft, const BoxView& boxes,
                                                          std::span<std::uint32_t> overlap,
                                                          std::span<std::uint32_t> inside);
[[nodiscard]] SHAFTCULL_EXPORT KeptCounts list_classified(const CompiledShaft& shaft, const SphereView& spheres,
                                                          std::span<std::uint32_t> overlap,
                                                          std::span<std::uint32_t> inside);

/// Whether the shaft keeps any bound. Looks at bounds from the first on, in chunks of 512 at first and of 16,384 at
/// most, and stops after the first chunk of which one is kept.
[[nodiscard]] SHAFTCULL_EXPORT bool any(const CompiledShaft& shaft, const BoxView& boxes);
[[nodiscard]] SHAFTCULL_EXPORT bool any(const CompiledShaft& shaft, const SphereView& spheres);

/// Clears the bits of bounds that are in none of some layers, as trees leave them out (Excluding::only_layers): bit i
/// stays set iff layers[i] & only_layers is not 0. `bits` are any that a call for one shaft wrote, or a row of those
/// for many: words_for(layers.size()) words. Throws InvalidArgument for another size, or if the two spans share memory.
SHAFTCULL_EXPORT void keep_layers(std::span<std::uint64_t> bits, std::span<const std::uint32_t> layers,
                                  std::uint32_t only_layers);

/// What a shaft says of one bound.
enum class Answer : std::uint8_t {
  outside,  ///< nothing of it is in the shaft
  overlap,  ///< a part of it is, or it touches
  inside,   ///< all of it is
};

/// Whether the shaft keeps this one bound. Some 20 ns for a box with AVX2, about half of what a view of one box takes:
/// a loop over a few bounds that lie about in memory need not make a view of them first. Of many, cull() of a view
/// takes a hundredth of that for each.
[[nodiscard]] SHAFTCULL_EXPORT bool cull(const CompiledShaft& shaft, const Box& box);
[[nodiscard]] SHAFTCULL_EXPORT bool cull(const CompiledShaft& shaft, const Sphere& sphere);

/// Which of the three answers the shaft has for this one bound.
[[nodiscard]] SHAFTCULL_EXPORT Answer classify(const CompiledShaft& shaft, const Box& box);
[[nodiscard]] SHAFTCULL_EXPORT Answer classify(const CompiledShaft& shaft, const Sphere& sphere);

}  // namespace shaftcull
