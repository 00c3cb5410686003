// SPDX-License-Identifier: MIT
/// Answers of `shaftcull cull`, from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/cull_scene.hpp"

namespace shaftcull::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

TEST_F(CliCull, ListsWhatLiesBetweenAsText) {
  const Outcome outcome = cull({"--from", "left", "--to", "right"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr("left -> right: 2 objects may lie between (1 inside, 1 overlap)"));
  EXPECT_THAT(outcome.out, HasSubstr("overlap  middle  [3,-2,-2,7,2,2]"));
  EXPECT_THAT(outcome.out, HasSubstr("inside   small  [4.5,-0.5,-0.5,5.5,0.5,0.5]"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("aside")));
}

TEST_F(CliCull, SaysWhatBlocksIfBoundsAreSolid) {
  const Outcome text = cull({"--from", "left", "--to", "right", "--solid"});
  ASSERT_EQ(text.exit_code, 0) << text.error;
  EXPECT_THAT(text.out, HasSubstr("2 objects may lie between (1 inside, 1 overlap), 1 of them blocks\n"));
  EXPECT_THAT(text.out, HasSubstr("blocks   middle  [3,-2,-2,7,2,2]"));
  EXPECT_THAT(text.out, HasSubstr("inside   small"));
  EXPECT_THAT(cull({"--from", "left", "--to", "aside", "--solid"}).out, HasSubstr(", none of them blocks\n"));

  const Outcome json = cull({"--from", "left", "--to", "right", "--solid", "--tree", "--format", "json"});
  ASSERT_EQ(json.exit_code, 0) << json.error;
  const auto pair = nlohmann::json::parse(json.out)["pairs"][0];
  EXPECT_EQ(pair["occluded"], true);
  EXPECT_EQ(pair["candidates"][0]["answer"], "blocks");
  EXPECT_EQ(pair["candidates"][1]["answer"], "inside");
  const Outcome csv = cull({"--from", "left", "--to", "right", "--solid", "--format", "csv"});
  EXPECT_THAT(csv.out, HasSubstr("0,left,right,middle,,blocks,3,-2,-2,7,2,2"));
}

TEST_F(CliCull, LeavesOutWhatOnlyTouchesIfContactIsOpen) {
  const std::string shelf = folder_.write(
      "shelf.obj", obj_of({{"left", 0, 0, 1}, {"right", 10, 0, 1}, {"between", 5, 0, 1}, {"below", 5, -2, 1}}));
  for (const bool tree : {false, true}) {
    std::vector<std::string> arguments = {"cull", shelf, "--from", "left", "--to", "right", "--contact", "closed"};
    if (tree) arguments.emplace_back("--tree");
    EXPECT_THAT(run_program(arguments).out, AllOf(HasSubstr("2 objects may lie between"), HasSubstr("below")));
    arguments[7] = "open";
    const Outcome open = run_program(arguments);
    ASSERT_EQ(open.exit_code, 0) << open.error;
    EXPECT_THAT(open.out, AllOf(HasSubstr("1 object may lie between"), HasSubstr("between"), Not(HasSubstr("below"))));
  }
  expect_refusal(run_program({"cull", shelf, "--random", "2", "--contact", "half"}));
}

TEST_F(CliCull, ListsWhatABodyMayHitAndWhen) {
  const std::vector<std::string> arguments{"--from", "left", "--swept", "8,0,0", "--times", "--format"};
  const auto as = [&](const char* format) {
    auto with_format = arguments;
    with_format.emplace_back(format);
    Outcome outcome = cull(with_format);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    return outcome.out;
  };
  EXPECT_THAT(as("text"), AllOf(HasSubstr("left swept by 8,0,0: 3 objects may be hit (1 inside, 2 overlap)"),
                                HasSubstr("overlap  middle  [3,-2,-2,7,2,2]  from 0.25\n"),
                                HasSubstr("inside   small  [4.5,-0.5,-0.5,5.5,0.5,0.5]  from 0.4375\n"),
                                HasSubstr("overlap  right  [9,-1,-1,11,1,1]  from 1\n")));
  EXPECT_THAT(lines(as("csv")), ElementsAre("pair,from,to,object,triangle,answer,lo_x,lo_y,lo_z,hi_x,hi_y,hi_z,time",
                                            "0,left,,middle,,overlap,3,-2,-2,7,2,2,0.25",
                                            "0,left,,small,,inside,4.5,-0.5,-0.5,5.5,0.5,0.5,0.4375",
                                            "0,left,,right,,overlap,9,-1,-1,11,1,1,1"));
  const auto report = nlohmann::json::parse(as("json"));
  EXPECT_EQ(report["shaft"]["kind"], "swept");
  EXPECT_EQ(report["shaft"]["displacement"], nlohmann::json({8, 0, 0}));
  const auto& pair = report["pairs"][0];
  EXPECT_EQ(pair["from"]["object"], "left");
  EXPECT_FALSE(pair.contains("to"));
  EXPECT_EQ(pair["candidates"][1]["time"], 0.4375);
}

TEST_F(CliCull, ListsWhatABodyMayHitThatMovesWithoutEnd) {
  const Outcome outcome =
      cull({"--from", "left", "--swept", "0.5,0,0", "--infinite", "--times", "--format", "csv", "--tree"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("middle,,overlap,3,-2,-2,7,2,2,4\n"), HasSubstr("0.5,0.5,7\n"),
                                 HasSubstr("right,,inside,9,-1,-1,11,1,1,16\n"), Not(HasSubstr("aside"))));
}

TEST_F(CliCull, ListsOnlyWhatIsReachedFirst) {
  const std::vector<std::string> arguments{"--from", "right", "--swept", "-8,0,0", "--first"};
  EXPECT_THAT(cull(arguments).out,
              AllOf(HasSubstr("right swept by -8,0,0: 1 object is reached first (0 inside, 1 overlap)"),
                    HasSubstr("overlap  middle  [3,-2,-2,7,2,2]  from 0.25\n"), Not(HasSubstr("small  [")),
                    Not(HasSubstr("left  ["))));
  auto away = arguments;
  away[3] = "8,0,0";
  EXPECT_THAT(cull(away).out, HasSubstr("right swept by 8,0,0: nothing is reached"));
  // Both start in the large cube, and of equal times the first in the file counts.
  const Outcome csv = cull({"--from", "5,0,0,5,0,0", "--swept", "1,0,0", "--first", "--format", "csv"});
  EXPECT_THAT(lines(csv.out),
              ElementsAre(HasSubstr("hi_z,time"), "0,\"5,0,0,5,0,0\",,middle,,overlap,3,-2,-2,7,2,2,0"));
}

TEST_F(CliCull, ListsWhatLiesInAShadow) {
  const Outcome outcome = cull({"--from", "left", "--to", "middle", "--shadow", "--times"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("shadow of middle from left: 2 objects may lie in it (2 inside, 0 overlap)"),
                                 HasSubstr("inside   right  [9,-1,-1,11,1,1]  from 0.25\n"),
                                 HasSubstr("inside   small  [4.5,-0.5,-0.5,5.5,0.5,0.5]  from 0\n")));
  const Outcome near = cull({"--from", "left", "--to", "middle", "--shadow", "--reach", "1.125"});
  ASSERT_EQ(near.exit_code, 0) << near.error;
  EXPECT_THAT(near.out, AllOf(HasSubstr("small"), Not(HasSubstr("right"))));
}

TEST_F(CliCull, RefusesALightThatTouchesItsOccluder) {
  const Outcome outcome = cull({"--from", "middle", "--to", "small", "--shadow"});
  expect_refusal(outcome);
  EXPECT_THAT(outcome.error,
              HasSubstr("--shadow: light [3,-2,-2,7,2,2] and occluder [4.5,-0.5,-0.5,5.5,0.5,0.5] touch"));
}

TEST_F(CliCull, DrawsRandomLightsAndOccludersThatAreApart) {
  const Outcome outcome = cull({"--random", "50", "--shadow", "--format", "json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto report = nlohmann::json::parse(outcome.out);
  ASSERT_THAT(report["pairs"], SizeIs(50));
  for (const auto& pair : report["pairs"]) {
    EXPECT_FALSE(pair["from"]["object"] == "middle" && pair["to"]["object"] == "small") << "they touch";
    EXPECT_FALSE(pair["from"]["object"] == "small" && pair["to"]["object"] == "middle") << "they touch";
  }
  const std::string nested = folder_.write("nested.obj", obj_of({{"in", 0, 0, 1}, {"out", 0, 0, 2}}));
  const Outcome none = run_program({"cull", nested, "--random", "1", "--shadow", "--ends", "object"});
  expect_refusal(none);
  EXPECT_THAT(none.error, HasSubstr("no two objects of"));
}

TEST_F(CliCull, DrawsRandomBodies) {
  const Outcome outcome = cull({"--random", "6", "--swept", "8,0,0"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr(" swept by 8,0,0: "), Not(HasSubstr("->"))));
}

TEST_F(CliCull, ListsWhatLiesInAConvexHull) {
  const Outcome outcome = cull({"--hull", "4,-1,-1,6,1,1", "5,3,0", "--format", "json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["shaft"]["kind"], "hull");
  EXPECT_EQ(report["shaft"]["points"].size(), 9U);
  const auto& candidates = report["pairs"][0]["candidates"];
  ASSERT_THAT(candidates, SizeIs(2));
  EXPECT_EQ(candidates[0]["object"], "middle");
  EXPECT_EQ(candidates[1]["object"], "small");
  EXPECT_EQ(candidates[1]["answer"], "inside");
  EXPECT_THAT(cull({"--hull", "4,-1,-1,6,1,1", "5,3,0", "--towards", "0,1,0"}).out,
              AllOf(HasSubstr("convex hull of 9 points: 3 objects may lie in it"), HasSubstr("aside")));
}

TEST_F(CliCull, TestsTrianglesOrBoxesAroundThem) {
  const std::string path = folder_.write("slanted.obj",
                                         "o slanted\nv 5 3.4 -1\nv 5 -1 3.4\nv 6 3 3\nf 1 2 3\n"
                                         "o wall\nv 7 -9 -9\nv 7 9 -9\nv 7 0 30\nf 4 5 6\n"
                                         "o speck\nv 4 0 0\nv 4 0.5 0\nv 4 0 0.5\nf 7 8 9\n");
  const std::vector<std::string> ends{"cull", path, "--from", "-1,-1,-1,1,1,1", "--to", "9,-1,-1,11,1,1"};
  const auto of = [&](const std::vector<std::string>& more) {
    auto arguments = ends;
    arguments.insert(arguments.end(), more.begin(), more.end());
    Outcome outcome = run_program(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    arguments.emplace_back("--tree");
    EXPECT_EQ(run_program(arguments).out, outcome.out);
    return outcome.out;
  };
  EXPECT_THAT(of({"--bounds", "triangle"}), HasSubstr("3 triangles may lie between (1 inside, 2 overlap)"));
  EXPECT_THAT(of({"--triangles", "vertices"}), HasSubstr("overlap  slanted triangle 0"));
  const std::string exact = of({"--triangles", "exact", "--solid"});
  EXPECT_THAT(exact, AllOf(HasSubstr("2 triangles may lie between (1 inside, 1 overlap), 1 of them blocks"),
                           HasSubstr("blocks   wall triangle 0"), HasSubstr("inside   speck triangle 0"),
                           Not(HasSubstr("slanted triangle"))));
  const auto report = nlohmann::json::parse(of({"--triangles", "exact", "--format", "json"}));
  EXPECT_EQ(report["triangles"], "exact");
  EXPECT_EQ(report["pairs"][0]["candidates"].size(), 2U);
}

TEST_F(CliCull, LeavesOutTrianglesThatOnlyTouchIfContactIsOpen) {
  const std::string path = folder_.write("lid.obj",
                                         "o lid\nv 4 1 0\nv 6 1 0\nv 5 3 0\nf 1 2 3\n"
                                         "o fin\nv 4 0.5 0\nv 6 0.5 0\nv 5 3 0\nf 4 5 6\n"
                                         "o tip\nv 4 0.5 0\nv 6 0.5 0\nv 5 1 0\nf 7 8 9\n");
  const std::vector<std::string> arguments{"cull",           path,          "--from", "-1,-1,-1,1,1,1", "--to",
                                           "9,-1,-1,11,1,1", "--triangles", "exact",  "--contact"};
  auto closed = arguments;
  closed.emplace_back("closed");
  EXPECT_THAT(run_program(closed).out, AllOf(HasSubstr("lid triangle"), HasSubstr("fin triangle")));
  auto open = arguments;
  open.emplace_back("open");
  EXPECT_THAT(run_program(open).out, AllOf(Not(HasSubstr("lid triangle")), HasSubstr("overlap  fin triangle"),
                                           HasSubstr("inside   tip triangle")));
}

TEST_F(CliCull, ListsWhatLiesBetweenAsJson) {
  const Outcome outcome = cull({"--from", "left", "--to", "right", "--format", "json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["objects"], 5);
  ASSERT_THAT(report["pairs"], SizeIs(1));
  const auto& pair = report["pairs"][0];
  EXPECT_EQ(pair["from"]["object"], "left");
  EXPECT_EQ(pair["to"]["box"]["lo"], nlohmann::json({9, -1, -1}));
  ASSERT_THAT(pair["candidates"], SizeIs(2));
  EXPECT_EQ(pair["candidates"][0]["object"], "middle");
  EXPECT_EQ(pair["candidates"][0]["answer"], "overlap");
  EXPECT_EQ(pair["candidates"][1]["object"], "small");
  EXPECT_EQ(pair["candidates"][1]["answer"], "inside");
}

TEST_F(CliCull, ListsWhatLiesBetweenAsCsv) {
  const Outcome outcome = cull({"--from", "left", "--to", "right", "--format", "csv"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(lines(outcome.out), ElementsAre("pair,from,to,object,triangle,answer,lo_x,lo_y,lo_z,hi_x,hi_y,hi_z",
                                              "0,left,right,middle,,overlap,3,-2,-2,7,2,2",
                                              "0,left,right,small,,inside,4.5,-0.5,-0.5,5.5,0.5,0.5"));
}

TEST_F(CliCull, QuotesCommasAndQuotesInCsvAndJson) {
  const std::string path =
      folder_.write("quotes.obj", obj_of({{"a", 0, 0, 1}, {"say_\"b\",_twice", 5, 0, 1}, {"c", 10, 0, 1}}));
  const std::vector<std::string> arguments{"cull", "--scene", path, "--from", "a", "--to", "c", "--format"};
  auto csv = arguments;
  csv.emplace_back("csv");
  EXPECT_THAT(run_program(csv).out, HasSubstr("0,a,c,\"say_\"\"b\"\",_twice\",,inside,"));
  auto json = arguments;
  json.emplace_back("json");
  const auto report = nlohmann::json::parse(run_program(json).out);
  EXPECT_EQ(report["pairs"][0]["candidates"][0]["object"], "say_\"b\",_twice");
}

TEST_F(CliCull, ListsTriangles) {
  const Outcome outcome = cull({"--from", "left", "--to", "right", "--bounds", "triangle", "--format", "json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto report = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(report["count"], 5 * 12);
  int middle = 0;
  int small = 0;
  for (const auto& candidate : report["pairs"][0]["candidates"]) {
    EXPECT_TRUE(candidate["object"] == "middle" || candidate["object"] == "small") << candidate;
    ++(candidate["object"] == "small" ? small : middle);
    EXPECT_LT(candidate["triangle"], 12);
  }
  EXPECT_EQ(small, 12);
  // The shaft is the row itself, so of the large cube it only meets the two ends.
  EXPECT_EQ(middle, 4);
}

TEST_F(CliCull, TakesBoxesForEnds) {
  const Outcome outcome = cull({"--from", "-1,-1,-1,1,1,1", "--to", "4,8,-1,6,10,1", "--format", "csv"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr(",left,,inside,"));
  EXPECT_THAT(outcome.out, HasSubstr(",aside,,inside,"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("right")));
}

TEST_F(CliCull, ListsAFileInMapCoordinatesAsTheSameFileAtZero) {
  // Floats near these coordinates are 0.5 apart, so that the small cube would have sides of 1 or 1.5.
  constexpr double east = 4512345;
  const std::string map = folder_.write("map.obj", obj_of({{"left", east, 0, 1},
                                                           {"middle", east + 5, 0, 2},
                                                           {"small", east + 5, 0, 0.625},
                                                           {"right", east + 10, 0, 1},
                                                           {"aside", east + 5, 9, 1}}));
  const auto listed = [&](const std::vector<std::string>& more) {
    return output_of(with({"cull", map, "--format", "csv"}, more));
  };
  EXPECT_THAT(listed({"--from", "left", "--to", "right"}),
              AllOf(HasSubstr("small,,inside,4512349.375,-0.625,-0.625,4512350.625,0.625,0.625\n"),
                    HasSubstr("middle,,overlap,4512348,-2,-2,4512352,2,2\n"), Not(HasSubstr("aside"))));
  // Boxes and corners of the command line are in coordinates of the file. These end 1/32 before the small cube.
  EXPECT_THAT(listed({"--from", "4512343,-1,-1,4512344,1,1", "--to", "4512345,-1,-1,4512349.34375,1,1"}),
              AllOf(HasSubstr(",middle,"), Not(HasSubstr(",small,"))));
  EXPECT_THAT(listed({"--hull", "4512343,-1,-1,4512349.34375,1,1"}),
              AllOf(HasSubstr(",middle,"), Not(HasSubstr(",small,"))));
  EXPECT_THAT(listed({"--hull", "4512343,-1,-1,4512349.40625,1,1"}), HasSubstr(",small,"));
  const auto json =
      nlohmann::json::parse(output_of({"cull", map, "--from", "left", "--to", "right", "--format", "json"}));
  EXPECT_EQ(json["origin"], nlohmann::json({4512350, 4, 0}));
  EXPECT_EQ(json["pairs"][0]["from"]["box"]["hi"][0], 4512346);
  EXPECT_THAT(output_of({"cull", map, "--random", "1"}), HasSubstr("relative to 4512350, 4, 0"));
  EXPECT_THAT(listed({"--from", "left", "--to", "right", "--origin", "0,0,0"}),
              HasSubstr("small,,inside,4512349.5,-0.625"));
  EXPECT_THAT(refusal_of({"cull", map, "--random", "1", "--origin", "1,2,inf"}), HasSubstr("give finite numbers"));
  EXPECT_THAT(refusal_of({"cull", map, "--hull", "1e300,0,0", "1,1,1,2,2,2"}),
              HasSubstr("--hull 1e300,0,0: '1e300' is out of range for a float"));
  EXPECT_THAT(refusal_of({"cull", map, "--from", "1,1,1,1e300,2,2", "--to", "left"}),
              HasSubstr("--from 1,1,1,1e300,2,2, relative to 4512350,4,0: hi x is inf"));
}

TEST_F(CliCull, TakesAndPrintsDecimalsOfMapCoordinatesAsTheyAreInTheFile) {
  // The floor's 0.1 is rounded, and so is that of the ends which stand on it: they touch.
  const auto slab = [](const char* name, const char* lo, const char* hi, int first) {
    const std::string z[2] = {lo, hi};
    std::string obj = std::string("o ") + name + '\n';
    for (int v = 0; v != 3; ++v) {
      obj += "v " + std::string(v == 1 ? "4512355.38" : "4512345.38") + (v == 2 ? " 10" : " 0") + ' ' + z[v / 2] + '\n';
    }
    return obj + "f " + std::to_string(first) + ' ' + std::to_string(first + 1) + ' ' + std::to_string(first + 2) +
           '\n';
  };
  const std::string file = folder_.write("floor.obj", slab("floor", "0", "0.1", 1) + slab("lid", "3", "3.3", 4));
  const std::vector<std::string> ends{
      "cull", file, "--from", "4512346,1,0.1,4512347,2,1.1", "--to", "4512353,8,0.1,4512354,9,1.1", "--format", "csv"};
  EXPECT_THAT(output_of(ends), HasSubstr(",floor,,overlap,4512345.38,0,0,4512355.38,10,0.1\n"));
  EXPECT_THAT(output_of(with(ends, {"--contact", "open"})), Not(HasSubstr("floor")));
}

TEST_F(CliCull, DrawsTheSameRandomPairsForTheSameSeed) {
  const std::vector<std::string> arguments{"--random", "7", "--seed", "3", "--format", "json"};
  const Outcome first = cull(arguments);
  ASSERT_EQ(first.exit_code, 0) << first.error;
  EXPECT_EQ(first.out, cull(arguments).out);
  const auto report = nlohmann::json::parse(first.out);
  ASSERT_THAT(report["pairs"], SizeIs(7));
  for (const auto& pair : report["pairs"]) {
    EXPECT_NE(pair["from"]["object"], pair["to"]["object"]);
    for (const auto& candidate : pair["candidates"]) {
      EXPECT_NE(candidate["object"], pair["from"]["object"]);
      EXPECT_NE(candidate["object"], pair["to"]["object"]);
    }
  }
}

TEST_F(CliCull, AnswersAlikeOnEveryInstructionSetOfThisMachine) {
  const std::vector<std::string> arguments{"--random", "20", "--bounds", "triangle", "--format", "csv"};
  const Outcome best = cull(arguments);
  ASSERT_EQ(best.exit_code, 0) << best.error;
  auto scalar = arguments;
  scalar.insert(scalar.end(), {"--isa", "scalar"});
  EXPECT_EQ(best.out, cull(scalar).out);
}

TEST_F(CliCull, SaysTheSameWithATree) {
  for (const char* format : {"text", "json", "csv"}) {
    const std::vector<std::string> arguments = {"--random", "10", "--bounds", "triangle", "--format", format};
    std::vector<std::string> with_tree = arguments;
    with_tree.emplace_back("--tree");
    const Outcome scanned = cull(arguments);
    const Outcome outcome = cull(with_tree);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
    EXPECT_THAT(outcome.out, Not(IsEmpty()));
    EXPECT_EQ(outcome.out, scanned.out);
  }
}

}  // namespace
}  // namespace shaftcull::test
