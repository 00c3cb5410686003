// SPDX-License-Identifier: MIT
/// Paths as the user gave them, to be opened.
#pragma once

#include <filesystem>
#include <string>

namespace shaftcull::cli {

/// The path that a name in UTF-8 stands for. On Windows it is made absolute, so that it may be longer than 260
/// characters; everywhere else it is the name itself, whatever bytes that has.
[[nodiscard]] std::filesystem::path file_path(const std::string& name);

/// Such a path as the user may read it.
[[nodiscard]] std::string file_name(const std::filesystem::path& path);

}  // namespace shaftcull::cli
