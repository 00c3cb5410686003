// SPDX-License-Identifier: MIT
/// Shafts in both forms.
#pragma once

#include <span>
#include <vector>

#include "shaftcull/compiled.hpp"

namespace shaftcull {

inline constexpr Form forms[] = {Form::slab, Form::planes};

[[nodiscard]] constexpr const char* name(Form form) { return form == Form::slab ? "slab" : "planes"; }

[[nodiscard]] inline CompiledShaft in_form(CompiledShaft shaft, Form form) {
  set_form(shaft, form);
  return shaft;
}
[[nodiscard]] inline std::vector<CompiledShaft> in_form(std::span<const CompiledShaft> shafts, Form form) {
  std::vector<CompiledShaft> copies(shafts.begin(), shafts.end());
  set_form(copies, form);
  return copies;
}

}  // namespace shaftcull
