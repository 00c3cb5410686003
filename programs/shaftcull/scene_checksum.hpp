// SPDX-License-Identifier: MIT
/// A short text that identifies a scene. Ranks compare it with each other, and a resumed run compares it with the
/// stored one.
#pragma once

#include <string>

#include "sees_scene.hpp"

namespace shaftcull::cli {

/// The number of patches and of solids that were found, and a checksum of patches and occluders.
[[nodiscard]] std::string scene_checksum(const SeesScene& scene);

}  // namespace shaftcull::cli
