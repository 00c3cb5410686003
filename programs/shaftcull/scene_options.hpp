// SPDX-License-Identifier: MIT
/// The scene that a subcommand asks about: mesh files, or rooms that are made up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "mesh.hpp"
#include "origin_option.hpp"
#include "sees_scene.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull::cli {

struct SceneOptions {
  std::vector<std::string> paths;
  bool by_material = false;
  std::size_t rooms = 0;
  std::uint64_t seed = 1;  ///< of rooms, and of rays
  OriginOption origin;
  SeesChoice choice;
  bool may_be_two_sided = false;  ///< the subcommand has --two-sided

  /// Adds --scene, --rooms and how objects are read; the number of --patches has this meaning.
  void add(CLI::App& subcommand, const std::string& patches);
  /// Throws InvalidArgument unless there is either a file or rooms; `verb` is the subcommand.
  void require_scene(const std::string& verb) const;
  /// What messages call the scene.
  [[nodiscard]] std::string source() const;
  [[nodiscard]] MeshScene load() const;
  /// A line about normals that seem to point the wrong way; empty if they do not.
  [[nodiscard]] std::string hint_about_normals(const SightCounts& counts) const;
};

}  // namespace shaftcull::cli
