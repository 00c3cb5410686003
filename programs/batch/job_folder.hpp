// SPDX-License-Identifier: MIT
/// The folder beside the output in which a job keeps what is finished.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace shaftcull::batch {

/// What a job is: lines of a name and a value. Runs with the same lines give the same file.
using JobDescription = std::vector<std::pair<std::string, std::string>>;

[[nodiscard]] std::string text_of(const JobDescription& job);

/// OUT.parts: a file that says which job it is, one that is locked while a run works on it, and finished blocks.
class JobFolder {
 public:
  explicit JobFolder(std::string path);
  JobFolder(const JobFolder&) = delete;
  JobFolder& operator=(const JobFolder&) = delete;
  ~JobFolder();

  [[nodiscard]] const std::string& path() const noexcept { return path_; }

  /// Makes the folder if there is none, and locks it; where the file system has no locks, it goes without. Throws
  /// InvalidArgument if it cannot be made, or holds anything although no job made it; std::runtime_error if another run
  /// has locked it.
  void lock();

  /// Writes down which job it is; if an unfinished job is there, compares. Throws InvalidArgument, which names the
  /// first line that differs, if it is another job.
  void begin(const JobDescription& job);

  /// Whether begin() found the job begun before.
  [[nodiscard]] bool resumed() const noexcept { return resumed_; }

  /// Removes what jobs keep in the folder, and the folder if nothing else is in it, and unlocks it. What cannot be
  /// removed stays.
  void remove() noexcept;

 private:
  std::string path_;
  int lock_ = -1;
  bool resumed_ = false;
};

}  // namespace shaftcull::batch
