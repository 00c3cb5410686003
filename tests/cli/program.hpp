// SPDX-License-Identifier: MIT
/// The program `shaftcull`, run from outside as a user runs it.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace shaftcull::test {

/// What a run of the program left behind.
struct Outcome {
  int exit_code;
  std::string out;
  std::string error;
};

/// Runs the program of the environment variable SHAFTCULL_CLI, or else of this build. `environment` holds
/// assignments, "NAME=value"; `redirection` sends standard output elsewhere, ">/dev/full".
[[nodiscard]] Outcome run_program(const std::vector<std::string>& arguments, const std::string& environment = "",
                                  const std::string& redirection = "");

/// Runs the program, expects it to end well, and returns what it wrote.
[[nodiscard]] std::string output_of(const std::vector<std::string>& arguments);

/// Expects that the program refused what it was given: exit code 2, one line on standard error, no output.
void expect_refusal(const Outcome& outcome);

/// Runs the program, expects it to refuse, and returns what it said.
[[nodiscard]] std::string refusal_of(const std::vector<std::string>& arguments);

[[nodiscard]] std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more);

[[nodiscard]] std::vector<std::string> lines(std::string_view text);
/// The words of the first line that starts with `begin`, after it.
[[nodiscard]] std::vector<std::string> words_after(const std::string& text, const std::string& begin);
[[nodiscard]] std::vector<double> numbers_in(const std::string& text);
/// The value of an attribute of the first element that begins so.
[[nodiscard]] std::string attribute(const std::string& svg, const std::string& element, const std::string& name);

/// A folder of its own for one test, removed with everything in it at the end.
class ScratchFolder {
 public:
  ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();

  /// Writes a file and returns its path.
  [[nodiscard]] std::string write(const std::string& name, std::string_view content) const;
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

/// The program while it runs, to send it signals. It is killed at the end if it still runs.
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
