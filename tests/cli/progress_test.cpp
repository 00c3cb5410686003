// SPDX-License-Identifier: MIT
/// The line that tells how far a long run is, with a clock of the test's own.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

#include "progress.hpp"

namespace shaftcull::cli {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class ProgressLine : public testing::Test {
 protected:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };

  std::string written() {
    std::rewind(file_.get());
    std::array<char, 4096> buffer{};
    return {buffer.data(), std::fread(buffer.data(), 1, buffer.size(), file_.get())};
  }

  std::unique_ptr<std::FILE, Close> file_{std::tmpfile()};
  Progress::Clock::time_point start_{};
};

TEST_F(ProgressLine, ComesEveryFiveSecondsWithoutATerminal) {
  {
    Progress progress(file_.get(), false, start_);
    for (int i = 1; i <= 14; ++i) progress.update(std::to_string(i), start_ + seconds(i));
  }
  EXPECT_EQ(written(), "5\n10\n");
}

TEST_F(ProgressLine, WaitsAfterAMilestone) {
  {
    Progress progress(file_.get(), false, start_);
    progress.milestone("begun", start_ + seconds(3));
    progress.update("early", start_ + seconds(7));
    progress.update("late", start_ + seconds(8));
  }
  EXPECT_EQ(written(), "begun\nlate\n");
}

TEST_F(ProgressLine, IsWrittenOverInPlaceOnATerminal) {
  {
    Progress progress(file_.get(), true, start_);
    progress.update("too early", start_ + milliseconds(99));
    progress.update("one", start_ + milliseconds(100));
    progress.update("too early", start_ + milliseconds(199));
    progress.update("two", start_ + milliseconds(200));
    progress.milestone("done", start_ + milliseconds(201));
  }
  EXPECT_EQ(written(), "one\r\033[Ktwo\r\033[Kdone\n");
}

}  // namespace
}  // namespace shaftcull::cli
