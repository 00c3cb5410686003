// SPDX-License-Identifier: MIT
/// Several mesh files as one scene.
#pragma once

#include <span>
#include <string>

#include "mesh.hpp"

namespace shaftcull::cli {

/// As load_mesh_isolated() of one file. Of several, all have the origin of the first; the only object of a file is
/// called as the file, without its extension, and others as the file and their name: "north/window".
[[nodiscard]] MeshScene load_mesh_files(std::span<const std::string> paths, const MeshReading& reading);

}  // namespace shaftcull::cli
