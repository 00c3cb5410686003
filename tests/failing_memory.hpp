// SPDX-License-Identifier: MIT
/// operator new of the whole program, which counts its calls and fails where it is told to.
///
/// What oneTBB allocates for itself does not fail. Nor does what tasks list in (kernel/parallel/task_memory.hpp), which
/// comes from oneTBB's allocator and does not pass here; in builds without oneTBB (preset serial) it fails like all
/// else.
#pragma once

#include <cstddef>

namespace shaftcull {

/// Calls of operator new so far, in all threads.
[[nodiscard]] std::size_t allocations() noexcept;

/// Bytes that operator new was asked for so far, in all threads.
[[nodiscard]] std::size_t allocated_bytes() noexcept;

/// Bytes that operator new has given and that are not deleted yet, and the most there were since forget_peak(). 0 where
/// the C library does not say how large a piece of memory is.
[[nodiscard]] std::size_t live_bytes() noexcept;
[[nodiscard]] std::size_t peak_bytes() noexcept;
void forget_peak() noexcept;

/// Which calls of operator new fail, counted in all threads from when a FailingMemory is made.
enum class Failing {
  only_one,      ///< the n-th
  from_then_on,  ///< the n-th and all after it
};

/// While one of these lives, some calls of operator new throw std::bad_alloc. One at a time.
class FailingMemory {
 public:
  /// n is counted from 1.
  FailingMemory(std::size_t n, Failing failing) noexcept;
  ~FailingMemory();
  FailingMemory(const FailingMemory&) = delete;
  FailingMemory& operator=(const FailingMemory&) = delete;

  /// Whether a call has failed.
  [[nodiscard]] bool has_failed() const noexcept;
};

}  // namespace shaftcull
