// SPDX-License-Identifier: MIT
/// `shaftcull sees` of mesh files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cli/program.hpp"

namespace shaftcull::test {
namespace {

using testing::AllOf;
using testing::Each;
using testing::HasSubstr;

/// Two facets of side 2 that face each other, at x = 0 and 10, then what the test adds.
class CliSeesMesh : public testing::Test {
 protected:
  /// A hexahedron: the bottom counterclockwise as seen from above, then the top likewise.
  [[nodiscard]] std::string hexahedron(const std::string& name, const std::vector<std::string>& corners) const {
    std::string obj = "o " + name + '\n';
    for (const std::string& corner : corners) obj += "v " + corner + '\n';
    for (const auto& face : {"9 12 11 10", "13 14 15 16", "9 10 14 13", "10 11 15 14", "11 12 16 15", "12 9 13 16"}) {
      obj += std::string("f ") + face + '\n';
    }
    return obj;
  }

  [[nodiscard]] std::string upright_wall() const {
    return hexahedron("wall", {"4 -5 -5", "6 -5 -5", "6 5 -5", "4 5 -5", "4 -5 5", "6 -5 5", "6 5 5", "4 5 5"});
  }

  /// Turned by a fifth of a right angle or so.
  [[nodiscard]] std::string turned_wall() const {
    return hexahedron("wall", {"3 -5 -5", "5 -5 -5", "7 5 -5", "5 5 -5", "3 -5 5", "5 -5 5", "7 5 5", "5 5 5"});
  }

  [[nodiscard]] std::string file(const std::string& wall) const {
    return folder_.write("scene.obj",
                         "o left\nv 0 -1 -1\nv 0 1 -1\nv 0 1 1\nv 0 -1 1\nf 1 2 3 4\n"
                         "o right\nv 10 -1 -1\nv 10 -1 1\nv 10 1 1\nv 10 1 -1\nf 5 6 7 8\n" +
                             wall);
  }

  /// What is said of the four pairs of a triangle on the left and one on the right.
  [[nodiscard]] std::vector<std::string> across(const std::string& wall, const std::vector<std::string>& more) const {
    const std::string out = folder_.path("sights.csv");
    static_cast<void>(output_of(with({"sees", file(wall), "--patches", "100", "--out", out}, more)));
    std::ifstream csv(out);
    std::vector<std::string> sights;
    for (std::string line; std::getline(csv, line);) {
      for (const char* pair : {"0,2,", "2,0,", "0,3,", "3,0,", "1,2,", "2,1,", "1,3,", "3,1,"}) {
        if (line.starts_with(pair)) sights.push_back(line.substr(4));
      }
    }
    EXPECT_THAT(sights, testing::SizeIs(4));
    return sights;
  }

  ScratchFolder folder_;
};

TEST_F(CliSeesMesh, NothingBetweenIsClear) { EXPECT_THAT(across("", {}), Each("clear")); }

TEST_F(CliSeesMesh, AWallIsFoundAndBlocks) {
  EXPECT_THAT(across(upright_wall(), {}), Each("occluded"));
  EXPECT_THAT(across(upright_wall(), {"--rays", "16"}), Each("occluded,"));
}

TEST_F(CliSeesMesh, AWallThatIsNotLookedForIsUndecidedAndRaysMeetIt) {
  EXPECT_THAT(across(upright_wall(), {"--no-solids"}), Each("undecided"));
  EXPECT_THAT(across(upright_wall(), {"--no-solids", "--rays", "16"}), Each("undecided,0"));
}

TEST_F(CliSeesMesh, RaysPassBesideAPost) {
  const std::string post =
      hexahedron("post", {"4 0 -9", "6 0 -9", "6 9 -9", "4 9 -9", "4 0 9", "6 0 9", "6 9 9", "4 9 9"});
  for (const std::string& sight : across(post, {"--rays", "400"})) {
    ASSERT_THAT(sight, testing::StartsWith("undecided,"));
    const int seen = std::stoi(sight.substr(10));
    EXPECT_TRUE(seen > 0 && seen < 400) << sight;
  }
}

TEST_F(CliSeesMesh, ASolidWallBlocks) {
  EXPECT_THAT(across(upright_wall(), {"--solid", "wall"}), Each("occluded"));
  EXPECT_THAT(across(upright_wall(), {"--solid", "w*"}), Each("occluded"));
}

TEST_F(CliSeesMesh, ASolidAroundAPatchBlocksWithRaysToo) {
  const std::string around_left =
      hexahedron("wall", {"-1 -5 -5", "1 -5 -5", "1 5 -5", "-1 5 -5", "-1 -5 5", "1 -5 5", "1 5 5", "-1 5 5"});
  EXPECT_THAT(across(around_left, {"--solid", "wall"}), Each("occluded"));
  EXPECT_THAT(across(around_left, {"--solid", "wall", "--rays", "4"}), Each("occluded,"));
}

TEST_F(CliSeesMesh, ATurnedSolidWallIsTaken) {
  const std::string out = output_of({"sees", file(turned_wall()), "--solid", "wall", "--format", "json"});
  EXPECT_EQ(nlohmann::json::parse(out)["solids"], 1);
  EXPECT_THAT(across(turned_wall(), {"--rays", "16", "--solid", "wall"}),
              Each(testing::AnyOf("undecided,0", "occluded,")));
}

TEST_F(CliSeesMesh, OneSlantedRoofAmongManyWallsIsAnsweredByItsCorners) {
  // A square that leans, in two triangles, and ten walls in one plane below it: the roof's box sticks out of its plane.
  std::string obj = "o roof\nv 0 0 10\nv 1 0 11\nv 1 1 11\nv 0 1 10\nf 1 2 3 4\no walls\n";
  for (int i = 0; i < 10; ++i) {
    const std::string lo = std::to_string(2 * i);
    const std::string hi = std::to_string(2 * i + 1);
    for (const std::string& corner : {lo + " 0", hi + " 0", hi + " 1", lo + " 1"}) obj += "v " + corner + " 0\n";
    const int first = 5 + 4 * i;
    obj += "f " + std::to_string(first) + ' ' + std::to_string(first + 1) + ' ' + std::to_string(first + 2) + ' ' +
           std::to_string(first + 3) + '\n';
  }
  const std::string path = folder_.write("roof.obj", obj);
  const auto pairs = nlohmann::json::parse(output_of({"sees", path, "--patches", "9", "--format", "json"}))["pairs"];
  EXPECT_EQ(pairs["facing_away"], 22 * 21 / 2);  // the roof faces up, and each wall too
  EXPECT_EQ(pairs["clear"], 0);
}

// The corner of a box around the upper facet reaches through the wall; the facet does not.
TEST_F(CliSeesMesh, FacetsOfTwoSidesHaveTheirCorners) {
  const std::string slanted = folder_.write("slanted.obj",
                                            "o lower\nv 0 0 0\nv 4 0 0\nv 4 0 4\nf 1 2 3\n"
                                            "o upper\nv 0 4 0\nv 4 4 0\nv 4 4 4\nf 4 6 5\n"
                                            "o aside\nv 0 2 3.5\nv 1 2 3.75\nv 0 2 4\nf 7 8 9\n");
  const auto pairs = [&](const std::vector<std::string>& more) {
    return nlohmann::json::parse(
        output_of(with({"sees", slanted, "--patches", "99", "--format", "json"}, more)))["pairs"];
  };
  EXPECT_EQ(pairs({"--two-sided"})["clear"], 3);
}

TEST_F(CliSeesMesh, FacetsThatTurnAwayFaceAwayUnlessTheyHaveTwoSides) {
  const std::string away = folder_.write("away.obj",
                                         "o left\nv 0 -1 -1\nv 0 1 -1\nv 0 1 1\nf 3 2 1\n"
                                         "o right\nv 9 -1 -1\nv 9 1 -1\nv 9 1 1\nf 4 5 6\n");
  const auto pairs = [&](const std::vector<std::string>& more) {
    return nlohmann::json::parse(output_of(with({"sees", away, "--patches", "9", "--format", "json"}, more)))["pairs"];
  };
  EXPECT_EQ(pairs({})["facing_away"], 1);
  EXPECT_EQ(pairs({"--two-sided"})["facing_away"], 0);
  EXPECT_EQ(pairs({"--two-sided"})["clear"], 1);
}

/// A glTF file of one triangle, mesh 0, in the plane z = 0, with these nodes.
std::string gltf_of_nodes(const std::vector<std::string>& nodes) {
  std::string list;
  std::string numbers;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    list += (i == 0 ? "" : ",") + nodes[i];
    numbers += (i == 0 ? "" : ",") + std::to_string(i);
  }
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" + numbers + R"(]}],"nodes":[)" + list +
         R"(],"meshes":[{"name":"leaf","primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
         "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";
}

TEST_F(CliSeesMesh, ANodeThatReflectsFacesAsItsMeshDoes) {
  const auto pairs = [&](const std::string& ceiling) {
    const std::string file = folder_.write("room.gltf", gltf_of_nodes({R"({"name":"floor","mesh":0})", ceiling}));
    return nlohmann::json::parse(output_of({"sees", file, "--patches", "9", "--format", "json"}))["pairs"];
  };
  EXPECT_EQ(pairs(R"({"name":"ceiling","mesh":0,"translation":[0,0,2],"scale":[1,1,-1]})")["clear"], 1);
  EXPECT_EQ(pairs(R"({"name":"ceiling","mesh":0,"translation":[0,1,2],"rotation":[1,0,0,0]})")["clear"], 1);
  EXPECT_EQ(pairs(R"({"name":"ceiling","mesh":0,"translation":[0,0,2],"scale":[-1,-1,-1]})")["clear"], 1);
  EXPECT_EQ(pairs(R"({"name":"ceiling","mesh":0,"translation":[0,0,2],"scale":[-1,-1,1]})")["facing_away"], 1);
}

TEST_F(CliSeesMesh, TheUsualPatchSizeIsShortAndDoesNotMakeTooManyPairs) {
  std::string floors;
  for (const std::string z : {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"}) {
    for (const std::string xy : {"0 0 ", "22.8577 0 ", "22.8577 22.8577 ", "0 22.8577 "}) {
      floors += "v " + xy + z + '\n';
    }
    floors += "f -4 -3 -2 -1\n";
  }
  const auto report = [](const std::string& file) {
    return nlohmann::json::parse(output_of({"sees", file, "--format", "json"}));
  };
  const nlohmann::json few = report(folder_.write("floor.obj", floors.substr(0, floors.find('f') + 14)));
  EXPECT_EQ(few["patch_size"], 0.7144);
  const nlohmann::json many = report(folder_.write("floors.obj", floors));
  EXPECT_GT(many["patch_size"], 0.7144);
  EXPECT_LE(many["pairs"]["all"], 500'000'000);
  EXPECT_GT(many["pairs"]["all"], 100'000'000);
}

/// Two squares that face away from each other unless they are turned round.
constexpr const char* outward_squares = R"(
v 0 0 0
v 0 0 1
v 0 1 1
v 0 1 0
v 1 0 0
v 1 1 0
v 1 1 1
v 1 0 1
o left
f 1 2 3 4
o right
f 5 6 7 8
)";

TEST_F(CliSeesMesh, NormalsThatPointOutwardsGetAHintAndCanBeFlipped) {
  const std::string file = folder_.write("outward.obj", outward_squares);
  const std::vector<std::string> arguments{"sees", file, "--patches", "9", "--format", "json"};
  const Outcome outward = run_program(arguments);
  EXPECT_THAT(outward.error,
              AllOf(HasSubstr("100.0 % of the pairs face away."), HasSubstr("use --flip"), HasSubstr("--two-sided")));
  const Outcome flipped = run_program(with(arguments, {"--flip"}));
  EXPECT_EQ(nlohmann::json::parse(flipped.out)["pairs"]["clear"], 4);
  EXPECT_THAT(flipped.error, testing::Not(HasSubstr("face away")));
  EXPECT_THAT(run_program(with(arguments, {"--two-sided"})).error, testing::Not(HasSubstr("face away")));
  static_cast<void>(refusal_of(with(arguments, {"--flip", "--two-sided"})));
}

TEST_F(CliSeesMesh, CoordinatesThatFloatsCannotHoldAreToldInNumbers) {
  const auto wall = [](const std::string& x, const std::string& thicker_x) {
    return "v " + x + " 0 0\nv " + thicker_x + " 0 0\nv " + thicker_x + " 3 0\nv " + x + " 3 0\nf 1 2 3 4\n";
  };
  const auto said = [](const std::string& file, const std::vector<std::string>& more = {}) {
    return run_program(with({"sees", file, "--patches", "0.25"}, more)).error;
  };
  const std::string map = folder_.write("map.obj", wall("4512345", "4512345.5"));
  EXPECT_THAT(said(map, {"--origin", "0,0,0"}),
              AllOf(HasSubstr("Coordinates reach 4512345.5, where floats are 0.5 apart"), HasSubstr("patches are 0.25"),
                    HasSubstr("the thinnest object is 0.5 thick"), HasSubstr("--origin moves the scene"),
                    HasSubstr("floats are 1e-07 apart"), testing::Not(HasSubstr("relative"))));
  EXPECT_THAT(said(map), AllOf(HasSubstr("Coordinates are relative to 4512345, 2, 0"),
                               testing::Not(HasSubstr("Coordinates reach"))));
  EXPECT_THAT(said(folder_.write("near.obj", wall("4", "4.5"))), testing::Not(HasSubstr("relative")));
  EXPECT_THAT(said(folder_.write("near.obj", wall("4", "4.5"))), testing::Not(HasSubstr("Coordinates reach")));
}

/// A room with a wall of 0.2 m in it, moved: coordinates have as many digits as they need.
std::string room_at(double x, double y) {
  std::ostringstream obj;
  obj.precision(17);
  const auto box = [&](const char* name, std::array<double, 3> lo, std::array<double, 3> hi, bool inwards, int first) {
    obj << "o " << name << '\n';
    for (int c = 0; c != 8; ++c) {
      obj << "v " << (c % 2 == 0 ? lo[0] : hi[0]) + x << ' ' << (c / 2 % 2 == 0 ? lo[1] : hi[1]) + y << ' '
          << (c / 4 == 0 ? lo[2] : hi[2]) << '\n';
    }
    for (const auto& f :
         {std::array{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5}, {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}}) {
      obj << 'f';
      for (int i = 0; i != 4; ++i) {
        const auto at = static_cast<std::size_t>(inwards ? 3 - i : i);
        obj << ' ' << f[at] + first;
      }
      obj << '\n';
    }
  };
  box("room", {0, 0, 0}, {8, 6, 3}, true, 0);
  box("wall", {3.875, 1.5, 0}, {4.125, 6, 3}, false, 8);
  return obj.str();
}

/// The coordinates of vertices in a PLY file, and the answers behind them.
struct PlyFile {
  std::vector<std::array<double, 3>> vertices;
  std::string answers;
};
PlyFile ply_in(const std::string& path) {
  std::ifstream file(path);
  PlyFile ply;
  bool is_header = true;
  for (std::string line; std::getline(file, line);) {
    if (is_header) {
      is_header = line != "end_header";
      continue;
    }
    std::istringstream words(line);
    std::array<double, 3> at{};
    int colours = 0;
    const bool is_face = line.starts_with("3 ") && std::count(line.begin(), line.end(), ' ') == 6;
    if (!ply.answers.empty() || (is_face && !ply.vertices.empty() && ply.vertices.size() % 3 == 0)) {
      ply.answers += line + '\n';
    } else if (words >> at[0] >> at[1] >> at[2] >> colours) {
      ply.vertices.push_back(at);
    }
  }
  return ply;
}

TEST_F(CliSeesMesh, InMapCoordinatesTheAnswersAreThoseOfTheSameSceneAtZero) {
  const auto seen = [&](const std::string& name, const std::string& obj, const std::vector<std::string>& more) {
    const std::string ply = folder_.path(name + ".ply");
    const std::vector<std::string> arguments{
        "sees", folder_.write(name + ".obj", obj), "--patches", "1", "--ply", ply, "--format", "json"};
    return std::pair(nlohmann::json::parse(output_of(with(arguments, more)))["pairs"], ply_in(ply));
  };
  // 4 is the middle of the room, so that the origin that is chosen is that of the first.
  const auto [at_zero, ply_at_zero] = seen("zero", room_at(0, 0), {"--origin", "4,3,2"});
  const auto [on_map, ply_on_map] = seen("map", room_at(4512345, 5400123), {});
  EXPECT_EQ(on_map, at_zero);
  EXPECT_GT(at_zero["occluded"], 0);
  EXPECT_EQ(ply_on_map.answers, ply_at_zero.answers);
  ASSERT_EQ(ply_on_map.vertices.size(), ply_at_zero.vertices.size());
  for (std::size_t i = 0; i != ply_on_map.vertices.size(); ++i) {
    EXPECT_EQ(ply_on_map.vertices[i][0] - 4512345, ply_at_zero.vertices[i][0]) << i;
    EXPECT_EQ(ply_on_map.vertices[i][1] - 5400123, ply_at_zero.vertices[i][1]) << i;
    EXPECT_EQ(ply_on_map.vertices[i][2], ply_at_zero.vertices[i][2]) << i;
  }
  for (const char* subcommand : {"sees", "factors"}) {
    const std::string npz = folder_.path(std::string(subcommand) + ".npz");
    static_cast<void>(output_of({subcommand, folder_.path("map.obj"), "--patches", "4", "--out", npz}));
    std::ifstream file(npz, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    EXPECT_NE(bytes.find("origin.npy"), std::string::npos) << subcommand;
  }
  const auto [rounded, ply_rounded] = seen("rounded", room_at(4512345, 5400123), {"--origin", "0,0,0"});
  EXPECT_NE(rounded, at_zero);
}

TEST_F(CliSeesMesh, AnOriginMayBeGivenAndIsThatOfAllFiles) {
  const std::string first = folder_.write("first.obj", "v 1000 0 0\nv 1001 0 0\nv 1000 1 0\nf 1 2 3\n");
  const std::string second = folder_.write("second.obj", "v 0 0 5\nv 0 1 5\nv 1 0 5\nf 1 2 3\n");
  const std::string ply = folder_.path("both.ply");
  EXPECT_THAT(run_program({"sees", first, second, "--patches", "9"}).error, HasSubstr("relative to 1001, 1, 0"));
  EXPECT_THAT(run_program({"sees", second, "--patches", "9", "--origin", "1,2,3.5", "--ply", ply}).error,
              HasSubstr("relative to 1, 2, 3.5"));
  EXPECT_EQ(ply_in(ply).vertices.front(), (std::array<double, 3>{0, 0, 5}));
  EXPECT_THAT(refusal_of({"sees", first, "--origin", "1,2"}), HasSubstr("--origin"));
  EXPECT_THAT(refusal_of({"sees", first, "--origin", "1,2,nan"}), HasSubstr("finite"));
  EXPECT_THAT(refusal_of({"sees", "--rooms", "1", "--origin", "1,2,3"}), HasSubstr("--origin"));
  // Vertices that only assimp reads are left to it, unless they have to be moved.
  for (const char* vertex : {"v 1000 0 \\\n0", "v 2000 0 0 2", "v 1000 nan 0"}) {
    const std::string odd = folder_.write("odd.obj", std::string("v 1000 1 0\nv 1001 0 0\n") + vertex + "\nf 1 2 3\n");
    EXPECT_THAT(run_program({"sees", odd, "--patches", "9"}).error, testing::Not(HasSubstr("relative"))) << vertex;
    EXPECT_THAT(refusal_of({"sees", odd, "--origin", "1,2,3"}), HasSubstr("odd.obj:3: \"v ")) << vertex;
  }
  const std::string plus = folder_.write("plus.obj", "v +1000 0 0 0.5 0.5 0.5\nv 1001 0 0 1\nv +1000 1 0\nf 1 2 3\n");
  EXPECT_THAT(run_program({"sees", plus, "--patches", "9"}).error, HasSubstr("relative to 1001, 1, 0"));
}

/// What the program calls the objects of a scene: those that it names where one is missing.
std::string names_in(const std::vector<std::string>& arguments) {
  return refusal_of(with(with({"sees"}, arguments), {"--solid", "no such name"}));
}

TEST_F(CliSeesMesh, FilesAreOneSceneAndNameTheirOnlyObject) {
  const auto stl = [&](const std::string& name, const std::string& z) {
    return folder_.write(name, "solid exported\nfacet normal 0 0 1\nouter loop\nvertex 0 0 " + z + "\nvertex 1 0 " + z +
                                   "\nvertex 0 1 " + z + "\nendloop\nendfacet\nendsolid exported\n");
  };
  const std::string two = folder_.write("two.obj", "o a\nv 0 0 5\nv 0 1 5\nv 1 0 5\nf 1 2 3\no b\nf 1 2 3\n");
  const std::vector<std::string> files{stl("floor.stl", "0"), stl("roof.stl", "1"), two};
  const auto report =
      nlohmann::json::parse(output_of(with(with({"sees"}, files), {"--patches", "9", "--format", "json"})));
  EXPECT_EQ(report["objects"], 4);
  EXPECT_EQ(report["scene"], files[0] + " and 2 more files");
  EXPECT_EQ(report["pairs"]["all"], 6);
  EXPECT_THAT(names_in(files),
              AllOf(HasSubstr("'floor'"), HasSubstr("'roof'"), HasSubstr("'two/a'"), HasSubstr("'two/b'")));
}

TEST_F(CliSeesMesh, ANodeWithoutANameHasThatOfItsMesh) {
  const std::string file =
      folder_.write("leaves.gltf", gltf_of_nodes({R"({"mesh":0})", R"({"mesh":0})", R"({"name":"stem","mesh":0})"}));
  EXPECT_THAT(names_in({file}), AllOf(HasSubstr("'leaf'"), HasSubstr("'leaf #2'"), HasSubstr("'stem'")));
}

TEST_F(CliSeesMesh, MaterialsCanBeObjects) {
  const std::string file = folder_.write("house.obj",
                                         "o north\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl brick\nf 1 2 3\nusemtl glass\n"
                                         "f 1 2 3\no south\nusemtl brick\nf 1 2 3\n");
  EXPECT_THAT(names_in({file}), AllOf(HasSubstr("'north'"), HasSubstr("'south'"), testing::Not(HasSubstr("brick"))));
  EXPECT_THAT(names_in({file, "--by-material"}),
              AllOf(HasSubstr("'brick'"), HasSubstr("'glass'"), testing::Not(HasSubstr("north"))));
}

TEST_F(CliSeesMesh, ForAFileOfAnUnknownKindThoseThatCanBeReadAreNamed) {
  const std::string radiance = folder_.write("x.mgf", "m brick = v\n");
  EXPECT_THAT(refusal_of({"sees", radiance}),
              AllOf(HasSubstr("x.mgf: files of this kind cannot be read; convert the file, for example with Blender"),
                    HasSubstr(" .obj "), HasSubstr(" .stl "), testing::Not(HasSubstr("too small"))));
  EXPECT_THAT(refusal_of({"sees", folder_.write("x.glb", "not that")}), HasSubstr("assimp reports: "));
}

TEST_F(CliSeesMesh, NumbersOfJsonAreShort) {
  const std::string json = output_of({"sees", file(upright_wall()), "--format", "json"});
  for (const std::string key : {"seconds", "pairs_per_second", "patch_size"}) {
    const std::size_t begin = json.find(key + "\": ") + key.size() + 3;
    EXPECT_LE(json.find_first_of(",\n", begin) - begin, 12) << json.substr(begin, 30);
  }
}

TEST_F(CliSeesMesh, AMeshOfPatchesHasTheirShares) {
  const std::string ply = folder_.path("seen.ply");
  static_cast<void>(output_of({"sees", file(""), "--patches", "9", "--ply", ply}));
  const std::vector<std::string> said = lines(bytes_of_file(ply));
  EXPECT_EQ(said[0], "ply");
  EXPECT_THAT(said, testing::IsSupersetOf({"comment object 0 left", "comment object 1 right", "element vertex 12",
                                           "element face 4", "property float seen", "end_header"}));
  // Each triangle sees the two of the other square, of three others; the last corner is the first of the file's last
  // face.
  EXPECT_EQ(said[said.size() - 5], "10 1 -1 252 255 164");
  EXPECT_THAT(std::vector<std::string>(said.end() - 4, said.end()),
              testing::ElementsAre("3 0 1 2 0 0.666667 0", "3 3 4 5 0 0.666667 0", "3 6 7 8 1 0.666667 0",
                                   "3 9 10 11 1 0.666667 0"));
  // It is a mesh that the program reads itself: its patches.
  EXPECT_EQ(nlohmann::json::parse(output_of({"sees", ply, "--patches", "9", "--format", "json"}))["patches"], 4);
}

TEST_F(CliSeesMesh, CoordinatesCanBeScaled) {
  const auto report = [&](const std::vector<std::string>& more) {
    return nlohmann::json::parse(output_of(with({"sees", file(""), "--format", "json"}, more)));
  };
  const nlohmann::json metres = report({"--patches", "0.6"});
  const nlohmann::json kilometres = report({"--patches", "0.0006", "--scale", "0.001"});
  EXPECT_EQ(kilometres["patches"], metres["patches"]);
  EXPECT_EQ(kilometres["pairs"], metres["pairs"]);
  EXPECT_THAT(
      refusal_of({"sees", folder_.write("large.obj", "v 0 0 0\nv 1e35 0 0\nv 0 1e35 0\nf 1 2 3\n"), "--scale", "1e9"}),
      HasSubstr("--scale 1000000000: coordinates would be too large for floats"));
}

TEST_F(CliSeesMesh, ADentIsNotSolid) {
  std::string dented = upright_wall();
  dented.replace(dented.find("v 4 5 5"), 7, "v 5 1 1");
  EXPECT_THAT(output_of({"sees", file(dented), "--patches", "2", "--solid", "wall"}),
              HasSubstr("--solid: skipped 1 object that cannot be solid; the first is 'wall': it is not convex\n"));
}

TEST_F(CliSeesMesh, FilesThatAreNotThereAreNamed) {
  EXPECT_THAT(refusal_of({"sees", folder_.path("none.obj")}),
              AllOf(HasSubstr("none.obj: there is no such file"), HasSubstr("OBJ")));
}

TEST_F(CliSeesMesh, TrianglesWithoutAnAreaGiveNoPatches) {
  const std::string line = folder_.write("line.obj", "o a\nv 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n");
  EXPECT_THAT(refusal_of({"sees", line}), HasSubstr("no triangle has an area"));
}

TEST_F(CliSeesMesh, AFileIsTakenByOptionToo) {
  EXPECT_THAT(refusal_of({"sees", "--scene", "none.obj"}), HasSubstr("none.obj: there is no such file"));
}

}  // namespace
}  // namespace shaftcull::test
