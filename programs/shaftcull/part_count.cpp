// SPDX-License-Identifier: MIT
#include "part_count.hpp"

#include <algorithm>

namespace shaftcull::cli {

std::uint64_t pair_count(std::size_t patches) noexcept {
  const std::uint64_t count = patches;
  return count == 0 ? 0 : count * (count - 1) / 2;
}

std::uint32_t part_count(std::size_t patches, std::uint64_t pairs_of_part) noexcept {
  const std::uint64_t most = pairs_of_part < pairs_of_sees ? 128 : 512;
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(pair_count(patches) / pairs_of_part, 1, most));
}

}  // namespace shaftcull::cli
