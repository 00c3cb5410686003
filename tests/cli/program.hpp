/// The program `shaftcull`, run from outside as a user runs it.
#pragma once

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
/// assignments, "NAME=value".
[[nodiscard]] Outcome run_program(const std::vector<std::string>& arguments, const std::string& environment = "");

[[nodiscard]] std::vector<std::string> lines(std::string_view text);

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

}  // namespace shaftcull::test
