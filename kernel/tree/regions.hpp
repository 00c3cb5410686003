// SPDX-License-Identifier: MIT
/// Building trees of more bounds than caches hold, region by region.
#pragma once

#include <cstddef>

#include "tree/build.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {

/// Whether a tree of so many bounds is to be built by regions.
[[nodiscard]] bool are_regions_worth_it(std::size_t bounds, const RegionSizes& sizes) noexcept;

/// The same tree as build() makes.
///
/// The largest halvings move entries, which cut tree order into regions; these keep the user's order. One pass through
/// the user's memory then carries bounds to their regions, so that what is read all over is near: each region is
/// ordered and written by one task with memory that caches hold.
///
/// Scratch memory, besides the tree that is made: 4 bytes a bound (spheres 12), and when these are free again at most 8
/// for regions that are in the works, or those of one thread if they take more. Entries are where leaves will be.
/// Blocks of bounds that are carried take 0.4 MB a thread.
template <class Bound, class Source>
[[nodiscard]] TreeParts<Bound> build_by_regions(const Source& source, const RegionSizes& sizes);

}  // namespace shaftcull::kernel
