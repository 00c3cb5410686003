// SPDX-License-Identifier: MIT
#include "trial/sight_trial.hpp"

#include <fmt/format.h>

namespace shaftcull::cli {
namespace {

/// Most patches of a scene: two groups and more at times, and quick in exact arithmetic.
constexpr unsigned most_sight_patches = 80;

SightScenery scenery_of(std::uint64_t number) { return static_cast<SightScenery>(number % sight_sceneries); }

/// One stream of scenes for each seed.
std::uint64_t scene_seed(std::uint64_t seed, std::uint64_t number) {
  return seed * 0x9e3779b97f4a7c15U + number / sight_sceneries;
}

}  // namespace

SightTrial::SightTrial(std::uint64_t seed, std::uint64_t number)
    : what_(fmt::format("random_sight_scene({}, {}, {})", name(scenery_of(number)), scene_seed(seed, number),
                        most_sight_patches)),
      case_(random_sight_scene(scenery_of(number), scene_seed(seed, number), most_sight_patches)),
      truths_(case_) {}

void SightTrial::ask() {
  const std::string fault = truths_.fault_of(case_.collect(case_.options));
  if (!fault.empty() && failure_.empty()) failure_ = what_ + ": " + fault;
}

}  // namespace shaftcull::cli
