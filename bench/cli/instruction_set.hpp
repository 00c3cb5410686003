/// The option --isa, and the check of SHAFTCULL_ISA that every subcommand makes before it starts.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace shaftcull::cli {

class InstructionSet {
 public:
  void add_option(CLI::App& subcommand);
  /// Selects what was asked for. Throws InvalidArgument if this machine does not have it, or if
  /// nothing was asked for and SHAFTCULL_ISA is not usable.
  void select() const;

 private:
  std::string name_;
};

}  // namespace shaftcull::cli
