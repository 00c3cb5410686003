// SPDX-License-Identifier: MIT
/// Which task has which shafts.
#pragma once

#include <algorithm>
#include <cstddef>

#include "parallel/parallel.hpp"
#include "support/index_range.hpp"

namespace shaftcull::kernel {

/// Tasks of `each` shafts. Of few shafts, the first task has the first ones, until these have found so much that tasks
/// for the others are worth their cost.
class ShaftTasks {
 public:
  ShaftTasks(std::size_t shafts, std::size_t each) noexcept
      : shafts_(shafts), each_(each), threads_(static_cast<std::size_t>(threads_here())), first_(each) {
    are_few_ = threads_ > 1 && shafts < each * threads_;
  }

  [[nodiscard]] std::size_t shafts() const noexcept { return shafts_; }
  /// At most so many tasks.
  [[nodiscard]] std::size_t most() const noexcept {
    return are_few_ ? 1 + of_each_thread * threads_ : chunk_count(shafts_, each_);
  }
  /// How many there are; behind for_each_shaft().
  [[nodiscard]] std::size_t count() const noexcept {
    return first_ >= shafts_ ? (shafts_ != 0 ? 1 : 0) : 1 + chunk_count(shafts_ - first_, each_);
  }
  /// Likewise.
  [[nodiscard]] IndexRange shafts_of(std::size_t task) const noexcept {
    if (task == 0) return {0, std::min(first_, shafts_)};
    const IndexRange behind_first = chunk_at(shafts_ - first_, each_, task - 1);
    return {first_ + behind_first.first, behind_first.size};
  }

  /// Calls fill(task, s) for every shaft, in parallel: it returns how many bounds the task has found so far.
  template <class Fill>
  void for_each_shaft(const Fill& fill) {
    std::size_t done = 0;
    if (are_few_) {
      parallel_for(1, 1, [&](std::size_t, std::size_t) {
        for (first_ = 0; first_ != shafts_;) {
          const std::size_t found = fill(0, first_++);
          if (found * (shafts_ - first_) >= worth_tasks * first_) break;
        }
      });
      done = 1;
      each_ = chunk_count(shafts_ - first_, of_each_thread * threads_);
      if (first_ == shafts_) return;
    }
    parallel_for(count() - done, 1, [&](std::size_t t, std::size_t) {
      const IndexRange shafts = shafts_of(done + t);
      for (std::size_t s = shafts.first; s != shafts.end(); ++s) fill(done + t, s);
    });
  }

 private:
  static constexpr std::size_t of_each_thread = 4;
  /// So many bounds take ten microseconds and more to find.
  static constexpr std::size_t worth_tasks = 12000;

  std::size_t shafts_;
  std::size_t each_;
  std::size_t threads_;
  std::size_t first_;  ///< shafts of the first task
  bool are_few_;
};

}  // namespace shaftcull::kernel
