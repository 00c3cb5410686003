// SPDX-License-Identifier: MIT
/// The option --origin of subcommands that read mesh files.
#pragma once

#include <optional>
#include <vector>

#include <CLI/CLI.hpp>

#include "mesh.hpp"

namespace shaftcull::cli {

class OriginOption {
 public:
  /// This must live until the command line has been parsed.
  CLI::Option* add_option(CLI::App& subcommand);
  /// The point that was given; nothing if the reader is to choose one. Throws InvalidArgument if it is not finite.
  [[nodiscard]] std::optional<WorldPoint> value() const;

 private:
  std::vector<double> numbers_;
};

}  // namespace shaftcull::cli
