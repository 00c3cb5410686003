// SPDX-License-Identifier: MIT
// What `shaftcull hash` does, for systems that lack the libraries which the program needs: compares answers with those
// on record, on every instruction set. An argument, of any kind, has it ask about all cases and not only the first
// ones.
#include <cinttypes>
#include <cstdio>
#include <string>

#include "hashes/hashes.hpp"
#include "shaftcull/isa.hpp"

int main(int arguments, char** /*argument*/) {
  using shaftcull::hashes::Deviation;
  using shaftcull::hashes::Family;
  bool all_right = true;
  for (const shaftcull::Isa isa : shaftcull::available_isas()) {
    const std::string set(name(isa));
    bool right = true;
    for (const Family& family : shaftcull::hashes::families()) {
      for (const Deviation& found : deviations(family, arguments == 1, {&isa, 1})) {
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
