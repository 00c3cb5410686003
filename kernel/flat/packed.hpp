// SPDX-License-Identifier: MIT
/// Candidates that many shafts are asked about, side by side in memory.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "flat/scan.hpp"
#include "parallel/parallel.hpp"
#include "streams/rows.hpp"
#include "support/index_range.hpp"

namespace shaftcull::kernel {

/// A copy of their bounds, made once for all shafts.
class PackedCandidates {
 public:
  PackedCandidates(const PackedCandidates&) = delete;
  PackedCandidates& operator=(const PackedCandidates&) = delete;
  /// Of bounds that have candidates.
  explicit PackedCandidates(const ScannedBounds& from)
      : packed_(from), memory_(std::make_unique_for_overwrite<float[]>(from.streams.rows * row(from))) {
    constexpr std::size_t block = 16384;
    const std::span<const std::uint32_t> candidates = *from.candidates;
    parallel_for(chunk_count(candidates.size(), block), 1, [&](std::size_t b, std::size_t) {
      const IndexRange task = chunk_at(candidates.size(), block, b);
      float* rows[9];
      for (std::size_t r = 0; r != from.streams.rows; ++r) rows[r] = memory_.get() + r * row(from) + task.first;
      gather(from, task.first, task.size, rows);
    });
    for (std::size_t r = 0; r != from.streams.rows; ++r) stream_[r] = memory_.get() + r * row(from);
    packed_.streams.stream = stream_.data();
    packed_.streams.count = candidates.size();
  }

  /// Bit i of their answers is candidate i.
  [[nodiscard]] const ScannedBounds& bounds() const noexcept { return packed_; }

 private:
  [[nodiscard]] static std::size_t row(const ScannedBounds& from) noexcept {
    return row_floats(from.streams.rows, from.candidates->size());
  }

  ScannedBounds packed_;
  std::unique_ptr<float[]> memory_;
  std::array<const float*, 9> stream_{};  // into it
};

}  // namespace shaftcull::kernel
