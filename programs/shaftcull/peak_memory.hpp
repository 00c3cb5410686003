// SPDX-License-Identifier: MIT
/// How much memory the program takes.
#pragma once

#include <cstdint>

namespace shaftcull::cli {

/// The most bytes of memory that the program has had until now.
[[nodiscard]] std::uint64_t peak_memory();

}  // namespace shaftcull::cli
