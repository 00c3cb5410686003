// SPDX-License-Identifier: MIT
#include "part_count.hpp"

#include <algorithm>

namespace shaftcull::cli {

std::uint64_t pair_count(std::size_t patches) noexcept {
  const std::uint64_t count = patches;
  return count == 0 ? 0 : count * (count - 1) / 2;
}

std::uint32_t part_count(std::size_t patches, const PartSizes& sizes) noexcept {
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(pair_count(patches) / sizes.pairs, 1, sizes.most));
}

}  // namespace shaftcull::cli
