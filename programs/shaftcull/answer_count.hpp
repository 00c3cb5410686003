// SPDX-License-Identifier: MIT
/// What the library answers over random shafts, counted.
#pragma once

#include <cstdint>

#include "random_shafts.hpp"
#include "shaft_choice.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::cli {

struct AnswerCount {
  std::uint64_t bounds = 0;
  std::uint64_t outside = 0;
  std::uint64_t touching = 0;  ///< outside with the contact that was asked for, but not with closed contact
  std::uint64_t inside = 0;
};

/// Of the cubes.
[[nodiscard]] AnswerCount count_cubes(const RandomShafts& shafts, const ShaftChoice& choice);

/// Of a triangle in each cube.
[[nodiscard]] AnswerCount count_triangles(const RandomShafts& shafts, const ShaftChoice& choice, TriangleTest test);

/// How much of something there is: by any cube that blocks, and by those alone that do not hold all of an end.
struct OcclusionSum {
  std::uint64_t all = 0;
  std::uint64_t by_any = 0;
  std::uint64_t by_one_between = 0;
};

struct OcclusionCount {
  OcclusionSum cubes;   ///< that block a shaft
  OcclusionSum shafts;  ///< that a cube blocks
};

/// Of the cubes, taken for solid; shafts are between two boxes.
[[nodiscard]] OcclusionCount count_blocking(const RandomShafts& shafts, const ShaftChoice& choice);

}  // namespace shaftcull::cli
