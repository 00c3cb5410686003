// SPDX-License-Identifier: MIT
/// Runs the tests of one executable on the instruction set that SHAFTCULL_ISA names, or on the best one.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <vector>

#include "shaftcull/isa.hpp"

namespace {

/// CTest counts a test that ends with this exit code as skipped (SKIP_RETURN_CODE in CMakeLists.txt).
constexpr int skipped = 77;

/// Whether SHAFTCULL_ISA names an instruction set that exists, but not on this machine.
bool lacks_instruction_set(const char* text) {
  const std::optional<shaftcull::Isa> isa = shaftcull::isa_from_name(text);
  const std::vector<shaftcull::Isa> available = shaftcull::available_isas();
  return isa && std::find(available.begin(), available.end(), *isa) == available.end();
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  const char* const isa = std::getenv("SHAFTCULL_ISA");
  if (isa != nullptr && *isa != '\0' && !shaftcull::isa_from_name(isa)) {
    std::cout << shaftcull::isa_choice().refusal << ".\n";
    return 1;
  }
  if (isa != nullptr && lacks_instruction_set(isa)) {
    std::cout << "Skipped: this machine does not have " << isa << ".\n";
    return skipped;
  }
  return RUN_ALL_TESTS();
}
