// SPDX-License-Identifier: MIT
/// Answers of a share of the bounds.
#pragma once

#include <cstdint>

#include "batch/block_answer.hpp"
#include "batch/question.hpp"
#include "batch/shaft_source.hpp"
#include "batch/share_tree.hpp"

namespace shaftcull::batch {

/// Answers of shafts [first, first + count) by a share of the bounds; parallel. Indices are positions in the file of
/// bounds, whatever the share. Only shafts that meet the box around the share are asked about.
[[nodiscard]] BlockAnswer answer(const ShareTree& share, const ShaftSource& shafts, std::uint64_t first,
                                 std::uint64_t count, const Question& question);

}  // namespace shaftcull::batch
