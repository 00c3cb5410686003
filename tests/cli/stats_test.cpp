// SPDX-License-Identifier: MIT
/// `shaftcull stats`, from outside.
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
using testing::SizeIs;

TEST(CliStats, ReproducesThePapersHistogram) {
  const Outcome outcome = run_program({"stats", "--shafts", "3000", "--box-radius", "0.125"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_NEAR(std::stod(words_after(outcome.out, "Joining planes per shaft:")[0]), 5.99, 0.08);
  // Three standard deviations of 3000 shafts, and the rounding of the reference.
  const auto share = [&](const char* planes) { return std::stod(words_after(outcome.out, planes)[1]); };
  EXPECT_NEAR(share("0     "), 1, 1.1);
  EXPECT_NEAR(share("4     "), 11, 2.2);
  EXPECT_NEAR(share("6     "), 74, 2.9);
  EXPECT_NEAR(share("8     "), 14, 2.4);
}

TEST(CliStats, CountsThePapersPlaneTests) {
  const Outcome outcome = run_program({"stats", "--shafts", "3000", "--box-radius", "0.125"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto unsorted = words_after(outcome.out, "unsorted");
  const auto sorted = words_after(outcome.out, "by volume");
  EXPECT_NEAR(std::stod(unsorted[0]), 5.53, 0.1);
  EXPECT_NEAR(std::stod(sorted[0]), 5.25, 0.1);
  EXPECT_NEAR(std::stod(unsorted[1]), 4.13, 0.2);
  EXPECT_NEAR(std::stod(sorted[1]), 3.37, 0.2);
}

/// The percentages in the row of a table that begins so.
std::vector<double> shares_in(const std::string& text, const std::string& row) {
  for (const std::string& line : lines(text)) {
    if (line.starts_with(row)) return numbers_in(line.substr(row.size()));
  }
  ADD_FAILURE() << "no row of " << row << " in\n" << text;
  return {0, 0, 0, 0};
}

TEST(CliStats, CountAnswersOfEveryKind) {
  struct KindOptions {
    std::string row;
    std::vector<std::string> options;
  };
  for (const KindOptions& kind : {KindOptions{"swept  ", {"--swept", "0.5,0.25,0"}},
                                  KindOptions{"swept without end", {"--swept", "0.5,0.25,0", "--infinite"}},
                                  KindOptions{"shadow", {"--shadow"}}, KindOptions{"between", {"--lattice", "40"}}}) {
    SCOPED_TRACE(kind.row);
    const std::string text = output_of(with({"stats", "--shafts", "200"}, kind.options));
    const std::vector<double> shares = shares_in(text, kind.row);
    ASSERT_THAT(shares, SizeIs(4));
    EXPECT_NEAR(shares[0] + shares[2] + shares[3], 100, 0.2);
    EXPECT_GT(shares[0], 1);
    EXPECT_GT(shares[2], 1);
    EXPECT_EQ(shares[1], 0);
  }
}

TEST(CliStats, ShadowsThatEndKeepLess) {
  const std::vector<std::string> arguments{"stats", "--shafts", "200", "--shadow"};
  EXPECT_GT(shares_in(output_of(with(arguments, {"--reach", "1.25"})), "shadow")[0],
            shares_in(output_of(arguments), "shadow")[0]);
}

TEST(CliStats, CountWhatOnlyTouchesIfContactIsOpen) {
  const std::vector<std::string> arguments{"stats", "--shafts", "200", "--lattice", "40", "--contact"};
  const std::vector<double> closed = shares_in(output_of(with(arguments, {"closed"})), "between");
  const std::vector<double> open = shares_in(output_of(with(arguments, {"open"})), "between");
  EXPECT_EQ(closed[1], 0);
  EXPECT_GT(open[1], 1);
  EXPECT_NEAR(open[0] * (1 - open[1] / 100), closed[0], 0.2) << "what touches is all that contact changes";
}

TEST(CliStats, TestTrianglesInCubesByVerticesAndExactly) {
  const std::vector<std::string> arguments{"stats", "--shafts", "50", "--triangles"};
  for (const std::vector<std::string>& kind : {std::vector<std::string>{}, std::vector<std::string>{"--shadow"},
                                               std::vector<std::string>{"--swept", "0.5,0,0"},
                                               std::vector<std::string>{"--contact", "open", "--lattice", "20"}}) {
    SCOPED_TRACE(testing::PrintToString(kind));
    const std::string text = output_of(with(arguments, kind));
    const std::string name = kind.empty() || kind[0] == "--contact" ? "between" : kind[0].substr(2);
    EXPECT_THAT(text, HasSubstr("9,261 triangles in cubes of half extent 0.125"));
    const std::vector<double> by_vertices = shares_in(text, name + ", by vertices");
    const std::vector<double> exact = shares_in(text, name + ", exact");
    ASSERT_THAT(by_vertices, SizeIs(4));
    ASSERT_THAT(exact, SizeIs(4));
    for (const std::vector<double>& shares : {by_vertices, exact}) {
      EXPECT_NEAR(shares[0] + shares[2] + shares[3], 100, 0.2);
      EXPECT_GT(shares[2], 1);
    }
    EXPECT_GT(exact[0], by_vertices[0] + 0.5) << "boxes around slanted triangles meet more than these";
    EXPECT_EQ(exact[3], by_vertices[3]);
    EXPECT_GT(exact[3], 1);
  }
}

TEST(CliStats, OfTrianglesThatArePointsSayTheSameByBothTests) {
  const std::string text = output_of({"stats", "--shafts", "50", "--triangles", "--box-radius", "0"});
  const std::vector<double> by_vertices = shares_in(text, "between, by vertices");
  EXPECT_EQ(by_vertices, shares_in(text, "between, exact"));
  EXPECT_EQ(by_vertices[2], 0) << "a point is inside or outside";
}

TEST(CliStats, CountTrianglesThatOnlyTouchIfContactIsOpen) {
  const std::vector<std::string> arguments{"stats", "--shafts", "50", "--triangles", "--lattice", "10", "--contact"};
  const std::string closed = output_of(with(arguments, {"closed"}));
  const std::string open = output_of(with(arguments, {"open"}));
  for (const char* const row : {"between, by vertices", "between, exact"}) {
    const std::vector<double> of_closed = shares_in(closed, row);
    const std::vector<double> of_open = shares_in(open, row);
    EXPECT_EQ(of_closed[1], 0);
    EXPECT_GT(of_open[1], 1);
    EXPECT_NEAR(of_open[0] * (1 - of_open[1] / 100), of_closed[0], 0.2) << "what touches is all that contact changes";
  }
}

/// What the table of --solid says: of cubes that block, then of shafts that are occluded, the number and percentage by
/// any cube, and by cubes around no end alone.
struct Blocking {
  std::vector<double> cubes;
  std::vector<double> shafts;
};

Blocking blocking_in(const std::vector<std::string>& options) {
  std::string text = output_of(with({"stats", "--shafts", "200", "--solid"}, options));
  std::erase(text, ',');
  return {shares_in(text, "cubes that block"), shares_in(text, "shafts that are occluded")};
}

TEST(CliStats, CountHowOftenCubesBlock) {
  const Blocking small = blocking_in({"--box-radius", "0.1"});
  const Blocking large = blocking_in({"--box-radius", "0.3"});
  for (const Blocking& blocking : {small, large}) {
    ASSERT_THAT(blocking.cubes, SizeIs(4));
    ASSERT_THAT(blocking.shafts, SizeIs(4));
    EXPECT_GE(blocking.cubes[0], blocking.shafts[0]) << "a shaft is occluded by one cube at least";
    EXPECT_GT(blocking.cubes[0], blocking.cubes[2]);
    EXPECT_GE(blocking.shafts[0], blocking.shafts[2]);
    EXPECT_GT(blocking.shafts[2], 0);
    EXPECT_NEAR(blocking.shafts[1], blocking.shafts[0] / 2, 0.06) << "of 200 shafts";
    EXPECT_NEAR(blocking.cubes[1], blocking.cubes[0] / (200.0 * 9261) * 100, 0.06);
  }
  EXPECT_GT(large.shafts[0], small.shafts[0]);
  EXPECT_GT(large.cubes[0], small.cubes[0]);
}

TEST(CliStats, CountNoBlockingByPointsAndAllByWhatIsAroundEverything) {
  EXPECT_EQ(blocking_in({"--box-radius", "0"}).shafts[0], 0);
  const Blocking all = blocking_in({"--box-radius", "10"});
  EXPECT_EQ(all.cubes[0], 200.0 * 9261);
  EXPECT_EQ(all.shafts[0], 200);
  EXPECT_EQ(all.shafts[2], 0) << "every cube is around an end";
}

TEST(CliStats, CountTheSameBlockingWhateverTheContact) {
  const Blocking closed = blocking_in({"--lattice", "20"});
  const Blocking open = blocking_in({"--lattice", "20", "--contact", "open"});
  EXPECT_EQ(closed.cubes, open.cubes);
  EXPECT_EQ(closed.shafts, open.shafts);
}

TEST(CliStats, RefuseToAskWhatHasNoAnswer) {
  EXPECT_THAT(refusal_of({"stats", "--solid", "--swept", "1,0,0"}), AllOf(HasSubstr("--solid"), HasSubstr("--swept")));
  EXPECT_THAT(refusal_of({"stats", "--solid", "--shadow"}), AllOf(HasSubstr("--solid"), HasSubstr("--shadow")));
  EXPECT_THAT(refusal_of({"stats", "--solid", "--triangles"}), AllOf(HasSubstr("--solid"), HasSubstr("--triangles")));
  EXPECT_THAT(refusal_of({"stats", "--triangles", "exact"}), HasSubstr("exact"));
  EXPECT_THAT(output_of({"stats", "--help"}), AllOf(HasSubstr("--solid"), HasSubstr("--triangles")));
  EXPECT_THAT(output_of({"stats", "--shafts", "1", "--lattice", "9"}), Not(HasSubstr("block")));
}

}  // namespace
}  // namespace shaftcull::test
