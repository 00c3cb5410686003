// SPDX-License-Identifier: MIT
#include "environment.hpp"

#include <cstdlib>

namespace shaftcull {

void set_environment(const char* name, const char* value) {
  value == nullptr ? unsetenv(name) : setenv(name, value, 1);
}

}  // namespace shaftcull
