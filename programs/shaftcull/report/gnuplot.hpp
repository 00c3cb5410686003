// SPDX-License-Identifier: MIT
/// gnuplot as a child process: a script in, a picture out.
#pragma once

#include <string>

namespace shaftcull::cli {

/// What gnuplot draws for `script`, which sets no output.
/// Throws InvalidArgument if there is no gnuplot, std::runtime_error with its complaint if it fails.
[[nodiscard]] std::string run_gnuplot(const std::string& script);

}  // namespace shaftcull::cli
