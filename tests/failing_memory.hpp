// SPDX-License-Identifier: MIT
/// operator new of the whole program, which counts its calls and fails where it is told to.
///
/// What oneTBB allocates for itself does not fail. Nor does what tasks list in (kernel/parallel/task_memory.hpp), which
/// comes from oneTBB's allocator and does not pass here; in builds without oneTBB (preset serial) it fails like all
/// else.
#pragma once

#include <cstddef>
#include <new>

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

/// How a call ended of which an allocation was to fail.
struct FailedCall {
  bool was_thrown;  ///< it threw std::bad_alloc
  bool has_failed;  ///< an allocation has failed; else it makes fewer
};

/// Makes a call whose n-th allocation, from 1 on, fails.
template <class Call>
FailedCall call_with_failing(std::size_t n, Failing failing, const Call& call) {
  const FailingMemory memory(n, failing);
  bool was_thrown = false;
  try {
    call();
  } catch (const std::bad_alloc&) {
    was_thrown = true;
  }
  return {was_thrown, memory.has_failed()};
}

}  // namespace shaftcull
