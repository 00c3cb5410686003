// SPDX-License-Identifier: MIT
/// The program's options, `demo`, `draw` and `verify`, from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cli/program.hpp"

namespace shaftcull::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

TEST(Cli, TellsItsVersionAndSubcommands) {
  const Outcome version = run_program({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, StartsWith("shaftcull "));
  const Outcome help = run_program({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out,
              AllOf(HasSubstr("demo"), HasSubstr("cull"), HasSubstr("stats"), HasSubstr("draw"), HasSubstr("verify")));
}

TEST(Cli, RejectsBadOptionsInOneLine) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{{},
                                                                                         {"fly"},
                                                                                         {"demo", "--frames", "none"},
                                                                                         {"demo", "--scene", "moon"},
                                                                                         {"draw", "--size", "1"},
                                                                                         {"stats", "--shafts", "0"},
                                                                                         {"demo", "--isa", "mmx"},
                                                                                         {"verify", "--isa", "mmx"},
                                                                                         {"verify", "--cases", "0"},
                                                                                         {"hash", "--isa", "mmx"},
                                                                                         {"hash", "--family", "moon"},
                                                                                         {"demo", "--threads", "-3"},
                                                                                         {"draw", "--from", "1,2,3"}}) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const Outcome outcome = run_program(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(lines(outcome.error), SizeIs(1)) << outcome.error;
    EXPECT_THAT(outcome.out, IsEmpty());
  }
}

TEST(Program, SaysWhatAnOptionMayBe) {
  EXPECT_THAT(run_program({"cull", "--scene", "x", "--bounds", "foo"}).error,
              AllOf(HasSubstr("--bounds"), HasSubstr("foo"), HasSubstr("object"), HasSubstr("triangle")));
  EXPECT_THAT(run_program({"cull", "--scene", "x", "--format", "xml"}).error,
              AllOf(HasSubstr("--format"), HasSubstr("xml"), HasSubstr("text"), HasSubstr("json"), HasSubstr("csv")));
  const std::string help = run_program({"cull", "--help"}).out;
  EXPECT_TRUE(std::all_of(help.begin(), help.end(), [](unsigned char c) { return c >= ' ' || c == '\n'; })) << help;
}

TEST(Cli, RunsAndSaysSoWhereTheEnvironmentNamesAnUnknownInstructionSet) {
  const Outcome drawn = run_program({"draw"}, "SHAFTCULL_ISA=mmx");
  EXPECT_EQ(drawn.exit_code, 0);
  EXPECT_EQ(drawn.out, run_program({"draw"}).out);
  EXPECT_THAT(lines(drawn.error), SizeIs(1)) << drawn.error;
  EXPECT_THAT(drawn.error, AllOf(HasSubstr("SHAFTCULL_ISA=mmx"), HasSubstr("scalar"), HasSubstr("using")));
}

TEST(Cli, SaysWithItsVersionWhichInstructionSetWasAskedForAndWhichIsInUse) {
  EXPECT_THAT(run_program({"--version"}, "SHAFTCULL_ISA=SCALAR").out, HasSubstr("in use: scalar)"));
  const Outcome unknown = run_program({"--version"}, "SHAFTCULL_ISA=mmx");
  EXPECT_EQ(unknown.exit_code, 0);
  EXPECT_THAT(unknown.out, AllOf(HasSubstr("in use: "), HasSubstr("SHAFTCULL_ISA=mmx is not an instruction set")));
}

TEST(CliDraw, ShowsBothBoxesAndAllThreeAnswers) {
  const Outcome outcome = run_program({"draw"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("xy slice"), HasSubstr("xz slice"), HasSubstr("yz slice")));
  for (const char* cells : {"AAA", "BBB", "###", "+", "..."}) EXPECT_THAT(outcome.out, HasSubstr(cells));
}

TEST(CliDraw, SurroundsTheShaftWithOutside) {
  const Outcome outcome = run_program({"draw", "--from", "0,0,0,1,1,1", "--to", "5,5,5,6,6,6", "--size", "40"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  std::vector<std::string> picture;
  for (const std::string& line : lines(outcome.out)) {
    if (line.size() == 9 + 40 && line.find_first_not_of("AaBb@#+.", 9) == std::string::npos)
      picture.push_back(line.substr(9));
  }
  ASSERT_THAT(picture, testing::Not(IsEmpty()));
  for (const std::string& row : picture) {
    EXPECT_EQ(row.front(), '.');
    EXPECT_EQ(row.back(), '.');
  }
  EXPECT_EQ(picture.front(), std::string(40, '.'));
  EXPECT_EQ(picture.back(), std::string(40, '.'));
}

TEST(CliDemo, PrintsATableOfAllScenes) {
  const Outcome outcome =
      run_program({"demo", "--bounds", "5000", "--frames", "3", "--shafts", "8", "--isa", "scalar"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  for (const char* scene : {"sphereflake", "city", "crowd"}) {
    const auto words = words_after(outcome.out, scene);
    EXPECT_EQ(words[0], "3");
    EXPECT_EQ(words[1], "5,000");
    EXPECT_EQ(words[2], "8");
    EXPECT_THAT(outcome.error, HasSubstr(scene));
  }
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("ms/frame"), HasSubstr("worst"), HasSubstr("tests/s"), HasSubstr("kept"),
                    HasSubstr("scalar"), HasSubstr("threads"), HasSubstr("streams"), HasSubstr("2 trees")));
  EXPECT_THAT(outcome.error, testing::Not(HasSubstr("\r"))) << "a live line needs a terminal";
}

TEST(CliDemo, KeepsTheSameBoundsOnEveryNumberOfThreads) {
  const auto kept = [](const std::string& threads) {
    const Outcome outcome =
        run_program({"demo", "--scene", "sphereflake", "--bounds", "20000", "--frames", "2", "--threads", threads});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    // scene, frames, bounds, shafts, four times, rate with unit, kept
    return words_after(outcome.out, "sphereflake").at(9);
  };
  EXPECT_EQ(kept("1"), kept("0"));
}

TEST(Cli, VerifyFindsNoWrongAnswer) {
  const Outcome outcome = run_program({"verify", "--cases", "20000", "--seed", "7"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(words_after(outcome.out, "all")[0], "20,000");
  EXPECT_THAT(words_after(outcome.out, "Wrong answers:")[0], "0");
}

TEST(Cli, VerifyCountsTheSameOnAnyNumberOfThreads) {
  const auto summary = [](const char* threads) {
    return words_after(run_program({"verify", "--cases", "10000", "--seed", "8", "--threads", threads}).out, "all");
  };
  EXPECT_EQ(summary("1"), summary("0"));
}

}  // namespace
}  // namespace shaftcull::test
