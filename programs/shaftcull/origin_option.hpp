// SPDX-License-Identifier: MIT
/// The option --origin of subcommands that read coordinates in doubles.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "mesh.hpp"

namespace shaftcull::cli {

/// What it is for subcommands that read mesh files.
inline constexpr const char* origin_of_meshes =
    "Subtract this point from the coordinates of the file (default: for map coordinates, one near the middle)";

class OriginOption {
 public:
  /// This must live until the command line has been parsed.
  CLI::Option* add_option(CLI::App& subcommand, const std::string& description);
  /// The point that was given, which is finite.
  [[nodiscard]] const std::optional<WorldPoint>& value() const { return point_; }

 private:
  std::optional<WorldPoint> point_;
};

}  // namespace shaftcull::cli
