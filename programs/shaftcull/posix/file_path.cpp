// SPDX-License-Identifier: MIT
#include "file_path.hpp"

namespace shaftcull::cli {

std::filesystem::path file_path(const std::string& name) { return name; }

std::string file_name(const std::filesystem::path& path) { return path.string(); }

}  // namespace shaftcull::cli
