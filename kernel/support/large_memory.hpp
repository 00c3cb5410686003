// SPDX-License-Identifier: MIT
/// Memory that is larger than caches, and is asked for in huge pages: 2 MiB of it is then one page fault and one entry
/// of the processor's page tables, not 512.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace shaftcull::kernel {

/// Asks for huge pages in all of some memory but its ends, which the system may or may not give. For memory that is not
/// written yet.
inline void ask_for_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::size_t huge_page = std::size_t{2} << 20U;
  void* first = memory;
  std::size_t left = bytes;
  if (std::align(huge_page, huge_page, first, left) == nullptr) return;
  madvise(first, left / huge_page * huge_page, MADV_HUGEPAGE);  // no matter if it is not heard
#endif
}

/// Memory for `size` numbers, not initialised. Comes from operator new and goes back there.
template <class Number>
class LargeMemory {
 public:
  LargeMemory() noexcept = default;
  explicit LargeMemory(std::size_t size)
      : numbers_(size == 0 ? nullptr : static_cast<Number*>(::operator new(size * sizeof(Number), line))) {
    ask_for_huge_pages(numbers_.get(), size * sizeof(Number));
  }

  [[nodiscard]] Number* get() const noexcept { return numbers_.get(); }
  void free() noexcept { numbers_.reset(); }

 private:
  static constexpr std::align_val_t line{64};
  struct Free {
    void operator()(Number* numbers) const noexcept { ::operator delete(numbers, line); }
  };
  std::unique_ptr<Number[], Free> numbers_;
};

}  // namespace shaftcull::kernel
