// SPDX-License-Identifier: MIT
/// View frusta as engines cull by them: a box is kept unless its near corner is beyond one of six planes. It keeps
/// boxes that are behind two planes' common edge, which a convex hull does not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/streams.hpp"

namespace shaftcull::bench {

/// Outside is where normal·p > offset.
using SixPlanes = std::array<Plane, 6>;

/// Writes one bit for each box of a view: separate streams, whole words, AVX2 by hand.
void cull_by_six_planes_avx2(const SixPlanes& planes, const BoxView& boxes, std::uint64_t* kept) noexcept;

/// The same for an array of boxes as centre and half extent, one after the other, with an early end: the loop that most
/// engines have.
struct CentreExtent {
  Vec3 centre;
  Vec3 half_extent;
};
void cull_by_six_planes(const SixPlanes& planes, std::span<const CentreExtent> boxes, std::uint64_t* kept) noexcept;

}  // namespace shaftcull::bench
