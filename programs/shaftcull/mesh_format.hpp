// SPDX-License-Identifier: MIT
/// Which format a mesh file has, by its first bytes.
#pragma once

#include <string>
#include <string_view>

namespace shaftcull::cli {

/// The usual ending of names of files that begin so; empty if unknown.
[[nodiscard]] std::string ending_of(std::string_view bytes);

/// A header of 80 bytes, the number of triangles, and 50 bytes for each.
[[nodiscard]] bool is_binary_stl(std::string_view bytes);

}  // namespace shaftcull::cli
