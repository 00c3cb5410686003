/// Fetching memory before it is read.
#pragma once

#include <cstddef>

namespace shaftcull::kernel {

/// Fetches `count` items, which begin with a cache line, into the second-level cache. Not the first: a processor waits for
/// a few lines of its own first-level cache at a time, and for many more of the second.
///
/// Always inlined, because a call of a function that only fetches is no call to g++ 12: it leaves it out.
template <class Item>
[[gnu::always_inline]] inline void fetch_to_second_level(const Item* item, std::size_t count) noexcept {
  constexpr std::size_t line = 64 / sizeof(Item);
  for (std::size_t i = 0; i < count; i += line) __builtin_prefetch(item + i, 0, 2);
}

}  // namespace shaftcull::kernel
