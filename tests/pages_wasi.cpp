// SPDX-License-Identifier: MIT
#include "pages.hpp"

#include <cstdlib>
#include <cstring>

#include "aligned_heap.hpp"

namespace shaftcull {

Pages::Pages(std::size_t bytes)
    : bytes_(bytes), memory_(static_cast<std::byte*>(allocate_aligned(bytes, page_bytes()))) {
  if (memory_ == nullptr) std::abort();
  std::memset(memory_, 0, bytes);
}
Pages::~Pages() { free_aligned(memory_); }

std::size_t Pages::page_bytes() { return 4096; }

bool Pages::forbid_writing() const { return true; }
bool Pages::forbid_from(std::size_t /*first*/) const { return true; }

}  // namespace shaftcull
