// SPDX-License-Identifier: MIT
/// Tree order: which bounds share a node.
#pragma once

#include "kernels/table.hpp"
#include "tree/entries.hpp"

namespace shaftcull::kernel {

/// Writes the indices of entries in tree order: class after class, and within a class so that any 64, 4096, … in a row
/// from a multiple of that on are close together. It is the same on every instruction set and for any number of
/// threads. Entries are lost; `spare` has space for as many.
template <class Index>
void write_tree_order(const EntryStreams<Index>& entries, const EntryStreams<Index>& spare,
                      const ClassBounds& class_first, const Kernels& kernels, Index* order);

}  // namespace shaftcull::kernel
