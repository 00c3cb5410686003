// SPDX-License-Identifier: MIT
#include <shaftcull/shaftcull.hpp>

std::size_t boxes_kept(const shaftcull::CompiledShaft& shaft, const shaftcull::BoxTree& tree) {
  return count(shaft, tree);
}
