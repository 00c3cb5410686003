// SPDX-License-Identifier: MIT
/// The program `shaftcull`, run from outside as a user runs it.
#pragma once

#include <cstddef>
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

/// The program of the environment variable SHAFTCULL_CLI, or else of this build.
[[nodiscard]] std::string program_path();

[[nodiscard]] std::string bytes_of_file(const std::string& path);
[[nodiscard]] std::size_t files_in(const std::string& folder);

/// Runs that program. `environment` is an assignment, "NAME=value"; in a POSIX shell it may be several, or other
/// commands. `redirection`, which only such a shell does, sends standard output elsewhere, ">/dev/full".
[[nodiscard]] Outcome run_program(const std::vector<std::string>& arguments, const std::string& environment = "",
                                  const std::string& redirection = "");

/// Runs the program, expects it to end well, and returns what it wrote.
[[nodiscard]] std::string output_of(const std::vector<std::string>& arguments);

/// Expects that the program refused what it was given: exit code 2, one line on standard error, no output.
void expect_refusal(const Outcome& outcome);

/// Runs the program, expects it to refuse, and returns what it said.
[[nodiscard]] std::string refusal_of(const std::vector<std::string>& arguments);

/// Arguments of the program for a room whose walls are solid; and for a report of one whose first cupboard is solid,
/// too.
inline const std::vector<std::string> one_room{"sees", "--rooms", "1", "--patches", "1.5", "--solid", "wall*"};
inline const std::vector<std::string> report_of_one_room{"sees",    "--rooms", "1",          "--patches", "1.5",
                                                         "--solid", "wall*",   "cupboard 1", "--format",  "json"};

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
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.string() + '/' + name; }

 private:
  std::filesystem::path folder_;
};

}  // namespace shaftcull::test
