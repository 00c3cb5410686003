// SPDX-License-Identifier: MIT
/// `shaftcull cull` of files of one object, whose parts are ends of shafts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "cli/cull_scene.hpp"

namespace shaftcull::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

/// A wavy sheet of 2 × 16 × 16 triangles, all in one object.
class CliCullParts : public testing::Test {
 protected:
  static std::string sheet() {
    std::ostringstream obj;
    obj << "o sheet\n";
    for (int y = 0; y <= 16; ++y) {
      for (int x = 0; x <= 16; ++x) obj << "v " << x << ' ' << y << ' ' << (x * y) % 5 << '\n';
    }
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        const int corner = 17 * y + x + 1;
        obj << "f " << corner << ' ' << corner + 1 << ' ' << corner + 18 << '\n';
        obj << "f " << corner << ' ' << corner + 18 << ' ' << corner + 17 << '\n';
      }
    }
    return obj.str();
  }

  [[nodiscard]] nlohmann::json report(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"cull", path_});
    arguments.insert(arguments.end(), {"--format", "json"});
    const Outcome outcome = run_program(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    return nlohmann::json::parse(outcome.out);
  }

  ScratchFolder folder_;
  std::string path_ = folder_.write("sheet.obj", sheet());
};

TEST_F(CliCullParts, AreTheEndsOfRandomPairsInAFileOfOneObject) {
  const auto result = report({"--random", "50"});
  EXPECT_EQ(result["objects"], 1);
  EXPECT_EQ(result["bounds"], "part");
  EXPECT_EQ(result["count"], 64);  // of eight triangles each
  ASSERT_THAT(result["pairs"], SizeIs(50));
  std::size_t candidates = 0;
  for (const auto& pair : result["pairs"]) {
    EXPECT_EQ(pair["from"]["object"], "sheet");
    EXPECT_NE(pair["from"]["part"], pair["to"]["part"]);
    for (const auto& candidate : pair["candidates"]) {
      EXPECT_NE(candidate["part"], pair["from"]["part"]);
      EXPECT_NE(candidate["part"], pair["to"]["part"]);
    }
    candidates += pair["candidates"].size();
  }
  EXPECT_GT(candidates, 50U);
}

TEST_F(CliCullParts, LeaveOutNoTriangleButTheirOwn) {
  // The two ends as boxes hold nothing, so what they list beyond the parts are the triangles of both parts.
  const auto of_parts = report({"--random", "5", "--bounds", "triangle"});
  EXPECT_EQ(of_parts["count"], 512);
  for (const auto& pair : of_parts["pairs"]) {
    const auto box_text = [](const nlohmann::json& box) {
      std::string text;
      for (const char* corner : {"lo", "hi"}) {
        for (const auto& x : box[corner]) text += (text.empty() ? "" : ",") + x.dump();
      }
      return text;
    };
    const auto of_boxes =
        report({"--bounds", "triangle", "--from", box_text(pair["from"]["box"]), "--to", box_text(pair["to"]["box"])});
    EXPECT_EQ(of_boxes["pairs"][0]["candidates"].size(), pair["candidates"].size() + 16);
  }
}

TEST_F(CliCullParts, AreNamedWhereEndsAreMissing) {
  const Outcome outcome = run_program({"cull", path_});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.error, HasSubstr("its object is 'sheet', with parts such as 'sheet part 1'"));
}

TEST_F(CliCullParts, CanBeNamed) {
  const auto random = report({"--random", "1"})["pairs"][0];
  const auto name = [](const nlohmann::json& end) { return "sheet part " + end["part"].dump(); };
  const auto named = report({"--from", name(random["from"]), "--to", name(random["to"])})["pairs"][0];
  EXPECT_EQ(named, random);
}

TEST_F(CliCullParts, AreWrittenInEveryFormat) {
  const Outcome text = run_program({"cull", path_, "--random", "1"});
  EXPECT_THAT(text.out, AllOf(HasSubstr("1 object, 64 part bounds"), HasSubstr(" -> sheet part ")));
  const Outcome csv = run_program({"cull", path_, "--random", "1", "--format", "csv"});
  EXPECT_EQ(lines(csv.out).front(), "pair,from,to,object,part,answer,lo_x,lo_y,lo_z,hi_x,hi_y,hi_z");
}

TEST_F(CliCullParts, AnswerTheSameWithATree) {
  const std::vector<std::string> arguments{"cull", path_, "--random", "20"};
  std::vector<std::string> with_tree = arguments;
  with_tree.emplace_back("--tree");
  EXPECT_EQ(run_program(arguments).out, run_program(with_tree).out);
}

TEST_F(CliCullParts, StandBackWhereObjectsAreManyUnlessAskedFor) {
  const std::string path =
      folder_.write("four.obj", obj_of({{"a", 0, 0, 1}, {"b", 5, 0, 1}, {"c", 10, 0, 1}, {"d", 15, 0, 1}}));
  EXPECT_THAT(run_program({"cull", path, "--random", "1"}).out, Not(HasSubstr("part")));
  EXPECT_THAT(run_program({"cull", path, "--random", "1", "--ends", "part"}).out, HasSubstr("part"));
  EXPECT_THAT(run_program({"cull", path_, "--random", "1", "--ends", "object"}).error,
              AllOf(HasSubstr("only one object"), HasSubstr("'sheet'")));
}

TEST_F(CliCullParts, NeedTwoTriangles) {
  const std::string path = folder_.write("one.obj", "o only\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Outcome outcome = run_program({"cull", path, "--random", "1"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.error, AllOf(HasSubstr("only one triangle"), HasSubstr("'only'")));
}

}  // namespace
}  // namespace shaftcull::test
