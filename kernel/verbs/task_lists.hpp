// SPDX-License-Identifier: MIT
/// Lists that tasks make shaft by shaft, put together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "parallel/parallel.hpp"
#include "shaftcull/results.hpp"
#include "support/index_range.hpp"
#include "support/list_memory.hpp"

namespace shaftcull::kernel {

/// Each task lists the indices of `each` shafts, one after the other, into an output of its own.
template <class Output>
class TaskLists {
 public:
  TaskLists(std::size_t shafts, std::size_t each, IndexLists& lists)
      : shafts_(shafts),
        each_(each),
        output_(chunk_count(shafts, each)),
        lists_(lists),
        in_progress_(lists.offsets, lists.indices) {
    lists.offsets.assign(shafts + 1, 0);
  }

  /// Calls fill(s, output) for every shaft, in parallel: it adds the list of shaft s.
  template <class Fill>
  void for_each_shaft(const Fill& fill) {
    parallel_for(output_.size(), 1, [&](std::size_t t, std::size_t) {
      const IndexRange task = chunk_at(shafts_, each_, t);
      for (std::size_t s = task.first; s != task.end(); ++s) {
        fill(s, output_[t]);
        end_list(t, s);
      }
    });
  }
  /// For those who fill two outputs at once.
  [[nodiscard]] std::size_t tasks() const noexcept { return output_.size(); }
  [[nodiscard]] IndexRange shafts_of(std::size_t task) const noexcept { return chunk_at(shafts_, each_, task); }
  [[nodiscard]] Output& operator[](std::size_t task) noexcept { return output_[task]; }
  /// Ends the list of shaft s, which is the last one in its task's output so far.
  void end_list(std::size_t task, std::size_t s) noexcept { lists_.offsets[s + 1] = output_[task].count(); }

  /// Copies the outputs to the caller's lists: write(output, out) writes one.
  template <class Write>
  void concatenate(const Write& write) {
    std::uint64_t before = 0;
    for (std::size_t t = 0; t != output_.size(); ++t) {
      const IndexRange task = shafts_of(t);
      for (std::size_t s = task.first; s != task.end(); ++s) lists_.offsets[s + 1] += before;
      before = lists_.offsets[task.end()];
    }
    in_progress_.resize_items(before);
    parallel_for(output_.size(), 1, [&](std::size_t t, std::size_t) {
      const Output done = std::move(output_[t]);
      write(done, lists_.indices.data() + lists_.offsets[t * each_]);
    });
  }
  /// All lists of the call are concatenated: they are not emptied at the end.
  void complete() noexcept { in_progress_.complete(); }

 private:
  std::size_t shafts_;
  std::size_t each_;
  std::vector<Output> output_;
  IndexLists& lists_;
  IncompleteLists<std::uint32_t> in_progress_;
};

}  // namespace shaftcull::kernel
