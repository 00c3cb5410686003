// SPDX-License-Identifier: MIT
/// Lists of many shafts: one pass over the bounds. Tasks list what they keep in memory of their own. Once all counts
/// are known, these lists are copied to where they belong in the user's.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "flat/batch_job.hpp"
#include "flat/tiling.hpp"
#include "parallel/parallel.hpp"
#include "parallel/task_memory.hpp"
#include "shaftcull/results.hpp"
#include "support/list_memory.hpp"

namespace shaftcull::kernel {

/// What a task lists, of its first shaft, then of the second, …: positions within its block.
using TaskList = TaskMemory<std::uint32_t>;

/// Turns counts, one row of shafts for every block, into positions in `indices` where the lists go; fills `offsets`.
inline void turn_into_positions(std::vector<std::uint64_t>& counts, std::size_t blocks, std::size_t shafts,
                                std::vector<std::uint64_t>& offsets) {
  offsets.assign(shafts + 1, 0);
  for (std::size_t b = 0; b != blocks; ++b) {
    for (std::size_t s = 0; s != shafts; ++s) offsets[s + 1] += counts[b * shafts + s];
  }
  for (std::size_t s = 0; s != shafts; ++s) offsets[s + 1] += offsets[s];
  std::vector<std::uint64_t> next(offsets.begin(), offsets.end() - 1);
  for (std::size_t b = 0; b != blocks; ++b) {
    for (std::size_t s = 0; s != shafts; ++s) next[s] += std::exchange(counts[b * shafts + s], next[s]);
  }
}

/// Lists the bounds of a job of one kind, those kept, or of two: those that overlap and those inside. Indices of
/// 32 bits tell them apart.
template <std::size_t kinds>
void list_rows(const BatchJob& job, const std::array<IndexLists*, kinds>& lists) {
  const Tiling tiling(job.bounds().count, job.shafts());
  std::array<std::vector<TaskList>, kinds> task_lists;
  std::array<std::vector<std::uint64_t>, kinds> positions;  // counts at first
  for (std::size_t kind = 0; kind != kinds; ++kind) {
    task_lists[kind].resize(tiling.blocks() * tiling.groups());
    positions[kind].resize(tiling.blocks() * job.shafts());
  }
  const SetBits& set_bits = job.set_bits();
  parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    const IndexRange block = tiling.block(b);
    const IndexRange group = tiling.group(g);
    const std::size_t words = bit_words(block.size);
    const std::size_t kind_words = group.size * words;
    TaskScratch<std::uint64_t, 4 * tile_words> scratch(kinds * kind_words);
    std::uint64_t* const kept = scratch.get();
    if constexpr (kinds == 2) {
      std::uint64_t* const inside = kept + kind_words;
      job.test(block, group, {kept, words}, {inside, words});
      for (std::size_t w = 0; w != kind_words; ++w) kept[w] &= ~inside[w];
    } else {
      job.test(block, group, {kept, words});
    }
    for (std::size_t kind = 0; kind != kinds; ++kind) {
      const std::uint64_t* const bits = kept + kind * kind_words;
      std::uint64_t* const counts = positions[kind].data() + b * job.shafts() + group.first;
      std::size_t total = 0;
      for (std::size_t s = 0; s != group.size; ++s) total += counts[s] = set_bits.count(bits + s * words, words);
      if (total == 0) continue;
      TaskList task_list(total + set_bits_slack);
      std::uint32_t* out = task_list.get();
      for (std::size_t s = 0; s != group.size; ++s) {
        set_bits.write(bits + s * words, words, counts[s], out);
        out += counts[s];
      }
      task_lists[kind][b * tiling.groups() + g] = std::move(task_list);
    }
  });

  using InProgress = IncompleteLists<std::uint32_t>;
  auto in_progress = [&]<std::size_t... kind>(std::index_sequence<kind...>) {
    return std::array<InProgress, kinds>{InProgress(lists[kind]->offsets, lists[kind]->indices)...};
  }
  (std::make_index_sequence<kinds>());
  for (std::size_t kind = 0; kind != kinds; ++kind) {
    turn_into_positions(positions[kind], tiling.blocks(), job.shafts(), lists[kind]->offsets);
    in_progress[kind].resize_items(lists[kind]->offsets.back());
  }
  parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    for (std::size_t kind = 0; kind != kinds; ++kind) {
      const TaskList task_list = std::move(task_lists[kind][b * tiling.groups() + g]);
      const std::uint32_t* from = task_list.get();
      const std::uint64_t* const here = positions[kind].data() + b * job.shafts();
      const std::uint64_t* const next =
          b + 1 == tiling.blocks() ? lists[kind]->offsets.data() + 1 : here + job.shafts();
      for (std::size_t s = tiling.group(g).first; s != tiling.group(g).end(); ++s) {
        const auto size = static_cast<std::size_t>(next[s] - here[s]);
        std::transform(
            from, from + size, lists[kind]->indices.data() + here[s],
            [first = static_cast<std::uint32_t>(tiling.block(b).first)](std::uint32_t i) { return first + i; });
        from += size;
      }
    }
  });
  for (InProgress& each : in_progress) each.complete();
}

}  // namespace shaftcull::kernel
