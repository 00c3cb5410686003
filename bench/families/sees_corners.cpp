// SPDX-License-Identifier: MIT
/// sees/SCENE/corners/HOW: all pairs of patches that are given by their corners. HOW: `upright` as the scene is,
/// `turned` by 30 degrees about the vertical, `found` turned, with solids that find_solids() finds in the triangles. An
/// item is a pair.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "families/sees_scene.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::bench {
namespace {

enum class Way : unsigned char { upright, turned, found };

Vec3 turned(const Vec3& p) {
  const double sine = 0.5;
  const double cosine = 0.5 * std::numbers::sqrt3;
  return {static_cast<float>(cosine * p[0] - sine * p[1]), static_cast<float>(sine * p[0] + cosine * p[1]), p[2]};
}

/// Patches that are not upright, a millimetre before their walls. Their corners are rounded, as those of walls are: a
/// patch that lies behind its wall, by rounding, would see nothing.
PatchScene before_walls(PatchScene scene) {
  for (std::size_t i = 0; i != scene.patches.size(); ++i) {
    const Vec3& normal = scene.patch_planes[i].normal;
    const bool is_upright = std::count(normal.begin(), normal.end(), 0.0F) == 2;
    for (std::size_t k = 0; k != 3 && !is_upright; ++k) scene.patches[i].corner[k] += 0.001F * normal[k];
  }
  return scene;
}

/// What rows of patches by corners need of a scene. Its boxes become turned ones.
PatchScene turned(const PatchScene& scene) {
  PatchScene result;
  result.objects = scene.objects;
  result.zone = scene.zone;
  for (const Triangle& triangle : scene.triangles) {
    result.triangles.push_back({{turned(triangle.vertex[0]), turned(triangle.vertex[1]), turned(triangle.vertex[2])}});
  }
  const auto add_turned = [&](TurnedBox box) {
    for (Vec3& corner : box) corner = turned(corner);
    result.turned.push_back(box);
  };
  for (const Box& box : scene.boxes) add_turned(corners_of(box));
  for (const TurnedBox& box : scene.turned) add_turned(box);
  for (const Patch& patch : scene.patches) {
    result.patches.push_back({turned(patch.corner), turned(patch.across), turned(patch.up), patch.triangle});
  }
  for (const Plane& plane : scene.patch_planes) result.patch_planes.push_back({turned(plane.normal), plane.offset});
  return result;
}

struct CornerQuestion {
  PatchSet patches;
  Occluders occluders;

  CornerQuestion(const PatchScene& scene, bool find) {
    std::vector<std::uint32_t> numbers(scene.patches.size());
    std::iota(numbers.begin(), numbers.end(), 0U);
    patches = polygons_of(scene, numbers);
    if (find) {
      occluders.add_mesh(TriangleStream(scene.triangles).view(), {.region = patches.box()});
    } else {
      occluders = occluders_of(scene);
    }
  }
};

}  // namespace

void declare_corners(Suite& suite, const std::shared_ptr<SeesScene>& sees) {
  for (const auto& [way, how] :
       {std::pair{Way::upright, "upright"}, std::pair{Way::turned, "turned"}, std::pair{Way::found, "found"}}) {
    const std::string row = fmt::format("sees/{}/corners/{}", sees->name, how);
    suite.add(row, "",
              [=, &suite, of = way, noted = std::make_shared<bool>(false)](benchmark::State& state) {
                select_isa(measured_isa());
                const CornerQuestion all(before_walls(of == Way::upright ? sees->scene() : turned(sees->scene())),
                                         of == Way::found);
                SightCounts counts;
                for (auto _ : state) counts = count_visibility(all.patches, all.occluders, {.candidates = false});
                state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(counts.total()));
                if (!std::exchange(*noted, true)) suite.note(fmt::format("{}: {}", row, shares_text(counts)));
              },
              {.once = true});
  }
}

}  // namespace shaftcull::bench
