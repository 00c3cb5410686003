// SPDX-License-Identifier: MIT
/// The scene that a subcommand asks about: mesh files, or rooms that are made up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "mesh.hpp"
#include "sees_scene.hpp"

namespace shaftcull::cli {

struct SceneOptions {
  std::vector<std::string> paths;
  bool by_material = false;
  std::size_t rooms = 0;
  std::uint64_t seed = 1;  ///< of rooms, and of rays
  SeesChoice choice;

  /// Adds --scene, --rooms and how objects are read; the number of --patches has this meaning.
  void add(CLI::App& subcommand, const std::string& patches);
  /// Throws InvalidArgument unless there is either a file or rooms; `verb` is the subcommand.
  void require_scene(const std::string& verb) const;
  /// What messages call the scene.
  [[nodiscard]] std::string source() const;
  [[nodiscard]] MeshScene load() const;
};

}  // namespace shaftcull::cli
