// SPDX-License-Identifier: MIT
/// Many shafts against a tree, in parallel: counts, lists and callbacks.
#include <algorithm>
#include <type_traits>
#include <utility>

#include "parallel/parallel.hpp"
#include "shaftcull/blocked.hpp"
#include "support/fail.hpp"
#include "support/index_range.hpp"
#include "support/list_memory.hpp"
#include "tree/query.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

using kernel::chunk_at;
using kernel::chunk_count;
using kernel::IndexRange;
using kernel::Question;
using kernel::task_shafts;

std::vector<std::uint32_t>& items_of(IndexLists& lists) { return lists.indices; }
std::vector<LeafRange>& items_of(LeafRangeLists& lists) { return lists.ranges; }
using LeafRanges = kernel::ChunkedOutput<LeafRange>;

kernel::KeptLeavesList list_of(const kernel::LeafIndices& /*indices*/, kernel::KeptLeavesOutput& output) {
  return kernel::KeptLeavesList(output);
}
kernel::LeafRangeList<LeafRanges> list_of(const kernel::LeafIndices& indices, LeafRanges& output) {
  return {indices, output};
}

void write(const kernel::KeptLeavesOutput& kept, const kernel::LeafIndices& indices, std::uint32_t* out) {
  kept.write(indices, out);
}
void write(const LeafRanges& ranges, const kernel::LeafIndices& /*indices*/, LeafRange* out) {
  ranges.for_each_chunk([&](const LeafRange* items, std::size_t size) { out = std::copy_n(items, size, out); });
}

/// The tasks' outputs, to be concatenated.
template <class Lists>
class TaskOutputs {
 public:
  using Output = std::conditional_t<std::is_same_v<Lists, IndexLists>, kernel::KeptLeavesOutput, LeafRanges>;

  TaskOutputs(std::size_t shafts, Lists& lists)
      : shafts_(shafts),
        output_(chunk_count(shafts, task_shafts)),
        lists_(lists),
        in_progress_(lists.offsets, items_of(lists)) {
    lists.offsets.assign(shafts + 1, 0);
  }
  [[nodiscard]] Output& operator[](std::size_t task) noexcept { return output_[task]; }
  /// Ends the list of shaft s, which is the last one in its task's output so far.
  void end_list(std::size_t task, std::size_t s) noexcept { lists_.offsets[s + 1] = output_[task].count(); }

  void concatenate(const kernel::LeafIndices& indices) {
    std::uint64_t before = 0;
    for (std::size_t t = 0; t != output_.size(); ++t) {
      const IndexRange task = chunk_at(shafts_, task_shafts, t);
      for (std::size_t s = task.first; s != task.end(); ++s) lists_.offsets[s + 1] += before;
      before = lists_.offsets[task.end()];
    }
    in_progress_.resize_items(before);
    auto& items = items_of(lists_);
    kernel::parallel_for(output_.size(), 1, [&](std::size_t t, std::size_t) {
      const Output done = std::move(output_[t]);
      write(done, indices, items.data() + lists_.offsets[t * task_shafts]);
    });
  }
  /// All lists of the call are concatenated: they are not emptied at the end.
  void complete() noexcept { in_progress_.complete(); }

 private:
  std::size_t shafts_;
  std::vector<Output> output_;
  Lists& lists_;
  kernel::IncompleteLists<typename std::decay_t<decltype(items_of(std::declval<Lists&>()))>::value_type> in_progress_;
};

/// Throws InvalidArgument if lists, called `name` in the message of `call`, hold memory that excludes bounds.
template <class Bound, class Lists>
void require_apart(const kernel::Query<Bound>& query, const char* call, const char* name, Lists& lists) {
  query.require_apart(call, name, kernel::bytes_of(lists.offsets));
  query.require_apart(call, name, kernel::bytes_of(items_of(lists)));
}

template <class Bound, class Lists>
void list_kept(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree, Lists& lists,
               const Excluding& excluding, Question question = Question::kept, const char* call = "list_many") {
  const kernel::Query<Bound> query(shafts, tree, question, excluding);
  require_apart(query, call, "lists", lists);
  TaskOutputs<Lists> all(shafts.size(), lists);
  kernel::parallel_for(chunk_count(shafts.size(), task_shafts), 1, [&](std::size_t t, std::size_t) {
    const IndexRange task = chunk_at(shafts.size(), task_shafts, t);
    for (std::size_t s = task.first; s != task.end(); ++s) {
      kernel::KeptLister lister(list_of(query.indices(), all[t]));
      query.walk(s, lister);
      all.end_list(t, s);
    }
  });
  all.concatenate(query.indices());
  all.complete();
}

template <class Bound, class Lists>
void list_classes(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree, Lists& overlap, Lists& inside,
                  const Excluding& excluding) {
  const kernel::Query<Bound> query(shafts, tree, Question::kept_and_inside, excluding);
  if (&overlap == &inside) kernel::refuse_shared_memory("list_classified_many", "overlap", "inside");
  require_apart(query, "list_classified_many", "overlap", overlap);
  require_apart(query, "list_classified_many", "inside", inside);
  TaskOutputs<Lists> overlaps(shafts.size(), overlap);
  TaskOutputs<Lists> insides(shafts.size(), inside);
  kernel::parallel_for(chunk_count(shafts.size(), task_shafts), 1, [&](std::size_t t, std::size_t) {
    const IndexRange task = chunk_at(shafts.size(), task_shafts, t);
    for (std::size_t s = task.first; s != task.end(); ++s) {
      kernel::ClassLister lister(list_of(query.indices(), overlaps[t]), list_of(query.indices(), insides[t]));
      query.walk(s, lister);
      overlaps.end_list(t, s);
      insides.end_list(t, s);
    }
  });
  overlaps.concatenate(query.indices());
  insides.concatenate(query.indices());
  overlaps.complete();
  insides.complete();
}

/// Shafts whose answers wait for their turn, for each thread.
constexpr std::size_t slots_per_thread = 8;

template <class Callback>
void require_callback(const Callback& callback) {
  if (!callback) kernel::fail(InvalidArgument("the shaft callback is empty; pass something that can be called"));
}

/// Walks with the visitor that visitor_of(slot) makes, for every shaft in parallel, and then calls deliver(s, slot),
/// one at a time in their order. `Slot` is where a shaft's answers wait; it can be cleared.
template <class Slot, class Bound, class VisitorOf, class Deliver>
void deliver_in_order(const kernel::Query<Bound>& query, const VisitorOf& visitor_of, const Deliver& deliver) {
  std::vector<Slot> slots(slots_per_thread * static_cast<std::size_t>(kernel::threads_here()));
  const auto work = [&](std::size_t s, std::size_t slot) {
    slots[slot].clear();
    auto visitor = visitor_of(slots[slot]);
    query.walk(s, visitor);
  };
  kernel::ordered_pipeline(query.shafts(), slots.size(), work,
                           [&](std::size_t s, std::size_t slot) { deliver(s, slots[slot]); });
}

using Ranges = kernel::GrowingOutput<LeafRange>;
using RangeList = kernel::LeafRangeList<Ranges>;

std::span<const LeafRange> span_of(const Ranges& ranges) noexcept { return {ranges.data(), ranges.count()}; }

}  // namespace

template <class Bound>
void count_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                std::span<std::uint64_t> kept_counts, const Excluding& excluding) {
  const kernel::Query<Bound> query(shafts, tree, Question::kept, excluding);
  kernel::require_counts("kept_counts", kept_counts, shafts.size());
  query.require_apart("count_many", "kept_counts", kernel::bytes_of(kept_counts));
  kernel::parallel_for(chunk_count(shafts.size(), task_shafts), 1, [&](std::size_t t, std::size_t) {
    const IndexRange task = chunk_at(shafts.size(), task_shafts, t);
    for (std::size_t s = task.first; s != task.end(); ++s) {
      kernel::Counter counter(query.kernels());
      query.walk(s, counter);
      kept_counts[s] = counter.count();
    }
  });
}

template <class Bound>
void count_at_most_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree, std::size_t most,
                        std::span<std::uint64_t> kept_counts, const Excluding& excluding) {
  const kernel::Query<Bound> query(shafts, tree, Question::kept, excluding);
  kernel::require_counts("kept_counts", kept_counts, shafts.size());
  query.require_apart("count_at_most_many", "kept_counts", kernel::bytes_of(kept_counts));
  kernel::parallel_for(chunk_count(shafts.size(), task_shafts), 1, [&](std::size_t t, std::size_t) {
    const IndexRange task = chunk_at(shafts.size(), task_shafts, t);
    for (std::size_t s = task.first; s != task.end(); ++s) {
      kernel::LimitedCounter counter(most);
      if (most != 0) query.walk(s, counter);
      kept_counts[s] = counter.count();
    }
  });
}

template <class Bound>
void list_at_most_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree, std::size_t most,
                       std::span<std::uint32_t> kept, std::span<std::uint64_t> kept_counts,
                       const Excluding& excluding) {
  const kernel::Query<Bound> query(shafts, tree, Question::kept, excluding);
  kernel::require_room("kept", kept, shafts.size(), most);
  kernel::require_counts("kept_counts", kept_counts, shafts.size());
  constexpr const char* call = "list_at_most_many";
  kernel::require_apart(call, "kept", kernel::bytes_of(kept), "kept_counts", kernel::bytes_of(kept_counts));
  query.require_apart(call, "kept", kernel::bytes_of(kept));
  query.require_apart(call, "kept_counts", kernel::bytes_of(kept_counts));
  kernel::parallel_for(chunk_count(shafts.size(), task_shafts), 1, [&](std::size_t t, std::size_t) {
    const IndexRange task = chunk_at(shafts.size(), task_shafts, t);
    for (std::size_t s = task.first; s != task.end(); ++s) {
      kernel::SpanOutput<std::uint32_t> output(kept.subspan(s * most, most));
      using List = kernel::IndexList<kernel::SpanOutput<std::uint32_t>>;
      kernel::LimitedLister<List> lister(List(query.indices(), output), output, most);
      if (most != 0) query.walk(s, lister);
      kept_counts[s] = std::min(output.count(), most);
    }
  });
}

template <class Bound>
void count_classified_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                           std::span<KeptCounts> counts, const Excluding& excluding) {
  const kernel::Query<Bound> query(shafts, tree, Question::kept_and_inside, excluding);
  kernel::require_counts("counts", counts, shafts.size());
  query.require_apart("count_classified_many", "counts", kernel::bytes_of(counts));
  kernel::parallel_for(chunk_count(shafts.size(), task_shafts), 1, [&](std::size_t t, std::size_t) {
    const IndexRange task = chunk_at(shafts.size(), task_shafts, t);
    for (std::size_t s = task.first; s != task.end(); ++s) {
      kernel::ClassCounter counter(query.kernels());
      query.walk(s, counter);
      counts[s] = counter.counts();
    }
  });
}

template <class Bound>
void list_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree, IndexLists& lists,
               const Excluding& excluding) {
  list_kept(shafts, tree, lists, excluding);
}
template <class Bound>
void list_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree, LeafRangeLists& lists,
               const Excluding& excluding) {
  list_kept(shafts, tree, lists, excluding);
}

void list_blocking_many(std::span<const CompiledShaft> shafts, const BoundsTree<Box>& solids, IndexLists& lists,
                        const Excluding& excluding) {
  list_kept(shafts, solids, lists, excluding, Question::blocking, "list_blocking_many");
}
template <class Bound>
void list_classified_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree, IndexLists& overlap,
                          IndexLists& inside, const Excluding& excluding) {
  list_classes(shafts, tree, overlap, inside, excluding);
}
template <class Bound>
void list_classified_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree, LeafRangeLists& overlap,
                          LeafRangeLists& inside, const Excluding& excluding) {
  list_classes(shafts, tree, overlap, inside, excluding);
}

template <class Bound>
void for_each_kept(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                   FunctionRef<void(const KeptRanges&)> callback, const Excluding& excluding) {
  const kernel::Query<Bound> query(shafts, tree, Question::kept, excluding);
  require_callback(callback);
  deliver_in_order<Ranges>(
      query, [&](Ranges& kept) { return kernel::KeptLister(RangeList(query.indices(), kept)); },
      [&](std::size_t s, const Ranges& kept) {
        callback({s, span_of(kept)});
      });
}

template <class Bound>
void for_each_classified(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                         FunctionRef<void(const ClassifiedRanges&)> callback, const Excluding& excluding) {
  const kernel::Query<Bound> query(shafts, tree, Question::kept_and_inside, excluding);
  require_callback(callback);
  struct Slot {
    Ranges overlap;
    Ranges inside;
    void clear() noexcept {
      overlap.clear();
      inside.clear();
    }
  };
  deliver_in_order<Slot>(
      query,
      [&](Slot& slot) {
        return kernel::ClassLister(RangeList(query.indices(), slot.overlap), RangeList(query.indices(), slot.inside));
      },
      [&](std::size_t s, const Slot& slot) {
        callback({s, span_of(slot.overlap), span_of(slot.inside)});
      });
}

#define SHAFTCULL_QUERIES(Bound)                                                                                       \
  template void count_many(std::span<const CompiledShaft>, const BoundsTree<Bound>&, std::span<std::uint64_t>,         \
                           const Excluding&);                                                                          \
  template void count_at_most_many(std::span<const CompiledShaft>, const BoundsTree<Bound>&, std::size_t,              \
                                   std::span<std::uint64_t>, const Excluding&);                                        \
  template void list_at_most_many(std::span<const CompiledShaft>, const BoundsTree<Bound>&, std::size_t,               \
                                  std::span<std::uint32_t>, std::span<std::uint64_t>, const Excluding&);               \
  template void count_classified_many(std::span<const CompiledShaft>, const BoundsTree<Bound>&, std::span<KeptCounts>, \
                                      const Excluding&);                                                               \
  template void list_many(std::span<const CompiledShaft>, const BoundsTree<Bound>&, IndexLists&, const Excluding&);    \
  template void list_many(std::span<const CompiledShaft>, const BoundsTree<Bound>&, LeafRangeLists&,                   \
                          const Excluding&);                                                                           \
  template void list_classified_many(std::span<const CompiledShaft>, const BoundsTree<Bound>&, IndexLists&,            \
                                     IndexLists&, const Excluding&);                                                   \
  template void list_classified_many(std::span<const CompiledShaft>, const BoundsTree<Bound>&, LeafRangeLists&,        \
                                     LeafRangeLists&, const Excluding&);                                               \
  template void for_each_kept(std::span<const CompiledShaft>, const BoundsTree<Bound>&,                                \
                              FunctionRef<void(const KeptRanges&)>, const Excluding&);                                 \
  template void for_each_classified(std::span<const CompiledShaft>, const BoundsTree<Bound>&,                          \
                                    FunctionRef<void(const ClassifiedRanges&)>, const Excluding&);
SHAFTCULL_QUERIES(Box)
SHAFTCULL_QUERIES(Sphere)
#undef SHAFTCULL_QUERIES

}  // namespace shaftcull
