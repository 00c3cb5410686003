// SPDX-License-Identifier: MIT
/// What the program says when it fails.
#pragma once

#include <string>

namespace shaftcull::cli {

/// Reports an error in a single line, whatever the text that others gave us looks like. Returns `code`.
int complain(std::string what, int code);

}  // namespace shaftcull::cli
