// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "aligned_heap.hpp"

// _aligned_msize() would tell sizes, but asks for the alignment, which operator delete is not always told of.
namespace shaftcull {
namespace {

/// Stands just before what is handed out.
struct Piece {
  void* whole;
  std::size_t bytes;  ///< of all of it
};

Piece& piece_of(void* memory) noexcept { return *std::launder(static_cast<Piece*>(memory) - 1); }

}  // namespace

void* allocate_aligned(std::size_t bytes, std::size_t alignment) noexcept {
  alignment = std::max(alignment, alignof(Piece));
  const std::size_t size = bytes + alignment + sizeof(Piece);
  void* const whole = size < bytes ? nullptr : std::malloc(size);
  if (whole == nullptr) return nullptr;
  const std::uintptr_t first = reinterpret_cast<std::uintptr_t>(whole) + sizeof(Piece);
  void* const memory = reinterpret_cast<void*>((first + alignment - 1) / alignment * alignment);
  new (static_cast<Piece*>(memory) - 1) Piece{whole, size};
  return memory;
}
void free_aligned(void* memory) noexcept {
  if (memory != nullptr) std::free(piece_of(memory).whole);
}

std::size_t allocated_bytes_of(void* memory) noexcept { return memory == nullptr ? 0 : piece_of(memory).bytes; }

}  // namespace shaftcull
