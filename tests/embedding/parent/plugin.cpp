// SPDX-License-Identifier: MIT
// A plugin that has the library in itself.
#include <shaftcull/shaftcull.hpp>

extern "C" const void* code_of_complete() { return reinterpret_cast<const void*>(&shaftcull::complete); }
extern "C" void use_scalar() { shaftcull::select_isa(shaftcull::Isa::scalar); }
extern "C" bool uses_scalar() { return shaftcull::active_isa() == shaftcull::Isa::scalar; }
