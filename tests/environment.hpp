// SPDX-License-Identifier: MIT
/// The environment of this process, which programs that it starts inherit.
#pragma once

namespace shaftcull {

/// Sets a variable, or removes it if `value` is null. No other thread may read the environment meanwhile.
void set_environment(const char* name, const char* value);

}  // namespace shaftcull
