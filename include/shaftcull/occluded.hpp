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
/// Solids are boxes; spheres and triangles are refused. Options, errors, threads, stack and memory that runs out:
/// query.hpp and many.hpp. Query::only is refused. A shaft that is not between two boxes (volumes.hpp) is refused with
/// InvalidArgument, by its position.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/query.hpp"
#include "shaftcull/results.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Whether this one box blocks the shaft. Some tens of nanoseconds. No allocation.
[[nodiscard]] SHAFTCULL_EXPORT bool occluded(const CompiledShaft& shaft, const Box& solid);

/// Whether a convex polygon blocks the shaft: a wall or a roof at any angle. `polygon` has its corners in order, either
/// way round; corners may be repeated.
///
/// Every segment must go from one side of its plane to the other, within its edges; touching the plane or an edge does
/// not block. Corners that are floats are seldom in one plane. So the polygon is taken as the triangles that its first
/// corner makes with each of its other edges, and a segment must pass the planes of all of them. Exact. O(corners),
/// some microseconds; no allocation. Throws InvalidArgument for fewer than three corners, and for one that is not
/// finite.
[[nodiscard]] SHAFTCULL_EXPORT bool occluded(const CompiledShaft& shaft, std::span<const Vec3> polygon);

/// Whether any of the boxes blocks the shaft. A view is looked through from the first box on, and a tree in nodes that
/// may hold a box that blocks; both stop soon after they find one. No allocation.
[[nodiscard]] SHAFTCULL_EXPORT bool occluded(const CompiledShaft& shaft, const Bounds& solids,
                                             const Query& query = no_options);

/// The index of the box that blocks the shaft: of several in a view the lowest, in a tree the first in tree order
/// (BoundsTree::order()). Nothing if none does. Throws InvalidArgument for a view of more than 2³² − 1 boxes. Otherwise
/// as occluded().
[[nodiscard]] SHAFTCULL_EXPORT std::optional<std::uint32_t> find_occluder(const CompiledShaft& shaft,
                                                                          const Bounds& solids,
                                                                          const Query& query = no_options);

/// Writes the indices of all boxes that block the shaft, ascending or in tree order, and returns how many there are;
/// results.hpp says what happens if they do not fit. With Query::limit it lists the first that many. No allocation.
/// Throws InvalidArgument as find_occluder().
[[nodiscard]] SHAFTCULL_EXPORT std::size_t list_occluders(const CompiledShaft& shaft, const Bounds& solids,
                                                          std::span<std::uint32_t> blocking,
                                                          const Query& query = no_options);

/// Bit s % 64 of word s / 64 of `occluded` is set iff a box blocks shafts[s]; bits past the last shaft are zero. In
/// parallel. `occluded` has exactly bit_words(shafts.size()) words. Bits do not depend on the number of threads.
/// O(shafts · boxes) for a view, though it ends for each shaft as occluded() does.
SHAFTCULL_EXPORT void occluded_many(std::span<const CompiledShaft> shafts, const Bounds& solids,
                                    std::span<std::uint64_t> occluded, const Query& query = no_options);

/// Lists for each shaft the boxes that list_occluders() lists, in parallel.
SHAFTCULL_EXPORT void list_occluders_many(std::span<const CompiledShaft> shafts, const Bounds& solids,
                                          IndexLists& lists, const Query& query = no_options);

}  // namespace shaftcull
