// SPDX-License-Identifier: MIT
/// Executors, which run the library's parallel calls on the caller's own threads, in place of oneTBB.
#pragma once

#include <cstddef>

#include "shaftcull/export.hpp"
#include "shaftcull/function_ref.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// A job system, such as that of a game engine. While an executor is set (set_executor()), all parallel calls of the
/// library run on it: calls for many shafts, of trees and of visibility. Results do not depend on the executor.
class SHAFTCULL_EXPORT Executor {
 public:
  Executor() = default;
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;
  virtual ~Executor();

  /// Calls task(0) … task(count − 1), each once and on any thread, including the calling thread, and returns when all
  /// have ended. Tasks may run one after another: each takes work until no work is left. `count` is at most threads().
  /// Tasks do not throw, do not wait for each other, and take at most 64 KiB of stack in an optimised build.
  ///
  /// Several threads may call run() at the same time, if they make calls of the library at the same time. A task never
  /// calls run().
  virtual void run(std::size_t count, FunctionRef<void(std::size_t)> task) = 0;

  /// The number of threads, 1 or more. A call is cut into this many tasks at most.
  [[nodiscard]] virtual std::size_t threads() const noexcept = 0;
};

/// Sets the executor, and returns the previous executor. With null, which is the default, calls run on oneTBB or, in a
/// build without oneTBB, on the calling thread alone. The executor must live until it is replaced and the calls that
/// use it have returned. Safe to call from any thread; a call in progress continues with the executor it began with.
SHAFTCULL_EXPORT Executor* set_executor(Executor* executor) noexcept;

}  // namespace shaftcull
