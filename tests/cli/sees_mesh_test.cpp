// SPDX-License-Identifier: MIT
/// `shaftcull sees` of mesh files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
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

TEST_F(CliSeesMesh, ASolidAroundAPatchBlocksUnlessThereAreRays) {
  const std::string around_left =
      hexahedron("wall", {"-1 -5 -5", "1 -5 -5", "1 5 -5", "-1 5 -5", "-1 -5 5", "1 -5 5", "1 5 5", "-1 5 5"});
  EXPECT_THAT(across(around_left, {"--solid", "wall"}), Each("occluded"));
  EXPECT_THAT(across(around_left, {"--solid", "wall", "--rays", "4"}), Each(testing::StartsWith("undecided,")));
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
  EXPECT_THAT(outward.error, AllOf(HasSubstr("100.0 % of the pairs face away."), HasSubstr("--flip turns them round"),
                                   HasSubstr("--two-sided")));
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
  const auto said = [](const std::string& file) { return run_program({"sees", file, "--patches", "0.25"}).error; };
  EXPECT_THAT(said(folder_.write("map.obj", wall("4512345", "4512345.5"))),
              AllOf(HasSubstr("Coordinates reach 4512345.5, where floats are 0.5 apart"), HasSubstr("patches are 0.25"),
                    HasSubstr("the thinnest object 0.5"), HasSubstr("where floats are 1e-07 apart")));
  EXPECT_THAT(said(folder_.write("near.obj", wall("4", "4.5"))), testing::Not(HasSubstr("Coordinates reach")));
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
              AllOf(HasSubstr("x.mgf: files of this kind cannot be read; convert it to one of"), HasSubstr(" .obj "),
                    HasSubstr(" .stl "), testing::Not(HasSubstr("too small"))));
  EXPECT_THAT(refusal_of({"sees", folder_.write("x.glb", "not that")}), HasSubstr("assimp says: "));
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
      HasSubstr("--scale 1000000000: coordinates are too large then for floats"));
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
