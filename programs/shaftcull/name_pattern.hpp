// SPDX-License-Identifier: MIT
/// Patterns of names, as those of a shell.
#pragma once

#include <string_view>

namespace shaftcull::cli {

/// Whether a pattern stands for a name: * for any characters, ? for one, [a-z_] for one of these, [!a-z_] for one that
/// is none of these, and \* for * itself. As fnmatch() of POSIX has it, which not every system knows.
[[nodiscard]] bool matches(std::string_view pattern, std::string_view name);

}  // namespace shaftcull::cli
