// SPDX-License-Identifier: MIT
/// What `draw` shows beside the shaft: triangles, and boxes that are flat, from outside; and the pictures of
/// docs/volumes.md.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "cli/program.hpp"

namespace shaftcull::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

/// From x = 0 to x = 10, a unit wide and high.
const std::vector<std::string> bar{"draw", "--from", "0,0,0,1,1,1", "--to", "9,0,0,10,1,1"};

/// The colour that the last polygon of a picture is filled with.
std::string fill_of_last_polygon(const std::string& svg) {
  return attribute(svg.substr(svg.rfind("<polygon")), "<polygon", "fill");
}

TEST(CliDrawTriangle, HasTheAnswerOfTheExactTest) {
  const std::string text = output_of(with(bar, {"--triangle", "4,0.2,0.5", "6,0.2,0.5", "5,0.8,0.6",  //
                                                "--triangle", "4,-3,0.5", "6,-3,0.5", "5,5,0.6",      //
                                                "--triangle", "3,0.9,0.5", "3,2,-2", "3,2,3",         //
                                                "--triangle", "-1,0.5,0.5", "-1,2.5,0.5", "1,2.5,0.5"}));
  EXPECT_THAT(text, AllOf(HasSubstr("triangle [4,0.2,0.5 6,0.2,0.5 5,0.8,0.6]: inside\n"),
                          HasSubstr("triangle [4,-3,0.5 6,-3,0.5 5,5,0.6]: overlap\n"),
                          HasSubstr("triangle [3,0.9,0.5 3,2,-2 3,2,3]: overlap\n"),
                          HasSubstr("triangle [-1,0.5,0.5 -1,2.5,0.5 1,2.5,0.5]: outside\n")));
  EXPECT_THAT(output_of(with(bar, {"--bound", "-1,0.5,0.5,1,2.5,0.5"})), HasSubstr("[-1,0.5,0.5,1,2.5,0.5]: overlap\n"))
      << "the box around the last triangle meets the shaft";
}

TEST(CliDrawTriangle, IsOutsideIfItOnlyTouchesAndContactIsOpen) {
  const std::vector<std::string> arguments = with(bar, {"--triangle", "4,1,0", "6,1,0", "5,1,1"});
  EXPECT_THAT(output_of(arguments), HasSubstr("]: inside\n")) << "it lies in a face, which is part of the shaft";
  EXPECT_THAT(output_of(with(arguments, {"--contact", "open"})), HasSubstr("]: outside\n"));
  EXPECT_THAT(output_of(with(bar, {"--contact", "open", "--triangle", "4,0,0", "6,0,0", "5,1,1"})),
              HasSubstr("]: inside\n"));
}

TEST(CliDrawTriangle, HasAnswersOfEveryKindButHulls) {
  const std::vector<std::string> triangle{"--triangle", "5,0.2,0.5", "6,0.2,0.5", "5,0.8,0.5"};
  for (const std::vector<std::string>& kind :
       {std::vector<std::string>{"--swept", "9,0,0"}, std::vector<std::string>{"--swept", "9,0,0", "--infinite"},
        std::vector<std::string>{"--shadow", "--to", "2,0,0,3,1,1"}}) {
    EXPECT_THAT(output_of(with(with({"draw"}, kind), triangle)), HasSubstr("5,0.8,0.5]: inside\n"));
  }
  const std::vector<std::string> wedge{"draw", "--hull", "0,0,0", "9,0,0", "0,9,0", "0,0,2", "9,0,2", "0,9,2"};
  EXPECT_THAT(output_of(with(wedge, triangle)), HasSubstr("5,0.8,0.5]: inside\n"));
  EXPECT_THAT(output_of(with(wedge, {"--triangle", "6,6,1", "7,6,1", "6,4,1"})), HasSubstr("6,4,1]: outside\n"))
      << "its box meets the wedge";
}

/// The rows of cells of a slice, from above.
std::vector<std::string> cells_of(const std::string& text, const std::string& slice) {
  std::vector<std::string> rows;
  bool found = false;
  for (const std::string& line : lines(text)) {
    if (line.starts_with(slice)) {
      found = true;
    } else if (found && line.find_first_not_of("AaBb@Tt#+.", 9) != std::string::npos) {
      break;
    } else if (found) {
      rows.push_back(line.substr(9));
    }
  }
  return rows;
}

TEST(CliDrawTriangle, IsSeenInEachSlice) {
  // Upright at x = 5, which is the middle: the slice there shows all of it, and others cut it along a line.
  const std::string text = output_of(
      with(bar, {"--size", "44", "--triangle", "5,-2,0.5", "5,3,0.5", "5,0.5,4", "--bound", "0,0,-3,1,1,-3"}));
  const std::vector<std::string> at_x = cells_of(text, "yz slice at x = 5 ");
  ASSERT_THAT(at_x, Not(IsEmpty()));
  const auto count = [](const std::vector<std::string>& rows, char mark) {
    std::ptrdiff_t sum = 0;
    for (const std::string& row : rows) sum += std::count(row.begin(), row.end(), mark);
    return sum;
  };
  EXPECT_EQ(count(at_x, 't'), 0);
  EXPECT_GT(count(at_x, 'T'), 60);
  const std::vector<std::string> at_y = cells_of(text, "xz slice at y = 0.5 ");
  ASSERT_THAT(at_y, Not(IsEmpty()));
  EXPECT_EQ(count(at_y, 't'), 0) << "the cut is as high as the triangle";
  EXPECT_GE(count(at_y, 'T'), 7);
  const std::vector<std::string> at_z = cells_of(text, "xy slice at z = 0.5 ");
  ASSERT_THAT(at_z, Not(IsEmpty()));
  EXPECT_GE(count(at_z, 'T'), 10) << "an edge is in the slice";
  EXPECT_THAT(text, HasSubstr("T triangle (t: before or behind it)"));
  EXPECT_THAT(output_of(bar), Not(HasSubstr("triangle")));
}

TEST(CliDrawTriangle, IsMarkedSmallWhereTheSliceMissesIt) {
  const std::string text = output_of(with(bar, {"--triangle", "3,3,3", "6,3,3", "4,5,3", "--bound", "0,0,-2,1,1,-2"}));
  const std::vector<std::string> at_z = cells_of(text, "xy slice at z = 0.5 ");
  ASSERT_THAT(at_z, Not(IsEmpty()));
  EXPECT_TRUE(
      std::any_of(at_z.begin(), at_z.end(), [](const std::string& row) { return row.find("ttt") != row.npos; }));
  EXPECT_TRUE(std::none_of(at_z.begin(), at_z.end(), [](const std::string& row) { return row.find('T') != row.npos; }));
}

TEST(CliDrawTriangle, IsInThePictureInTheColourOfItsAnswer) {
  const auto seen = [](const std::vector<std::string>& corners) {
    return output_of(with(with(bar, {"--svg", "--triangle"}), corners));
  };
  // 66 pixels are a unit.
  const std::string inside = seen({"4,0.25,0.5", "6,0.25,0.5", "5,0.75,0.5"});
  EXPECT_THAT(inside, AllOf(HasSubstr("<polygon points=\"294,79.5 426,79.5 360,46.5\""), HasSubstr(">inside</text>")));
  const std::string overlap = seen({"4,-1,0.5", "6,-1,0.5", "5,2,0.5"});
  EXPECT_THAT(overlap, HasSubstr(">overlap</text>"));
  const std::string outside = seen({"4,2,0.5", "6,2,0.5", "5,4,0.5"});
  EXPECT_THAT(outside, HasSubstr(">outside</text>"));
  EXPECT_NE(fill_of_last_polygon(inside), fill_of_last_polygon(overlap));
  EXPECT_NE(fill_of_last_polygon(overlap), fill_of_last_polygon(outside));
  EXPECT_GT(numbers_in(attribute(outside, "<svg", "viewBox"))[3], numbers_in(attribute(inside, "<svg", "viewBox"))[3])
      << "the frame holds triangles";
}

TEST(CliDrawTriangle, MayBeASegmentOrAPoint) {
  for (const std::vector<std::string>& corners : {std::vector<std::string>{"4,0.5,0.5", "6,0.5,0.5", "6,0.5,0.5"},
                                                  std::vector<std::string>{"5,0.5,0.5", "5,0.5,0.5", "5,0.5,0.5"}}) {
    EXPECT_THAT(output_of(with(with(bar, {"--triangle"}), corners)), AllOf(HasSubstr("]: inside\n"), HasSubstr("T")));
    EXPECT_THAT(output_of(with(with(bar, {"--svg", "--triangle"}), corners)),
                AllOf(HasSubstr(">inside</text>"), Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
  }
}

TEST(CliDrawTriangle, IsRefusedIfItHasNotThreeCorners) {
  EXPECT_THAT(refusal_of({"draw", "--triangle", "0,0,0", "3,0,0"}),
              HasSubstr("--triangle 0,0,0 3,0,0: 2 corners; a triangle takes three: X,Y,Z X,Y,Z X,Y,Z"));
  EXPECT_THAT(refusal_of({"draw", "--triangle", "0,0,0", "3,0,0", "1,1,1", "--triangle", "2,2,2"}),
              HasSubstr("4 corners; a triangle takes three"));
  EXPECT_THAT(refusal_of({"draw", "--triangle", "0,0,0", "3,0", "1,1,1"}),
              HasSubstr("--triangle 3,0: 2 numbers; a corner takes three numbers: x,y,z"));
  EXPECT_THAT(refusal_of({"draw", "--triangle", "0,0,0", "3,0,0", "1,inf,1"}),
              HasSubstr("--triangle 1,inf,1: y is inf; give finite numbers"));
  EXPECT_THAT(refusal_of({"draw", "--triangle", "0,0,0", "3,0,0", "1,up,1"}), HasSubstr("'up' is not a number"));
}

TEST(CliDrawFlat, BoxesAreLinesAndDots) {
  const std::vector<std::string> flat{"draw",          "--svg",   "--from",      "0,0,0,0,2,1", "--to",
                                      "10,1,0,10,1,1", "--bound", "4,3,0,6,3,1", "--bound",     "2,4,0,3,5,1"};
  const std::string svg = output_of(flat);
  // 66 pixels are a unit, and y = 5 is at the upper edge.
  EXPECT_THAT(svg, HasSubstr("<path d=\"M30,228 L30,360\"")) << "A is upright";
  EXPECT_THAT(svg, HasSubstr("<path d=\"M294,162 L426,162\"")) << "the first bound lies";
  EXPECT_THAT(attribute(svg, "<circle", "cx") + ' ' + attribute(svg, "<circle", "cy"), "690 294") << "B is a point";
  for (const char* const size : {" width=\"0\"", " height=\"0\""}) {
    EXPECT_THAT(svg, Not(HasSubstr(size))) << "SVG does not draw such rectangles";
  }
  EXPECT_THAT(svg, HasSubstr("<rect x=\"162\" y=\"30\" width=\"66\" height=\"66\""));
}

TEST(CliDrawFlat, PatchesAreNotHiddenByTheWallsThatTheyLieOn) {
  const std::string svg = output_of({"draw", "--svg", "--from", "0,0,0,0,2,1", "--to", "10,0,0,10,2,1", "--contact",
                                     "open", "--bound", "-1,-1,0,0,3,1"});
  EXPECT_THAT(svg, AllOf(HasSubstr("with open contact"), HasSubstr(">outside</text>")));
  const std::size_t patch = svg.find("stroke-width=\"5\"");
  ASSERT_NE(patch, std::string::npos);
  EXPECT_GT(patch, svg.find(">outside</text>")) << "what comes later is drawn over it";
}

std::string file_content(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The commands of a page that make pictures, with what they are written to.
struct PictureCommand {
  std::vector<std::string> arguments;
  std::string file;
};

std::vector<PictureCommand> picture_commands(const std::string& page) {
  const std::string joined = std::regex_replace(page, std::regex(R"(\\\n)"), " ");
  std::vector<PictureCommand> commands;
  for (const std::string& line : lines(joined)) {
    if (!line.starts_with("    shaftcull draw --svg")) continue;
    std::istringstream words(line);
    PictureCommand command;
    std::string word;
    words >> word;
    while (words >> word && word != ">") command.arguments.push_back(word);
    words >> command.file;
    commands.push_back(command);
  }
  return commands;
}

TEST(KindsPage, HasThePicturesThatItsCommandsMake) {
  const std::string docs = SHAFTCULL_DOCS;
  const std::string page = file_content(docs + "/volumes.md");
  const std::vector<PictureCommand> commands = picture_commands(page);
  EXPECT_THAT(commands, SizeIs(9));
  for (const PictureCommand& command : commands) {
    SCOPED_TRACE(command.file);
    ASSERT_THAT(command.file, testing::StartsWith("docs/volumes/"));
    const std::string name = command.file.substr(std::string("docs/").size());
    EXPECT_THAT(page, HasSubstr("](" + name + ")"));
    EXPECT_EQ(output_of(command.arguments), file_content(docs + "/" + name));
  }
}

}  // namespace
}  // namespace shaftcull::test
