// SPDX-License-Identifier: MIT
/// `shaftcull factors` of mesh files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/program.hpp"

namespace shaftcull::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class CliFactors : public testing::Test {
 protected:
  /// A cube of which floor, ceiling and walls look inwards: each side a quadrilateral, each an object.
  [[nodiscard]] std::string cube() const {
    return folder_.write("cube.obj",
                         "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                         "o floor\nf 1 2 3 4\no ceiling\nf 5 8 7 6\no south\nf 1 5 6 2\no north\nf 4 3 7 8\n"
                         "o west\nf 1 4 8 5\no east\nf 2 6 7 3\n");
  }

  [[nodiscard]] nlohmann::json report(const std::vector<std::string>& more) const {
    return nlohmann::json::parse(output_of(with({"factors", cube(), "--format", "json"}, more)));
  }

  /// Factors of a CSV file, by the pair of its patches.
  [[nodiscard]] static std::map<std::pair<int, int>, double> factors_in(const std::string& csv) {
    const std::vector<std::string> rows = lines(csv);
    EXPECT_EQ(rows.front(), "from,to,factor");
    std::map<std::pair<int, int>, double> factors;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const std::vector<double> numbers = numbers_in(rows[i]);
      if (numbers.size() != 3) continue;
      factors[{static_cast<int>(numbers[0]), static_cast<int>(numbers[1])}] = numbers[2];
    }
    return factors;
  }

  ScratchFolder folder_;
};

TEST_F(CliFactors, OfACubeAreThePublishedOnes) {
  const nlohmann::json whole = report({"--objects"});
  EXPECT_EQ(whole["patches"], 6);
  EXPECT_EQ(whole["objects"], 6);
  EXPECT_EQ(whole["pairs"]["clear"], 15);
  EXPECT_EQ(whole["factors"], 30);
  EXPECT_NEAR(whole["area"], 6, 1e-9);
  EXPECT_NEAR(whole["largest_row_sum"], 1, 1e-6);
  EXPECT_NEAR(whole["mean_sky"], 0, 1e-6);
  ASSERT_EQ(whole["object_factors"].size(), 30U);
  for (const nlohmann::json& pair : whole["object_factors"]) {
    const bool are_opposite = pair["from"].get<std::string>() + pair["to"].get<std::string>() == "floorceiling";
    if (are_opposite) {
      EXPECT_NEAR(pair["factor"], 0.199825, 1e-6);
    }
  }
}

TEST_F(CliFactors, CutFacetsIntoPieces) {
  EXPECT_EQ(report({"--patches", "0.5"})["patches"], 24);
  EXPECT_EQ(report({"--patches", "0.51"})["patches"], 24);
  EXPECT_EQ(report({"--patches", "1"})["patches"], 6);
  const nlohmann::json pieces = report({"--patches", "0.25"});
  EXPECT_EQ(pieces["patches"], 96);
  EXPECT_NEAR(pieces["largest_row_sum"], 1, 1e-6);
  // A triangle is no quadrilateral, and two that are not flat together are none either.
  const std::string bent = folder_.write("bent.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nf 1 2 3\nf 1 3 4\n");
  EXPECT_THAT(output_of({"factors", bent}), HasSubstr("2 triangles, 2 patches"));
  const std::string dented = folder_.write("dented.obj", "v 0 0 0\nv 2 0 0\nv 0.1 0.1 0\nv 0 2 0\nf 1 2 3\nf 1 3 4\n");
  EXPECT_THAT(output_of({"factors", dented}), HasSubstr("2 triangles, 2 patches"));
}

TEST_F(CliFactors, AreWrittenAsLines) {
  const std::string out = folder_.path("factors.csv");
  static_cast<void>(output_of({"factors", cube(), "--out", out}));
  const std::map<std::pair<int, int>, double> factors = factors_in(bytes_of_file(out));
  EXPECT_EQ(factors.size(), 30U);
  EXPECT_NEAR(factors.at({0, 1}), 0.199825, 1e-6);
  EXPECT_NEAR(factors.at({0, 2}), 0.200044, 1e-6);
  const Outcome both = run_program({"factors", cube(), "--out", "-"});
  EXPECT_EQ(both.exit_code, 0);
  EXPECT_EQ(factors_in(both.out), factors);
  EXPECT_THAT(both.error, HasSubstr("30 factors above 0"));
}

TEST_F(CliFactors, TellOfEachPatch) {
  const std::vector<std::string> rows = lines(output_of({"factors", cube(), "--format", "csv"}));
  ASSERT_GE(rows.size(), 7U);
  EXPECT_EQ(rows[0], "patch,object,triangle,area,row_sum,sky,error,left_out");
  EXPECT_THAT(rows[1], HasSubstr("0,floor,0,1,"));
  // Without a ceiling the floor sees a fifth of the sky.
  const std::string open = folder_.write(
      "open.obj",
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "o floor\nf 1 2 3 4\no south\nf 1 5 6 2\no north\nf 4 3 7 8\no west\nf 1 4 8 5\no east\nf 2 6 7 3\n");
  const std::vector<double> floor = numbers_in(lines(output_of({"factors", open, "--format", "csv"}))[1]);
  ASSERT_GE(floor.size(), 5U);
  EXPECT_NEAR(floor[4], 0.199825, 1e-5);
}

TEST_F(CliFactors, LeaveOutSmallOnesAndSaySo) {
  const nlohmann::json all = report({"--patches", "0.25"});
  const nlohmann::json some = report({"--patches", "0.25", "--min", "0.01"});
  EXPECT_LT(some["factors"], all["factors"]);
  EXPECT_GT(some["largest_left_out"], 0.01);
  EXPECT_EQ(all["largest_left_out"], 0);
  EXPECT_EQ(some["largest_row_sum"], all["largest_row_sum"]);
}

TEST_F(CliFactors, OfAClosedRoomCanBeClosed) {
  EXPECT_NEAR(report({"--close", "--patches", "0.5"})["largest_row_sum"], 1, 1e-9);
  EXPECT_THAT(refusal_of({"factors", "--rooms", "1", "--close"}), HasSubstr("rows cannot be closed: "));
}

TEST_F(CliFactors, AreDrawn) {
  const std::string svg = folder_.path("sky.svg");
  const std::string ply = folder_.path("sky.ply");
  static_cast<void>(output_of({"factors", cube(), "--svg", svg, "--ply", ply}));
  EXPECT_THAT(bytes_of_file(svg), AllOf(HasSubstr("<svg"), HasSubstr("Sky view factors"), HasSubstr("</svg>")));
  EXPECT_THAT(bytes_of_file(ply), AllOf(HasSubstr("element vertex 24\n"), HasSubstr("element face 6\n"),
                                        HasSubstr("property float sky"), HasSubstr("comment object 0 floor")));
}

TEST_F(CliFactors, OfRoomsAreTheSameForAnyNumberOfThreads) {
  const auto factors_with = [&](const std::string& threads) {
    return output_of({"factors", "--rooms", "1", "--patches", "1.5", "--format", "csv", "--threads", threads});
  };
  const std::string one = factors_with("1");
  EXPECT_EQ(factors_with("2"), one);
  EXPECT_GT(lines(one).size(), 50U);
}

TEST_F(CliFactors, SayWhereNormalsSeemToPointTheWrongWay) {
  const Outcome outwards = run_program({"factors", cube(), "--flip"});
  EXPECT_THAT(outwards.error, AllOf(HasSubstr("100.0 % of the pairs face away."), HasSubstr("leave out --flip")));
  EXPECT_THAT(outwards.out, HasSubstr("0 factors above 0"));
  EXPECT_EQ(run_program({"factors", cube()}).error, "");
}

TEST_F(CliFactors, RefuseWhatTheyCannotDo) {
  EXPECT_THAT(refusal_of({"factors"}), HasSubstr("no file is given"));
  EXPECT_THAT(refusal_of({"factors", cube(), "--rooms", "1"}), HasSubstr("do not go together"));
  EXPECT_THAT(refusal_of({"factors", cube(), "--out", folder_.path("a.txt")}), HasSubstr("ends in .npz or .csv"));
  EXPECT_THAT(refusal_of({"factors", cube(), "--out", folder_.path("a.csv"), "--svg", folder_.path("a.csv")}),
              HasSubstr("give two files"));
  EXPECT_THAT(refusal_of({"factors", cube(), "--up", "z"}), HasSubstr("--svg"));
  EXPECT_THAT(refusal_of({"factors", cube(), "--objects", "--min", "0.1"}), HasSubstr("--min"));
  EXPECT_THAT(refusal_of({"factors", cube(), "--patches", "0.0001"}), HasSubstr("more than"));
  EXPECT_THAT(refusal_of({"factors", folder_.path("none.obj")}), HasSubstr("none.obj"));
  EXPECT_EQ(files_in(folder_.path("")), 1U) << "no file was written";
}

}  // namespace
}  // namespace shaftcull::test
