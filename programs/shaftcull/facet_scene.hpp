// SPDX-License-Identifier: MIT
/// A scene whose patches are the facets of its mesh, and what is written of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "factor_patches.hpp"
#include "npz.hpp"
#include "scene_options.hpp"
#include "sees_scene.hpp"

namespace shaftcull::cli {

struct FacetScene {
  std::string source;  ///< the file, or which rooms
  SeesScene scene;
  FactorPatches patches;
  double patch_size = 0;  ///< 0: facets are whole

  [[nodiscard]] std::uint32_t object_of(std::size_t patch) const {
    return scene.mesh.triangles[patches.triangle[patch]].object;
  }
  /// The number, within the object, of the first triangle that the patch is of.
  [[nodiscard]] std::uint32_t triangle_of(std::size_t patch) const {
    return scene.mesh.triangles[patches.triangle[patch]].triangle;
  }
  /// The objects, triangles and patches, for the first line of a report.
  [[nodiscard]] std::string described() const;
};

/// Throws as make_sees_scene() and factor_patches(); also for too many objects, if a report of each is wanted.
[[nodiscard]] FacetScene make_facet_scene(const SceneOptions& options, bool reports_objects);

/// Arrays with the corners, objects and triangles of patches.
void add_patches(NpzFile& file, const FacetScene& scene);

/// A number of each patch, in colours.
struct FacetMap {
  std::span<const double> values;
  double full;        ///< the value that has the palest colour
  const char* name;   ///< of the values in a mesh, and of their colours in a picture
  const char* words;  ///< what they are shares of
  const char* title;
};

/// Writes an SVG picture of the scene from above, or a PLY file of all patches, in the colours of the map.
void write_map_svg(const FacetScene& scene, const FacetMap& map, const std::string& path, std::size_t up);
void write_map_ply(const FacetScene& scene, const FacetMap& map, const std::string& path);

}  // namespace shaftcull::cli
