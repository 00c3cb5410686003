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
  using shaftcull::hashes::Family;
  using shaftcull::hashes::Way;
  bool all_right = true;
  for (const shaftcull::Isa isa : shaftcull::available_isas()) {
    shaftcull::select_isa(isa);
    const std::string name(shaftcull::name(isa));
    bool right = true;
    for (const Family& family : shaftcull::hashes::families()) {
      const std::uint64_t on_record = arguments > 1 ? family.hash_of_many : family.hash_of_few;
      for (const Way way : family.ways) {
        const std::uint64_t hash = family.hash_of(arguments > 1 ? family.many : family.few, way);
        if (hash == on_record) continue;
        right = false;
        std::printf("%s: %s is %016" PRIx64 ", and not %016" PRIx64 "\n", name.c_str(), family.name, hash, on_record);
      }
    }
    if (right) std::printf("%s: hashes as on record\n", name.c_str());
    all_right = all_right && right;
  }
  return all_right ? 0 : 1;
}
