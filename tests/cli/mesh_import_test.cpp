// SPDX-License-Identifier: MIT
/// Meshes that arrive on standard input, and what formats do with axes and names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/program.hpp"

namespace shaftcull::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class CliMeshImport : public testing::Test {
 protected:
  /// What `sees -` does with these bytes on standard input.
  [[nodiscard]] Outcome sees_input(const std::string& bytes, const std::vector<std::string>& more = {}) const {
    return run_program(with({"sees", "-", "--patches", "9", "--format", "json"}, more), "",
                       "<'" + folder_.write("input", bytes) + "'");
  }
  [[nodiscard]] std::string refused_input(const std::string& bytes) const {
    const Outcome outcome = sees_input(bytes);
    expect_refusal(outcome);
    return outcome.error;
  }

  ScratchFolder folder_;
};

constexpr const char* obj = "# two facets\no a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no b\nv 0 0 2\nf 4 2 3\n";
constexpr const char* ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
constexpr const char* stl =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
    "endsolid a\n";
/// The same facet at (4512345.125, 0, 0).
constexpr const char* ply_on_map =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty uchar red\nproperty double x\nproperty double y\n"
    "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "9 4512345.125 0 0\n9 4512346.125 0 0\n9 4512345.125 1 0\n3 0 1 2\n";
constexpr const char* stl_on_map =
    "solid a\nfacet normal 0 0 1\nouter loop\n  vertex 4512345.125 0 0\n  vertex 4512346.125 0 0\n"
    "  vertex 4.512345125e6 1 0\nendloop\nendfacet\nendsolid a\n";
constexpr const char* off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
constexpr const char* gltf = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"name":"shelf","children":[1]},{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
                             "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";

/// A wall 4 m long, 0.2 m thick and 3 m high, in millimetres, from (1, 0.5, 0) on.
constexpr const char* ifc = R"(ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('ViewDefinition [CoordinationView]'),'2;1');
FILE_NAME('wall.ifc','2020-01-01T00:00:00',(''),(''),'','','');
FILE_SCHEMA(('IFC2X3'));
ENDSEC;
DATA;
#5=IFCOWNERHISTORY($,$,$,.ADDED.,$,$,$,0);
#6=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);
#8=IFCUNITASSIGNMENT((#6));
#9=IFCCARTESIANPOINT((0.,0.,0.));
#10=IFCAXIS2PLACEMENT3D(#9,$,$);
#11=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#10,$);
#12=IFCPROJECT('p',#5,'project',$,$,$,$,(#11),#8);
#13=IFCLOCALPLACEMENT($,#10);
#14=IFCSITE('s',#5,'site',$,$,#13,$,$,.ELEMENT.,$,$,$,$,$);
#17=IFCRELAGGREGATES('r',#5,$,$,#12,(#14));
#20=IFCCARTESIANPOINT((2000.,100.));
#21=IFCDIRECTION((1.,0.));
#22=IFCAXIS2PLACEMENT2D(#20,#21);
#23=IFCRECTANGLEPROFILEDEF(.AREA.,$,#22,4000.,200.);
#24=IFCDIRECTION((0.,0.,1.));
#25=IFCEXTRUDEDAREASOLID(#23,#10,#24,3000.);
#26=IFCSHAPEREPRESENTATION(#11,'Body','SweptSolid',(#25));
#27=IFCPRODUCTDEFINITIONSHAPE($,$,(#26));
#28=IFCCARTESIANPOINT((1000.,500.,0.));
#29=IFCAXIS2PLACEMENT3D(#28,$,$);
#30=IFCLOCALPLACEMENT(#13,#29);
#31=IFCWALL('w',#5,'north',$,$,#30,#27,$);
#32=IFCRELCONTAINEDINSPATIALSTRUCTURE('c',#5,$,$,(#31),#14);
ENDSEC;
END-ISO-10303-21;
)";

TEST_F(CliMeshImport, StandardInputHasTheFormatThatItsFirstBytesShow) {
  const std::vector<std::pair<const char*, const char*>> meshes{{obj, "x.obj"}, {ply, "x.ply"},   {stl, "x.stl"},
                                                                {off, "x.off"}, {gltf, "x.gltf"}, {ifc, "x.ifc"}};
  for (const auto& [bytes, name] : meshes) {
    const Outcome streamed = sees_input(bytes);
    ASSERT_EQ(streamed.exit_code, 0) << name << ": " << streamed.error;
    const auto of_stream = nlohmann::json::parse(streamed.out);
    const std::string file = folder_.write(name, bytes);
    const auto of_file = nlohmann::json::parse(output_of({"sees", file, "--patches", "9", "--format", "json"}));
    EXPECT_EQ(of_stream["scene"], "standard input") << name;
    EXPECT_EQ(of_stream["triangles"], of_file["triangles"]) << name;
    EXPECT_EQ(of_stream["pairs"], of_file["pairs"]) << name;
  }
}

TEST_F(CliMeshImport, ABinaryStlIsToldByItsLength) {
  const float facet[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::string binary = std::string(80, 's') + std::string("\1\0\0\0", 4);
  binary += std::string(reinterpret_cast<const char*>(facet), sizeof facet) + std::string(2, '\0');
  EXPECT_EQ(nlohmann::json::parse(sees_input(binary).out)["triangles"], 1);
  EXPECT_THAT(refused_input(binary + "?"), HasSubstr("does not begin like"));
}

TEST_F(CliMeshImport, InputOfNoKnownFormatIsRefused) {
  EXPECT_THAT(refused_input("hello\n"), HasSubstr("standard input: does not begin like OBJ, PLY, STL"));
  EXPECT_THAT(refused_input(""), HasSubstr("standard input: "));
  EXPECT_THAT(refused_input("ply\nformat ascii 1.0\n"),
              HasSubstr("standard input: the file is broken: its PLY header"));
  EXPECT_THAT(refused_input("{\"asset\": "),
              AllOf(HasSubstr("begins like a file of format gltf"), HasSubstr("assimp")));
}

/// The file `ply_on_map` with its vertices and faces in binary.
std::string binary_ply_on_map(bool is_big_endian) {
  std::string bytes = ply_on_map;
  bytes.resize(bytes.find("end_header\n") + std::string_view("end_header\n").size());
  bytes.replace(bytes.find("ascii"), 5, is_big_endian ? "binary_big_endian" : "binary_little_endian");
  const auto add = [&](auto value) {
    std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
    if (is_big_endian == (std::endian::native == std::endian::little)) std::reverse(raw.begin(), raw.end());
    bytes += raw;
  };
  for (const auto& [x, y] : {std::pair(4512345.125, 0.0), {4512346.125, 0.0}, {4512345.125, 1.0}}) {
    add(std::uint8_t{9});
    for (const double coordinate : {x, y, 0.0}) add(coordinate);
  }
  add(std::uint8_t{3});
  for (const std::int32_t corner : {0, 1, 2}) add(corner);
  return bytes;
}

TEST_F(CliMeshImport, FormatsThatHaveDoublesKeepAllDigitsInMapCoordinates) {
  const std::vector<std::pair<std::string, const char*>> meshes{{ply_on_map, "text.ply"},
                                                                {binary_ply_on_map(false), "little.ply"},
                                                                {binary_ply_on_map(true), "big.PLY"},
                                                                {stl_on_map, "text.stl"}};
  const std::vector<std::string> everything{"--hull", "4512340,-9,-9,4512350,9,9", "--bounds", "object", "--format",
                                            "csv"};
  const std::string exact = ",inside,4512345.125,0,0,4512346.125,1,0\n";
  for (const auto& [bytes, name] : meshes) {
    const std::string file = folder_.write(name, bytes);
    EXPECT_THAT(output_of(with({"cull", file}, everything)), HasSubstr(exact)) << name;
    EXPECT_THAT(output_of(with({"cull", file, "--origin", "4512345,0.25,3"}, everything)), HasSubstr(exact)) << name;
    EXPECT_THAT(output_of(with({"cull", file, "--origin", "0,0,0"}, everything)), HasSubstr("4512345,0,0,4512346,1,0"))
        << name;
    const Outcome streamed = run_program(with({"cull", "-"}, everything), "", "<'" + file + "'");
    EXPECT_THAT(streamed.out, HasSubstr(exact)) << name << ": " << streamed.error;
  }
}

TEST_F(CliMeshImport, NoVertexStaysBehindWhereAssimpDividesTextInOtherWays) {
  // Where a file is read in doubles or not: its box is where it is in the file, but for the rounding of floats there.
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
      text.replace(at, from.size(), to);
    }
    return text;
  };
  const std::string obj_on_map = "o t\nv 4512345 0 0\nv 4512347 0 0\nv 4512345 3 0\nf 1 2 3\n";
  const std::string stl_near = replaced(replaced(stl_on_map, "4512345.125", "4512345"), "4512346.125", "4512347");
  const std::string ply_near = replaced(replaced(ply_on_map, "4512345.125", "4512345"), "4512346.125", "4512347");
  const std::vector<std::pair<std::string, const char*>> meshes{
      {replaced(stl_near, "outer loop\n", "outer loop "), "first.stl"},
      {replaced(stl_near, "\n", " "), "line.stl"},
      {replaced(stl_near, "\n", "\r"), "macintosh.stl"},
      {replaced(stl_near, "vertex ", "vertex\f"), "feed.stl"},
      {replaced(obj_on_map, "\n", "\r"), "macintosh.obj"},
      {replaced(obj_on_map, "o t\n", "o t\n v 4512345 77 0\n"), "indented.obj"},
      {replaced(replaced(ply_near, "double", "uint"), "e6", ""), "whole.ply"}};
  for (const auto& [bytes, name] : meshes) {
    const std::string file = folder_.write(name, bytes);
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--origin", "4512345.5,0,1"}}) {
      const Outcome outcome =
          run_program(with({"cull", file, "--hull", "4512340,-9,-9,4512350,9,9", "--format", "csv"}, more));
      if (outcome.exit_code != 0) {
        expect_refusal(outcome);  // one line that says so is as good
        continue;
      }
      EXPECT_THAT(outcome.out, HasSubstr(",4512345,0,0,4512347,")) << name << ' ' << more.size();
      EXPECT_THAT(outcome.out, testing::Not(HasSubstr("77"))) << name << ' ' << more.size();
    }
  }
}

TEST_F(CliMeshImport, ABinaryPlyMayBeginWithAnyByteWhenItIsMoved) {
  // 63.041 - 5.211 begins with the byte 10, which assimp takes for the end of a line.
  std::string bytes = binary_ply_on_map(false);
  bytes.erase(bytes.find("property uchar red\n"), std::string_view("property uchar red\n").size());
  const std::size_t data = bytes.find("end_header\n") + std::string_view("end_header\n").size();
  std::string vertices;
  for (const double x : {63.041, 0.0, 0.0, 64.041, 0.0, 0.0, 63.041, 1.0, 0.0}) {
    vertices += std::string(reinterpret_cast<const char*>(&x), sizeof x);
  }
  bytes = bytes.substr(0, data) + vertices + bytes.substr(bytes.size() - 13);
  const std::string file = folder_.write("ten.ply", bytes);
  for (const char* origin : {"5.211,0,0", "0,0,0", "1,2,3"}) {
    EXPECT_THAT(output_of({"cull", "--origin", origin, file, "--hull", "60,-9,-9,70,9,9", "--format", "csv"}),
                HasSubstr("63.041,0,0,64.041,1,0\n"))
        << origin;
  }
}

TEST_F(CliMeshImport, WithoutAnOriginVerticesThatOnlyTheReaderKnowsAreLeftToIt) {
  // Lists in vertices, faces before vertices, and floats: no digits are lost, or they cannot be found here.
  const auto relative = [&](std::string bytes, const std::string& from, const std::string& to) {
    bytes.replace(bytes.find(from), from.size(), to);
    return sees_input(bytes).error.find("relative to") != std::string::npos;
  };
  EXPECT_TRUE(relative(ply_on_map, "9 4512345.125 0 0", "9 4512345.125 0 0"));
  EXPECT_FALSE(relative(ply_on_map, "property uchar red", "property list uchar int red"));
  EXPECT_FALSE(relative(ply_on_map, "element vertex 3", "element other 0\nelement vertex 3"));
  EXPECT_FALSE(relative(ply_on_map, "9 4512345.125 0 0", "9 nan 0 0"));
  EXPECT_FALSE(relative(ply_on_map, "double y", "double x"));
  EXPECT_FALSE(relative(ply_on_map, "double y", "int y"));
  EXPECT_FALSE(relative(ply_on_map, "format ascii", "format Ascii"));
  std::string endless = ply_on_map;
  endless.replace(endless.find("end_header"), 10, "end_headers");
  EXPECT_THAT(refused_input(endless), HasSubstr("its PLY header"));
  EXPECT_FALSE(relative(stl_on_map, "vertex 4512345.125 0 0", "vertex 4512345.125 0"));
}

TEST_F(CliMeshImport, ANodeWithoutAnyNameHasThatOfTheNodeAbove) {
  const Outcome outcome = sees_input(gltf, {"--solid", "none"});
  EXPECT_THAT(outcome.error, HasSubstr("'shelf'"));
}

TEST_F(CliMeshImport, ZPointsUpInIfcAndWallsStayUpright) {
  const std::string ply_file = folder_.path("wall.ply");
  const Outcome outcome = sees_input(ifc, {"--ply", ply_file});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  std::ifstream file(ply_file);
  std::string line;
  while (std::getline(file, line) && line != "end_header") continue;
  const float y[2] = {0.5F, 0.7F};
  const float z[2] = {0, 3};
  for (int corner = 0; corner != 36; ++corner) {
    double p[3];
    ASSERT_TRUE(file >> p[0] >> p[1] >> p[2]);
    std::getline(file, line);
    EXPECT_NEAR(p[0], p[0] < 3 ? 1 : 5, 1e-6);
    EXPECT_NEAR(p[1], p[1] < 0.6 ? y[0] : y[1], 1e-6);
    EXPECT_NEAR(p[2], p[2] < 1 ? z[0] : z[1], 1e-6);
    EXPECT_EQ(p[2] < 1 ? p[2] : 0, 0) << "the foot is on the ground";
  }
}

}  // namespace
}  // namespace shaftcull::test
