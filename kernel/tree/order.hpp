/// Tree order: which bounds share a node.
#pragma once

#include <cstdint>

#include "tree/entries.hpp"

namespace shaftcull::kernel {

/// Writes the indices of entries in tree order: class after class, and within a class so that any 64, 4096, … in a row
/// from a multiple of that on are close together. It is the same on every instruction set and for any number of
/// threads. Entries are lost; `spare` has room for as many.
void write_tree_order(const EntryStreams& entries, const EntryStreams& spare, const ClassBounds& class_first,
                      std::uint32_t* order);

}  // namespace shaftcull::kernel
