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
#include "verbs/shaft_tasks.hpp"

namespace shaftcull::kernel {

/// Each task lists the indices of its shafts, one after the other, into an output of its own.
template <class Output>
class TaskLists {
 public:
  TaskLists(const ShaftTasks& tasks, IndexLists& lists)
      : tasks_(tasks), output_(tasks.most()), lists_(lists), in_progress_(lists.offsets, lists.indices) {
    lists.offsets.assign(tasks.shafts() + 1, 0);
  }

  [[nodiscard]] Output& operator[](std::size_t task) noexcept { return output_[task]; }
  /// Ends the list of shaft s, which is the last one in its task's output so far, and returns how long that is.
  std::size_t end_list(std::size_t task, std::size_t s) noexcept {
    return lists_.offsets[s + 1] = output_[task].count();
  }

  /// Copies the outputs to the caller's lists: write(output, out) writes one.
  template <class Write>
  void concatenate(const Write& write) {
    std::uint64_t before = 0;
    for (std::size_t t = 0; t != tasks_.count(); ++t) {
      const IndexRange shafts = tasks_.shafts_of(t);
      for (std::size_t s = shafts.first; s != shafts.end(); ++s) lists_.offsets[s + 1] += before;
      before = lists_.offsets[shafts.end()];
    }
    in_progress_.resize_items(before);
    parallel_for(tasks_.count(), 1, [&](std::size_t t, std::size_t) {
      const Output done = std::move(output_[t]);
      write(done, lists_.indices.data() + lists_.offsets[tasks_.shafts_of(t).first]);
    });
  }
  /// All lists of the call are concatenated: they are not emptied at the end.
  void complete() noexcept { in_progress_.complete(); }

 private:
  const ShaftTasks& tasks_;
  std::vector<Output> output_;
  IndexLists& lists_;
  IncompleteLists<std::uint32_t> in_progress_;
};

}  // namespace shaftcull::kernel
