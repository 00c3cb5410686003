// SPDX-License-Identifier: MIT
#include <cstdlib>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include "aligned_heap.hpp"

namespace shaftcull {

void* allocate_aligned(std::size_t bytes, std::size_t alignment) noexcept {
  return std::aligned_alloc(alignment, (bytes + alignment) / alignment * alignment);  // it wants a multiple
}
void free_aligned(void* memory) noexcept { std::free(memory); }

std::size_t allocated_bytes_of([[maybe_unused]] void* memory) noexcept {
#ifdef __GLIBC__
  return memory == nullptr ? 0 : malloc_usable_size(memory);
#else
  return 0;
#endif
}

}  // namespace shaftcull
