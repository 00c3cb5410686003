// SPDX-License-Identifier: MIT
/// The arrays of a file of answers for NumPy. docs/program.md says what they hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "npz_layout.hpp"
#include "sees_run.hpp"

namespace shaftcull::cli {

/// What an array of answers holds.
enum class AnswerKind : std::uint8_t { blocks, undecided, seen, first_candidate, candidates };
struct AnswerArray {
  AnswerKind kind;
  NpyFormat format;
};

/// Arrays that answers are put into, in the order in which they begin the file: `seen` if there are rays,
/// `first_candidate` and behind it `candidates` if those are wanted.
[[nodiscard]] std::vector<AnswerArray> answer_arrays(const SightContent& content);

/// What `first_candidate` begins with, before the first part.
constexpr std::uint64_t no_candidate_before = 0;

/// An array that is known before anything is asked.
struct SceneArray {
  NpyFormat format;
  std::uint64_t rows;
  /// Calls with all bytes, piece by piece.
  std::function<void(const std::function<void(std::span<const std::byte>)>& take)> pour;
};

/// Those behind the others. They refer to what they are given.
[[nodiscard]] std::vector<SceneArray> scene_arrays(const SeesScene& scene, std::span<const std::uint32_t> order,
                                                   const SightContent& content);

}  // namespace shaftcull::cli
