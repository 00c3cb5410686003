// SPDX-License-Identifier: MIT
/// The number of parts into which pairs of patches are divided. Ranks share the parts, and an interrupted run keeps
/// finished ones.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shaftcull::cli {

/// The number of pairs of `patches` patches.
[[nodiscard]] std::uint64_t pair_count(std::size_t patches) noexcept;

/// How pairs are divided: into so many pairs per part, about, and into so many parts at most. Handing out parts costs
/// nothing then, and yet there is work for many machines.
struct PartSizes {
  std::uint64_t pairs;
  std::uint64_t most;
};
inline constexpr PartSizes parts_of_sees{std::uint64_t{1} << 21, 512};
inline constexpr PartSizes parts_of_factors{std::uint64_t{1} << 18, 128};  // a pair takes longer

/// The number of parts, 1 or more. It depends on the number of patches alone, so that answers come in one order
/// everywhere.
[[nodiscard]] std::uint32_t part_count(std::size_t patches, const PartSizes& sizes) noexcept;

}  // namespace shaftcull::cli
