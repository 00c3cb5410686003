// SPDX-License-Identifier: MIT
/// What a program that was built without assimp says of mesh files.
#include <gmock/gmock.h>

#include "isolated_mesh.hpp"
#include "message_of.hpp"

namespace shaftcull::cli {
namespace {

TEST(NoMeshReader, NamesTheFileThePackagesAndTheOption) {
  const std::string message = message_of([] { static_cast<void>(load_mesh_isolated("room.obj", {})); });
  EXPECT_THAT(message, testing::HasSubstr("room.obj: this program was built without assimp"));
  EXPECT_THAT(message, testing::HasSubstr("libassimp-dev"));
  EXPECT_THAT(message, testing::HasSubstr("SHAFTCULL_WITH_ASSIMP=ON"));
}

}  // namespace
}  // namespace shaftcull::cli
