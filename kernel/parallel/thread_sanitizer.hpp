/// What oneTBB promises about the order of things, said to ThreadSanitizer, which cannot see it: the libtbb.so of
/// distributions is not built for it, so every task would seem to race with the call that waits for it.
///
/// Only promises of oneTBB's documentation are repeated, so a race between two tasks is still found (docs/testing.md).
/// In any other build all of this is nothing.
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

/// What a thread did before give() is over when another returns from take().
class Handover {
 public:
#ifdef SHAFTCULL_THREAD_SANITIZER
  void give() noexcept { __tsan_release(&address_); }
  void take() noexcept { __tsan_acquire(&address_); }

 private:
  char address_ = 0;
#else
  void give() noexcept {}
  void take() noexcept {}
#endif
};

/// One for each of some slots.
class Handovers {
 public:
#ifdef SHAFTCULL_THREAD_SANITIZER
  explicit Handovers(std::size_t slots) : each_(slots) {}
  [[nodiscard]] Handover& operator[](std::size_t slot) noexcept { return each_[slot]; }

 private:
  std::vector<Handover> each_;
#else
  explicit Handovers(std::size_t /*slots*/) noexcept {}
  [[nodiscard]] Handover operator[](std::size_t /*slot*/) const noexcept { return {}; }
#endif
};

/// Gives at the end of the scope, be it by an exception.
class GiveAtEnd {
 public:
  explicit GiveAtEnd(Handover& handover) noexcept : handover_(handover) {}
  ~GiveAtEnd() { handover_.give(); }
  GiveAtEnd(const GiveAtEnd&) = delete;
  GiveAtEnd& operator=(const GiveAtEnd&) = delete;

 private:
  Handover& handover_;
};

/// Takes at the end of the scope, be it by an exception.
class TakeAtEnd {
 public:
  explicit TakeAtEnd(Handover& handover) noexcept : handover_(handover) {}
  ~TakeAtEnd() { handover_.take(); }
  TakeAtEnd(const TakeAtEnd&) = delete;
  TakeAtEnd& operator=(const TakeAtEnd&) = delete;

 private:
  Handover& handover_;
};

}  // namespace shaftcull::kernel
