// SPDX-License-Identifier: MIT
/// What the program says of options, subcommands and boxes that it cannot use, from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/program.hpp"

namespace shaftcull::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct NumberOption {
  std::vector<std::string> subcommand;
  std::string option;
  std::string least;
  std::string most;
};

const std::vector<NumberOption> whole_numbers{
    {{"demo"}, "--bounds", "1", "100000000"},
    {{"demo"}, "--shafts", "1", "100000"},
    {{"demo"}, "--frames", "1", "1000000"},
    {{"demo"}, "--threads", "0", "1024"},
    {{"cull", "a.obj"}, "--random", "1", "1000000"},
    {{"cull", "a.obj", "--random", "1"}, "--seed", "0", "18446744073709551615"},
    {{"sees"}, "--rooms", "1", "10000"},
    {{"sees", "a.obj"}, "--rays", "1", "65536"},
    {{"sees", "a.obj"}, "--memory", "1", "1000000"},
    {{"sees", "a.obj"}, "--threads", "0", "1024"},
    {{"stats"}, "--shafts", "1", "100000000"},
    {{"stats"}, "--lattice", "1", "1000000"},
    {{"stats"}, "--seed", "0", "18446744073709551615"},
    {{"draw"}, "--size", "12", "400"},
    {{"verify"}, "--cases", "1", "1125899906842624"},
    {{"verify"}, "--seed", "0", "18446744073709551615"},
    {{"verify"}, "--threads", "0", "1024"},
    {{"hash"}, "--threads", "0", "1024"},
};

const std::vector<NumberOption> real_numbers{{{"demo"}, "--seconds", "0.001", "86400"},
                                             {{"stats"}, "--box-radius", "0", "10"}};

/// Gives an option a value that it must refuse with the option, the value, the reason and the range.
void expect_refused(const NumberOption& number, const std::string& value, const std::string& reason) {
  SCOPED_TRACE(number.subcommand.front() + ' ' + number.option + ' ' + value);
  std::vector<std::string> arguments = number.subcommand;
  arguments.insert(arguments.end(), {number.option, value});
  EXPECT_THAT(refusal_of(arguments), AllOf(HasSubstr(number.option + ' ' + value + ": " + reason),
                                           HasSubstr("from " + number.least + " to " + number.most)));
}

TEST(CliNumbers, WholeNumbersAreWholeAndInTheirRange) {
  for (const NumberOption& number : whole_numbers) {
    expect_refused(number, "-1", "too small");
    expect_refused(number, "99999999999999999999999", "too large");
    expect_refused(number, "inf", "too large");
    expect_refused(number, "nan", "not a number");
    expect_refused(number, "12x", "not a number");
    expect_refused(number, "13.5", "not a whole number");
    expect_refused(number, "2e1", "not written in digits");
  }
}

TEST(CliNumbers, RealNumbersAreNumbersAndInTheirRange) {
  for (const NumberOption& number : real_numbers) {
    expect_refused(number, "nan", "not a number");
    expect_refused(number, "-nan", "not a number");
    expect_refused(number, "inf", "too large");
    expect_refused(number, "-inf", "too small");
    expect_refused(number, "-0.5", "too small");
    expect_refused(number, "1e9", "too large");
    expect_refused(number, "1e999", "out of range");
    expect_refused(number, "fast", "not a number");
    expect_refused(number, "1,5", "not a number");
  }
}

TEST(CliNumbers, EndsOfARangeBelongToIt) {
  const Outcome outcome =
      run_program({"stats", "--shafts", "1", "--seed", "18446744073709551615", "--box-radius", "10"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr("half extent 10 (seed 18446744073709551615)"));
  EXPECT_EQ(run_program({"stats", "--shafts", "1", "--seed", "0", "--box-radius", "0"}).exit_code, 0);
}

TEST(CliSubcommands, AnUnknownOneIsNamed) {
  EXPECT_THAT(refusal_of({"fly"}),
              AllOf(HasSubstr("no subcommand 'fly'"), HasSubstr("'demo'"), HasSubstr("'cull'"), HasSubstr("'hash'")));
}

TEST(CliSubcommands, AreListedWhereNoneIsGiven) {
  EXPECT_THAT(refusal_of({}), AllOf(HasSubstr("'demo'"), HasSubstr("'stats'"), HasSubstr("shaftcull --help")));
}

TEST(CliSubcommands, AFileInPlaceOfOneIsGivenToCull) {
  const ScratchFolder folder;
  const std::string path = folder.write("room.obj", "v 0 0 0\n");
  EXPECT_THAT(refusal_of({path}), HasSubstr("shaftcull cull " + path));
}

TEST(CliSubcommands, AnOptionInPlaceOfOneIsNamed) {
  EXPECT_THAT(refusal_of({"--frames", "3"}), HasSubstr("--frames: the program itself has no such option"));
}

TEST(CliOptions, AnUnknownOneIsNamedWithTheHelpThatListsThem) {
  EXPECT_THAT(refusal_of({"demo", "--frame", "3"}), AllOf(HasSubstr("--frame"), HasSubstr("shaftcull demo --help")));
}

TEST(CliBoxes, AWrongNumberOfNumbersIsCounted) {
  EXPECT_THAT(refusal_of({"draw", "--from", "0,0,0,1,1"}), HasSubstr("--from 0,0,0,1,1: 5 numbers; a box takes six"));
  EXPECT_THAT(refusal_of({"draw", "--to", "1"}), HasSubstr("--to 1: 1 number; a box takes six"));
  EXPECT_THAT(refusal_of({"draw", "--to", "0,0,0,1,1,1,1"}), HasSubstr("7 numbers; a box takes six"));
}

TEST(CliBoxes, WhatIsNoNumberIsNamed) {
  EXPECT_THAT(refusal_of({"draw", "--from", "0,0,0,1,one,1"}), HasSubstr("'one' is not a number"));
  EXPECT_THAT(refusal_of({"draw", "--from", "0,0,0,1,,1"}), HasSubstr("'' is not a number"));
  EXPECT_THAT(refusal_of({"draw", "--from", "0,0,0,1,1e99,1"}), HasSubstr("'1e99' is out of range for a float"));
}

TEST(CliBoxes, TheCoordinateThatIsNotFiniteIsNamed) {
  EXPECT_THAT(refusal_of({"draw", "--from", "0,nan,0,1,1,1"}), AllOf(HasSubstr("lo y is nan"), Not(HasSubstr("lo x"))));
  EXPECT_THAT(refusal_of({"draw", "--from", "0,0,0,1,1,inf"}), HasSubstr("hi z is inf"));
}

TEST(CliBoxes, CornersInTheWrongOrderAreNamed) {
  EXPECT_THAT(refusal_of({"draw", "--from", "0,0,5,1,1,1"}), HasSubstr("lo z = 5 is greater than hi z = 1"));
}

}  // namespace
}  // namespace shaftcull::test
