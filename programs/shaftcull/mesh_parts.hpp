// SPDX-License-Identifier: MIT
/// Parts of a mesh: the ends of shafts in files that have few objects.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mesh.hpp"

namespace shaftcull::cli {

/// A file whose objects have equally many triangles is divided into this many parts or more, up to twice as many.
inline constexpr std::size_t usual_parts = 64;

/// Divides each object's triangles into parts of at most `most` triangles, at least 1, and writes MeshTriangle::part.
/// An object with more triangles is halved at the median of their centres along the axis where these spread the widest,
/// and so are its halves. What becomes of the triangles depends on their boxes and their order alone. O(n log n) for n
/// triangles, which are sorted by object.
[[nodiscard]] std::vector<MeshPart> divide_into_parts(std::span<MeshTriangle> triangles, std::size_t most);

}  // namespace shaftcull::cli
