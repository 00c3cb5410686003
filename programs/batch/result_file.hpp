// SPDX-License-Identifier: MIT
/// The HDF5 file that a job ends with.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "batch/block_answer.hpp"
#include "batch/question.hpp"
#include "batch/written_file.hpp"

namespace shaftcull::batch {

/// What the file says of itself: attributes of its root.
struct ResultDescription {
  std::vector<std::pair<std::string, std::string>> texts;
  std::vector<std::pair<std::string, std::uint64_t>> numbers;
};

/// Where the numbers of each dataset begin in the file, in bytes.
using ResultPlaces = std::vector<std::uint64_t>;

/// Makes the file with all its datasets, and nothing in them: in one piece each, in chunks that stand one behind the
/// other, so that ranks write numbers to where they belong. `list_totals` are the lengths of all lists. The same
/// arguments give the same bytes. Throws std::runtime_error if it cannot be made.
[[nodiscard]] ResultPlaces make_result_file(const std::string& path, Answer answer, std::uint64_t shafts,
                                            const std::array<std::uint64_t, 2>& list_totals,
                                            const ResultDescription& description);

/// Writes the answers of `count` shafts from `first` on: one block of `shafts` in all. `list_begins` are how many
/// indices the lists of all blocks before have. Throws std::runtime_error.
void write_block(WrittenFile& file, const ResultPlaces& places, Answer answer, std::uint64_t shafts,
                 std::uint64_t first, std::uint64_t count, const std::array<std::uint64_t, 2>& list_begins,
                 const BlockAnswer& block);

/// How many datasets there are.
[[nodiscard]] std::size_t datasets_of(Answer answer) noexcept;

}  // namespace shaftcull::batch
