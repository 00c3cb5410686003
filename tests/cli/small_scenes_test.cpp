// SPDX-License-Identifier: MIT
/// `shaftcull sees` of small scenes that have right answers: those of cli/scenes/answers.txt.
#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cli/program.hpp"

namespace shaftcull::test {
namespace {

using Json = nlohmann::json;

const std::string scenes_folder = SHAFTCULL_SMALL_SCENES;

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) {
    if (!trimmed(part).empty()) parts.push_back(trimmed(part));
  }
  return parts;
}

/// A line of the table.
struct SmallScene {
  int line;
  std::string scene;
  std::vector<std::string> options;
  std::vector<std::string> conditions;
  friend void PrintTo(const SmallScene& of, std::ostream* to) { *to << of.scene; }
};

std::vector<SmallScene> small_scenes() {
  std::vector<SmallScene> scenes;
  std::ifstream table(scenes_folder + "/answers.txt");
  int number = 0;
  for (std::string line; std::getline(table, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    const std::vector<std::string> columns = split(line, '|');
    scenes.push_back({number, columns.at(0), split(columns.at(1), ' '), split(columns.at(2), ',')});
  }
  return scenes;
}

/// Boxes of 18 × 18 on squares of 30, of many heights, and the ground.
std::string city() {
  std::string obj;
  for (int block = 0; block != 100; ++block) {
    const int x = block / 10 * 30;
    const int y = block % 10 * 30;
    const int height = 8 + block * 37 % 29;
    obj += "o block" + std::to_string(block) + '\n';
    for (const int z : {0, height}) {
      for (const auto& [along, across] : std::array<std::pair<int, int>, 4>{{{0, 0}, {18, 0}, {18, 18}, {0, 18}}}) {
        obj += "v " + std::to_string(x + along) + ' ' + std::to_string(y + across) + ' ' + std::to_string(z) + '\n';
      }
    }
    obj += "f -8 -5 -6 -7\nf -4 -3 -2 -1\nf -8 -7 -3 -4\nf -6 -5 -1 -2\nf -7 -6 -2 -3\nf -8 -4 -1 -5\n";
  }
  return obj + "o ground\nv -6 -6 0\nv 294 -6 0\nv 294 294 0\nv -6 294 0\nf -4 -3 -2 -1\n";
}

/// Walls, seen from within, of rectangles of about the same size, each of two triangles.
class GridMesh {
 public:
  using Point = std::array<double, 3>;

  /// The rectangle at `corner` with these edges, seen from where `u` × `v` leads, in so many pieces along each.
  void add(const Point& corner, const Point& u, const Point& v, int pieces_u, int pieces_v) {
    const auto number = [&](int i, int j) {
      std::array<char, 100> text{};
      Point p{};
      for (std::size_t k = 0; k != 3; ++k) p[k] = corner[k] + u[k] * i / pieces_u + v[k] * j / pieces_v;
      std::snprintf(text.data(), text.size(), "%.17g %.17g %.17g", p[0], p[1], p[2]);
      const auto [found, is_new] = vertices_.try_emplace(text.data(), vertices_.size() + 1);
      if (is_new) lines_ += "v " + found->first + '\n';
      return std::to_string(found->second);
    };
    for (int i = 0; i != pieces_u; ++i) {
      for (int j = 0; j != pieces_v; ++j) {
        const std::string from = number(i, j);
        const std::string far = number(i + 1, j + 1);
        const std::string faces[2] = {number(i + 1, j), number(i, j + 1)};
        faces_ += "f " + from + ' ' + faces[0] + ' ' + far + "\nf " + from + ' ' + far + ' ' + faces[1] + '\n';
      }
    }
  }

  [[nodiscard]] std::string obj() const { return "o room\n" + lines_ + faces_; }

 private:
  std::map<std::string, std::size_t> vertices_;
  std::string lines_;
  std::string faces_;
};

/// A room in the shape of an L, 4 high, of 896 squares.
std::string l_room() {
  constexpr std::array<std::array<double, 2>, 6> outline{{{0, 0}, {8, 0}, {8, 4}, {4, 4}, {4, 8}, {0, 8}}};
  GridMesh mesh;
  for (std::size_t k = 0; k != 6; ++k) {
    const auto& [x, y] = outline[(k + 1) % 6];
    const double u[2] = {outline[k][0] - x, outline[k][1] - y};
    mesh.add({x, y, 0}, {u[0], u[1], 0}, {0, 0, 4}, static_cast<int>(2 * std::hypot(u[0], u[1])), 8);
  }
  for (const auto& [y, width] : std::array<std::pair<double, double>, 2>{{{0, 8}, {4, 4}}}) {
    const int pieces = static_cast<int>(2 * width);
    mesh.add({0, y, 0}, {width, 0, 0}, {0, 4, 0}, pieces, 8);
    mesh.add({0, y, 4}, {0, 4, 0}, {width, 0, 0}, 8, pieces);
  }
  return mesh.obj();
}

/// A cavity of 10 × 9 × 8, each of its six walls cut into 11 · 6 · fineness² rectangles.
std::string cavity(int fineness) {
  const double size[3] = {10, 9, 8};
  GridMesh mesh;
  for (std::size_t axis = 0; axis != 3; ++axis) {
    GridMesh::Point u{};
    GridMesh::Point v{};
    u[(axis + 1) % 3] = size[(axis + 1) % 3];
    v[(axis + 2) % 3] = size[(axis + 2) % 3];
    GridMesh::Point far{};
    far[axis] = size[axis];
    mesh.add({0, 0, 0}, u, v, 11 * fineness, 6 * fineness);
    mesh.add(far, v, u, 6 * fineness, 11 * fineness);
  }
  return mesh.obj();
}

/// About the z axis, or about one that leans.
std::string turned(const std::string& obj, double degrees, const std::array<double, 3>& towards) {
  const double s = std::sin(degrees / 180 * std::numbers::pi);
  const double c = std::cos(degrees / 180 * std::numbers::pi);
  const double length = std::hypot(towards[0], towards[1], towards[2]);
  const double axis[3] = {towards[0] / length, towards[1] / length, towards[2] / length};
  std::string result;
  std::istringstream in(obj);
  for (std::string line; std::getline(in, line);) {
    double x = 0;
    double y = 0;
    double z = 0;
    if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3) {
      const double along = (axis[0] * x + axis[1] * y + axis[2] * z) * (1 - c);
      std::array<char, 100> text{};
      std::snprintf(text.data(), text.size(), "v %.17g %.17g %.17g",
                    c * x + s * (axis[1] * z - axis[2] * y) + along * axis[0],
                    c * y + s * (axis[2] * x - axis[0] * z) + along * axis[1],
                    c * z + s * (axis[0] * y - axis[1] * x) + along * axis[2]);
      line = text.data();
    }
    result += line + '\n';
  }
  return result;
}

class CliSmallScenes : public testing::TestWithParam<SmallScene> {
 protected:
  /// The path of a scene, made where it is not one of the files.
  [[nodiscard]] std::string file_of(const std::string& scene) const {
    const std::vector<std::string> words = split(scene, ' ');
    static const std::map<std::string, std::function<std::string()>> made{{"city", city},
                                                                          {"l_room", l_room},
                                                                          {"cavity_792", [] { return cavity(1); }},
                                                                          {"cavity_3168", [] { return cavity(2); }}};
    const auto make = made.find(words.at(0));
    std::string path = scenes_folder + '/' + words[0];
    if (words.size() == 1 && make == made.end()) return path;
    std::string obj = make == made.end() ? bytes_of_file(path) : make->second();
    if (words.size() != 1) {
      const bool about_z = words.size() == 3;
      obj = turned(obj, std::stod(words.at(2)),
                   about_z ? std::array<double, 3>{0, 0, 1} : std::array<double, 3>{1, 2, 3});
    }
    return folder_.write(words[0] + ".made.obj", obj);
  }

  [[nodiscard]] Outcome run(const std::string& scene) const {
    std::vector<std::string> arguments{"sees", file_of(scene), "--format", "json"};
    return run_program(with(std::move(arguments), GetParam().options));
  }

  /// The number that a condition is about: of `A - B kind`, or of `kind`.
  static double number(const Json& report, const std::vector<std::string>& words) {
    if (words.size() == 1) {
      const bool is_found = report["found"].contains(words[0]);
      return (is_found ? report["found"] : report["pairs"]).at(words[0]).get<double>();
    }
    for (const Json& pair : report.at("object_pairs")) {
      if (pair["a"] == words.at(0) && pair["b"] == words.at(2)) {
        return pair.at(words.at(3) == "all" ? "pairs" : words.at(3)).get<double>();
      }
    }
    throw std::runtime_error("no pairs of " + words.at(0) + " and " + words.at(2));
  }

  void expect(const std::string& condition, const Json& report) const {
    const std::vector<std::string> words = split(condition, ' ');
    ASSERT_GE(words.size(), 3U) << condition;
    const std::vector<std::string> subject(words.begin(), words.end() - 2);
    const std::string& relation = words[words.size() - 2];
    const std::string& value = words.back();
    const double left = number(report, subject);
    double right = 0;
    if (const std::size_t of = value.find("%of:"); of != std::string::npos) {
      right = std::stod(value) / 100 * number(Json::parse(run(value.substr(of + 4)).out), subject);
    } else if (value.find("obj") != std::string::npos || value.find("gltf") != std::string::npos) {
      right = number(Json::parse(run(value).out), subject);
    } else {
      right = std::stod(value);
      if (value.back() == '%') right *= report["pairs"]["all"].get<double>() / 100;
    }
    const bool holds = relation == "=" ? left == right : relation == "<" ? left < right : left > right;
    EXPECT_TRUE(holds) << condition << ": " << left << ", and " << right;
  }

  ScratchFolder folder_;
};

TEST_P(CliSmallScenes, HasTheRightAnswers) {
  const SmallScene& scene = GetParam();
  SCOPED_TRACE("answers.txt:" + std::to_string(scene.line) + ": " + scene.scene);
  const Outcome outcome = run(scene.scene);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const Json report = Json::parse(outcome.out);
  for (const std::string& condition : scene.conditions) {
    if (condition == "says nothing of coordinates") {
      EXPECT_EQ(outcome.error.find("Coordinates reach"), std::string::npos) << outcome.error;
    } else if (condition.starts_with("says ")) {
      EXPECT_NE(outcome.error.find(condition.substr(5)), std::string::npos) << outcome.error;
    } else {
      expect(condition, report);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, CliSmallScenes, testing::ValuesIn(small_scenes()),
                         [](const testing::TestParamInfo<SmallScene>& row) {
                           std::string name = row.param.scene + "_line_" + std::to_string(row.param.line);
                           for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
                           return name;
                         });

}  // namespace
}  // namespace shaftcull::test
