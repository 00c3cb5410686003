// SPDX-License-Identifier: MIT
/// A reader of mesh files that crashes, or does not end, does not take the program with it. The reader here stands for
/// assimp's.
#include <gmock/gmock.h>

#include <csignal>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>

#include "isolated_mesh.hpp"
#include "message_of.hpp"

namespace shaftcull::cli {

MeshScene load_mesh(const std::string& path, const MeshReading& reading) {
  if (path == "crash.obj") {
    std::signal(SIGSEGV, SIG_DFL);  // whatever a sanitizer would say
    std::raise(SIGSEGV);
  }
  if (path == "abort.obj") {
    std::signal(SIGABRT, SIG_DFL);
    std::abort();
  }
  if (path == "forever.obj") std::raise(SIGXCPU);  // as at the end of the processor time that it has
  if (path == "killed.obj") std::raise(SIGKILL);
  if (path == "leave.obj") std::_Exit(0);
  if (path == "refuse.obj") throw InvalidArgument("refuse.obj: there is no face in it");
  if (path == "memory.obj") throw std::bad_alloc();
  if (path == "fault.obj") throw std::runtime_error("a fault");
  MeshScene scene;
  scene.origin = {1, 2, 3};
  scene.names = {path, ""};
  scene.boxes = {Box{{0, 0, 0}, {1, 1, 1}}, Box{{2, 2, 2}, {3, 3, 3}}};
  scene.parts.resize(70'000);  // more than a pipe holds
  scene.parts.back().number = 7;
  if (reading.triangles) scene.triangles.resize(3);
  return scene;
}

namespace {

std::string message_for(const std::string& path) {
  return message_of([&] { static_cast<void>(load_mesh_isolated(path, {})); });
}

TEST(IsolatedMesh, IsTheSceneThatWasRead) {
  const MeshScene scene = load_mesh_isolated("room.obj", {});
  EXPECT_EQ(scene.origin, (WorldPoint{1, 2, 3}));
  EXPECT_THAT(scene.names, testing::ElementsAre("room.obj", ""));
  ASSERT_EQ(scene.boxes.size(), 2U);
  EXPECT_EQ(scene.boxes[1].hi, (Vec3{3, 3, 3}));
  ASSERT_EQ(scene.parts.size(), 70'000U);
  EXPECT_EQ(scene.parts.back().number, 7U);
  EXPECT_EQ(scene.triangles.size(), 3U);
  EXPECT_EQ(load_mesh_isolated("room.obj", {.triangles = false}).triangles.size(), 0U);
}

TEST(IsolatedMesh, SaysThatTheReaderCrashed) {
  EXPECT_EQ(
      message_for("crash.obj"),
      "crash.obj: the reader of assimp crashed on it (Segmentation fault): the file is broken, or assimp has a fault");
  EXPECT_EQ(message_for("abort.obj"),
            "abort.obj: the reader of assimp crashed on it (Aborted): the file is broken, or assimp has a fault");
  EXPECT_EQ(message_for("leave.obj"),
            "leave.obj: the reader of assimp crashed on it: the file is broken, or assimp has a fault");
}

TEST(IsolatedMesh, SaysThatTheReaderRanOutOfTimeOrMemory) {
  EXPECT_THAT(message_for("forever.obj"),
              testing::StartsWith("forever.obj: the reader of assimp ran out of time or memory on it (CPU time limit"));
  EXPECT_THAT(message_for("killed.obj"),
              testing::StartsWith("killed.obj: the reader of assimp ran out of time or memory on it (Killed)"));
}

TEST(IsolatedMesh, PassesOnWhatTheReaderSays) {
  EXPECT_EQ(message_for("refuse.obj"), "refuse.obj: there is no face in it");
  EXPECT_EQ(message_for("fault.obj"), "fault.obj: the reader of assimp failed on it: a fault");
  EXPECT_THAT(message_for("memory.obj"), testing::StartsWith("memory.obj: the reader of assimp failed on it: "));
}

TEST(IsolatedMesh, CanBeReadAfterACrash) {
  EXPECT_THAT(message_for("crash.obj"), testing::HasSubstr("crashed"));
  EXPECT_EQ(load_mesh_isolated("room.obj", {}).names.front(), "room.obj");
}

}  // namespace
}  // namespace shaftcull::cli
