// SPDX-License-Identifier: MIT
/// `shaftcull sun` of mesh files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "cli/program.hpp"

namespace shaftcull::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CliSun : public testing::Test {
 protected:
  /// A floor of 10 by 10 that faces up, and in the middle of it a thin wall, 2 high, from south to north.
  [[nodiscard]] std::string yard() const {
    return folder_.write("yard.obj",
                         "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 5 0 0\nv 5 10 0\nv 5 10 2\nv 5 0 2\n"
                         "o floor\nf 1 2 3 4\no wall\nf 5 6 7 8\no back\nf 5 8 7 6\n");
  }
  [[nodiscard]] std::string plain() const {
    return folder_.write("plain.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\no floor\nf 1 2 3 4\n");
  }

  [[nodiscard]] static nlohmann::json report(const std::vector<std::string>& more) {
    return nlohmann::json::parse(output_of(with({"sun", "--format", "json"}, more)));
  }

  ScratchFolder folder_;
};

// Of a day at a latitude φ with declination δ, cos(half of the daylight's angle) = −tan φ tan δ.
TEST_F(CliSun, ShinesAsLongAsTheDayIsOnAnOpenFloor) {
  const auto daylight = [&](const std::string& latitude, const std::string& day) -> double {
    return report({plain(), "--latitude", latitude, "--day", day, "--every", "1"})["mean_hours"];
  };
  constexpr double degree = std::numbers::pi / 180;
  const double longest = 2 * std::acos(-std::tan(48.1 * degree) * std::tan(23.44 * degree)) / degree / 15;
  EXPECT_NEAR(daylight("48.1", "06-21"), longest, 0.05);
  EXPECT_NEAR(daylight("-48.1", "06-21"), 24 - longest, 0.05);
  EXPECT_NEAR(daylight("48.1", "12-21"), 24 - longest, 0.05);
  EXPECT_NEAR(daylight("48.1", "3-21"), 12, 0.05);
  EXPECT_NEAR(daylight("0", "08-13"), 12, 0.05);
  EXPECT_EQ(daylight("80", "06-21"), 24);
  // Steps are cut at the horizon: so the day is as long by any step.
  const nlohmann::json coarse = report({plain(), "--latitude", "48.1", "--day", "06-21", "--every", "100"});
  EXPECT_NEAR(coarse["daylight"], longest, 0.05);
  EXPECT_THAT(output_of({"sun", plain(), "--latitude", "48.1", "--day", "06-21", "--every", "100", "--rays", "1"}),
              AllOf(HasSubstr("every 102.9 min"), HasSubstr("at most 16 rays per")));
  EXPECT_EQ(daylight("-80", "06-21"), 0);
}

TEST_F(CliSun, IsHighestAtNoonAndMovesFromEastToWest) {
  const std::string out = folder_.path("sun.npz");
  static_cast<void>(output_of({"sun", plain(), "--latitude", "48.1", "--day", "03-21", "--every", "60", "--out", out}));
  // A wall that faces east has sun in the morning; one that faces south on the northern half, as long as the day is.
  const auto hours_of = [&](const std::string& corners, const std::string& up) -> double {
    const std::string file = folder_.write("wall.obj", corners + "f 1 2 3 4\n");
    return report({file, "--latitude", "48.1", "--day", "03-21", "--every", "1", "--up", up})["mean_hours"];
  };
  EXPECT_NEAR(hours_of("v 0 0 0\nv 0 1 0\nv 0 1 1\nv 0 0 1\n", "z"), 6, 0.05);  // faces +x: east
  EXPECT_NEAR(hours_of("v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\n", "z"), 12, 0.1);  // faces −y: south
  EXPECT_NEAR(hours_of("v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\n", "z"), 0, 0.1);   // faces +y: north
  EXPECT_NEAR(hours_of("v 0 0 0\nv 0 1 0\nv 0 1 1\nv 0 0 1\n", "y"), 6, 0.05);  // faces +x: east
  EXPECT_NEAR(hours_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n", "y"), 12, 0.1);  // faces +z: south
  EXPECT_NEAR(hours_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n", "x"), 0, 0.1);   // faces +z: north
  EXPECT_NEAR(hours_of("v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\n", "x"), 6, 0.05);  // faces +y: east
}

TEST_F(CliSun, IsHiddenByAWall) {
  // From above all is lit; from the west at 45 degrees the wall's shadow is 2 wide, of 10; from the east likewise.
  const std::string sun = folder_.write("sun.csv", "# x,y,z,hours\n0,0,1,4\r\n\n-1,0,1,2\n1, 0, 1\n0,0,-1,8\n");
  const nlohmann::json whole = report({yard(), "--directions", sun, "--objects", "--rays", "4096"});
  EXPECT_EQ(whole["positions"], 4);
  EXPECT_EQ(whole["daylight"], 15);
  EXPECT_EQ(whole["patches"], 3);
  EXPECT_EQ(whole["never_lit"], 0);
  ASSERT_EQ(whole["object_hours"].size(), 3U);
  EXPECT_EQ(whole["object_hours"][0]["object"], "floor");
  EXPECT_EQ(whole["object_hours"][0]["area"], 100);
  EXPECT_NEAR(whole["object_hours"][0]["hours"], 4 + 0.8 * 3, 0.01);
  EXPECT_NEAR(whole["object_hours"][1]["hours"].get<double>() + whole["object_hours"][2]["hours"].get<double>(), 3,
              1e-6);
  EXPECT_NEAR(whole["mean_hours"], (100 * 6.4 + 20 * 2 + 20 * 1) / 140, 0.01);
  EXPECT_NEAR(whole["most_hours"], 6.4, 0.01);
  // Pieces next to the wall have less of it than others.
  const std::vector<std::string> rows =
      lines(output_of({"sun", yard(), "--directions", sun, "--patches", "1", "--format", "csv"}));
  EXPECT_EQ(rows[0], "patch,object,triangle,area,hours,error");
  EXPECT_EQ(rows.size(), 1 + 100U + 2 * 20U);
  EXPECT_EQ(rows[1], "0,floor,0,1,7,0");
  EXPECT_EQ(rows[1 + 4], "4,floor,0,1,6,0");
  EXPECT_EQ(rows[1 + 5], "5,floor,0,1,5,0");
  // Turned round, only what shines from below is left to the floor.
  const nlohmann::json turned = report({yard(), "--directions", sun, "--flip", "--objects"});
  EXPECT_EQ(turned["object_hours"][0]["hours"], 8);
}

TEST_F(CliSun, TellsAnErrorThatIsHonest) {
  // A fifth of the floor lies in the shadow of each of 40 suns; rays find the fifth with an error.
  std::string suns;
  for (int i = 0; i != 40; ++i) suns += i % 2 == 0 ? "-1,0,1,2\n" : "1,0,1,2\n";
  const std::string sun = folder_.write("suns.csv", suns);
  for (const char* rays : {"16", "64", "1024"}) {
    const std::vector<std::string> rows =
        lines(output_of({"sun", yard(), "--directions", sun, "--rays", rays, "--format", "csv"}));
    const auto cell = [&](std::size_t i) { return std::stod(rows[1].substr(rows[1].find_last_of(',', i) + 1)); };
    const double error = cell(std::string::npos);
    const double hours = cell(rows[1].find_last_of(',') - 1);
    // √40 suns × 2 h × √(0.8 × 0.2 / rays), of rays at random
    EXPECT_NEAR(error, std::sqrt(40.0) * 2 * std::sqrt(0.16 / std::stod(rays)), 0.05 * error) << rays;
    EXPECT_LE(std::abs(hours - 64), 3 * error) << rays;
    EXPECT_NE(hours, 64);
  }
  // With an error to stop at, fewer rays are cast, and the error is that one at most.
  const nlohmann::json whole = report({yard(), "--directions", sun, "--rays", "4096", "--error", "0.05"});
  EXPECT_NEAR(whole["largest_error"], std::sqrt(40.0) * 2 * 0.05, 1e-6);
  EXPECT_LT(report({yard(), "--directions", sun, "--rays", "4096"})["largest_error"], 0.1);
}

TEST_F(CliSun, IsTheSameForAnyNumberOfThreads) {
  const std::vector<std::string> asked{"sun",   "--rooms", "1",       "--patches", "1",        "--latitude", "30",
                                       "--day", "9-1",     "--every", "90",        "--format", "csv"};
  const std::string one = output_of(with(asked, {"--threads", "1"}));
  EXPECT_EQ(output_of(with(asked, {"--threads", "2"})), one);
  EXPECT_EQ(output_of(with(asked, {"--isa", "scalar"})), one);
  EXPECT_NE(output_of(with(asked, {"--rays", "16", "--seed", "7"})), one);
}

TEST_F(CliSun, IsDrawnAndWrittenForNumPy) {
  const std::string sun = folder_.write("sun.csv", "-1,0,1,2\n");
  const std::string svg = folder_.path("sun.svg");
  const std::string ply = folder_.path("sun.ply");
  const std::string out = folder_.path("sun.npz");
  const std::string text =
      output_of({"sun", yard(), "--directions", sun, "--patches", "1", "--svg", svg, "--ply", ply, "--out", out});
  EXPECT_THAT(text, AllOf(HasSubstr("3 objects, 6 triangles, 140 patches of at most 1"),
                          HasSubstr("1 position, 2.00 h"), HasSubstr("of 140 patches are never lit")));
  EXPECT_THAT(bytes_of_file(svg), AllOf(HasSubstr("Hours of sun"), HasSubstr("of 2.00 h of sun"), HasSubstr("</svg>")));
  const std::string mesh = bytes_of_file(ply);
  EXPECT_THAT(mesh, AllOf(HasSubstr("element face 140"), HasSubstr("property float sun"), HasSubstr(" 0 2\n"),
                          HasSubstr(" 0 0\n")));
  const std::string arrays = bytes_of_file(out);
  for (const char* name : {"hours.npy", "lit.npy", "directions.npy", "direction_hours.npy", "area.npy", "normals.npy",
                           "patch_corners.npy", "first_corner.npy", "patch_objects.npy", "patch_triangles.npy"}) {
    EXPECT_THAT(arrays, HasSubstr(name));
  }
  EXPECT_THAT(arrays, HasSubstr("'shape': (140, 1)"));
  const Outcome drawn = run_program({"sun", yard(), "--directions", sun, "--svg", "-"});
  EXPECT_EQ(drawn.exit_code, 0);
  EXPECT_THAT(drawn.out, AllOf(HasSubstr("</svg>"), Not(HasSubstr("thread"))));
  EXPECT_THAT(drawn.error, HasSubstr("most sun: "));
}

TEST_F(CliSun, RefusesWhatItCannotDo) {
  const std::string file = plain();
  EXPECT_THAT(refusal_of({"sun"}), HasSubstr("no file is given"));
  EXPECT_THAT(refusal_of({"sun", file}), HasSubstr("no position of the sun is given"));
  EXPECT_THAT(refusal_of({"sun", file, "--latitude", "48"}), HasSubstr("--day"));
  EXPECT_THAT(refusal_of({"sun", file, "--day", "06-21"}), HasSubstr("--latitude"));
  for (const char* day : {"", "6", "13-01", "2-29", "0-1", "1-0", "06-21-", "x-y", "06-", "-6"}) {
    EXPECT_THAT(refusal_of({"sun", file, "--latitude", "48", "--day=" + std::string(day)}), HasSubstr("--day")) << day;
  }
  EXPECT_THAT(refusal_of({"sun", file, "--latitude", "91", "--day", "6-1"}), HasSubstr("91"));
  EXPECT_THAT(refusal_of({"sun", file, "--latitude", "1", "--day", "6-1", "--every", "0"}), HasSubstr("--every"));
  EXPECT_THAT(refusal_of({"sun", file, "--directions", folder_.path("none.csv")}), HasSubstr("cannot be read"));
  for (const char* line :
       {"1,2", "1,2,3,4,5", "0,0,0", "1,2,3,-1", "a,b,c", "1,2,inf", "nan,0,1", "1,,2", "1e31,0,0", "x,y,z"}) {
    const std::string bad = folder_.write("bad.csv", "0,0,1\n" + std::string(line) + "\n");
    EXPECT_THAT(refusal_of({"sun", file, "--directions", bad}), AllOf(HasSubstr("line 2"), HasSubstr(line)));
  }
  EXPECT_THAT(refusal_of({"sun", file, "--directions", folder_.write("empty.csv", "# none\n\n")}),
              HasSubstr("the file has no line x,y,z"));
  const std::string sun = folder_.write("sun.csv", "\xEF\xBB\xBFx,y,z\n0,0,1\n");
  EXPECT_EQ(report({file, "--directions", sun})["mean_hours"], 1);
  EXPECT_THAT(refusal_of({"sun", file, "--directions", sun, "--svg", sun}), HasSubstr("would be replaced"));
  EXPECT_THAT(refusal_of({"sun", file, "--directions", sun, "--ply", file}), HasSubstr("would be replaced"));
  EXPECT_THAT(refusal_of({"factors", file, "--svg", file}), HasSubstr("would be replaced"));
  EXPECT_THAT(refusal_of({"sun", file, "--directions", sun, "--out", "x.csv"}), HasSubstr(".npz"));
  EXPECT_THAT(refusal_of({"sun", file, "--directions", sun, "--svg", "a", "--ply", "a"}), HasSubstr("give two files"));
  EXPECT_THAT(refusal_of({"sun", file, "--directions", sun, "--day", "6-1", "--latitude", "1"}),
              HasSubstr("--directions"));
}

}  // namespace
}  // namespace shaftcull::test
