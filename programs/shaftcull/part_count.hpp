// SPDX-License-Identifier: MIT
/// The number of parts into which pairs of patches are divided. Ranks share the parts, and an interrupted run keeps
/// finished ones.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shaftcull::cli {

/// The number of pairs of `patches` patches.
[[nodiscard]] std::uint64_t pair_count(std::size_t patches) noexcept;

/// How many pairs a part has, about. Factors take longer.
inline constexpr std::uint64_t pairs_of_sees = std::uint64_t{1} << 21;
inline constexpr std::uint64_t pairs_of_factors = std::uint64_t{1} << 18;

/// The number of parts: at most 512, or 128 if parts are so small. Handing out so few parts costs nothing,
/// and yet there is work for many machines. The number depends on the number of patches alone, so that answers come in
/// one order everywhere.
[[nodiscard]] std::uint32_t part_count(std::size_t patches, std::uint64_t pairs_of_part = pairs_of_sees) noexcept;

}  // namespace shaftcull::cli
