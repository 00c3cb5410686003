// SPDX-License-Identifier: MIT
#include "instruction_set.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "printable.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {

std::string available_names() {
  std::string names;
  for (const Isa isa : available_isas()) names += fmt::format("{}{}", names.empty() ? "" : ", ", name(isa));
  return names;
}

std::vector<Isa> instruction_sets(const std::vector<std::string>& names) {
  const std::vector<Isa> available = available_isas();
  if (names.empty()) {
    const IsaChoice choice = isa_choice();
    return choice.asked.empty() || !choice.refusal.empty() ? available : std::vector<Isa>{choice.running};
  }
  std::vector<Isa> isas;
  for (const std::string& text : names) {
    const auto isa = isa_from_name(text);
    if (!isa || std::ranges::find(available, *isa) == available.end()) {
      throw InvalidArgument(
          fmt::format("--isa {}: no such instruction set here; available: {}", text, available_names()));
    }
    isas.push_back(*isa);
  }
  return isas;
}

std::string names_of(const std::vector<Isa>& isas) {
  std::string names;
  for (const Isa isa : isas) names += fmt::format(" {}", name(isa));
  return names;
}

void InstructionSet::add_option(CLI::App& subcommand) {
  subcommand
      .add_option("--isa", name_,
                  fmt::format("Instruction set; this machine has {} (default: the last)", available_names()))
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
    throw InvalidArgument(
        fmt::format("--isa {}: no such instruction set; available here: {}", name_, available_names()));
  }
  select_isa(*isa);
}

}  // namespace shaftcull::cli
