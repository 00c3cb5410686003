// SPDX-License-Identifier: MIT
/// The options --isa, and what every subcommand says before it starts if SHAFTCULL_ISA cannot be followed.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "shaftcull/isa.hpp"

namespace shaftcull::cli {

/// The instruction sets that this machine has, slowest first: "scalar, sse4_2, avx2".
[[nodiscard]] std::string available_names();

/// Those that a run compares: those that are named; else that of SHAFTCULL_ISA, if this machine has it; else all that
/// it has. Throws InvalidArgument for a name of none of these.
[[nodiscard]] std::vector<Isa> instruction_sets(const std::vector<std::string>& names);

/// Names of instruction sets, each after a space: " sse4_2 avx2".
[[nodiscard]] std::string names_of(const std::vector<Isa>& isas);

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
