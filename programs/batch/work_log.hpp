// SPDX-License-Identifier: MIT
/// What a rank did, and when.
#pragma once

#include <chrono>
#include <cstdint>
#include <fstream>
#include <functional>
#include <mutex>
#include <string>

namespace shaftcull::batch {

/// Lines of CSV: what, share, block, begin, seconds. `begin` is in seconds since the log was. For profiles, and for
/// `programs/batch/model.py`, which says how long a job takes on more machines.
class WorkLog {
 public:
  /// Writes to PATH.RANK; nothing, if the path is empty. Throws InvalidArgument if that cannot be made.
  WorkLog(const std::string& path, int rank);

  /// Does some work, and notes how long it took. Threads may call it at the same time.
  void time(const char* what, std::uint64_t share, std::uint64_t block, const std::function<void()>& work);

 private:
  using Clock = std::chrono::steady_clock;

  std::mutex mutex_;
  std::ofstream file_;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace shaftcull::batch
