// SPDX-License-Identifier: MIT
/// The program `shaftcull` while it runs, on POSIX systems.
#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>
#include <vector>

#include "cli/program.hpp"

namespace shaftcull::test {

/// To be sent signals. It is killed at the end if it still runs.
class RunningProgram {
 public:
  explicit RunningProgram(const std::vector<std::string>& arguments);
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;
  ~RunningProgram();

  /// Reads standard error until `text` has come. False if it ends without.
  [[nodiscard]] bool wait_for(std::string_view text);
  void send(int signal) const;
  /// Waits for the end. The exit code of a program that a signal ended is -1.
  [[nodiscard]] Outcome finish();

 private:
  bool read_error();

  ScratchFolder folder_;
  std::string error_;
  int error_pipe_ = -1;
  pid_t process_ = -1;
};

}  // namespace shaftcull::test
