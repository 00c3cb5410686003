// SPDX-License-Identifier: MIT
#include "shaftcull/isa.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <iterator>
#include <string>

#include "dispatch/active_kernels.hpp"
#include "kernels/kernel_table.hpp"
#include "shaftcull/error.hpp"
#include "support/compiler.hpp"
#include "support/fail.hpp"

namespace shaftcull {
namespace kernel {

#define SHAFTCULL_BUILT(set, features) \
  namespace set {                      \
  extern const Kernels* const kernels; \
  }
#define SHAFTCULL_NOT_BUILT(set)
#include "dispatch/instruction_sets.inc"
#undef SHAFTCULL_BUILT
#undef SHAFTCULL_NOT_BUILT

}  // namespace kernel

namespace {

/// What is known of an instruction set.
struct InstructionSet {
  Isa isa;
  std::string_view name;
  const kernel::Kernels* const* kernels;  ///< null if this build has none; they may be, too (simd/baseline.hpp)
  bool (*machine_runs)() noexcept;  ///< whether the processor has the instructions and the operating system saves the
                                    ///< registers
};

/// All there are, the better ones later.
constexpr InstructionSet sets[] = {
#define SHAFTCULL_BUILT(set, features) \
  {Isa::set, #set, &kernel::set::kernels, []() noexcept -> bool { return features; }},
#define SHAFTCULL_NOT_BUILT(set) {Isa::set, #set, nullptr, []() noexcept { return false; }},
#include "dispatch/instruction_sets.inc"
#undef SHAFTCULL_BUILT
#undef SHAFTCULL_NOT_BUILT
};

constexpr bool are_numbered_in_order() {
  for (std::size_t i = 0; i != std::size(sets); ++i) {
    if (sets[i].isa != static_cast<Isa>(i)) return false;
  }
  return true;
}
static_assert(are_numbered_in_order(), "kernel/CMakeLists.txt lists instruction sets in the order of Isa");

bool available(const InstructionSet& set) noexcept {
  return set.kernels != nullptr && *set.kernels != nullptr && set.machine_runs();
}
bool available(Isa isa) noexcept { return available(sets[static_cast<std::size_t>(isa)]); }

std::string list_of_available() {
  std::string list;
  for (const Isa isa : available_isas()) list += (list.empty() ? "" : ", ") + std::string(name(isa));
  return list;
}

/// What SHAFTCULL_ISA says, or nothing.
std::string_view asked_for() noexcept {
  const char* text = std::getenv("SHAFTCULL_ISA");
  return text == nullptr ? std::string_view() : std::string_view(text);
}

/// The choice of the environment if there is one that can be followed, else the best there is.
const InstructionSet& initial_set() noexcept {
  const std::optional<Isa> wanted = isa_from_name(asked_for());
  if (wanted && available(*wanted)) return sets[static_cast<std::size_t>(*wanted)];
  const InstructionSet* best = &sets[0];
  for (const InstructionSet& set : sets) best = available(set) ? &set : best;
  return *best;
}

constexpr char lower(char c) noexcept { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

constinit std::atomic<const InstructionSet*> chosen = nullptr;

/// Chooses if nobody has; a select_isa() that comes in between wins.
SHAFTCULL_COLD const InstructionSet& chosen_first() noexcept {
  const InstructionSet* set = nullptr;
  const InstructionSet* const first = &initial_set();
  return chosen.compare_exchange_strong(set, first, std::memory_order_relaxed) ? *first : *set;
}

const InstructionSet& chosen_set() noexcept {
  const InstructionSet* const set = chosen.load(std::memory_order_relaxed);
  return set != nullptr ? *set : chosen_first();
}

}  // namespace

std::string_view name(Isa isa) noexcept {
  const auto i = static_cast<std::size_t>(isa);
  return i < std::size(sets) ? sets[i].name : "unknown";
}

std::optional<Isa> isa_from_name(std::string_view text) noexcept {
  for (const InstructionSet& set : sets) {
    const auto same = [](char a, char b) { return a == lower(b); };
    if (std::equal(set.name.begin(), set.name.end(), text.begin(), text.end(), same)) return set.isa;
  }
  return std::nullopt;
}

std::vector<Isa> available_isas() {
  std::vector<Isa> isas;
  for (const InstructionSet& set : sets) {
    if (available(set)) isas.push_back(set.isa);
  }
  return isas;
}

Isa active_isa() noexcept { return chosen_set().isa; }

IsaChoice isa_choice() {
  IsaChoice choice{std::string(asked_for()), {}, active_isa()};
  if (choice.asked.empty()) return choice;
  const std::optional<Isa> wanted = isa_from_name(choice.asked);
  if (wanted && available(*wanted)) return choice;
  choice.refusal = "SHAFTCULL_ISA=" + choice.asked +
                   (wanted ? " is not available here" : " is not an instruction set") + "; this machine has " +
                   list_of_available();
  return choice;
}

void select_isa(Isa isa) {
  if (static_cast<std::size_t>(isa) >= std::size(sets)) {
    kernel::fail(InvalidArgument("there is no instruction set number " + std::to_string(static_cast<int>(isa)) +
                                 "; this machine has " + list_of_available()));
  }
  if (!available(isa)) {
    kernel::fail(InvalidArgument("instruction set " + std::string(name(isa)) +
                                 " is not available here; this machine has " + list_of_available()));
  }
  chosen.store(&sets[static_cast<std::size_t>(isa)], std::memory_order_relaxed);
}

namespace kernel {

const Kernels& active_kernels() noexcept { return **chosen_set().kernels; }

}  // namespace kernel
}  // namespace shaftcull
