// SPDX-License-Identifier: MIT
/// In how many parts all pairs of patches are answered: ranks share them, and a run that was ended keeps them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shaftcull::cli {

/// How many pairs so many patches are.
[[nodiscard]] std::uint64_t pair_count(std::size_t patches) noexcept;

/// So few parts that handing them out costs nothing, and so many that there is work for many machines. Their number
/// depends on the number of patches alone, so that answers come in one order everywhere.
[[nodiscard]] std::uint32_t part_count(std::size_t patches) noexcept;

}  // namespace shaftcull::cli
