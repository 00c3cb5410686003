// SPDX-License-Identifier: MIT
#include <sys/mman.h>
#include <unistd.h>

#include <new>

#include "pages.hpp"

namespace shaftcull {

Pages::Pages(std::size_t bytes) : bytes_(bytes) {
  void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  memory_ = static_cast<std::byte*>(memory);
}
Pages::~Pages() { munmap(memory_, bytes_); }

std::size_t Pages::page_bytes() { return static_cast<std::size_t>(sysconf(_SC_PAGESIZE)); }

bool Pages::forbid_writing() const { return mprotect(memory_, bytes_, PROT_READ) == 0; }
bool Pages::forbid_from(std::size_t first) const { return mprotect(memory_ + first, bytes_ - first, PROT_NONE) == 0; }

}  // namespace shaftcull
