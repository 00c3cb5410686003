// SPDX-License-Identifier: MIT
/// What answers of a scene depend on, as a word: ranks compare it, and a run that is resumed.
#pragma once

#include <string>

#include "sees_scene.hpp"

namespace shaftcull::cli {

/// The number of patches and of solids that were found, and a checksum of patches and occluders.
[[nodiscard]] std::string scene_checksum(const SeesScene& scene);

}  // namespace shaftcull::cli
