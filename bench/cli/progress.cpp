#include "progress.hpp"

#include <unistd.h>

#include <cstdio>

#include <fmt/format.h>

namespace shaftcull::cli {
namespace {
constexpr auto shortest_pause = std::chrono::milliseconds(100);
}

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() { clear(); }

void Progress::milestone(std::string_view text) {
  clear();
  fmt::print(stderr, "{}\n", text);
}

void Progress::update(std::string_view text) {
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || now - last_ < shortest_pause) return;
  last_ = now;
  clear();
  fmt::print(stderr, "{}", text);
  std::fflush(stderr);
  line_shown_ = true;
}

void Progress::clear() {
  // Back to the first column, then erase to the end of the line.
  if (line_shown_) std::fputs("\r\033[K", stderr);
  line_shown_ = false;
}

}  // namespace shaftcull::cli
