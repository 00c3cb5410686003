// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include "standard_streams.hpp"

namespace shaftcull::cli {
namespace {
constexpr auto pause_on_terminal = std::chrono::milliseconds(100);
constexpr auto pause_elsewhere = std::chrono::seconds(5);
}  // namespace

Progress::Progress() : Progress(stderr, errors_go_to_terminal(), Clock::now()) {}

Progress::Progress(std::FILE* file, bool is_terminal, Clock::time_point now)
    : file_(file), terminal_(is_terminal), last_(now) {}

Progress::~Progress() { clear(); }

void Progress::milestone(std::string_view text, Clock::time_point now) {
  clear();
  last_ = now;
  write(text);
  write("\n");
}

void Progress::update(std::string_view text, Clock::time_point now) {
  if (now - last_ < (terminal_ ? Clock::duration(pause_on_terminal) : Clock::duration(pause_elsewhere))) return;
  if (!terminal_) {
    milestone(text, now);
    return;
  }
  last_ = now;
  clear();
  write(text);
  line_shown_ = true;
}

void Progress::clear() {
  // Back to the first column, then erase to the end of the line.
  if (line_shown_) write("\r\033[K");
  line_shown_ = false;
}

void Progress::write(std::string_view text) {
  // A run goes on even if its progress cannot be written.
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), file_));
  std::fflush(file_);
}

}  // namespace shaftcull::cli
