// SPDX-License-Identifier: MIT
/// Changes that wait for a commit.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tree/leaf_block.hpp"

namespace shaftcull::kernel {

/// What becomes of an index: the last of several changes counts. That of a box takes half a cache line, since commits
/// read changes all over memory.
template <class Bound>
struct alignas(rows_of<Bound> == 6 ? 32 : 8) Change {
  std::uint32_t index : 31;
  std::uint32_t has_bound : 1;  ///< 0: erased
  std::uint32_t layers;
  float bound[rows_of<Bound>];
};
static_assert(sizeof(Change<Box>) == 32 && sizeof(Change<Sphere>) == 24);

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
