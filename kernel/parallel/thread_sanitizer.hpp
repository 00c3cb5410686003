// SPDX-License-Identifier: MIT
/// Tells ThreadSanitizer in which order oneTBB runs things. It cannot see that: the libtbb.so of distributions is not
/// built for it, so every task would seem to race with the call that waits for it.
///
/// Only promises of oneTBB's documentation are repeated, so a race between two tasks is still found (docs/testing.md).
/// In any other build these classes do nothing.
#pragma once

#include <cstddef>

#if defined(__SANITIZE_THREAD__)
#define SHAFTCULL_THREAD_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SHAFTCULL_THREAD_SANITIZER 1
#endif
#endif

#ifdef SHAFTCULL_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>

#include <vector>
#endif

namespace shaftcull::kernel {

/// What a thread did before release() has happened when another thread returns from acquire().
class HappensBefore {
 public:
#ifdef SHAFTCULL_THREAD_SANITIZER
  void release() noexcept { __tsan_release(&address_); }
  void acquire() noexcept { __tsan_acquire(&address_); }

 private:
  char address_ = 0;
#else
  void release() noexcept {}
  void acquire() noexcept {}
#endif
};

/// One for each of some slots.
class HappensBeforeSlots {
 public:
#ifdef SHAFTCULL_THREAD_SANITIZER
  explicit HappensBeforeSlots(std::size_t slots) : each_(slots) {}
  [[nodiscard]] HappensBefore& operator[](std::size_t slot) noexcept { return each_[slot]; }

 private:
  std::vector<HappensBefore> each_;
#else
  explicit HappensBeforeSlots(std::size_t /*slots*/) noexcept {}
  [[nodiscard]] HappensBefore operator[](std::size_t /*slot*/) const noexcept { return {}; }
#endif
};

/// Releases at the end of the scope, be it by an exception.
class ReleaseAtEnd {
 public:
  explicit ReleaseAtEnd(HappensBefore& order) noexcept : order_(order) {}
  ~ReleaseAtEnd() { order_.release(); }
  ReleaseAtEnd(const ReleaseAtEnd&) = delete;
  ReleaseAtEnd& operator=(const ReleaseAtEnd&) = delete;

 private:
  HappensBefore& order_;
};

/// Acquires at the end of the scope, be it by an exception.
class AcquireAtEnd {
 public:
  explicit AcquireAtEnd(HappensBefore& order) noexcept : order_(order) {}
  ~AcquireAtEnd() { order_.acquire(); }
  AcquireAtEnd(const AcquireAtEnd&) = delete;
  AcquireAtEnd& operator=(const AcquireAtEnd&) = delete;

 private:
  HappensBefore& order_;
};

}  // namespace shaftcull::kernel
