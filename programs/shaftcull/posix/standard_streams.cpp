// SPDX-License-Identifier: MIT
#include "standard_streams.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace shaftcull::cli {

void prepare_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // Opened for the wrong direction, so that using it fails, as using a closed one does.
    if (fcntl(stream, F_GETFD) < 0) static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
  }
}

bool errors_go_to_terminal() { return isatty(STDERR_FILENO) == 1; }

std::vector<std::string> command_line(int argc, char** argv) { return {argv, argv + argc}; }

}  // namespace shaftcull::cli
