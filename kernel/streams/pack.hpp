// SPDX-License-Identifier: MIT
/// From the user's records to streams: everything is checked, then written, so that an error leaves a stream unchanged.
#pragma once

#include <cstddef>
#include <span>

#include "shaftcull/streams.hpp"
#include "shaftcull/triangles.hpp"
#include "support/exact_floats.hpp"

namespace shaftcull::kernel {

/// Replaces the bounds of a stream from `first` on by records, as many as there are. Throws InvalidArgument if that
/// range does not lie within the stream, or if the records are null or in the stream's memory, BadBound for the first
/// illegal record.
void pack(const BoxView& boxes, std::size_t first, BoxStream& stream);
void pack(const SphereView& spheres, std::size_t first, SphereStream& stream);
void pack(const StridedBoxes& records, std::size_t first, BoxStream& stream);
void pack(const StridedCentreExtents& records, std::size_t first, BoxStream& stream);
void pack(const StridedSpheres& records, std::size_t first, SphereStream& stream);

// Likewise for triangles, whose coordinates must be finite. InvalidArgument also for a mesh whose indices are not three
// a triangle, or not below the number of vertices.
void pack(std::span<const Triangle> triangles, std::size_t first, TriangleStream& stream);
void pack(const TriangleView& triangles, std::size_t first, TriangleStream& stream);
void pack(const MeshView& mesh, std::size_t first, TriangleStream& stream);

}  // namespace shaftcull::kernel
