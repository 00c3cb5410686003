// SPDX-License-Identifier: MIT
/// Sixteen furnished rooms with doors between neighbours, as lights are baked in.
#pragma once

#include <cstdint>

#include "scenes/patch_scene.hpp"

namespace shaftcull::bench {

inline constexpr float interior_patch = 0.36F;  ///< metres along the edge of a patch

/// Lengths are metres, z is up. Walls, floor and ceiling are solid boxes, walls split around doors; furniture is turned
/// boxes; spheres of 5,120 triangles hang in the rooms. A patch's zone is its room.
[[nodiscard]] PatchScene interior(PatchSize size = {interior_patch}, std::uint32_t seed = 5000);

}  // namespace shaftcull::bench
