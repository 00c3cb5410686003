// SPDX-License-Identifier: MIT
/// Instruction sets.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "arguments.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::Isa;

namespace {

/// Names end with a 0, as those of the C++ interface are literals.
const char* text(Isa isa) noexcept { return shaftcull::name(isa).data(); }

}  // namespace

extern "C" {

shaftcull_status shaftcull_isa_name(uint64_t position, const char** name) {
  return guarded([&] {
    const char*& out = given(name, "name");
    if (position == SHAFTCULL_NONE) {
      out = text(shaftcull::active_isa());
      return;
    }
    const std::vector<Isa> available = shaftcull::available_isas();
    out = position < available.size() ? text(available[static_cast<std::size_t>(position)]) : nullptr;
  });
}

shaftcull_status shaftcull_select_isa(const char* name) {
  return guarded([&] {
    const std::string_view asked = &given(name, "name");
    const std::optional<Isa> isa = shaftcull::isa_from_name(asked);
    if (!isa) {
      std::string choice;
      for (const Isa one : shaftcull::available_isas()) choice += (choice.empty() ? "" : ", ") + std::string(text(one));
      refuse("name = \"" + std::string(asked) + "\" is no instruction set; this machine has " + choice);
    }
    shaftcull::select_isa(*isa);
  });
}

}  // extern "C"
