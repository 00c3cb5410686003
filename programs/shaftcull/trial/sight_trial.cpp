// SPDX-License-Identifier: MIT
#include "trial/sight_trial.hpp"

#include <fmt/format.h>

namespace shaftcull::cli {
namespace {

/// Most patches of a scene: two groups and more at times, and quick in exact arithmetic.
constexpr unsigned most_sight_patches = 80;
constexpr unsigned most_polygons = 24;

SightScenery scenery_of(std::uint64_t number) { return static_cast<SightScenery>(number % sight_sceneries); }

/// One stream of scenes for each seed.
std::uint64_t scene_seed(std::uint64_t seed, std::uint64_t number) {
  return seed * 0x9e3779b97f4a7c15U + number / sight_sceneries;
}

/// Whether patches are polygons, in one of three scenes of each scenery.
bool has_polygons(std::uint64_t number) { return number / sight_sceneries % 3 == 2; }
/// Whether these are seen from both sides, in every other one of these scenes.
bool has_both_sides(std::uint64_t number) { return number / sight_sceneries % 6 == 5; }

SightScene sight_scene_of(std::uint64_t seed, std::uint64_t number) {
  const std::uint64_t of_scene = scene_seed(seed, number);
  if (!has_polygons(number)) return random_sight_scene(scenery_of(number), of_scene, most_sight_patches);
  SightScene scene = with_corners(random_sight_scene(scenery_of(number), of_scene, most_polygons), of_scene);
  if (has_both_sides(number)) scene.sides = PatchSides::both;
  return scene;
}

std::string text_of_sights(std::uint64_t seed, std::uint64_t number) {
  const std::uint64_t of_scene = scene_seed(seed, number);
  const std::string name_of = name(scenery_of(number));
  if (!has_polygons(number))
    return fmt::format("random_sight_scene({}, {}, {})", name_of, of_scene, most_sight_patches);
  return fmt::format("with_corners(random_sight_scene({}, {}, {}), {}){}", name_of, of_scene, most_polygons, of_scene,
                     has_both_sides(number) ? " of both sides" : "");
}

}  // namespace

SightTrial::SightTrial(std::uint64_t seed, std::uint64_t number)
    : what_(text_of_sights(seed, number)), case_(sight_scene_of(seed, number)), truths_(case_) {}

void SightTrial::ask() {
  const std::string fault = truths_.fault_of(case_.collect(case_.options));
  if (!fault.empty() && failure_.empty()) failure_ = what_ + ": " + fault;
}

}  // namespace shaftcull::cli
