// SPDX-License-Identifier: MIT
/// The few ways that patches of a building or a machine face.
///
/// Two groups face away from each other as a whole only if each faces one way: the roofs of a row of houses see none of
/// its walls. Groups that are cut by place alone face all ways until they are small, and then there are many of them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "visibility/patch_halving.hpp"

namespace shaftcull::kernel {

/// Sorts patches by the way they face, if most of them face one of a few ways: those that face the same way are side by
/// side, and those that face other ways are last. Returns how many are in each part, at most `most_parts`, none of them
/// empty. If patches face more ways, there is one part, in the order given. O(n).
std::vector<std::size_t> sort_by_facing(std::span<PatchItem> items, std::size_t most_parts);

}  // namespace shaftcull::kernel
