// SPDX-License-Identifier: MIT
/// Signals that end long runs early.
#include <gtest/gtest.h>

#include <csignal>

#include "interrupt.hpp"

namespace shaftcull::test {
namespace {

using cli::InterruptWatch;

TEST(CliInterrupt, FirstSignalIsNoted) {
  const InterruptWatch watch;
  EXPECT_EQ(watch.signal(), 0);
  std::raise(SIGTERM);
  EXPECT_EQ(watch.signal(), SIGTERM);
}

TEST(CliInterruptDeathTest, SecondSignalEndsTheProgram) {
  const auto twice = [](int first, int second) {
    std::signal(SIGINT, SIG_DFL);  // ignored in what a shell runs in the background
    const InterruptWatch watch;
    std::raise(first);
    std::raise(second);
  };
  EXPECT_EXIT(twice(SIGINT, SIGINT), testing::ExitedWithCode(128 + SIGINT), "");
  EXPECT_EXIT(twice(SIGINT, SIGTERM), testing::ExitedWithCode(128 + SIGTERM), "");
}

TEST(CliInterrupt, IgnoredSignalsStayIgnored) {
  const auto before = std::signal(SIGINT, SIG_IGN);
  {
    const InterruptWatch watch;
    std::raise(SIGINT);
    EXPECT_EQ(watch.signal(), 0);
  }
  std::signal(SIGINT, before);
}

}  // namespace
}  // namespace shaftcull::test
