// SPDX-License-Identifier: MIT
/// Where output goes, and how files are made and replaced: by calls of the system (posix/, windows/).
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

namespace shaftcull::cli {

/// Who owns a file and who may do what with it, where the system knows that of files.
struct FileRights {
  unsigned owner = 0;
  unsigned group = 0;
  unsigned mode = 0;
};

/// What a path stands for.
struct OutputPlace {
  std::filesystem::path path;  ///< behind all symbolic links; empty if the file is open already
  int descriptor = -1;         ///< of a file that is open already
  bool is_standard_output = false;
  bool is_stream = false;
  bool is_replaced = false;  ///< there is a regular file
  FileRights rights = {};    ///< of that
};

/// Throws InvalidArgument for what can be neither written into nor replaced.
[[nodiscard]] OutputPlace output_place(const std::string& name);

/// What is wrong with output to `path`.
[[nodiscard]] std::string refusal_to_write(const std::string& path, const std::string& why);

// Those that return something return null, or false, and set errno if they fail.

/// Opens what is written into, to be closed by itself. From then on a pipe that nobody reads is an error as others are.
[[nodiscard]] std::FILE* open_stream(const OutputPlace& place);

/// Makes a file, which will replace the one at `place`: nothing that is there is opened. It has the rights of that one,
/// or else the usual ones.
[[nodiscard]] std::FILE* create_part(const std::filesystem::path& name, const OutputPlace& place);

/// Makes a file that only this process uses, for writing and reading, and that is gone when it is closed. Nothing that
/// is there is opened.
[[nodiscard]] std::FILE* create_temporary(const std::filesystem::path& name);

/// Gives a file, which is closed, the name that it was made for.
[[nodiscard]] bool replace_file(const std::filesystem::path& part, const OutputPlace& place);

/// Removes a file, which is closed, if it is there.
void remove_file(const std::filesystem::path& path);

}  // namespace shaftcull::cli
