// SPDX-License-Identifier: MIT
#include "families/sees_scene.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "shaftcull/geometry.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::bench {

Isa measured_isa() {
  const std::vector<Isa> available = available_isas();
  const std::optional<Isa> asked = isa_from_name(isa_choice().asked);
  const bool runs = asked && std::find(available.begin(), available.end(), *asked) != available.end();
  return runs ? *asked : available.back();
}

Occluders occluders_of(const PatchScene& scene, TurnedSolids turned) {
  Occluders occluders;
  occluders.add_solids(scene.boxes);
  std::vector<Vec3> corners;
  std::vector<std::size_t> first_corner{0};
  std::vector<Box> around;
  std::vector<Box> inside;
  for (const TurnedBox& box : scene.turned) {
    corners.insert(corners.end(), box.begin(), box.end());
    first_corner.push_back(corners.size());
    around.push_back(box_around(box));
    inside.push_back(inscribed_box(box));
  }
  if (turned == TurnedSolids::hulls) {
    occluders.add_solid_hulls(corners, first_corner);
  } else {
    occluders.add_boxes(around);
    occluders.add_solids(inside);
  }
  const std::size_t first = scene.objects[scene.first_mesh()];
  const TriangleStream meshes(std::span(scene.triangles).subspan(first));
  std::vector<std::size_t> first_triangle;
  for (std::size_t i = scene.first_mesh(); i != scene.objects.size(); ++i) {
    first_triangle.push_back(scene.objects[i] - first);
  }
  occluders.add_triangles(meshes, first_triangle);
  const Box somewhere{};
  benchmark::DoNotOptimize(count_visibility(PatchSet(std::span(&somewhere, 1)), occluders));
  return occluders;
}

PatchSet polygons_of(const PatchScene& scene, std::span<const std::uint32_t> patches) {
  std::vector<Vec3> corners;
  std::vector<std::size_t> first_corner{0};
  for (const std::uint32_t number : patches) {
    const Patch& patch = scene.patches[number];
    const auto at = [&patch](float u, float v) {
      Vec3 point;
      for (std::size_t k = 0; k != 3; ++k) point[k] = patch.corner[k] + u * patch.across[k] + v * patch.up[k];
      return point;
    };
    float height = 0;  // of across × up above the plane
    for (std::size_t k = 0; k != 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      const std::size_t m = (k + 2) % 3;
      const float cross = patch.across[l] * patch.up[m] - patch.across[m] * patch.up[l];
      height += cross * scene.patch_planes[number].normal[k];
    }
    const auto first = static_cast<std::ptrdiff_t>(corners.size());
    corners.push_back(at(0, 0));
    corners.push_back(at(1, 0));
    if (!patch.triangle) corners.push_back(at(1, 1));
    corners.push_back(at(0, 1));
    if (height < 0) std::reverse(corners.begin() + first, corners.end());
    first_corner.push_back(corners.size());
  }
  return PatchSet(corners, first_corner);
}

std::string shares_text(const SightCounts& counts) {
  const auto percent = [total = static_cast<double>(counts.total())](std::uint64_t part) {
    return 100 * static_cast<double>(part) / total;
  };
  return fmt::format("{:.1f} % clear, {:.1f} % occluded, {:.1f} % facing away, {:.1f} % undecided",
                     percent(counts.clear), percent(counts.occluded), percent(counts.facing_away),
                     percent(counts.undecided));
}

}  // namespace shaftcull::bench
