// SPDX-License-Identifier: MIT
/// Which shaft the command line asks for, as `draw` shows it, from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "cli/program.hpp"

namespace shaftcull::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

struct SeenRegion {
  double width;
  double height;
  std::vector<double> corners;  ///< x, y, x, y, …

  /// Whether some corner is where the picture ends, left, right, above or below.
  [[nodiscard]] bool is_cut_off() const {
    for (std::size_t i = 0; i < corners.size(); i += 2) {
      const double x = corners[i];
      const double y = corners[i + 1];
      if (x < 0.2 || x > width - 0.2 || y < 0.2 || y > height - 0.2) return true;
    }
    return false;
  }
};

SeenRegion region_in(const std::string& svg) {
  const std::vector<double> box = numbers_in(attribute(svg, "<svg", "viewBox"));
  EXPECT_THAT(box, SizeIs(4));
  return {box[2], box[3], numbers_in(attribute(svg, "<polygon", "points"))};
}

const std::vector<std::string> shadow{"draw", "--from", "0,2,0,1,4,1", "--to", "4,2,0,5,4,1", "--shadow"};

TEST(CliDraw, TellsOfEachKindWhatItIs) {
  EXPECT_THAT(output_of({"draw", "--swept", "3,1,0"}),
              AllOf(HasSubstr("body A = [0,0,0,1,1,1]\nends at B = [3,1,0,4,2,1]\nSwept by 3,1,0. A B boxes"),
                    HasSubstr("AAA"), HasSubstr("BBB"), HasSubstr("###")));
  EXPECT_THAT(output_of({"draw", "--swept", "3,1,0", "--infinite"}),
              AllOf(HasSubstr("Swept without end along 3,1,0. A box"), HasSubstr("AAA"), Not(HasSubstr("BBB"))));
  EXPECT_THAT(output_of(shadow), AllOf(HasSubstr("light A = ["), HasSubstr("occluder B = ["),
                                       HasSubstr("Shadow without end."), HasSubstr("###")));
  EXPECT_THAT(output_of(with(shadow, {"--reach", "2.5"})), HasSubstr("up to 2.5 times the distance of the occluder."));
  EXPECT_THAT(output_of({"draw", "--hull", "0,0,0", "4,0,0", "0,4,0", "0,0,4"}),
              AllOf(HasSubstr("Convex hull of 4 points. # inside"), HasSubstr("##")));
  EXPECT_THAT(output_of({"draw", "--hull", "0,0,0,1,1,1", "--towards", "0,0,-1"}),
              HasSubstr("Convex hull of 8 points, extended without end towards 0,0,-1."));
}

TEST(CliDraw, AnswersOfBoxesAndWhenTheyAreReached) {
  const std::string text = output_of(with(shadow, {"--times", "--bound", "2,2,0,3,4,1", "7.5,2.5,0.25,8,3.5,0.75"}));
  EXPECT_THAT(text,
              AllOf(HasSubstr("[2,2,0,3,4,1]: outside\n"), HasSubstr("[7.5,2.5,0.25,8,3.5,0.75]: inside from 0.5\n")));
  EXPECT_THAT(output_of({"draw", "--from", "0,0,0,1,1,1", "--to", "9,0,0,10,1,1", "--solid", "5,-1,-1,6,2,2",
                         "5,-1,-1,6,0.5,2"}),
              AllOf(HasSubstr("[5,-1,-1,6,2,2]: blocks\n"), HasSubstr("[5,-1,-1,6,0.5,2]: overlap\n")));
}

TEST(CliDraw, LeavesOutWhatOnlyTouchesIfContactIsOpen) {
  for (const std::vector<std::string>& kind :
       {std::vector<std::string>{"--to", "4,0,0,5,1,1"}, std::vector<std::string>{"--swept", "4,0,0"},
        std::vector<std::string>{"--swept", "4,0,0", "--infinite"}}) {
    const std::vector<std::string> arguments = with(with({"draw"}, kind), {"--bound", "2,1,0,3,2,1"});
    EXPECT_THAT(output_of(arguments), HasSubstr("]: overlap\n"));
    EXPECT_THAT(output_of(with(arguments, {"--contact", "open"})), HasSubstr("]: outside\n"));
  }
}

TEST(CliDraw, CutsOffWhatHasNoEndAtThePicturesFrame) {
  const auto seen = [](const std::vector<std::string>& arguments) {
    return region_in(output_of(with(arguments, {"--svg"})));
  };
  EXPECT_TRUE(seen(shadow).is_cut_off());
  EXPECT_FALSE(seen(with(shadow, {"--reach", "2"})).is_cut_off());
  EXPECT_TRUE(seen({"draw", "--swept", "1,2,0", "--infinite"}).is_cut_off());
  EXPECT_FALSE(seen({"draw", "--swept", "1,2,0"}).is_cut_off());
  EXPECT_TRUE(seen({"draw", "--hull", "0,0,0,1,1,1", "--towards", "1,2,0"}).is_cut_off());
  EXPECT_FALSE(seen({"draw", "--hull", "0,0,0,1,1,1"}).is_cut_off());
  EXPECT_FALSE(seen({"draw"}).is_cut_off());
}

TEST(CliDraw, ShowsAShadowBehindItsOccluder) {
  // 660 pixels wide are x from 0 to 10, where the shadow of twice the distance ends; x = 4 is where the occluder
  // begins.
  const SeenRegion seen = region_in(output_of(with(shadow, {"--reach", "2", "--svg"})));
  double left = seen.width;
  double right = 0;
  for (std::size_t i = 0; i < seen.corners.size(); i += 2) {
    left = std::min(left, seen.corners[i]);
    right = std::max(right, seen.corners[i]);
  }
  EXPECT_NEAR(left, 30 + 0.4 * (seen.width - 60), 0.2);
  EXPECT_NEAR(right, seen.width - 30, 0.2);
}

TEST(CliDraw, ShowsTwoAxesOfThree) {
  const auto size = [](const char* view) {
    const SeenRegion seen =
        region_in(output_of({"draw", "--svg", "--view", view, "--from", "0,0,0,1,1,1", "--to", "3,0,0,4,1,2"}));
    return std::lround((seen.height - 60) / (seen.width - 60) * 100);
  };
  EXPECT_EQ(size("xy"), 25);
  EXPECT_EQ(size("xz"), 50);
  EXPECT_EQ(size("yz"), 200);
}

TEST(CliDraw, ShowsPointsAndFlatShafts) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--from", "1,1,1,1,1,1", "--to", "1,1,1,1,1,1"},
        std::vector<std::string>{"--from", "1,1,1,1,1,1", "--swept", "0,0,0"},
        std::vector<std::string>{"--from", "1,1,1,1,1,1", "--swept", "0,0,5", "--infinite"},
        std::vector<std::string>{"--from", "0,0,0,0,0,0", "--to", "0,3,0,0,3,0", "--shadow"},
        std::vector<std::string>{"--hull", "1,2,3"}}) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const std::string svg = output_of(with({"draw", "--svg"}, arguments));
    EXPECT_THAT(svg, AllOf(HasSubstr("</svg>"), Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
    EXPECT_THAT(output_of(with({"draw"}, arguments)), HasSubstr("xy slice"));
  }
}

TEST(CliDraw, RefusesOptionsThatDoNotGoTogether) {
  EXPECT_THAT(refusal_of({"draw", "--infinite"}), HasSubstr("--swept"));
  EXPECT_THAT(refusal_of({"draw", "--reach", "2"}), HasSubstr("--shadow"));
  EXPECT_THAT(refusal_of({"draw", "--towards", "1,0,0"}), HasSubstr("--hull"));
  EXPECT_THAT(refusal_of({"draw", "--swept", "1,0,0", "--to", "0,0,0,1,1,1"}), HasSubstr("--to"));
  EXPECT_THAT(refusal_of({"draw", "--swept", "1,0,0", "--shadow"}), HasSubstr("--shadow"));
  EXPECT_THAT(refusal_of({"draw", "--swept", "1,0,0", "--solid", "0,0,0,1,1,1"}), HasSubstr("--solid"));
  EXPECT_THAT(refusal_of({"draw", "--hull", "1,0,0", "--from", "0,0,0,1,1,1"}), HasSubstr("--from"));
  EXPECT_THAT(refusal_of({"draw", "--hull", "1,0,0", "--swept", "1,0,0"}), HasSubstr("--swept"));
  EXPECT_THAT(refusal_of({"draw", "--hull", "1,0,0", "--times"}), HasSubstr("--times"));
  EXPECT_THAT(refusal_of({"draw", "--svg", "--size", "20"}), HasSubstr("--size"));
  EXPECT_THAT(refusal_of({"draw", "--view", "xz"}), HasSubstr("--svg"));
  EXPECT_THAT(refusal_of({"draw", "--svg", "--view", "xw"}), AllOf(HasSubstr("--view"), HasSubstr("xw")));
}

TEST(CliDraw, RefusesWhatNoShaftCanBeMadeOf) {
  EXPECT_THAT(refusal_of({"draw", "--swept", "1,2"}), HasSubstr("--swept 1,2: 2 numbers; a displacement takes three"));
  EXPECT_THAT(refusal_of({"draw", "--swept", "1,far,0"}), HasSubstr("'far' is not a number"));
  EXPECT_THAT(refusal_of({"draw", "--swept", "1,inf,0"}), HasSubstr("--swept 1,inf,0: y is inf"));
  EXPECT_THAT(refusal_of({"draw", "--swept", "0,0,0", "--infinite"}), HasSubstr("--swept 0,0,0: no direction"));
  EXPECT_THAT(refusal_of({"draw", "--shadow", "--reach", "0.5"}), HasSubstr("--reach 0.5: too small"));
  EXPECT_THAT(refusal_of({"draw", "--shadow", "--reach", "nan"}), HasSubstr("--reach nan: not a number"));
  EXPECT_THAT(refusal_of({"draw", "--shadow", "--to", "1,0,0,2,1,1"}),
              HasSubstr("--shadow: light [0,0,0,1,1,1] and occluder [1,0,0,2,1,1] touch"));
  EXPECT_THAT(refusal_of({"draw", "--hull", "room.obj"}), HasSubstr("--hull room.obj: neither a point"));
  EXPECT_THAT(refusal_of({"draw", "--hull", "0,0,nan"}), HasSubstr("z is nan"));
  EXPECT_THAT(refusal_of({"draw", "--hull", "0,0,0", "--towards", "0,0,0"}),
              HasSubstr("--towards 0,0,0: no direction"));
  std::vector<std::string> many{"draw", "--hull"};
  for (int i = 0; i < 5; ++i) many.emplace_back("0,0,0,1,1,1");
  EXPECT_THAT(refusal_of(many), HasSubstr("--hull: 40 corners and directions; a hull has at most 32"));
  EXPECT_THAT(refusal_of({"draw", "--bound", "1,2,3"}), HasSubstr("--bound 1,2,3: 3 numbers; a box takes six"));
}

}  // namespace
}  // namespace shaftcull::test
