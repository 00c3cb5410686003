// SPDX-License-Identifier: MIT
/// A city of boxes, a third of them turned, of which one district is asked what it sees.
#pragma once

#include <cstdint>

#include "scenes/patch_scene.hpp"

namespace shaftcull::bench {

inline constexpr float city_blocks_patch = 8.2F;  ///< metres along the edge of a patch

/// Lengths are metres, z is up. Ten thousand buildings, towers in the middle and houses at the edge, stand on a slab of
/// ground. Walls and roofs of the innermost are cut into patches, which are all in zone 0.
[[nodiscard]] PatchScene city_blocks(PatchSize size = {city_blocks_patch}, std::uint32_t seed = 5100);

}  // namespace shaftcull::bench
