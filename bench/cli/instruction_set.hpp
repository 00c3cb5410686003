// SPDX-License-Identifier: MIT
/// The option --isa, and what every subcommand says before it starts if SHAFTCULL_ISA cannot be followed.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace shaftcull::cli {

class InstructionSet {
 public:
  void add_option(CLI::App& subcommand);
  /// Selects what the option asks for, and throws InvalidArgument if this machine does not have it. Without the option
  /// SHAFTCULL_ISA counts; if that cannot be followed, standard error says so, and the best there is is used.
  void select() const;

 private:
  std::string name_;
};

}  // namespace shaftcull::cli
