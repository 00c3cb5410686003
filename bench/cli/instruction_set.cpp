// SPDX-License-Identifier: MIT
#include "instruction_set.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "printable.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/isa.hpp"

namespace shaftcull::cli {

void InstructionSet::add_option(CLI::App& subcommand) {
  subcommand
      .add_option("--isa", name_,
                  "Instruction set: scalar, portable128, sse4_2, avx2, avx512 or neon (default: the best there is)")
      ->type_name("NAME");
}

void InstructionSet::select() const {
  if (name_.empty()) {
    const IsaChoice choice = isa_choice();
    if (choice.refusal.empty()) return;
    const std::string note = fmt::format("shaftcull: {}; using {}", printable(choice.refusal), name(choice.running));
    static_cast<void>(std::fputs((note + '\n').c_str(), stderr));
    return;
  }
  const auto isa = isa_from_name(name_);
  if (!isa) {
    std::string available;
    for (const Isa each : available_isas()) available += fmt::format("{}{}", available.empty() ? "" : ", ", name(each));
    throw InvalidArgument(fmt::format("--isa {}: no such instruction set; available here: {}", name_, available));
  }
  select_isa(*isa);
}

}  // namespace shaftcull::cli
