// SPDX-License-Identifier: MIT
/// Whether two arrays share memory.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace shaftcull::kernel {

/// The bytes of an array.
template <class Item>
[[nodiscard]] std::span<const std::byte> bytes_of(const Item* first, std::size_t count) noexcept {
  return std::as_bytes(std::span<const Item>(first, count));
}
template <class Items>
[[nodiscard]] std::span<const std::byte> bytes_of(const Items& items) noexcept {
  return bytes_of(items.data(), items.size());
}

/// Whether two ranges of memory have a byte in common.
[[nodiscard]] inline bool overlap(std::span<const std::byte> a, std::span<const std::byte> b) noexcept {
  if (a.empty() || b.empty()) return false;
  const std::less<const std::byte*> is_before;  // ordered for pointers into different arrays, too
  return is_before(a.data(), b.data() + b.size()) && is_before(b.data(), a.data() + a.size());
}

}  // namespace shaftcull::kernel
