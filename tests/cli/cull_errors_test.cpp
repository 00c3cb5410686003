// SPDX-License-Identifier: MIT
/// What `shaftcull cull` refuses, and how it says so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/cull_scene.hpp"

namespace shaftcull::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST_F(CliCull, RefusesOptionsOfShaftsThatDoNotGoTogether) {
  const std::vector<std::string> ends{"--from", "left", "--to", "right"};
  const std::vector<std::string> body{"--from", "left", "--swept", "1,0,0"};
  const std::vector<std::string> hull{"--hull", "0,0,0,1,1,1"};
  for (const auto& arguments :
       {with(ends, {"--swept", "1,0,0"}), with(ends, {"--infinite"}), with(ends, {"--reach", "2"}),
        with(ends, {"--towards", "1,0,0"}), with(ends, {"--shadow", "--solid"}), with(body, {"--shadow"}),
        with(body, {"--solid"}), with(hull, ends), with(hull, {"--swept", "1,0,0"}), with(hull, {"--shadow"}),
        with(hull, {"--random", "2"}), with(hull, {"--times"}), with(hull, {"--first"}), with(hull, {"--solid"}),
        with(ends, {"--triangles", "exact", "--times"}), with(ends, {"--triangles", "exact", "--first"}),
        with(ends, {"--triangles", "exact", "--bounds", "object"}), std::vector<std::string>{"--swept", "1,0,0"},
        std::vector<std::string>{"--shadow", "--from", "left"}}) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    expect_refusal(cull(arguments));
  }
}

TEST_F(CliCull, RejectsAMissingFileInOneLine) {
  const Outcome outcome = run_program({"cull", "--scene", folder_.path("no such.obj"), "--random", "1"});
  expect_refusal(outcome);
  EXPECT_THAT(outcome.error, HasSubstr("no such.obj: there is no such file"));
}

TEST_F(CliCull, RejectsAnEmptyFileInOneLine) {
  const Outcome outcome = run_program({"cull", "--scene", folder_.write("empty.obj", ""), "--random", "1"});
  expect_refusal(outcome);
  EXPECT_THAT(outcome.error, HasSubstr("the file is empty"));
}

TEST_F(CliCull, RejectsADirectoryInOneLine) {
  const Outcome outcome = run_program({"cull", "--scene", folder_.path("."), "--random", "1"});
  expect_refusal(outcome);
  EXPECT_THAT(outcome.error, HasSubstr("is a directory"));
}

TEST_F(CliCull, RejectsBrokenFilesInOneLine) {
  const std::string half_a_glb("glTF\x02\0\0\0\xff\xff\0\0", 12);
  for (const std::string& path :
       {folder_.write("broken.obj", "v 0 0\nf 1 2 3\nf 9 9 9\n"),
        folder_.write("broken.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"),
        folder_.write("broken.gltf", "{\"asset\": "), folder_.write("broken.glb", half_a_glb),
        folder_.write("noise.stl", "\x01\x02\x03"), folder_.write("comment.obj", "# nothing\n"),
        folder_.write("unknown.xyz", "1 2 3\n")}) {
    SCOPED_TRACE(path);
    const Outcome outcome = run_program({"cull", "--scene", path, "--random", "1"});
    expect_refusal(outcome);
    EXPECT_THAT(outcome.error, HasSubstr(path));
  }
}

TEST_F(CliCull, OutlivesAFileThatCrashesItsReader) {
  const std::string path = folder_.write("cut.ply",
                                         "ply\nformat binary_little_endian 1.0\nelement vertex 1000\nproperty float x\n"
                                         "property float y\nproperty float z\nelement face 500\n"
                                         "property list uchar int vertex_index\nend_header\n0123456789");
  const Outcome outcome = run_program({"cull", "--scene", path, "--random", "1"});
  expect_refusal(outcome);
  EXPECT_THAT(outcome.error, HasSubstr(path));
}

TEST_F(CliCull, RejectsANanVertexAndNamesItsObject) {
  const std::string path = folder_.write("nan.obj", "o sick\nv 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
  const Outcome outcome = run_program({"cull", "--scene", path, "--random", "1"});
  expect_refusal(outcome);
  // One coordinate is NaN, so one is named.
  EXPECT_THAT(outcome.error, AllOf(HasSubstr("x of vertex 1 of 'sick' is nan"), Not(HasSubstr("y of"))));
}

TEST_F(CliCull, NamesTheObjectsThereAreForAnUnknownName) {
  const Outcome outcome = cull({"--from", "Left", "--to", "right"});
  expect_refusal(outcome);
  EXPECT_THAT(outcome.error, HasSubstr("--from Left"));
  EXPECT_THAT(outcome.error, HasSubstr("'left'"));
  EXPECT_THAT(outcome.error, HasSubstr("'middle'"));
}

TEST_F(CliCull, NamesTheClosestOfManyNames) {
  std::vector<Cube> cubes;
  for (int i = 0; i < 40; ++i) cubes.push_back({"thing" + std::to_string(100 + i), 3.0 * i, 0, 1});
  cubes.push_back({"lampshade", 0, 5, 1});
  const std::string path = folder_.write("many.obj", obj_of(cubes));
  const Outcome outcome = run_program({"cull", "--scene", path, "--from", "lampshde", "--to", "thing100"});
  expect_refusal(outcome);
  EXPECT_THAT(outcome.error, HasSubstr("'lampshade'"));
  EXPECT_THAT(outcome.error, HasSubstr("32 more"));
}

TEST_F(CliCull, RejectsBoxesThatNoShaftCanHave) {
  expect_refusal(cull({"--from", "1,0,0,0,1,1", "--to", "right"}));
  expect_refusal(cull({"--from", "nan,0,0,1,1,1", "--to", "right"}));
  expect_refusal(cull({"--from", "0,0,0,1,1", "--to", "right"}));
}

TEST_F(CliCull, RejectsContradictoryOptions) {
  expect_refusal(cull({}));
  expect_refusal(cull({"--from", "left"}));
  expect_refusal(cull({"--from", "left", "--to", "right", "--random", "2"}));
  expect_refusal(cull({"--random", "0"}));
  expect_refusal(cull({"--random", "2", "--format", "xml"}));
}

TEST_F(CliCull, TakesAFileWithoutAnOption) {
  const Outcome outcome = run_program({"cull", row_, "--from", "left", "--to", "right"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(outcome.out, cull({"--from", "left", "--to", "right"}).out);
}

TEST_F(CliCull, SaysWhatToAddToAFile) {
  const Outcome outcome = run_program({"cull", row_});
  expect_refusal(outcome);
  EXPECT_THAT(outcome.error,
              AllOf(HasSubstr("--from NAME --to NAME, or --random 10"), HasSubstr("'left'"), HasSubstr("'aside'")));
}

TEST_F(CliCull, SaysWhereTheFileBelongs) {
  const Outcome outcome = run_program({"cull"});
  expect_refusal(outcome);
  EXPECT_THAT(outcome.error, HasSubstr("shaftcull cull FILE"));
}

TEST_F(CliCull, RefusesABoxOfFiveNumbersAsABox) {
  const Outcome outcome = cull({"--from", "0,0,0,1,1", "--to", "right"});
  expect_refusal(outcome);
  EXPECT_THAT(outcome.error, HasSubstr("--from 0,0,0,1,1: 5 numbers; a box takes six"));
}

TEST_F(CliCull, KeepsControlCharactersOfNamesFromTheTerminal) {
  const std::string path = folder_.write(
      "red.obj",
      obj_of({{"left\x1b[31m", 0, 0, 1}, {"mid\x1b]0;x", 5, 0, 1}, {"right", 10, 0, 1}, {"aside", 5, 9, 1}}));
  const Outcome outcome = run_program({"cull", path, "--from", "left\x1b[31m", "--to", "right"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("left\\x1b[31m -> right"), HasSubstr("mid\\x1b]0;x"), Not(HasSubstr("\x1b"))));
  const Outcome error = run_program({"cull", path});
  EXPECT_THAT(error.error, AllOf(HasSubstr("left\\x1b[31m"), Not(HasSubstr("\x1b"))));
}

}  // namespace
}  // namespace shaftcull::test
