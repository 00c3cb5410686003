// SPDX-License-Identifier: MIT
/// The line that tells how far a long run is.
#pragma once

#include <chrono>
#include <cstdio>
#include <string_view>

namespace shaftcull::cli {

/// Writes to standard error, or another file. On a terminal there is one live line, written over in place ten times a
/// second at most. Elsewhere, as in a log, what update() says is printed every five seconds, a line each. Lines that
/// cannot be written are dropped.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  Progress();
  Progress(std::FILE* file, bool is_terminal, Clock::time_point now);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// A line of its own, at once, wherever the output goes.
  void milestone(std::string_view text, Clock::time_point now = Clock::now());
  /// Shown if the last line that was is old enough.
  void update(std::string_view text, Clock::time_point now = Clock::now());

 private:
  void clear();
  void write(std::string_view text);

  std::FILE* file_;
  bool terminal_;
  bool line_shown_ = false;
  Clock::time_point last_;
};

}  // namespace shaftcull::cli
