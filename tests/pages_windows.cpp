// SPDX-License-Identifier: MIT
#include <windows.h>

#include <new>

#include "pages.hpp"

namespace shaftcull {

Pages::Pages(std::size_t bytes) : bytes_(bytes) {
  memory_ = static_cast<std::byte*>(VirtualAlloc(nullptr, bytes, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE));
  if (memory_ == nullptr) throw std::bad_alloc();
}
Pages::~Pages() { VirtualFree(memory_, 0, MEM_RELEASE); }

std::size_t Pages::page_bytes() {
  SYSTEM_INFO system;
  GetSystemInfo(&system);
  return system.dwPageSize;
}

bool Pages::forbid_writing() const {
  DWORD before = 0;
  return VirtualProtect(memory_, bytes_, PAGE_READONLY, &before) != 0;
}
bool Pages::forbid_from(std::size_t first) const {
  DWORD before = 0;
  return VirtualProtect(memory_ + first, bytes_ - first, PAGE_NOACCESS, &before) != 0;
}

}  // namespace shaftcull
