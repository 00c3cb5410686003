// SPDX-License-Identifier: MIT
/// The memory that answers of one call may take, and how many pairs are answered at a time for that.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace shaftcull::kernel {

/// Of the bytes that the caller allows, five eighths are for answers to products that are under way, an eighth for
/// products that wait, and the rest for what is found before them.
class AnswerBudget {
 public:
  /// `threads` answer products. `writes` says that undecided pairs are written, not only counted; `resolves`, that the
  /// user gives verdicts on them, for which answers are copied.
  AnswerBudget(std::size_t memory, std::size_t threads, bool writes, bool resolves) noexcept
      : memory_(memory),
        writes_(writes),
        slots_(2 * threads),
        slot_bytes_(memory / 8 * 5 / slots_),
        answer_bytes_(slot_bytes_ / (resolves ? 10 : 6)),
        most_pairs_(largest_product()),
        most_waiting_(writes ? slots_ : largest_waiting()) {}

  /// How many products are under way at a time.
  [[nodiscard]] std::size_t slots() const noexcept { return slots_; }
  /// Bytes of answers to one of them: so few that they fit into the memory of a slot while that grows by doubling.
  [[nodiscard]] std::size_t answer_bytes() const noexcept { return answer_bytes_; }
  /// Bytes that a slot may hold when the next answers are written to it.
  [[nodiscard]] std::size_t kept_bytes() const noexcept { return slot_bytes_ / 2; }
  /// Bytes of a part of answers that are more than that. With many slots each has little room, and parts should not be
  /// too small.
  [[nodiscard]] std::size_t part_bytes() const noexcept { return std::max(answer_bytes_, memory_ / 128); }
  /// Bytes of answers that are found before products are made.
  [[nodiscard]] std::size_t bytes_before() const noexcept { return memory_ / 32; }

  /// Pairs of a product at most. A reference: fit() changes it.
  [[nodiscard]] const std::uint64_t& most_pairs() const noexcept { return most_pairs_; }
  /// Whether so many products of so many bytes should wait no longer.
  [[nodiscard]] bool is_full(std::size_t products, std::size_t bytes) const noexcept {
    return products >= most_waiting_ || bytes > memory_ / 8;
  }

  /// Products become smaller where answers to some of them had no room, and larger again where all had plenty: at most
  /// `most_bytes`.
  void fit(bool had_too_many, std::size_t most_bytes) noexcept {
    if (!writes_) return;
    if (had_too_many) {
      most_pairs_ = std::max(least_product, most_pairs_ / 4);
      most_waiting_ = slots_;
      return;
    }
    most_waiting_ = std::min(largest_waiting(), 2 * most_waiting_);
    if (most_bytes < answer_bytes_ / 8) most_pairs_ = std::min(largest_product(), 2 * most_pairs_);
  }

 private:
  static constexpr std::uint64_t least_product = 4096;  // pairs of two groups of patches

  /// The most pairs of a product that one thread answers: enough that handing them out costs nothing, and so few that
  /// their answers have room, at 8 bytes a pair.
  [[nodiscard]] std::uint64_t largest_product() const noexcept {
    if (!writes_) return std::uint64_t{1} << 20;
    return std::clamp<std::uint64_t>(answer_bytes_ / 8, least_product, std::uint64_t{1} << 18);
  }
  /// The most products that wait: so few that progress is reported.
  [[nodiscard]] std::size_t largest_waiting() const noexcept { return 64 * slots_; }

  std::size_t memory_;
  bool writes_;
  std::size_t slots_;
  std::size_t slot_bytes_;
  std::size_t answer_bytes_;
  std::uint64_t most_pairs_;
  std::size_t most_waiting_;
};

}  // namespace shaftcull::kernel
