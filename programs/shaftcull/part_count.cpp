// SPDX-License-Identifier: MIT
#include "part_count.hpp"

#include <algorithm>

namespace shaftcull::cli {

std::uint64_t pair_count(std::size_t patches) noexcept {
  const std::uint64_t count = patches;
  return count == 0 ? 0 : count * (count - 1) / 2;
}

std::uint32_t part_count(std::size_t patches) noexcept {
  constexpr std::uint64_t pairs_of_part = std::uint64_t{1} << 21;
  constexpr std::uint64_t most = 512;
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(pair_count(patches) / pairs_of_part, 1, most));
}

}  // namespace shaftcull::cli
