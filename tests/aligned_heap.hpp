// SPDX-License-Identifier: MIT
/// The memory below operator new.
#pragma once

#include <cstddef>

namespace shaftcull {

/// Null if there is none. `alignment` is a power of two.
[[nodiscard]] void* allocate_aligned(std::size_t bytes, std::size_t alignment) noexcept;
void free_aligned(void* memory) noexcept;

/// What is taken for `memory`, which allocate_aligned() returned; 0 where the system does not say.
[[nodiscard]] std::size_t allocated_bytes_of(void* memory) noexcept;

}  // namespace shaftcull
