// SPDX-License-Identifier: MIT
/// The caller's own threads, in place of oneTBB.
#pragma once

#include <cstddef>

#include "shaftcull/export.hpp"
#include "shaftcull/function_ref.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// A job system, as engines have one. While one is set (set_executor()), all parallel calls of the library run on it:
/// those for many shafts, of trees and of visibility. Results do not depend on it.
class SHAFTCULL_EXPORT Executor {
 public:
  Executor() = default;
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;
  virtual ~Executor();

  /// Calls task(0) … task(count − 1), each once and on any thread, the calling one included, and returns when all have
  /// ended. They may run one after another: each takes work until none is left. `count` is at most threads(). Tasks do
  /// not throw, do not wait for each other, and take at most 64 KiB of stack in an optimised build.
  ///
  /// Several threads may call this at once, if they make calls of the library at once. A task never calls it.
  virtual void run(std::size_t count, FunctionRef<void(std::size_t)> task) = 0;

  /// How many tasks a call is cut into: the number of threads, 1 or more.
  [[nodiscard]] virtual std::size_t threads() const noexcept = 0;
};

/// Sets the executor, and returns the one before. Null, which is the default: oneTBB, or in a build without oneTBB the
/// calling thread alone. The executor must live until it is replaced and the calls that use it have returned. Safe to
/// call from any thread; calls that have begun go on with what they began with.
SHAFTCULL_EXPORT Executor* set_executor(Executor* executor) noexcept;

}  // namespace shaftcull
