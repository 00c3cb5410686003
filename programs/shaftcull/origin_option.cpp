// SPDX-License-Identifier: MIT
#include "origin_option.hpp"

#include "box_text.hpp"

namespace shaftcull::cli {

CLI::Option* OriginOption::add_option(CLI::App& subcommand, const std::string& description) {
  return subcommand
      .add_option_function<std::string>(
          "--origin", [this](const std::string& text) { point_ = world_point_option("--origin", text, "an origin"); },
          description)
      ->type_name("X,Y,Z");
}

}  // namespace shaftcull::cli
