// SPDX-License-Identifier: MIT
// What `shaftcull hash` does, for systems that lack the libraries which the program needs: compares answers with those
// on record, on every instruction set. With --all it asks about all cases and not only the first ones; with --best on
// the fastest set only.
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <string>
#include <vector>

#include "hashes/hashes.hpp"
#include "shaftcull/isa.hpp"

int main(int arguments, char** argument) {
  using shaftcull::hashes::Deviation;
  using shaftcull::hashes::Family;
  const auto asked = [&](const char* option) {
    return std::any_of(argument + 1, argument + arguments, [=](const char* one) { return std::string(one) == option; });
  };
  const bool quick = !asked("--all");
  std::vector<shaftcull::Isa> sets = shaftcull::available_isas();
  if (asked("--best")) sets.erase(sets.begin(), sets.end() - 1);
  bool all_right = true;
  for (const shaftcull::Isa isa : sets) {
    const std::string set(name(isa));
    bool right = true;
    for (const Family& family : shaftcull::hashes::families()) {
      for (const Deviation& found : deviations(family, quick, {&isa, 1})) {
        right = false;
        std::printf("%s: %s, %s: %016" PRIx64 " is not on record\n", set.c_str(), family.name, name(found.way),
                    found.hash);
      }
    }
    if (right) std::printf("%s: hashes as on record\n", set.c_str());
    all_right = all_right && right;
  }
  return all_right ? 0 : 1;
}
