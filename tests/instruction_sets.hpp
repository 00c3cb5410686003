// SPDX-License-Identifier: MIT
/// Runs a test on one instruction set after the other.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "shaftcull/isa.hpp"

namespace shaftcull {

/// Those that this run is about: the one that SHAFTCULL_ISA names, if it can be used; on an emulated processor
/// (emulated.cmake) the one that the library picks by itself; else all there are.
inline std::vector<Isa> isas_under_test() {
  const IsaChoice choice = isa_choice();
  if (!choice.asked.empty() && choice.refusal.empty()) return {isa_from_name(choice.asked).value()};
  return std::getenv("SHAFTCULL_EXPECTED_ISA") != nullptr ? std::vector<Isa>{active_isa()} : available_isas();
}

/// All there are, whether this build has them or not.
inline std::vector<Isa> all_isas() {
  std::vector<Isa> isas;
  for (unsigned i = 0; name(static_cast<Isa>(i)) != "unknown"; ++i) isas.push_back(static_cast<Isa>(i));
  return isas;
}

/// Selects an instruction set until the end of the scope.
class UseIsa {
 public:
  explicit UseIsa(Isa isa) : before_(active_isa()) { select_isa(isa); }
  ~UseIsa() { select_isa(before_); }
  UseIsa(const UseIsa&) = delete;
  UseIsa& operator=(const UseIsa&) = delete;

 private:
  Isa before_;
};

/// Runs a test's body on each of them.
template <class Body>
void on_each_instruction_set(Body body) {
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    SCOPED_TRACE(std::string(name(isa)));
    body();
  }
}

}  // namespace shaftcull
