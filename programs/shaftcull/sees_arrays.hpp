// SPDX-License-Identifier: MIT
/// The arrays of a file of answers for NumPy. docs/program.md says what they hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "npz_layout.hpp"
#include "sees_scene.hpp"

namespace shaftcull::cli {

/// Arrays that answers are put into, in the order in which they begin the file. `seen` is there with rays.
enum AnswerArray : std::size_t { products_array, undecided_array, first_candidate_array, candidates_array, seen_array };
[[nodiscard]] std::vector<NpyFormat> answer_arrays(std::uint32_t rays);

/// What `first_candidate` begins with, before the first unit.
constexpr std::uint64_t no_candidate_before = 0;

/// An array that is known before anything is asked.
struct SceneArray {
  NpyFormat format;
  std::uint64_t rows;
  /// Calls with all bytes, piece by piece.
  std::function<void(const std::function<void(std::span<const std::byte>)>& take)> pour;
};

/// Those behind the others. They refer to what they are given. `rays` is 0 without.
[[nodiscard]] std::vector<SceneArray> scene_arrays(const SeesScene& scene, std::span<const std::uint32_t> order,
                                                   std::uint32_t rays);

}  // namespace shaftcull::cli
