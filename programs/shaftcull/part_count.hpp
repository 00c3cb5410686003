// SPDX-License-Identifier: MIT
/// The number of parts into which pairs of patches are divided. Ranks share the parts, and an interrupted run keeps
/// finished ones.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shaftcull::cli {

/// The number of pairs of `patches` patches.
[[nodiscard]] std::uint64_t pair_count(std::size_t patches) noexcept;

/// The number of parts: about 2 million pairs per part, and at most 512 parts. Handing out so few parts costs nothing,
/// and yet there is work for many machines. The number depends on the number of patches alone, so that answers come in
/// one order everywhere.
[[nodiscard]] std::uint32_t part_count(std::size_t patches) noexcept;

}  // namespace shaftcull::cli
