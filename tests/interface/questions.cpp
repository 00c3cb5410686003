/// The README's table of questions, and the page of kinds: their lines of code compile as they stand there, and the
/// shafts that they make keep what is in the way and cull what is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "shaftcull/shaftcull.hpp"

namespace sc = shaftcull;

namespace {

// The names that the README uses.
const sc::Box patch{{0, 0, 0}, {1, 1, 0}};
const sc::Box other_patch{{0, 0, 10}, {1, 1, 10}};
const sc::Box body{{0, 0, 0}, {1, 1, 1}};
const sc::Vec3 travel{0, 0, 9};
const sc::Box light{{0, 0, 10}, {1, 1, 10}};
const sc::Box receiver{{0, 0, 0}, {1, 1, 1}};
const sc::Vec3 light_position{0.5F, 0.5F, 10};
const sc::Vec3 towards_sun{0, 0, 1};
const sc::Box occluder{{0, 0, 8}, {1, 1, 9}};
constexpr float reach = 9;
constexpr sc::ClipDepth depth = sc::ClipDepth::minus_one_to_one;
// Looks along z from the origin: w = z, a right angle wide and high, near plane 1, far plane 51.
constexpr float matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1.04F, -2.04F, 0, 0, 1, 0};

const sc::ConvexHull view = sc::frustum(matrix, depth);
const std::vector<sc::Vec3> corners_of_both = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 10}, {1, 0, 10}, {1, 1, 10}};

// Of a question: the code as text, and whether what it makes keeps a box.
#define QUESTION(code)                                        \
  Question {                                                  \
#code, [](const sc::Box& box) { return cull(code, box); } \
  }

struct Question {
  const char* code;
  bool (*keeps)(const sc::Box& box);
};

std::vector<Question> questions() {
  return {QUESTION(sc::compile(patch, other_patch)),
          QUESTION(sc::swept(body, travel)),
          QUESTION(sc::compile(light, receiver)),
          QUESTION(sc::compile(sc::Box{light_position, light_position}, receiver)),
          QUESTION(sc::swept_without_end(receiver, towards_sun)),
          QUESTION(sc::shadow(light, occluder)),
          QUESTION(sc::shadow(light, occluder, reach)),
          QUESTION(sc::frustum(matrix, depth)),
          QUESTION(sc::casters(view, light_position)),
          QUESTION(sc::casters_towards(view, towards_sun)),
          QUESTION(sc::ConvexHull(corners_of_both)),
          QUESTION(sc::compile(patch, other_patch, sc::Contact::open))};
}

TEST(ReadmeQuestions, KeepWhatIsInTheWayAndCullWhatIsNot) {
  const sc::Box in_the_way{{0.4F, 0.4F, 5}, {0.6F, 0.6F, 6}};
  const sc::Box beside{{20, 0, 5}, {21, 1, 6}};
  for (const Question& question : questions()) {
    EXPECT_TRUE(question.keeps(in_the_way)) << question.code;
    EXPECT_FALSE(question.keeps(beside)) << question.code;
  }
}

TEST(ReadmeQuestions, TheWallBehindAPatchIsLeftOutWithOpenContact) {
  const sc::Box wall{{-9, -9, -1}, {9, 9, 0}};
  EXPECT_TRUE(cull(sc::compile(patch, other_patch), wall));
  EXPECT_FALSE(cull(sc::compile(patch, other_patch, sc::Contact::open), wall));
}

TEST(ReadmeQuestions, AWallHidesAPatch) {
  const auto is_hidden = [](const sc::BoxStream& walls) { return sc::blocked(sc::compile(patch, other_patch), walls); };
  std::vector<sc::Box> walls{{{20, 0, 5}, {21, 1, 6}}, {{-1, -1, 5}, {2, 2, 6}}};
  EXPECT_TRUE(is_hidden(sc::BoxStream(walls)));
  walls[1].lo[0] = 0.5F;
  EXPECT_FALSE(is_hidden(sc::BoxStream(walls)));
}

TEST(ReadmeQuestions, ATriangleIsInTheWayOrNot) {
  const auto in_the_way = [](const std::vector<sc::Triangle>& triangles) {
    return sc::any(sc::compile(patch, other_patch), sc::TriangleTree(std::span<const sc::Triangle>(triangles)));
  };
  EXPECT_TRUE(in_the_way({{{{{0.4F, 0.4F, 5}, {9, 0.4F, 5}, {9, 9, 6}}}}}));
  EXPECT_FALSE(in_the_way({{{{{2.2F, 0, 5}, {0, 2.2F, 5}, {2, 2, 6}}}}})) << "its box is in the way";
}

std::string text_of(const char* path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ReadmeQuestions, AreAskedOnThePageOfKindsAsHere) {
  const std::string page = text_of(SHAFTCULL_KINDS_PAGE);
  std::size_t found = 0;
  for (std::size_t begin = 0; (begin = page.find("`sc::", begin)) != std::string::npos; ++found) {
    const std::size_t end = page.find('`', begin + 1);
    const std::string code = page.substr(begin + 1, end - begin - 1);
    const std::vector<Question> known = questions();
    EXPECT_TRUE(code == "sc::blocked(sc::compile(patch, other_patch), walls)" ||
                std::any_of(known.begin(), known.end(), [&](const Question& each) { return each.code == code; }))
        << code << " is compiled by no test";
    begin = end + 1;
  }
  EXPECT_GE(found, 8U);
}

TEST(ReadmeQuestions, AreAskedAsTheReadmeSays) {
  const std::string readme = text_of(SHAFTCULL_README);
  EXPECT_NE(readme.find("`sc::any(sc::compile(patch, other_patch), sc::TriangleTree(mesh))`"), std::string::npos);
  EXPECT_NE(readme.find("`sc::blocked(sc::compile(patch, other_patch), walls)`"), std::string::npos);
  for (const Question& question : questions()) {
    EXPECT_NE(readme.find("`" + std::string(question.code) + "`"), std::string::npos) << question.code;
  }
}

}  // namespace
