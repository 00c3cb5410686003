// SPDX-License-Identifier: MIT
/// Solid boxes that hide one end of a shaft from the other.
///
/// A box *blocks* a shaft if every segment from a point of the shaft's box a to a point of its box b passes through it:
/// nothing of one end sees anything of the other. One such box settles a pair of patches, without a ray. What blocks is
/// *solid*: the caller says which boxes are, by passing no others. Walls and the cores of buildings are; the box around
/// a triangle, a tree or a table is not.
///
/// *Touching does not block.* A segment passes through a box where their relative interiors meet. So the wall that a
/// patch lies on does not block it, nor does a segment that runs along a wall. A flat box blocks what crosses it, and a
/// box that holds an end in its interior blocks all that starts there: leave such boxes out where that is not meant.
///
/// Answers are exact, as those of cull.hpp, for all finite floats, flat and point-like ends and boxes included. A box
/// that is empty (lo > hi) or has a NaN blocks nothing, and an infinite one is an unbounded box. Several boxes that
/// only together block every segment are not found. Planes added to a shaft are left out: what blocks all segments
/// blocks those that they leave. Only the two boxes are read, so a shaft may have been formed for whatever answers, and
/// whatever its contact.
///
/// Calls are safe to make from many threads. Floating-point modes and flags, stack, threads and memory that runs out
/// are as in cull.hpp, many.hpp and query.hpp. Before anything is written, they throw InvalidArgument for a shaft that
/// was never formed or is not between two boxes (kinds.hpp), by its position, for a null view or span, and for sizes
/// that do not fit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/query.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/tree.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Whether this one box blocks the shaft. Some tens of nanoseconds. No allocation.
[[nodiscard]] SHAFTCULL_EXPORT bool blocked(const CompiledShaft& shaft, const Box& solid);

/// Whether a convex polygon blocks the shaft: a wall or a roof at any angle. `polygon` has its corners in order, either
/// way round; corners may be repeated.
///
/// Every segment must go from one side of its plane to the other, within its edges; touching the plane or an edge does
/// not block. Corners that are floats are seldom in one plane. So the polygon is taken as the triangles that its first
/// corner makes with each of its other edges, and a segment must pass the planes of all of them. Exact. O(corners),
/// some microseconds; no allocation. Throws InvalidArgument for fewer than three corners, and for one that is not
/// finite.
[[nodiscard]] SHAFTCULL_EXPORT bool blocked(const CompiledShaft& shaft, std::span<const Vec3> polygon);

/// Whether any of the boxes blocks the shaft. Looks at boxes from the first on, in chunks of 512 at first and of 16,384
/// at most, and stops after the first chunk that holds one that does. O(count); no allocation.
[[nodiscard]] SHAFTCULL_EXPORT bool blocked(const CompiledShaft& shaft, const BoxView& solids);

/// Likewise for a tree. It looks only into nodes that may hold a box that blocks, and stops at the first box that
/// blocks the shaft. `excluding` leaves boxes out. Throws NeedsRefit if the tree needs one. No allocation.
[[nodiscard]] SHAFTCULL_EXPORT bool blocked(const CompiledShaft& shaft, const BoundsTree<Box>& solids,
                                            const Excluding& excluding = {});

/// The box that blocks the shaft: of several in a view the one with the lowest index, in a tree the index of the first
/// in tree order (BoundsTree::order()). Nothing if none does. Costs and errors are those of blocked().
[[nodiscard]] SHAFTCULL_EXPORT std::optional<std::size_t> blocked_by(const CompiledShaft& shaft, const BoxView& solids);
[[nodiscard]] SHAFTCULL_EXPORT std::optional<std::uint32_t> blocked_by(const CompiledShaft& shaft,
                                                                       const BoundsTree<Box>& solids,
                                                                       const Excluding& excluding = {});

/// Writes the indices of all boxes that block the shaft, ascending or in tree order, and returns how many there are;
/// results.hpp says what happens if they do not fit. No allocation. Throws InvalidArgument if there are more boxes than
/// 32-bit indices can tell apart, or if `blocking` shares memory with `excluding`.
[[nodiscard]] SHAFTCULL_EXPORT std::size_t list_blocking(const CompiledShaft& shaft, const BoxView& solids,
                                                         std::span<std::uint32_t> blocking);
[[nodiscard]] SHAFTCULL_EXPORT std::size_t list_blocking(const CompiledShaft& shaft, const BoundsTree<Box>& solids,
                                                         std::span<std::uint32_t> blocking,
                                                         const Excluding& excluding = {});

/// One bit a shaft, in parallel: bit s % 64 of word s / 64 of `blocked` is set iff a box blocks shafts[s]; bits past
/// the last shaft are zero. `blocked` has exactly words_for(shafts.size()) words. Bits do not depend on the number of
/// threads. O(shafts · boxes), though it ends for each shaft as blocked() does. Allocates nothing but task memory of
/// oneTBB.
SHAFTCULL_EXPORT void blocked_many(std::span<const CompiledShaft> shafts, const BoxView& solids,
                                   std::span<std::uint64_t> blocked);

/// Likewise for a tree. Throws InvalidArgument if `blocked` shares memory with `excluding`, too.
SHAFTCULL_EXPORT void blocked_many(std::span<const CompiledShaft> shafts, const BoundsTree<Box>& solids,
                                   std::span<std::uint64_t> blocked, const Excluding& excluding = {});

/// Lists what list_blocking() lists for each shaft, in parallel. Reuses the memory of `lists`; if this throws, they are
/// as they were or empty. Allocates what it lists.
SHAFTCULL_EXPORT void list_blocking_many(std::span<const CompiledShaft> shafts, const BoxView& solids,
                                         IndexLists& lists);
SHAFTCULL_EXPORT void list_blocking_many(std::span<const CompiledShaft> shafts, const BoundsTree<Box>& solids,
                                         IndexLists& lists, const Excluding& excluding = {});

}  // namespace shaftcull
