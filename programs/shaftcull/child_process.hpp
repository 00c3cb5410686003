// SPDX-License-Identifier: MIT
/// Programs that run as children of this one: by calls of the system (posix/, windows/).
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace shaftcull::cli {

/// The standard streams of a child: open files, which it reads and writes from where they stand.
struct ChildStreams {
  std::FILE* in;
  std::FILE* out;
  std::FILE* error;
};

/// Runs a program of the PATH, words[0], with its words, and waits for its end. Returns whether it succeeded. Throws
/// std::system_error if it cannot be started: std::errc::no_such_file_or_directory or permission_denied if there is no
/// such program.
[[nodiscard]] bool run_child(std::vector<std::string> words, const ChildStreams& streams);

}  // namespace shaftcull::cli
