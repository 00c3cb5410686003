// SPDX-License-Identifier: MIT
/// What `shaftcull sees` asks about: patches of a mesh, and what stands between them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesh.hpp"
#include "patches.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull::cli {

/// How a scene is made of a mesh.
struct SeesChoice {
  double patch_size = 0;           ///< 0: usual_patch_size()
  bool two_sided = false;          ///< patches have no planes
  std::vector<std::string> solid;  ///< names of objects, or patterns of names
};

/// A mesh with its patches and occluders.
struct SeesScene {
  MeshScene mesh;
  double patch_size;
  std::vector<MeshPatch> patches;
  std::vector<Box> boxes;     ///< one for each patch
  std::vector<Plane> planes;  ///< likewise; empty if patches are two-sided
  Occluders occluders;
  /// Of each occluder, as positions in mesh.triangles.
  std::vector<std::vector<std::uint32_t>> occluder_triangles;
  std::size_t solids;  ///< how many objects are solid: the last so many occluders

  /// The object that an occluder is, or is part of.
  [[nodiscard]] std::uint32_t object_of_occluder(std::size_t occluder) const {
    return mesh.triangles[occluder_triangles[occluder].front()].object;
  }
};

/// Triangles of objects that are not solid become occluders in groups of at most 32 neighbours of the same object.
/// Throws InvalidArgument for a name in `choice.solid` that no object has, an object that is no convex body, and as
/// split_into_patches(); `source` is what messages call the scene.
[[nodiscard]] SeesScene make_sees_scene(MeshScene mesh, const SeesChoice& choice, const std::string& source);

}  // namespace shaftcull::cli
