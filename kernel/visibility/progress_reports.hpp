// SPDX-License-Identifier: MIT
/// Calls of the user's progress callback, which may cancel the call that reports.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "shaftcull/visibility.hpp"
#include "support/fail.hpp"
#include "visibility/callers_modes.hpp"

namespace shaftcull::kernel {

/// Reports of one call, at most ten a second.
class ProgressReports {
 public:
  ProgressReports(const VisibilityOptions& options, const CallersModes& modes, std::uint64_t total)
      : options_(options), modes_(modes), total_(total) {}

  /// Throws Cancelled if the user does not want to go on.
  void report(std::uint64_t done, bool at_once = false) {
    if (!options_.progress) return;
    const auto now = std::chrono::steady_clock::now();
    if (!at_once && now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    if (!modes_([&] { return options_.progress({done, total_}); })) {
      fail(Cancelled("the call was cancelled by its progress callback after " + std::to_string(done) + " of " +
                     std::to_string(total_) + " pairs"));
    }
  }

 private:
  const VisibilityOptions& options_;
  const CallersModes& modes_;
  std::uint64_t total_;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace shaftcull::kernel
