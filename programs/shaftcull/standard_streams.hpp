// SPDX-License-Identifier: MIT
/// Standard input, output and error, and the words of the command line, as all systems have them.
#pragma once

#include <string>
#include <vector>

namespace shaftcull::cli {

/// To be called first: opens streams that the program was started without, as what cannot be used. Otherwise the first
/// file that it opens would get the number of one of them, and be written to as standard output. On Windows what is
/// written then goes out as it is, and consoles take it for UTF-8.
void prepare_standard_streams();

/// Whether standard error is a terminal that a line may be erased on.
[[nodiscard]] bool errors_go_to_terminal();

/// The command line in UTF-8, or on other systems than Windows in whatever bytes the user gave.
[[nodiscard]] std::vector<std::string> command_line(int argc, char** argv);

}  // namespace shaftcull::cli
