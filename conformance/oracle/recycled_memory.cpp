// SPDX-License-Identifier: MIT
/// Memory of GMP's numbers. The oracle makes and destroys millions of them, of a few sizes. So each thread keeps the
/// blocks that it frees, and takes them for the next numbers of the same size. Without this, malloc() and free() take a
/// third of the oracle's time, and nine tenths where AddressSanitizer replaces them. Linked into each program that
/// links the oracle.
#include <gmp.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

namespace shaftcull::oracle {
namespace {

/// Begins a block that is kept.
struct Block {
  Block* next;
};

/// Set when a thread ends. Numbers that are destroyed later are not kept.
thread_local bool is_thread_over = false;

/// The blocks that a thread keeps, of 8 bytes, of 16, …. A block has exactly its size, so blocks from before the
/// functions below were installed do as well.
class KeptBlocks {
 public:
  constexpr KeptBlocks() = default;
  KeptBlocks(const KeptBlocks&) = delete;
  KeptBlocks& operator=(const KeptBlocks&) = delete;
  ~KeptBlocks() {
    is_thread_over = true;
    for (Block* block : blocks_) {
      while (block != nullptr) std::free(std::exchange(block, block->next));
    }
  }

  void* allocate(std::size_t size) {
    if (keeps(size) && blocks_[size / step] != nullptr) {
      return std::exchange(blocks_[size / step], blocks_[size / step]->next);
    }
    void* const memory = std::malloc(size);
    if (memory == nullptr) std::abort();  // GMP does so, too
    return memory;
  }
  void free(void* memory, std::size_t size) {
    if (keeps(size)) {
      blocks_[size / step] = ::new (memory) Block{blocks_[size / step]};
    } else {
      std::free(memory);
    }
  }

 private:
  static constexpr std::size_t step = sizeof(Block);
  static constexpr std::size_t most_steps = 64;

  static bool keeps(std::size_t size) {
    return !is_thread_over && size != 0 && size % step == 0 && size / step < most_steps;
  }

  std::array<Block*, most_steps> blocks_{};
};

thread_local constinit KeptBlocks kept;

void* allocate(std::size_t size) { return kept.allocate(size); }
void free(void* memory, std::size_t size) { kept.free(memory, size); }
void* reallocate(void* memory, std::size_t old_size, std::size_t size) {
  void* const moved = kept.allocate(size);
  std::memcpy(moved, memory, std::min(old_size, size));
  kept.free(memory, old_size);
  return moved;
}

[[maybe_unused]] const bool is_installed = [] {
  mp_set_memory_functions(allocate, reallocate, free);
  return true;
}();

}  // namespace
}  // namespace shaftcull::oracle
