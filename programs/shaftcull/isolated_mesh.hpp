// SPDX-License-Identifier: MIT
/// Reading a mesh file in a process of its own.
#pragma once

#include <string>

#include "mesh.hpp"

namespace shaftcull::cli {

/// As load_mesh(), but also throws InvalidArgument if the file makes its reader crash or run on without end, as
/// some broken files do to some of assimp's many readers. Call it before threads are started: it forks.
[[nodiscard]] MeshScene load_mesh_isolated(const std::string& path, const MeshReading& reading);

}  // namespace shaftcull::cli
