// SPDX-License-Identifier: MIT
/// Boxes in clumps of neighbours, so that what is far from some shafts is left out many boxes at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/siblings/siblings.hpp"

namespace shaftcull::kernel {

/// Clump i has the boxes members[size · i] to before members[size · (i + 1)]; the last one may have fewer.
struct BoxClumps {
  static constexpr std::size_t size = 16;
  /// Fewer boxes have no clumps: they are looked at one by one.
  static constexpr std::size_t fewest_boxes = 512;

  std::vector<BoxRow> around;          ///< of each clump, the box around its boxes
  std::vector<std::uint32_t> numbers;  ///< of the clumps, from 0 on: a list of all
  std::vector<std::uint32_t> members;
};

/// Clumps of neighbours in the order of a tree over the boxes. O(n log n).
[[nodiscard]] BoxClumps box_clumps(std::span<const BoxRow> boxes);

}  // namespace shaftcull::kernel
