// SPDX-License-Identifier: MIT
#include "failing_memory.hpp"

#include <atomic>
#include <cstring>
#include <limits>
#include <new>

#if __has_include(<dlfcn.h>)
#include <dlfcn.h>
#endif

#include "aligned_heap.hpp"

namespace shaftcull {
namespace {

constexpr std::size_t never = std::numeric_limits<std::size_t>::max();

std::atomic<std::size_t> calls = 0;
std::atomic<std::size_t> asked = 0;
std::atomic<std::size_t> first_failing = never;  // calls are counted from 1
std::atomic<std::size_t> last_failing = never;
std::atomic<bool> any_failed = false;
std::atomic<std::size_t> live = 0;
std::atomic<std::size_t> peak = 0;

void* counted(void* memory) noexcept {
  const std::size_t now = live += allocated_bytes_of(memory);
  for (std::size_t before = peak; before < now && !peak.compare_exchange_weak(before, now);) {
  }
  return memory;
}

/// Whether `caller`, an address in code, is in oneTBB. It promises nothing of threads that find no memory for
/// themselves.
bool is_in_onetbb([[maybe_unused]] const void* caller) noexcept {
#if __has_include(<dlfcn.h>)
  Dl_info place;
  return dladdr(caller, &place) != 0 && place.dli_fname != nullptr && std::strstr(place.dli_fname, "libtbb") != nullptr;
#else
  return false;
#endif
}

/// Null if it fails. `caller` is the address of the code that asks.
void* allocate(std::size_t bytes, std::size_t alignment, const void* caller) noexcept {
  if (first_failing == never || !is_in_onetbb(caller)) {
    const std::size_t call = ++calls;
    if (call >= first_failing && call <= last_failing) {
      any_failed = true;
      return nullptr;
    }
  }
  asked += bytes;
  return counted(allocate_aligned(bytes, alignment));
}

void* allocate_or_throw(std::size_t bytes, std::size_t alignment, const void* caller) {
  void* const memory = allocate(bytes, alignment, caller);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

/// Not inlined: where only operator delete is, g++ takes the pair for a mismatched one.
[[gnu::noinline]] void release(void* memory) noexcept {
  live -= allocated_bytes_of(memory);
  free_aligned(memory);
}

constexpr std::size_t usual = alignof(std::max_align_t);

}  // namespace

std::size_t allocations() noexcept { return calls; }
std::size_t allocated_bytes() noexcept { return asked; }
std::size_t live_bytes() noexcept { return live; }
std::size_t peak_bytes() noexcept { return peak; }
void forget_peak() noexcept { peak = live.load(); }

FailingMemory::FailingMemory(std::size_t n, Failing failing) noexcept {
  any_failed = false;
  last_failing = failing == Failing::only_one ? calls + n : never;
  first_failing = calls + n;
}
FailingMemory::~FailingMemory() { first_failing = never; }
bool FailingMemory::has_failed() const noexcept { return any_failed; }

}  // namespace shaftcull

using shaftcull::allocate;
using shaftcull::allocate_or_throw;
using shaftcull::release;
using shaftcull::usual;

void* operator new(std::size_t bytes) { return allocate_or_throw(bytes, usual, __builtin_return_address(0)); }
void* operator new[](std::size_t bytes) { return allocate_or_throw(bytes, usual, __builtin_return_address(0)); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate_or_throw(bytes, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return allocate_or_throw(bytes, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return allocate(bytes, usual, __builtin_return_address(0));
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  return allocate(bytes, usual, __builtin_return_address(0));
}
void* operator new(std::size_t bytes, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return allocate(bytes, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return allocate(bytes, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t, const std::nothrow_t&) noexcept { release(memory); }
void operator delete[](void* memory, std::align_val_t, const std::nothrow_t&) noexcept { release(memory); }
