// SPDX-License-Identifier: MIT
/// `shaftcull sees`, from outside: counts, files and refusals. Its scene is made by the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cli/program.hpp"

namespace shaftcull::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using Json = nlohmann::json;

TEST(CliSees, KindsOfPairsAddUpToAll) {
  const Json report = Json::parse(output_of(report_of_one_room));
  const Json& pairs = report["pairs"];
  const std::uint64_t patches = report["patches"];
  EXPECT_EQ(pairs["all"], patches * (patches - 1) / 2);
  std::uint64_t sum = 0;
  for (const char* kind : {"clear", "occluded", "facing_away", "undecided"}) {
    EXPECT_GT(pairs[kind], 0) << kind;
    sum += pairs[kind].get<std::uint64_t>();
  }
  EXPECT_EQ(pairs["all"], sum);
  EXPECT_FALSE(pairs.contains("rays_visible"));
  EXPECT_EQ(report["objects"], 8);  // a floor, four walls, three pieces of furniture
  EXPECT_EQ(report["solids"], 5);
}

TEST(CliSees, RaysTellOfUndecidedPairsHowMuchIsSeen) {
  const Json without = Json::parse(output_of(report_of_one_room))["pairs"];
  const Json pairs = Json::parse(output_of(with(report_of_one_room, {"--rays", "9"})))["pairs"];
  for (const char* kind : {"clear", "occluded", "facing_away", "undecided", "all"}) {
    EXPECT_EQ(pairs[kind], without[kind]) << kind;
  }
  std::uint64_t sum = 0;
  for (const char* kind : {"rays_visible", "rays_partly", "rays_hidden"}) {
    EXPECT_GT(pairs[kind], 0) << kind;
    sum += pairs[kind].get<std::uint64_t>();
  }
  EXPECT_EQ(pairs["undecided"], sum);
}

TEST(CliSees, TableAndCsvHaveTheNumbersOfJson) {
  const Json pairs = Json::parse(output_of(with(report_of_one_room, {"--rays", "4"})))["pairs"];
  std::vector<std::string> arguments = with(report_of_one_room, {"--rays", "4"});
  arguments[9] = "csv";
  const std::vector<std::string> csv = lines(output_of(arguments));
  EXPECT_EQ(csv[0], "kind,pairs,share");
  for (std::size_t i = 1; i < csv.size(); ++i) {
    const std::string kind = csv[i].substr(0, csv[i].find(','));
    EXPECT_THAT(csv[i], testing::StartsWith(kind + ',' + std::to_string(pairs[kind].get<std::uint64_t>()) + ','));
  }
  EXPECT_THAT(csv, testing::SizeIs(8));
  arguments[9] = "text";
  std::string table = output_of(arguments);
  std::erase(table, ',');
  EXPECT_EQ(words_after(table, "occluded").at(0), std::to_string(pairs["occluded"].get<std::uint64_t>()));
  EXPECT_EQ(words_after(table, "  rays: partly").at(0), std::to_string(pairs["rays_partly"].get<std::uint64_t>()));
  EXPECT_THAT(table, AllOf(HasSubstr("1 room: 8 objects"), HasSubstr("pairs/s"), HasSubstr("MB of memory")));
}

TEST(CliSees, CsvFileHasEachPairOnceAndTheCountsThatArePrinted) {
  const ScratchFolder folder;
  const std::string path = folder.path("sights.csv");
  const Json report = Json::parse(output_of(with(report_of_one_room, {"--rays", "4", "--out", path})));
  const std::vector<std::string> rows = lines(bytes_of_file(path));
  ASSERT_EQ(rows[0], "a,b,sight,seen");
  std::map<std::string, std::uint64_t> counts;
  std::set<std::pair<int, int>> pairs;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    std::istringstream row(rows[i]);
    std::string cell[4];
    for (std::string& each : cell) std::getline(row, each, ',');
    pairs.insert(std::minmax(std::stoi(cell[0]), std::stoi(cell[1])));
    ++counts[cell[2]];
    if (cell[2] != "undecided") {
      EXPECT_EQ(cell[3], "");
      continue;
    }
    ++counts[cell[3] == "0" ? "rays_hidden" : cell[3] == "4" ? "rays_visible" : "rays_partly"];
  }
  counts["all"] = rows.size() - 1;
  EXPECT_EQ(Json(counts), report["pairs"]);
  EXPECT_EQ(pairs.size(), rows.size() - 1);
  EXPECT_LT(pairs.rbegin()->second, report["patches"].get<int>());
}

TEST(CliSees, FilesAreTheSameForAnyNumberOfThreadsAndInstructionSet) {
  const ScratchFolder folder;
  const auto file = [&](const std::string& name, const std::vector<std::string>& more) {
    static_cast<void>(output_of(with(with(report_of_one_room, {"--rays", "4", "--out", folder.path(name)}), more)));
    return bytes_of_file(folder.path(name));
  };
  const std::string one = file("one.csv", {"--threads", "1"});
  EXPECT_EQ(one, file("many.csv", {"--threads", "0", "--isa", "scalar"}));
  EXPECT_NE(one, file("other.csv", {"--seed", "2"}));
  EXPECT_EQ(file("one.npz", {"--candidates", "--threads", "1"}), file("many.npz", {"--candidates", "--threads", "0"}));
}

TEST(CliSees, FilesAreTheSameWhateverMemoryAnswersMayTake) {
  const ScratchFolder folder;
  const auto file = [&](const std::string& name, const char* megabytes) {
    static_cast<void>(output_of({"sees", "--rooms", "1", "--patches", "0.9", "--solid", "wall*", "--out",
                                 folder.path(name), "--memory", megabytes}));
    return bytes_of_file(folder.path(name));
  };
  for (const std::string kind : {".npz", ".csv"}) {
    EXPECT_TRUE(file("little" + kind, "1") == file("much" + kind, "256")) << kind;
  }
}

TEST(CliSees, FilesHaveCandidatesOnlyIfAskedFor) {
  const ScratchFolder folder;
  const std::string path = folder.path("sights.npz");
  for (const std::vector<std::string>& rays : std::vector<std::vector<std::string>>{{}, {"--rays", "2"}}) {
    static_cast<void>(output_of(with(with(report_of_one_room, rays), {"--out", path})));
    EXPECT_THAT(bytes_of_file(path), AllOf(HasSubstr("undecided.npy"), testing::Not(HasSubstr("candidate"))));
    static_cast<void>(output_of(with(with(report_of_one_room, rays), {"--out", path, "--candidates"})));
    EXPECT_THAT(bytes_of_file(path), AllOf(HasSubstr("first_candidate.npy"), HasSubstr("candidates.npy")));
  }
  EXPECT_THAT(refusal_of(with(report_of_one_room, {"--out", folder.path("sights.csv"), "--candidates"})),
              HasSubstr("a CSV file has no candidates; give an .npz file"));
  static_cast<void>(refusal_of(with(report_of_one_room, {"--candidates"})));
}

TEST(CliSees, ALargeFileIsAnnounced) {
  const ScratchFolder folder;
  const std::string path = folder.path("sights.npz");
  const std::vector<std::string> arguments{"sees", "--rooms", "3", "--patches", "0.8", "--out", path, "--candidates"};
  const Outcome outcome = run_program(arguments);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const std::vector<std::string> said = lines(outcome.error);
  ASSERT_THAT(said,
              testing::Contains(testing::MatchesRegex("This will take about .* s, and write .* MB to .*sights.npz")));
  const double megabytes = std::stod(said[1].substr(said[1].find("write ") + 6));
  EXPECT_NEAR(megabytes * 1e6 / static_cast<double>(std::filesystem::file_size(path)), 1, 0.3);

  EXPECT_THAT(run_program(with(report_of_one_room, {"--out", path})).error, testing::Not(HasSubstr("This will take")));
}

TEST(CliSees, PictureShowsPatchesFromAbove) {
  const ScratchFolder folder;
  const auto picture = [&](const std::string& up) {
    const std::string path = folder.path(up + ".svg");
    static_cast<void>(output_of(with(report_of_one_room, {"--svg", path, "--up", up})));
    return bytes_of_file(path);
  };
  const std::string from_above = picture("z");
  EXPECT_THAT(from_above, AllOf(testing::StartsWith("<svg "), HasSubstr("x to the right, y up</title>"),
                                HasSubstr("<path color=\"#"), testing::EndsWith("</svg>\n")));
  EXPECT_THAT(picture("y"), HasSubstr("z to the right, x up</title>"));
}

TEST(CliSees, PictureShowsUndecidedPairsApart) {
  const auto picture = [&](const std::vector<std::string>& more) {
    const Outcome outcome = run_program(with(with(report_of_one_room, {"--svg", "-"}), more));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    return outcome.out;
  };
  EXPECT_THAT(picture({}), AllOf(HasSubstr("% proven to be seen<"), HasSubstr("% undecided<")));
  EXPECT_THAT(picture({"--rays", "2"}),
              AllOf(HasSubstr("% of the other patches are seen<"), testing::Not(HasSubstr("undecided"))));
}

TEST(CliSees, ObjectsAddUpToAllPairs) {
  const std::vector<std::string> arguments = with(report_of_one_room, {"--objects", "--rays", "3"});
  const Json report = Json::parse(output_of(arguments));
  const Json& pairs = report["pairs"];
  std::map<std::string, std::uint64_t> sums;
  std::set<std::pair<std::string, std::string>> objects;
  for (const Json& entry : report["object_pairs"]) {
    objects.insert(std::minmax(entry["a"].get<std::string>(), entry["b"].get<std::string>()));
    std::uint64_t all = 0;
    for (const char* kind : {"clear", "occluded", "facing_away", "undecided"}) {
      sums[kind] += entry[kind].get<std::uint64_t>();
      all += entry[kind].get<std::uint64_t>();
    }
    EXPECT_EQ(entry["pairs"], all);
    EXPECT_LE(entry["rays_seen"], 1);
  }
  for (const auto& [kind, sum] : sums) EXPECT_EQ(pairs[kind], sum) << kind;
  EXPECT_EQ(objects.size(), 8 * 9 / 2);

  std::vector<std::string> other = arguments;
  other[9] = "csv";
  const std::vector<std::string> csv = lines(output_of(other));
  EXPECT_EQ(csv[0], "a,b,pairs,clear,occluded,facing_away,undecided,rays_seen");
  EXPECT_EQ(csv.size(), 1 + objects.size());
  other[9] = "text";
  EXPECT_THAT(output_of(other), AllOf(HasSubstr("pairs of objects"), HasSubstr("wall 1 - wall 2")));
  EXPECT_FALSE(Json::parse(output_of(report_of_one_room)).contains("object_pairs"));
}

TEST(CliSees, ThePageHasThePictureThatItsCommandMakes) {
  const std::string docs = SHAFTCULL_DOCS;
  const std::string page = bytes_of_file(docs + "/program.md");
  const std::size_t begin = page.find("    shaftcull sees --rooms 6 ");
  ASSERT_NE(begin, std::string::npos);
  const std::string command = page.substr(begin, page.find('\n', begin) - begin);
  std::istringstream words(command);
  std::vector<std::string> arguments;
  std::string word;
  for (words >> word; words >> word;) {
    std::erase(word, '\'');
    arguments.push_back(word);
  }
  ASSERT_EQ(arguments.back(), "docs/sees.svg");
  const ScratchFolder folder;
  arguments.back() = folder.path("sees.svg");
  static_cast<void>(output_of(arguments));
  EXPECT_EQ(bytes_of_file(arguments.back()), bytes_of_file(docs + "/sees.svg"));
}

TEST(CliSees, CoordinatesOfPicturesAreShort) {
  const ScratchFolder folder;
  static_cast<void>(output_of(with(report_of_one_room, {"--svg", folder.path("room.svg")})));
  const std::string svg = bytes_of_file(folder.path("room.svg"));
  for (std::size_t at = svg.find('.'); at != std::string::npos; at = svg.find('.', at + 1)) {
    const std::size_t end = svg.find_first_not_of("0123456789", at + 1);
    EXPECT_LE(end - at - 1, 3) << svg.substr(at - 9, 40);
  }
}

TEST(CliSees, AsksForAFile) {
  EXPECT_THAT(refusal_of({"sees"}), AllOf(HasSubstr("no file is given"), HasSubstr("--rooms 6")));
  for (const std::vector<std::string>& both : std::vector<std::vector<std::string>>{
           {"sees", "room.obj", "--rooms", "2"}, {"sees", "--rooms", "2", "--scene", "room.obj"}}) {
    EXPECT_THAT(refusal_of(both), AllOf(HasSubstr("sees: the file room.obj and --rooms 2 do not go together; give one"),
                                        testing::Not(HasSubstr("--scene"))));
  }
}

TEST(CliSees, PatchesHaveASizeAboveZero) {
  for (const char* size : {"0", "-1", "-inf"}) {
    EXPECT_THAT(refusal_of({"sees", "--rooms", "1", "--patches", size}),
                HasSubstr(std::string("--patches ") + size + ": too small"));
  }
  EXPECT_THAT(refusal_of({"sees", "--rooms", "1", "--patches", "nan"}), HasSubstr("--patches nan: not a number"));
  EXPECT_THAT(refusal_of({"sees", "--rooms", "1", "--patches", "small"}), HasSubstr("not a number"));
}

TEST(CliSees, TooManyPatchesAreRefused) {
  EXPECT_THAT(refusal_of({"sees", "--rooms", "1", "--patches", "1e-4"}),
              HasSubstr("--patches 0.0001: there would be more than 4,000,000 patches"));
  EXPECT_THAT(refusal_of({"sees", "--rooms", "6", "--patches", "0.5", "--out", "sights.csv"}),
              AllOf(HasSubstr("--out sights.csv: "), HasSubstr("a CSV file may have at most 100,000,000")));
}

TEST(CliSees, ObjectsThatAreNotThereAreNamed) {
  EXPECT_THAT(refusal_of({"sees", "--rooms", "1", "--solid", "walls"}),
              AllOf(HasSubstr("--solid 'walls': there is no object of that name in 1 room"), HasSubstr("'wall 1'")));
  static_cast<void>(refusal_of({"sees", "--rooms", "1", "--solid", "wall*", "door*"}));
}

TEST(CliSees, ObjectsThatCannotBeSolidAreSkipped) {
  const std::vector<std::string> room{"sees", "--rooms", "1", "--patches", "1.5", "--solid"};
  EXPECT_THAT(output_of(with(room, {"floor", "wall 1"})),
              AllOf(HasSubstr("1 named as solid\n"),
                    HasSubstr("--solid: skipped 1 object that cannot be solid; the first is 'floor': it is not "
                              "closed: an edge has one triangle, or more than two\n")));
  const Json skipped = Json::parse(output_of(with(room, {"floor", "wall 1", "--format", "json"})));
  EXPECT_EQ(skipped["solids"], 1);
  EXPECT_EQ(skipped["solids_skipped"], 1);
}

TEST(CliSees, SolidsHaveAnyNumberOfCorners) {
  const std::vector<std::string> room{"sees", "--rooms", "1", "--patches", "1.5", "--no-solids"};
  const std::string ball = output_of(with(room, {"--solid", "ball 1"}));
  EXPECT_THAT(ball, AllOf(HasSubstr("1 named as solid\n"), testing::Not(HasSubstr("skipped"))));
}

TEST(CliSees, SolidsAreFoundUnlessTheyAreNotWanted) {
  const std::vector<std::string> room{"sees", "--rooms", "1", "--patches", "1.5", "--format", "json"};
  const Json found = Json::parse(output_of(room));
  EXPECT_EQ(found["solids"], 0);
  EXPECT_GE(found["found"]["hulls"], 5);  // walls and the cupboard at least
  const Json none = Json::parse(output_of(with(room, {"--no-solids"})));
  EXPECT_EQ(none["found"], (Json{{"hulls", 0}, {"polygons", 0}, {"inner_boxes", 0}}));
  EXPECT_EQ(none["pairs"]["occluded"], 0);
  EXPECT_GT(found["pairs"]["occluded"], 0);
  EXPECT_LT(found["pairs"]["undecided"], none["pairs"]["undecided"]);
  // Patches at the foot of a wall that face each other within the wall: its box stands between them.
  const Json named = Json::parse(output_of(with(room, {"--no-solids", "--solid", "wall*", "cupboard*"})));
  EXPECT_GE(found["pairs"]["clear"], named["pairs"]["clear"]);
  EXPECT_LE(found["pairs"]["clear"], none["pairs"]["clear"]);
  EXPECT_THAT(output_of({"sees", "--rooms", "1", "--patches", "1.5"}), HasSubstr("solids found: "));
  // Sheets that are seen from both sides have no inside.
  EXPECT_EQ(Json::parse(output_of(with(room, {"--two-sided"})))["found"]["hulls"], 0);
}

TEST(CliSees, FilesThatCannotBeMadeAreRefused) {
  const ScratchFolder folder;
  EXPECT_THAT(refusal_of(with(report_of_one_room, {"--svg", "a.svg", "--ply", "a.svg"})),
              HasSubstr("--svg a.svg --ply a.svg: one file cannot be both; give two files"));
  for (const std::string& name : {folder.path("none/sights.npz"), folder.path("none/sights.csv")}) {
    EXPECT_THAT(refusal_of(with(report_of_one_room, {"--out", name})),
                HasSubstr(name + ": cannot be written: No such file"));
  }
  EXPECT_THAT(refusal_of(with(report_of_one_room, {"--svg", folder.path("none/a.svg")})),
              HasSubstr("cannot be written"));
  EXPECT_THAT(refusal_of(with(report_of_one_room, {"--out", folder.path("sights.txt")})),
              HasSubstr("give a name that ends in .npz or .csv"));
  std::filesystem::create_directory(folder.path("folder.npz"));
  EXPECT_THAT(refusal_of(with(report_of_one_room, {"--out", folder.path("folder.npz")})),
              HasSubstr("it is a directory"));
  EXPECT_EQ(files_in(folder.path("")), 1);
}

}  // namespace
}  // namespace shaftcull::test
