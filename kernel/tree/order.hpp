/// Tree order: which bounds share a node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// What the order is made from: where a bound is, and how far it reaches.
struct OrderEntry {
  Vec3 centre;
  std::uint32_t index;
};

/// Bounds of one size class, and how large they are: see size_class().
inline constexpr unsigned size_classes = 10;

/// Sorts entries of one class after the other, entries of class c being [class_first[c], class_first[c + 1]), so that
/// any 64, 4096, … in a row from a multiple of that on are close together.
void sort_into_tree_order(std::vector<OrderEntry>& entries, const std::size_t (&class_first)[size_classes + 1]);

}  // namespace shaftcull::kernel
