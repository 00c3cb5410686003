// SPDX-License-Identifier: MIT
#include "environment.hpp"

#include <cstdlib>

namespace shaftcull {

// An empty value removes a variable: there are no empty ones.
void set_environment(const char* name, const char* value) { _putenv_s(name, value == nullptr ? "" : value); }

}  // namespace shaftcull
