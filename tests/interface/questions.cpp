// SPDX-License-Identifier: MIT
/// The table of docs/questions.md, and the page of kinds: their lines of code compile as they stand there, and the
/// shafts that they make keep what is in the way and cull what is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shaftcull/shaftcull.hpp"
#include "text_of.hpp"

namespace sc = shaftcull;

namespace {

// The names that the table uses.
const sc::Box patch{{0, 0, 0}, {1, 1, 0}};
const sc::Box other_patch{{0, 0, 10}, {1, 1, 10}};
const sc::Box body{{0, 0, 0}, {1, 1, 1}};
const sc::Vec3 travel{0, 0, 9};
const sc::Box light{{0, 0, 10}, {1, 1, 10}};
const sc::Box receiver{{0, 0, 0}, {1, 1, 1}};
const sc::Vec3 light_position{0.5F, 0.5F, 10};
const sc::Vec3 towards_sun{0, 0, 1};
const sc::Vec3 from_sun{0, 0, 1};  // for what is above
const sc::Vec3 down{0, 0, 1};
const sc::Vec3 eye{0.5F, 0.5F, 10};
const sc::Box occluder{{0, 0, 8}, {1, 1, 9}};
constexpr float reach = 9;
constexpr sc::ClipDepth depth = sc::ClipDepth::minus_one_to_one;
// Looks along z from the origin: w = z, a right angle wide and high, near plane 1, far plane 51.
constexpr float matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1.04F, -2.04F, 0, 0, 1, 0};

const sc::ConvexHull view = sc::frustum(matrix, depth);
const std::vector<sc::Vec3> view_corners(view.points().begin(), view.points().end());
const std::vector<sc::Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
const std::vector<sc::Vec3> other_corners = {{0, 1, 10}, {1, 0, 10}, {1, 1, 10}};

const sc::CompiledShaft shaft = sc::compile(patch, other_patch);
const sc::BoxStream walls(std::vector<sc::Box>{{{20, 0, 5}, {21, 1, 6}}, {{-1, -1, 5}, {2, 2, 6}}});
const std::vector<sc::Vec3> wall_corners = {{-9, -9, 5}, {9, -9, 5}, {9, 9, 6}, {-9, 9, 6}};
const sc::BoxTree tree = [] {
  sc::BoxTree boxes(std::vector<sc::Box>{body, {{0, 0, 5}, {1, 1, 6}}, {{20, 0, 5}, {21, 1, 6}}});
  boxes.set_layers(std::vector<std::uint32_t>{1, 2, 4});
  return boxes;
}();
const sc::DynamicBoxTree bodies = [] {
  sc::DynamicBoxTree boxes;
  boxes.insert(body);
  boxes.insert({{0, 0, 5}, {1, 1, 6}});
  boxes.commit();
  return boxes;
}();
const sc::SphereTree spheres(std::vector<sc::Sphere>{{{0.5F, 0.5F, 6}, 0.25F}});
const sc::TriangleTree triangles(std::vector<sc::Triangle>{{{{{0.4F, 0.4F, 5}, {9, 0.4F, 5}, {9, 9, 6}}}}});
const sc::PatchSet patches(std::vector<sc::Box>{patch, other_patch, {{20, 0, 10}, {21, 1, 10}}});
const std::vector<sc::Vec3> corners_of_facets{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<std::size_t> first_of_facets{0, 4};
const sc::PatchSet facets(corners_of_facets, first_of_facets);
const std::vector<sc::Vec3> towards_suns{{9, 0, 1}, {0, 0, -1}};
std::vector<float> fractions(2);
const sc::Occluders occluders = [] {
  sc::Occluders solid;
  solid.add_solids(walls);
  return solid;
}();
std::uint64_t delivered = 0;
const auto deliver = [](const sc::SightBatch& batch) {
  for (const sc::PairBlock& block : batch.blocks) delivered += block.a.count * block.b.count;
  delivered += batch.undecided.pairs.size();
};
constexpr std::uint32_t me = 0;
const std::vector<std::uint32_t> indices{1};
std::vector<float> times(1);
std::vector<std::uint32_t> kept;

// Of a question: the code as text, and whether what it makes keeps a box.
#define QUESTION(code)                                             \
  Question {                                                       \
#code, [](const sc::Box& box) { return sc::keeps(code, box); } \
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
          QUESTION(sc::swept_infinite(receiver, towards_sun)),
          QUESTION(sc::shadow(light, occluder)),
          QUESTION(sc::shadow(light, occluder, reach)),
          QUESTION(sc::frustum(matrix, depth)),
          QUESTION(sc::casters(view, light_position)),
          QUESTION(sc::casters_towards(view, towards_sun)),
          QUESTION(sc::between_polygons(corners, other_corners)),
          QUESTION(sc::swept_infinite(body, down)),
          QUESTION(sc::swept_infinite(body, from_sun)),
          QUESTION(sc::shadow(sc::Box{eye, eye}, occluder)),
          QUESTION(sc::ConvexHull(view_corners)),
          QUESTION(sc::compile(patch, other_patch, sc::Contact::open))};
}

// Of a question that is answered at once: the code as text, and whether the answer is right, which is `answer` in the
// first argument.
#define ANSWER(is_right, ...)             \
  Answer {                                \
#__VA_ARGS__, [] {                      \
      const auto answer = __VA_ARGS__;      \
      return static_cast<bool>(is_right);   \
    } \
  }
// The same of a call that returns nothing.
#define WRITES(is_right, ...)             \
  Answer {                                \
#__VA_ARGS__, [] {                      \
      __VA_ARGS__;                          \
      return static_cast<bool>(is_right);   \
    } \
  }

struct Answer {
  const char* code;
  bool (*is_right)();
};

std::vector<Answer> answers() {
  return {
      ANSWER(answer, sc::occluded(sc::compile(patch, other_patch), walls)),
      ANSWER(answer, sc::occluded(sc::between_polygons(corners, other_corners), walls)),
      ANSWER(answer, sc::occluded(sc::compile(patch, other_patch), wall_corners)),
      ANSWER(answer.index == 1 && answer.time > 0.44F && answer.time < 0.45F,
             sc::first_contact(sc::swept(body, travel), tree, {.exclude = {me}})),
      ANSWER(answer.index == 0 && answer.time > 0.52F && answer.time < 0.53F,
             sc::first_contact(sc::swept(body, travel), spheres)),
      ANSWER(answer.index == 0 && answer.time == 0, sc::first_contact(sc::swept(body, travel), bodies)),
      WRITES(times[0] > 0.44F && times[0] < 0.45F, sc::entry_times(sc::swept(body, travel), tree, indices, times)),
      ANSWER(answer.occluded == 1 && delivered == 3, sc::visibility(patches, occluders, deliver)),
      ANSWER(answer.occluded == 1 && answer.total() == 3, sc::count_visibility(patches, occluders)),
      ANSWER(answer.size() == 1, sc::view_factors(facets, occluders)),
      WRITES(fractions[0] == 1 && fractions[1] == 0, sc::lit_fractions(facets, occluders, towards_suns, fractions)),
      ANSWER(answer, sc::any(shaft, triangles)),
      ANSWER(answer, sc::any(shaft, triangles, {.triangle_test = sc::TriangleTest::vertices})),
      ANSWER(answer, sc::any(shaft, tree)),
      ANSWER(answer == 2 && kept.size() == 2 && kept[0] + kept[1] == 1, sc::list(shaft, tree, kept, {.limit = 16})),
      ANSWER(answer == 1 && kept.size() == 1 && kept[0] == 0, sc::list(shaft, tree, kept, {.layer_mask = {0b101}}))};
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
  EXPECT_TRUE(keeps(sc::compile(patch, other_patch), wall));
  EXPECT_FALSE(keeps(sc::compile(patch, other_patch, sc::Contact::open), wall));
}

TEST(ReadmeQuestions, AreAnsweredAtOnce) {
  for (const Answer& each : answers()) EXPECT_TRUE(each.is_right()) << each.code;
}

TEST(ReadmeQuestions, OneWallThatDoesNotHideAllHidesNothing) {
  const sc::Box half{{0.5F, -1, 5}, {2, 2, 6}};
  EXPECT_FALSE(sc::occluded(sc::compile(patch, other_patch), half));
}

TEST(ReadmeQuestions, ATriangleBesideTheShaftIsNotInTheWayThoughItsBoxIs) {
  const sc::Triangle beside{{{{2.2F, 0, 5}, {0, 2.2F, 5}, {2, 2, 6}}}};
  EXPECT_FALSE(keeps(shaft, beside));
  EXPECT_TRUE(keeps(shaft, beside, sc::TriangleTest::vertices));
}

/// Whether a question above has this code.
bool is_asked_here(const std::string& code) {
  const std::vector<Question> all = questions();
  const std::vector<Answer> at_once = answers();
  const auto has_code = [&](const auto& each) { return each.code == code; };
  return std::any_of(all.begin(), all.end(), has_code) || std::any_of(at_once.begin(), at_once.end(), has_code);
}

/// All code in a text that begins with the library's name.
std::vector<std::string> code_in(const std::string& text) {
  std::vector<std::string> code;
  for (std::size_t begin = 0; (begin = text.find("`sc::", begin)) != std::string::npos;) {
    const std::size_t end = text.find('`', begin + 1);
    code.push_back(text.substr(begin + 1, end - begin - 1));
    begin = end + 1;
  }
  return code;
}

TEST(Questions, AreAskedOnThePageOfKindsAsHere) {
  const std::vector<std::string> code = code_in(sc::text_of(SHAFTCULL_VOLUMES_PAGE));
  for (const std::string& each : code) EXPECT_TRUE(is_asked_here(each)) << each << " is compiled by no test";
  EXPECT_GE(code.size(), 8U);
}

TEST(Questions, AreAskedInTheTableAsHere) {
  const std::string page = sc::text_of(SHAFTCULL_QUESTIONS_PAGE);
  const std::size_t begin = page.find("| question | code |");
  ASSERT_NE(begin, std::string::npos);
  const std::vector<std::string> code = code_in(page.substr(begin, page.find("\n\n", begin) - begin));
  for (const std::string& each : code) EXPECT_TRUE(is_asked_here(each)) << each << " is compiled by no test";
  const auto is_in_table = [&](const char* each) { return std::find(code.begin(), code.end(), each) != code.end(); };
  for (const Question& each : questions()) EXPECT_TRUE(is_in_table(each.code)) << each.code;
  for (const Answer& each : answers()) EXPECT_TRUE(is_in_table(each.code)) << each.code;
}

}  // namespace
