// SPDX-License-Identifier: MIT
/// Locks, and objects of a thread, where there are threads. Standard libraries of systems without any, as of
/// WebAssembly, have neither.
#pragma once

#include <mutex>

namespace shaftcull::kernel {

#if defined(_LIBCPP_HAS_NO_THREADS) || (defined(_LIBCPP_HAS_THREADS) && !_LIBCPP_HAS_THREADS)

#define SHAFTCULL_OF_THIS_THREAD static

class Mutex {};

class Lock {
 public:
  explicit Lock(Mutex& /*mutex*/) noexcept {}
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;
  ~Lock() {}  // NOLINT(modernize-use-equals-default): so that a lock that is not named again is no unused variable
};

#else

#define SHAFTCULL_OF_THIS_THREAD thread_local

using Mutex = std::mutex;
using Lock = std::lock_guard<std::mutex>;

#endif

/// Whether objects of a thread may have destructors. On Windows, g++ keeps such objects in memory that is freed when
/// the thread ends, before it destroys them.
#if defined(__MINGW32__) && !defined(__clang__)
inline constexpr bool thread_objects_may_have_destructors = false;
#else
inline constexpr bool thread_objects_may_have_destructors = true;
#endif

}  // namespace shaftcull::kernel
