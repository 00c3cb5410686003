// SPDX-License-Identifier: MIT
/// Changes that wait for a commit.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tree/leaf_block.hpp"

namespace shaftcull::kernel {

/// What becomes of an index: the last of several changes counts.
template <class Bound>
struct Change {
  std::uint32_t index;
  std::uint32_t layers;
  bool has_bound;  ///< false: erased
  float bound[rows_of<Bound>];
};

/// An index, whether it has a bound now, and what waits for it.
struct Slot {
  std::uint32_t generation = 0;
  std::uint32_t change : 31 = 0;  ///< 0, or one more than the position of its change
  std::uint32_t has_bound : 1 = 0;
};

/// Makes room for `more` items, so that adding them throws nothing. Amortised as push_back().
template <class Item>
void make_room(std::vector<Item>& items, std::size_t more) {
  if (items.capacity() - items.size() >= more) return;
  items.reserve(std::max(items.size() + more, 2 * items.capacity()));
}

}  // namespace shaftcull::kernel
