/// The live line that tells how far a long run is.
#pragma once

#include <chrono>
#include <string_view>

namespace shaftcull::cli {

/// A line on standard error. On a terminal it is written over in place, ten times a second at most; elsewhere
/// only milestones are printed, a line each.
class Progress {
 public:
  Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// Worth a line of its own wherever the output goes.
  void milestone(std::string_view text);
  /// Shown on a terminal only.
  void update(std::string_view text);
  [[nodiscard]] bool on_terminal() const noexcept { return terminal_; }

 private:
  void clear();

  bool terminal_;
  bool line_shown_ = false;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace shaftcull::cli
