// SPDX-License-Identifier: MIT
/// Signals that end long runs of the program early.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <string>
#include <vector>

#include "cli/running_program.hpp"
#include "interrupt.hpp"

namespace shaftcull::test {
namespace {

using cli::InterruptWatch;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Runs until `begun` is on standard error, sends the signal, and waits for the end.
Outcome interrupted(const std::vector<std::string>& arguments, const std::string& begun, int signal) {
  RunningProgram program(arguments);
  EXPECT_TRUE(program.wait_for(begun)) << begun;
  program.send(signal);
  return program.finish();
}

const std::vector<std::string> endless_demo{"demo", "--bounds", "1000", "--shafts", "4", "--frames", "1000000"};

TEST(CliInterrupt, DemoShowsTheFramesUntilThen) {
  const Outcome outcome = interrupted(endless_demo, "sphereflake", SIGINT);
  EXPECT_EQ(outcome.exit_code, 128 + SIGINT) << outcome.error;
  EXPECT_THAT(outcome.error, HasSubstr("shaftcull: demo: interrupted"));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("ms/frame"), HasSubstr("\nsphereflake "), Not(HasSubstr("\ncity "))));
}

TEST(CliInterrupt, SigtermEndsDemoAsWell) {
  const Outcome outcome = interrupted(endless_demo, "sphereflake", SIGTERM);
  EXPECT_EQ(outcome.exit_code, 128 + SIGTERM) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr("\nsphereflake "));
}

TEST(CliInterrupt, VerifySumsUpTheCasesUntilThen) {
  const Outcome outcome = interrupted({"verify", "--cases", "1000000000000"}, "cases (seed 1) on:", SIGINT);
  EXPECT_EQ(outcome.exit_code, 128 + SIGINT) << outcome.error;
  const auto count_before = [](const std::string& text, const std::string& words) {
    const std::size_t end = text.find(words);
    if (end == std::string::npos) return "no '" + words + "' in " + text;
    const std::size_t begin = text.find_last_of(" \n", end - 1) + 1;
    return text.substr(begin, end - begin);
  };
  // No case that was begun and not finished is among them.
  EXPECT_EQ(count_before(outcome.out, " cases (seed 1), each"),
            count_before(outcome.error, " of 1,000,000,000,000 cases"));
  EXPECT_THAT(outcome.out, HasSubstr("Wrong answers: 0 "));
}

TEST(CliInterrupt, HashEndsWithTheFamiliesUntilThen) {
  const Outcome outcome = interrupted({"hash"}, "20 families", SIGINT);
  EXPECT_EQ(outcome.exit_code, 128 + SIGINT) << outcome.error;
  EXPECT_THAT(outcome.error, HasSubstr("of 20 families"));
}

TEST(CliInterruptDeathTest, EndsWithTheWatch) {
  EXPECT_EXIT(
      {
        std::signal(SIGINT, SIG_DFL);
        { const InterruptWatch watch; }
        std::raise(SIGINT);
      },
      testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace shaftcull::test
