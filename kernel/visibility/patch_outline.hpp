// SPDX-License-Identifier: MIT
/// The outline of a patch: of one that was given as a box, too.
#pragma once

#include <cstddef>

#include "shaftcull/bounds.hpp"
#include "visibility/patch_tree.hpp"

namespace shaftcull::kernel {

/// The corners of a box that is flat across some axis, counterclockwise as seen from where `towards` is, −1 or 1, on
/// that axis.
[[nodiscard]] PatchCorners outline_of_flat_box(const Box& box, float towards) noexcept;

/// The corners around the patch at a position of the order, counterclockwise as seen from where it faces. Throws
/// InvalidArgument if it is a box that is not flat.
[[nodiscard]] PatchCorners outline_of(const PatchTree& tree, std::size_t position);

}  // namespace shaftcull::kernel
