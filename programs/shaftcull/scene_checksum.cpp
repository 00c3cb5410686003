// SPDX-License-Identifier: MIT
#include "scene_checksum.hpp"

#include <cstddef>
#include <span>

#include <fmt/format.h>

#include "batch/checksum.hpp"

namespace shaftcull::cli {

std::string scene_checksum(const SeesScene& scene) {
  batch::RunningChecksum sum;
  const auto add = [&](const auto& values) { sum.add(std::as_bytes(std::span(values))); };
  add(scene.boxes);
  add(scene.planes);
  add(scene.outlines.corners);
  for (const MeshPatch& patch : scene.patches) add(patch.corner);
  for (std::size_t i = 0; i < scene.occluders.size(); ++i) {
    const Box box = scene.occluders.box(i);
    add(box.lo);
    add(box.hi);
    add(scene.occluder_triangles[i]);
  }
  return fmt::format("{} patches, {} found solids, {:016x}", scene.patches.size(),
                     scene.solids.hulls + scene.solids.polygons + scene.solids.inner_boxes, sum.value());
}

}  // namespace shaftcull::cli
