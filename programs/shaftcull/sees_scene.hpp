// SPDX-License-Identifier: MIT
/// What `shaftcull sees` asks about: patches of a mesh, and what stands between them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh.hpp"
#include "patch_outlines.hpp"
#include "patches.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull::cli {

/// How a scene is made of a mesh.
struct SeesChoice {
  double patch_size = 0;           ///< 0: usual_patch_size()
  double scale = 1;                ///< of the mesh; the patch size is one of the scene that this makes
  bool two_sided = false;          ///< patches have no planes
  bool flip = false;               ///< triangles face the other way than in the file
  std::vector<std::string> solid;  ///< names of objects, or patterns of names
  bool finds_solids = true;        ///< solids are found in the triangles of all other objects
};

/// What hides pairs for certain, by how it came to be known.
struct SeesSolids {
  std::size_t named = 0;        ///< objects that the user named
  std::size_t skipped = 0;      ///< named objects that cannot be solid
  std::string skipped_because;  ///< the first of them, and why
  std::size_t hulls = 0;        ///< as FoundSolids has them
  std::size_t polygons = 0;     ///< likewise
  std::size_t inner_boxes = 0;  ///< likewise
};

/// A mesh with its patches and occluders.
struct SeesScene {
  MeshScene mesh;
  double patch_size;
  std::vector<MeshPatch> patches;
  std::vector<Box> boxes;     ///< one for each patch
  std::vector<Plane> planes;  ///< likewise; empty if patches are two-sided
  PatchOutlines outlines;     ///< none if all patches are boxes that are seen from one side
  float tolerance;            ///< of outlines, as VisibilityOptions has it
  Occluders occluders;
  /// Of each occluder, as positions in mesh.triangles.
  std::vector<std::vector<std::uint32_t>> occluder_triangles;
  SeesSolids solids;

  /// The patches, for the library: all, or some of them.
  [[nodiscard]] PatchSet patch_set() const;
  [[nodiscard]] PatchSet patch_set(std::span<const std::uint32_t> some) const;
  /// The object that an occluder is, or is part of.
  [[nodiscard]] std::uint32_t object_of_occluder(std::size_t occluder) const {
    return mesh.triangles[occluder_triangles[occluder].front()].object;
  }
};

/// Throws InvalidArgument for a name in `choice.solid` that no object has, and as split_into_patches(); `source` is
/// what messages call the scene.
[[nodiscard]] SeesScene make_sees_scene(MeshScene mesh, const SeesChoice& choice, const std::string& source);

}  // namespace shaftcull::cli
