/// list_many(), list_classified_many() and list_blocking_many(): one pass over the bounds. Tasks list what they keep in
/// memory of their own. Once all counts are known, these lists are copied to where they belong in the user's.
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "flat/batch_job.hpp"
#include "parallel/parallel.hpp"
#include "parallel/task_memory.hpp"
#include "shaftcull/blocked.hpp"
#include "shaftcull/many.hpp"
#include "support/list_memory.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

/// What a task lists, of its first shaft, then of the second, …: positions within its block.
using TaskList = kernel::TaskMemory<std::uint32_t>;

/// Turns counts, one row of shafts for every block, into positions in `indices` where the lists go; fills `offsets`.
void turn_into_positions(std::vector<std::uint64_t>& counts, std::size_t blocks, std::size_t shafts,
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

/// Lists bounds of one kind, those kept, or of two: those that overlap and those inside.
template <class View, class Index, std::size_t kinds>
void list_rows(std::span<const CompiledShaft> shafts, const View& bounds,
               const std::array<IndexListsOf<Index>*, kinds>& lists, const char* call, Form form,
               kernel::Bits kind_of_bits = kinds == 2 ? kernel::Bits::kept_and_inside : kernel::Bits::kept) {
  const kernel::BatchJob<View> job(shafts, bounds, kind_of_bits, form);
  kernel::require_index_width<Index>(call, bounds.count);

  const kernel::Tiling tiling = kernel::Tiling::unordered(job.bounds(), job.shafts());
  std::array<std::vector<TaskList>, kinds> task_lists;
  std::array<std::vector<std::uint64_t>, kinds> positions;  // counts at first
  for (std::size_t kind = 0; kind != kinds; ++kind) {
    task_lists[kind].resize(tiling.blocks() * tiling.groups());
    positions[kind].resize(tiling.blocks() * job.shafts());
  }
  const kernel::SetBits& set_bits = job.set_bits();
  kernel::parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    const kernel::IndexRange block = tiling.block(b);
    const kernel::IndexRange group = tiling.group(g);
    const std::size_t words = words_for(block.size);
    const std::size_t kind_words = group.size * words;
    kernel::TaskScratch<std::uint64_t, 4 * kernel::tile_words> scratch(kinds * kind_words);
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
      TaskList task_list(total + kernel::set_bits_slack);
      std::uint32_t* out = task_list.get();
      for (std::size_t s = 0; s != group.size; ++s) {
        set_bits.write(bits + s * words, words, counts[s], out);
        out += counts[s];
      }
      task_lists[kind][b * tiling.groups() + g] = std::move(task_list);
    }
  });

  using InProgress = kernel::IncompleteLists<Index>;
  auto in_progress = [&]<std::size_t... kind>(std::index_sequence<kind...>) {
    return std::array<InProgress, kinds>{InProgress(lists[kind]->offsets, lists[kind]->indices)...};
  }
  (std::make_index_sequence<kinds>());
  for (std::size_t kind = 0; kind != kinds; ++kind) {
    turn_into_positions(positions[kind], tiling.blocks(), job.shafts(), lists[kind]->offsets);
    in_progress[kind].resize_items(lists[kind]->offsets.back());
  }
  kernel::parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    for (std::size_t kind = 0; kind != kinds; ++kind) {
      const TaskList task_list = std::move(task_lists[kind][b * tiling.groups() + g]);
      const std::uint32_t* from = task_list.get();
      const std::uint64_t* const here = positions[kind].data() + b * job.shafts();
      const std::uint64_t* const next =
          b + 1 == tiling.blocks() ? lists[kind]->offsets.data() + 1 : here + job.shafts();
      for (std::size_t s = tiling.group(g).first; s != tiling.group(g).end(); ++s) {
        const auto size = static_cast<std::size_t>(next[s] - here[s]);
        std::transform(from, from + size, lists[kind]->indices.data() + here[s],
                       [first = static_cast<Index>(tiling.block(b).first)](std::uint32_t i) { return first + i; });
        from += size;
      }
    }
  });
  for (InProgress& each : in_progress) each.complete();
}

template <class View, class Index>
void list_kept(std::span<const CompiledShaft> shafts, const View& bounds, IndexListsOf<Index>& lists, Form form) {
  list_rows<View, Index, 1>(shafts, bounds, {&lists}, "list_many()", form);
}

template <class View, class Index>
void list_classes(std::span<const CompiledShaft> shafts, const View& bounds, IndexListsOf<Index>& overlap,
                  IndexListsOf<Index>& inside, Form form) {
  if (&overlap == &inside) kernel::refuse_shared_memory("list_classified_many", "overlap", "inside");
  list_rows<View, Index, 2>(shafts, bounds, {&overlap, &inside}, "list_classified_many()", form);
}

}  // namespace

template <BoundIndex Index>
void list_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, IndexListsOf<Index>& lists, Form form) {
  list_kept(shafts, boxes, lists, form);
}
template <BoundIndex Index>
void list_many(std::span<const CompiledShaft> shafts, const SphereView& spheres, IndexListsOf<Index>& lists,
               Form form) {
  list_kept(shafts, spheres, lists, form);
}

template <BoundIndex Index>
void list_classified_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, IndexListsOf<Index>& overlap,
                          IndexListsOf<Index>& inside, Form form) {
  list_classes(shafts, boxes, overlap, inside, form);
}
template <BoundIndex Index>
void list_classified_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                          IndexListsOf<Index>& overlap, IndexListsOf<Index>& inside, Form form) {
  list_classes(shafts, spheres, overlap, inside, form);
}

template <BoundIndex Index>
void list_blocking_many(std::span<const CompiledShaft> shafts, const BoxView& solids, IndexListsOf<Index>& lists) {
  list_rows<BoxView, Index, 1>(shafts, solids, {&lists}, "list_blocking_many()", Form::fastest, kernel::Bits::blocking);
}

template void list_blocking_many(std::span<const CompiledShaft>, const BoxView&, IndexListsOf<std::uint32_t>&);
template void list_blocking_many(std::span<const CompiledShaft>, const BoxView&, IndexListsOf<std::uint64_t>&);

template void list_many(std::span<const CompiledShaft>, const BoxView&, IndexListsOf<std::uint32_t>&, Form);
template void list_many(std::span<const CompiledShaft>, const BoxView&, IndexListsOf<std::uint64_t>&, Form);
template void list_many(std::span<const CompiledShaft>, const SphereView&, IndexListsOf<std::uint32_t>&, Form);
template void list_many(std::span<const CompiledShaft>, const SphereView&, IndexListsOf<std::uint64_t>&, Form);

template void list_classified_many(std::span<const CompiledShaft>, const BoxView&, IndexListsOf<std::uint32_t>&,
                                   IndexListsOf<std::uint32_t>&, Form);
template void list_classified_many(std::span<const CompiledShaft>, const BoxView&, IndexListsOf<std::uint64_t>&,
                                   IndexListsOf<std::uint64_t>&, Form);
template void list_classified_many(std::span<const CompiledShaft>, const SphereView&, IndexListsOf<std::uint32_t>&,
                                   IndexListsOf<std::uint32_t>&, Form);
template void list_classified_many(std::span<const CompiledShaft>, const SphereView&, IndexListsOf<std::uint64_t>&,
                                   IndexListsOf<std::uint64_t>&, Form);

}  // namespace shaftcull
