// SPDX-License-Identifier: MIT
/// Stands in for mesh.cpp and isolated_mesh.cpp where the program is built without assimp.
#include <fmt/format.h>

#include "isolated_mesh.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {

MeshScene load_mesh_isolated(const std::string& path, const MeshReading& /*reading*/) {
  throw InvalidArgument(
      fmt::format("{}: this program was built without assimp and cannot read mesh files; install assimp (Debian: "
                  "libassimp-dev), then configure with SHAFTCULL_WITH_ASSIMP=ON and build again",
                  path));
}

}  // namespace shaftcull::cli
