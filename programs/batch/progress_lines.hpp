// SPDX-License-Identifier: MIT
/// One line a second that tells how far a job is.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace shaftcull::batch {

enum class ProgressForm : std::uint8_t { none, text, json };

/// How far a job is.
struct ProgressState {
  const char* phase;            ///< "sort", "compute" or "write"
  std::uint64_t blocks_done;    ///< of this phase, those of earlier runs included
  std::uint64_t blocks;         ///< in all
  std::uint64_t blocks_before;  ///< done by earlier runs
  double things_a_block;        ///< on average
  double seconds;               ///< since this phase of this run began
  const char* things = "shafts";
  const char* pieces = "blocks";  ///< in text
};

/// "compute: 12 of 100 blocks, 3.1 M shafts/s, 7 s left", or {"phase":"compute", …} of JSON, with the same numbers.
/// Rates and times are left out (null) until this run has done a block.
[[nodiscard]] std::string progress_line(const ProgressState& state, ProgressForm form);

/// Writes lines to a file: those that come within a second of the last are dropped, unless they end a phase. Lines that
/// cannot be written are dropped, too.
class ProgressLines {
 public:
  using Clock = std::chrono::steady_clock;

  ProgressLines(std::FILE* file, ProgressForm form) : file_(file), form_(form) {}

  /// Whether a line would be written now.
  [[nodiscard]] bool due(Clock::time_point now = Clock::now()) const;
  void write(const ProgressState& state, Clock::time_point now = Clock::now());

 private:
  std::FILE* file_;
  ProgressForm form_;
  Clock::time_point last_ = Clock::now();
};

}  // namespace shaftcull::batch
