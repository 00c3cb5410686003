// SPDX-License-Identifier: MIT
/// What stands between the patches of `shaftcull sees`.
#pragma once

#include <string>

#include "sees_scene.hpp"

namespace shaftcull::cli {

/// Adds all occluders to a scene that has its mesh and its patches. Objects that `choice` names as solid, and bodies
/// found that are upright boxes, become solids. All other triangles become occluders in groups of at most 32 neighbours
/// of the same object, and solids found in them hide pairs. An object that is named as solid and is no convex body
/// counts as one that is not named. Throws InvalidArgument for a name that no object has; `source` is what messages
/// call the scene.
void add_occluders(SeesScene& scene, const SeesChoice& choice, const std::string& source);

}  // namespace shaftcull::cli
