// SPDX-License-Identifier: MIT
/// Prefetching memory before it is read.
#pragma once

#include <cstddef>

#include "support/compiler.hpp"

namespace shaftcull::kernel {

/// Prefetches into the second-level cache: `count` items from the beginning of a cache line on, or one anywhere. Not
/// into the first, which waits for some ten or twenty lines at a time, and the second for many more.
///
/// Always inlined, because a call of a function that only prefetches is no call to g++ 12: it leaves it out.
template <class Item>
SHAFTCULL_ALWAYS_INLINE inline void prefetch_to_second_level(const Item* item, std::size_t count) noexcept {
  constexpr std::size_t line = 64 / sizeof(Item);
  for (std::size_t i = 0; i < count; i += line) prefetch_to_read_later(item + i);
}

}  // namespace shaftcull::kernel
