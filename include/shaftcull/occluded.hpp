// SPDX-License-Identifier: MIT
/// Solid boxes that hide one end of a shaft from the other.
///
/// A box *blocks* a shaft if every segment between the relative interiors of the shaft's boxes a and b passes through
/// it; for a hull of between_polygons() (hull.hpp), between the relative interiors of its two ends. The relative
/// interior of a box is the box without its faces; of a flat box, without its edges; of a point, the point. One box
/// that blocks decides a pair of patches without a ray. Boxes that block are *solid*: the caller passes only solid
/// boxes. Walls and the cores of buildings are solid; the box around a triangle, a tree or a table is not.
///
/// A segment passes through a box where their relative interiors meet; a segment that only touches does not. So a wall
/// does not block the patch that lies on it, nor two ends in the plane of one of its faces. A flat box blocks segments
/// that cross it. A box that contains an end in its interior blocks all segments that start there. Leave it out if that
/// is not intended.
///
/// *A wall that ends flush with floor and ceiling blocks.* It hides one room from the next. In the same way, the middle
/// one of three equal cubes in a row hides the two others from each other. Some segments between points on the rims of
/// the two ends, for example along the ceiling, only touch the wall. Such segments have *measure zero*: among all
/// segments between the ends, their share is 0. They carry no light, and a random ray never takes one. A ray that
/// starts exactly at an edge of a patch may take such a segment, and reach the other end.
///
/// Answers are exact, like those of cull.hpp, for all finite floats, flat and point-like ends and boxes included. A box
/// that is empty (lo > hi) or has a NaN blocks nothing, and an infinite box is unbounded. Several boxes that only
/// together block every segment are not found. Planes added to a shaft are ignored: a box that blocks all segments also
/// blocks the segments that the planes leave. Only the shaft's two boxes are read, so contact does not matter.
///
/// Solids are boxes; spheres, triangles and Query::only are refused. A shaft of a moving box (volumes.hpp) is refused
/// with InvalidArgument, with its position, and so is a hull that was not made by between_polygons(). Options, other
/// errors, threads, stack and std::bad_alloc: query.hpp and many.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/query.hpp"
#include "shaftcull/results.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Returns whether one box blocks the shaft. Tens of nanoseconds; no allocation.
[[nodiscard]] SHAFTCULL_EXPORT bool occluded(const CompiledShaft& shaft, const Box& solid);

/// Returns whether a convex polygon blocks the shaft: a wall or a roof at any angle. `polygon` has its corners in
/// order, either way round; corners may be repeated.
///
/// Every segment between the relative interiors of the ends must go from one side of the polygon's plane to the other,
/// within its edges; touching the plane or an edge does not block. An end may touch the plane, but not lie in it.
/// Corners that are floats are seldom in one plane. So the polygon is treated as the triangles that its first corner
/// forms with each of its other edges, and a segment must pass through the planes of all these triangles. Exact.
/// O(corners), a few microseconds; no allocation. Throws InvalidArgument for fewer than three corners, and for a corner
/// that is not finite.
[[nodiscard]] SHAFTCULL_EXPORT bool occluded(const CompiledShaft& shaft, std::span<const Vec3> polygon);

/// Returns whether any of the boxes blocks the shaft. A view is scanned from the first box on; a tree is searched in
/// nodes that may contain a box that blocks. Both searches stop soon after the first such box. No allocation.
[[nodiscard]] SHAFTCULL_EXPORT bool occluded(const CompiledShaft& shaft, const Bounds& solids,
                                             const Query& query = no_options);

/// Returns the index of a box that blocks the shaft, or nothing if no box does. If several boxes do, the result is the
/// lowest index in a view, and the first in tree order (BoundsTree::order()) in a tree. Throws InvalidArgument for a
/// view of more than 2³² − 1 boxes. Otherwise as occluded().
[[nodiscard]] SHAFTCULL_EXPORT std::optional<std::uint32_t> find_occluder(const CompiledShaft& shaft,
                                                                          const Bounds& solids,
                                                                          const Query& query = no_options);

/// Writes the indices of all boxes that block the shaft, ascending or in tree order, and returns their number, also if
/// they do not fit (results.hpp). With Query::limit, the call lists at most that many, the first ones. No allocation.
/// Throws InvalidArgument as find_occluder() does.
[[nodiscard]] SHAFTCULL_EXPORT std::size_t list_occluders(const CompiledShaft& shaft, const Bounds& solids,
                                                          std::span<std::uint32_t> blocking,
                                                          const Query& query = no_options);

/// Writes the list to a vector, which becomes as long as the list, as list() does (cull.hpp). No option may be in the
/// vector's memory.
SHAFTCULL_EXPORT std::size_t list_occluders(const CompiledShaft& shaft, const Bounds& solids,
                                            std::vector<std::uint32_t>& blocking, const Query& query = no_options);

/// Writes bit s % 64 of word s / 64 of `occluded`, in parallel: 1 iff a box blocks shafts[s]. Bits past the last shaft
/// are 0. `occluded` has exactly bit_words(shafts.size()) words. Bits do not depend on the number of threads. O(shafts
/// · boxes) for a view, though the scan for each shaft stops as in occluded().
SHAFTCULL_EXPORT void occluded_many(std::span<const CompiledShaft> shafts, const Bounds& solids,
                                    std::span<std::uint64_t> occluded, const Query& query = no_options);

/// Writes the list of list_occluders(shafts[s], …) to list s, in parallel.
SHAFTCULL_EXPORT void list_occluders_many(std::span<const CompiledShaft> shafts, const Bounds& solids,
                                          IndexLists& lists, const Query& query = no_options);

}  // namespace shaftcull
