// SPDX-License-Identifier: MIT
#include "origin_option.hpp"

#include <cmath>

#include <fmt/format.h>

#include "shaftcull/error.hpp"

namespace shaftcull::cli {

CLI::Option* OriginOption::add_option(CLI::App& subcommand) {
  return subcommand
      .add_option(
          "--origin", numbers_,
          "Subtract this point from the coordinates of the file (default: for map coordinates, one near the middle)")
      ->type_name("X,Y,Z")
      ->delimiter(',')
      ->expected(3);
}

std::optional<WorldPoint> OriginOption::value() const {
  if (numbers_.empty()) return {};
  for (const double x : numbers_) {
    if (!std::isfinite(x)) {
      throw InvalidArgument(fmt::format("--origin {}: give finite numbers", fmt::join(numbers_, ",")));
    }
  }
  return WorldPoint{numbers_[0], numbers_[1], numbers_[2]};
}

}  // namespace shaftcull::cli
