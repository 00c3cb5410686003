// SPDX-License-Identifier: MIT
/// Tree order: which bounds share a node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/kernel_table.hpp"
#include "support/index_range.hpp"
#include "tree/entries.hpp"

namespace shaftcull::kernel {

/// Writes the indices of entries in tree order: class after class, and within a class so that any 64, 4096, … in a row
/// from a multiple of that on are close together. It is the same on every instruction set and for any number of
/// threads. Entries are lost; `spare` has space for as many. Regions of `most` entries stay as they are: see below.
void write_tree_order(const EntryStreams& entries, const EntryStreams& spare, const ClassBounds& class_first,
                      const Kernels& kernels, std::uint32_t* order, std::size_t most = 0);

// The same in two steps, for more entries than caches hold: write_tree_order() with `most`, then each region.

/// The parts of tree order that its largest halvings make: those of at most `most` entries, or within one node.
[[nodiscard]] std::vector<IndexRange> regions_of(const ClassBounds& class_first, std::size_t most);

/// Writes the indices of a region's entries in tree order. Streams and `order` begin with the region. By one task.
void write_order_within(const IndexRange& region, const EntryStreams& entries, const EntryStreams& spare,
                        const Kernels& kernels, std::uint32_t* order) noexcept;

}  // namespace shaftcull::kernel
