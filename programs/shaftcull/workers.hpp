// SPDX-License-Identifier: MIT
/// The threads that a demonstration runs on. The only place in the program that knows oneTBB.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace shaftcull::cli {

/// More threads than any machine we know of has.
inline constexpr int most_threads = 1024;

/// A fixed number of threads (one, in a build without oneTBB).
class Workers {
 public:
  /// From 0, as many as the machine offers, to most_threads. Throws InvalidArgument if the build cannot have that many.
  explicit Workers(int threads);
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  ~Workers();

  /// Calls `work` where the library's parallel calls use these threads.
  void run(const std::function<void()>& work) const;

  /// Calls `work(first, size)` for consecutive chunks of [0, count), in parallel. For use inside run().
  static void for_chunks(std::size_t count, std::size_t chunk,
                         const std::function<void(std::size_t, std::size_t)>& work);

  /// Calls both at the same time, if there are two threads. For use inside run().
  static void do_both(const std::function<void()>& one, const std::function<void()>& other);

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;
};

}  // namespace shaftcull::cli
