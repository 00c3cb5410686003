// SPDX-License-Identifier: MIT
/// Whether a box hides one end of a shaft from the other, in exact rational arithmetic and straight from the
/// definition: segment by segment. Slow, and shares no code with the library.
///
/// The definition is of segments between the relative interiors of the ends. These are the union of the ends shrunk
/// towards their middles, by however little, so it holds iff it holds for ends shrunk by an infinitely small part.
#pragma once

#include <gmpxx.h>

#include <array>
#include <vector>

#include "shaftcull/bounds.hpp"

namespace shaftcull::oracle {

using RationalPoint = std::array<mpq_class, 3>;

/// Whether the relative interiors of a segment and a box meet. Infinite extents are unbounded boxes; a box with lo > hi
/// or a NaN meets nothing.
[[nodiscard]] bool passes_through(const RationalPoint& from, const RationalPoint& to, const Box& box);

/// Whether all 64 segments from a corner of a to a corner of b pass through the box, where a and b are shrunk by an
/// infinitely small part.
[[nodiscard]] bool blocks(const Box& a, const Box& b, const Box& box);

/// The same for all segments between the corners of two convex polygons, or of other convex hulls.
[[nodiscard]] bool blocks(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const Box& box);

/// Likewise all segments between `steps` + 1 evenly spaced points on each axis of a and of b.
[[nodiscard]] bool blocks_samples(const Box& a, const Box& b, const Box& box, unsigned steps);

/// Whether a segment goes from one side of a convex polygon to the other strictly within its edges. The corners are in
/// one plane and in order, either way round.
[[nodiscard]] bool passes_through(const RationalPoint& from, const RationalPoint& to,
                                  const std::vector<RationalPoint>& polygon);

/// Whether all segments between `steps` + 1 evenly spaced points on each axis of a and of b do.
[[nodiscard]] bool blocks(const Box& a, const Box& b, const std::vector<Vec3>& polygon, unsigned steps);

/// The same for all segments between the corners of two convex polygons, or of other convex hulls.
[[nodiscard]] bool blocks(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const std::vector<Vec3>& polygon);

}  // namespace shaftcull::oracle
