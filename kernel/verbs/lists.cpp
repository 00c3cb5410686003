// SPDX-License-Identifier: MIT
/// Verbs of lists of indices. For many shafts, bounds in streams are listed in one pass (flat/list_rows.hpp). A tree,
/// and queries that end early, are asked shaft by shaft.
#include <algorithm>
#include <array>
#include <optional>

#include "flat/batch_job.hpp"
#include "flat/index_writer.hpp"
#include "flat/list_rows.hpp"
#include "flat/scan.hpp"
#include "parallel/parallel.hpp"
#include "query/outputs.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/occluded.hpp"
#include "support/arguments.hpp"
#include "support/compiler.hpp"
#include "tree/tree_query.hpp"
#include "verbs/asked.hpp"
#include "verbs/each_shaft.hpp"
#include "verbs/plain_boxes.hpp"
#include "verbs/stream_tests.hpp"
#include "verbs/task_lists.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

using kernel::Asked;
using kernel::bytes_of;
using kernel::IndexRange;
using kernel::Question;
using kernel::Scan;
using kernel::ScannedChunk;
using kernel::task_walks;
using kernel::TreeQuery;
using Output = kernel::SpanOutput<std::uint32_t>;
using SpanList = kernel::IndexList<Output>;

constexpr kernel::Takes takes_limit_alone{.limit = true, .only = false};

/// Indices, called `name` in messages, may be written there.
void require_indices(const Asked& asked, const char* name, std::span<const std::uint32_t> indices,
                     bool may_begin_at_only) {
  asked.require_index_width();
  kernel::require_memory(name, indices, "indices");
  asked.options().require_apart(name, bytes_of(indices), may_begin_at_only);
}

void require_lists(const Asked& asked, const char* name, const IndexLists& lists) {
  asked.require_index_width();
  asked.options().require_apart(name, bytes_of(lists.offsets));
  asked.options().require_apart(name, bytes_of(lists.indices));
}

/// Chunks of a call that ends when it has found `limit` bounds.
constexpr std::size_t chunk_for(std::size_t limit) noexcept {
  return limit == Query::no_limit ? kernel::chunk_bounds : kernel::first_chunk_bounds;
}

std::size_t list_scan(const Asked& asked, std::span<std::uint32_t> kept, std::size_t limit) {
  const Scan scan = asked.scan(0);
  const std::span<std::uint32_t> room = kept.first(std::min(kept.size(), limit));
  if (asked.options().only()) {
    std::size_t count = 0;
    scan.for_each_chunk(kernel::chunk_bounds, [&](const ScannedChunk& chunk) {
      kernel::for_each_bit(chunk.kept, chunk.words, [&](std::size_t i) {
        // Never ahead of what is read, so `kept` may be the candidates' own memory.
        if (count < room.size()) room[count] = scan.index_of(chunk.first + i);
        return ++count != limit;
      });
      return count < limit;
    });
    return count;
  }
  kernel::IndexWriter listed(asked.kernels().set_bits, room);
  scan.for_each_chunk(chunk_for(limit), [&](const ScannedChunk& chunk) {
    listed.add(chunk.first, chunk.kept, chunk.words);
    return listed.count() < limit;
  });
  return std::min(listed.count(), limit);
}

/// Adds to a list (tree/visitors.hpp) what shaft s keeps of a tree.
template <class List>
void list_walk(const TreeQuery& walks, std::size_t s, const List& list, std::size_t limit) {
  if (limit == Query::no_limit) {
    kernel::KeptLister lister(list);
    walks.walk(s, lister);
  } else if (limit != 0) {
    kernel::LimitedLister lister(list, limit);
    walks.walk(s, lister);
  }
}

std::size_t list_kept(const Asked& asked, std::span<std::uint32_t> kept, std::size_t limit) {
  const TreeQuery* const walks = asked.walks();
  if (walks == nullptr) return limit == 0 ? 0 : list_scan(asked, kept, limit);
  Output output(kept);
  list_walk(*walks, 0, SpanList(walks->indices(), output), limit);
  return output.count();
}

std::size_t list_kept(const Asked& asked, std::span<std::uint32_t> kept) {
  return list_kept(asked, kept, asked.options().limit());
}

KeptCounts list_classified_scan(const Asked& asked, std::span<std::uint32_t> overlap, std::span<std::uint32_t> inside) {
  const Scan scan = asked.scan(0);
  if (asked.options().only()) {
    Output overlaps(overlap);
    Output insides(inside);
    scan.for_each_chunk(kernel::chunk_bounds, [&](const ScannedChunk& chunk) {
      kernel::for_each_bit(chunk.kept, chunk.words, [&](std::size_t i) {
        const bool is_inside = (chunk.inside[i / 64] >> i % 64 & 1) != 0;
        (is_inside ? insides : overlaps).push(scan.index_of(chunk.first + i));
        return true;
      });
      return true;
    });
    return {overlaps.count(), insides.count()};
  }
  kernel::IndexWriter overlaps(asked.kernels().set_bits, overlap);
  kernel::IndexWriter insides(asked.kernels().set_bits, inside);
  scan.for_each_chunk(kernel::chunk_bounds, [&](const ScannedChunk& chunk) {
    for (std::size_t w = 0; w != chunk.words; ++w) chunk.kept[w] &= ~chunk.inside[w];
    overlaps.add(chunk.first, chunk.kept, chunk.words);
    insides.add(chunk.first, chunk.inside, chunk.words);
    return true;
  });
  return {overlaps.count(), insides.count()};
}

KeptCounts list_classified_walk(const TreeQuery& walks, std::span<std::uint32_t> overlap,
                                std::span<std::uint32_t> inside) {
  Output overlaps(overlap);
  Output insides(inside);
  kernel::ClassLister lister(SpanList(walks.indices(), overlaps), SpanList(walks.indices(), insides));
  walks.walk(0, lister);
  return {overlaps.count(), insides.count()};
}

/// Lists of bounds in streams of one kind, those kept, or of two: those that overlap and those inside.
template <std::size_t kinds>
void list_streams(const Asked& asked, const std::array<IndexLists*, kinds>& lists) {
  const kernel::StreamTests tests(asked);
  kernel::list_rows(kernel::BatchJob(tests.get()), lists);
  if (!asked.options().only()) return;
  const std::span<const std::uint32_t> named = *asked.options().only();
  constexpr std::size_t block = 16384;
  for (IndexLists* const each : lists) {
    kernel::IncompleteLists<std::uint32_t> in_progress(each->offsets, each->indices);
    kernel::parallel_for(kernel::chunk_count(each->indices.size(), block), 1, [&](std::size_t b, std::size_t) {
      const IndexRange task = kernel::chunk_at(each->indices.size(), block, b);
      for (std::size_t i = task.first; i != task.end(); ++i) each->indices[i] = named[each->indices[i]];
    });
    in_progress.complete();
  }
}

kernel::KeptLeavesList list_to(kernel::KeptLeavesOutput& output) noexcept { return kernel::KeptLeavesList(output); }

void list_tree(const TreeQuery& walks, std::size_t limit, IndexLists& lists) {
  kernel::ShaftTasks tasks(walks.shafts(), task_walks);
  kernel::TaskLists<kernel::KeptLeavesOutput> all(tasks, lists);
  tasks.for_each_shaft([&](std::size_t task, std::size_t s) {
    list_walk(walks, s, list_to(all[task]), limit);
    return all.end_list(task, s);
  });
  all.concatenate([&](const auto& output, std::uint32_t* out) { output.write(walks.indices(), out); });
  all.complete();
}

/// The first bounds of streams that each shaft keeps: shaft by shaft, since each ends somewhere else.
void list_first(const Asked& asked, IndexLists& lists) {
  kernel::ShaftTasks tasks(asked.shafts().size(), 1);
  kernel::TaskLists<kernel::GrowingOutput<std::uint32_t>> all(tasks, lists);
  const std::size_t limit = asked.options().limit();
  tasks.for_each_shaft([&](std::size_t task, std::size_t s) {
    kernel::GrowingOutput<std::uint32_t>& output = all[task];
    const std::size_t before = output.count();
    const Scan scan = asked.scan(s);
    scan.for_each_chunk(kernel::first_chunk_bounds, [&](const ScannedChunk& chunk) {
      kernel::for_each_bit(chunk.kept, chunk.words, [&](std::size_t i) {
        if (output.count() - before == limit) return false;
        output.push(scan.index_of(chunk.first + i));
        return true;
      });
      return output.count() - before != limit;
    });
    return all.end_list(task, s);
  });
  all.concatenate([](const auto& output, std::uint32_t* out) { std::copy_n(output.data(), output.count(), out); });
  all.complete();
}

void list_kept(const Asked& asked, IndexLists& lists) {
  if (const TreeQuery* const walks = asked.walks()) {
    list_tree(*walks, asked.options().limit(), lists);
  } else if (asked.options().has_limit()) {
    list_first(asked, lists);
  } else {
    list_streams<1>(asked, {&lists});
  }
}

// Not inlined, so that queries about plain boxes have no large stack.

SHAFTCULL_NOINLINE std::size_t list_bounds(const CompiledShaft& shaft, const Bounds& bounds,
                                           std::span<std::uint32_t> kept, const Query& query) {
  const Asked asked("list", {&shaft, 1}, bounds, Question::kept, query, kernel::takes_limit);
  require_indices(asked, "kept", kept, true);
  return list_kept(asked, kept);
}

/// Makes the vector as long as the list. It may hold the candidates.
std::size_t list_growing(const Asked& asked, std::vector<std::uint32_t>& listed) {
  constexpr std::size_t least_room = 256;
  const bool holds_candidates =
      asked.options().only() && !listed.empty() && asked.options().only()->data() == listed.data();
  if (!holds_candidates) listed.resize(std::max(listed.size(), std::min(least_room, asked.size())));
  std::size_t size = list_kept(asked, listed);
  const bool fits = size <= listed.size();
  listed.resize(size);
  if (!fits) size = list_kept(asked, listed);
  return size;
}

}  // namespace

std::size_t list(const CompiledShaft& shaft, const Bounds& bounds, std::span<std::uint32_t> kept, const Query& query) {
  if (const BoxView* const boxes = kernel::plain_boxes(bounds, query)) [[likely]] {
    kernel::require_plain(shaft, *boxes);
    kernel::require_index_width("list", boxes->count);
    kernel::require_memory("kept", kept, "indices");
    const kernel::Kernels& kernels = kernel::active_kernels();
    kernel::IndexWriter listed(kernels.set_bits, kept);
    kernel::for_each_plain_chunk(shaft, *boxes, kernels, kernel::chunk_bounds, [&](const ScannedChunk& chunk) {
      listed.add(chunk.first, chunk.kept, chunk.words);
      return true;
    });
    return listed.count();
  }
  return list_bounds(shaft, bounds, kept, query);
}

std::size_t list(const CompiledShaft& shaft, const Bounds& bounds, std::vector<std::uint32_t>& kept,
                 const Query& query) {
  const Asked asked("list", {&shaft, 1}, bounds, Question::kept, query, kernel::takes_limit);
  require_indices(asked, "kept", kept, true);
  return list_growing(asked, kept);
}

KeptCounts list_classified(const CompiledShaft& shaft, const Bounds& bounds, std::span<std::uint32_t> overlap,
                           std::span<std::uint32_t> inside, const Query& query) {
  const Asked asked("list_classified", {&shaft, 1}, bounds, Question::kept_and_inside, query, kernel::takes_candidates);
  require_indices(asked, "overlap", overlap, false);
  require_indices(asked, "inside", inside, false);
  kernel::require_apart("list_classified", "overlap", bytes_of(overlap), "inside", bytes_of(inside));
  if (const TreeQuery* const walks = asked.walks()) return list_classified_walk(*walks, overlap, inside);
  return list_classified_scan(asked, overlap, inside);
}

void list_many(std::span<const CompiledShaft> shafts, const Bounds& bounds, IndexLists& lists, const Query& query) {
  const Asked asked("list_many", shafts, bounds, Question::kept, query, kernel::takes_limit);
  require_lists(asked, "lists", lists);
  list_kept(asked, lists);
}

void list_classified_many(std::span<const CompiledShaft> shafts, const Bounds& bounds, IndexLists& overlap,
                          IndexLists& inside, const Query& query) {
  const Asked asked("list_classified_many", shafts, bounds, Question::kept_and_inside, query, kernel::takes_candidates);
  if (&overlap == &inside) kernel::refuse_shared_memory("list_classified_many", "overlap", "inside");
  require_lists(asked, "overlap", overlap);
  require_lists(asked, "inside", inside);
  const TreeQuery* const walks = asked.walks();
  if (walks == nullptr) return list_streams<2>(asked, {&overlap, &inside});
  kernel::ShaftTasks tasks(shafts.size(), task_walks);
  kernel::TaskLists<kernel::KeptLeavesOutput> overlaps(tasks, overlap);
  kernel::TaskLists<kernel::KeptLeavesOutput> insides(tasks, inside);
  tasks.for_each_shaft([&](std::size_t task, std::size_t s) {
    kernel::ClassLister lister(list_to(overlaps[task]), list_to(insides[task]));
    walks->walk(s, lister);
    return overlaps.end_list(task, s) + insides.end_list(task, s);
  });
  const auto write = [&](const auto& output, std::uint32_t* out) { output.write(walks->indices(), out); };
  overlaps.concatenate(write);
  insides.concatenate(write);
  overlaps.complete();
  insides.complete();
}

std::optional<std::uint32_t> find_occluder(const CompiledShaft& shaft, const Bounds& solids, const Query& query) {
  const Asked asked("find_occluder", {&shaft, 1}, solids, Question::blocking, query, {.only = false});
  asked.require_index_width();
  std::uint32_t first = 0;
  if (list_kept(asked, {&first, 1}, 1) == 0) return std::nullopt;
  return first;
}

std::size_t list_occluders(const CompiledShaft& shaft, const Bounds& solids, std::span<std::uint32_t> blocking,
                           const Query& query) {
  const Asked asked("list_occluders", {&shaft, 1}, solids, Question::blocking, query, takes_limit_alone);
  require_indices(asked, "blocking", blocking, false);
  return list_kept(asked, blocking);
}

std::size_t list_occluders(const CompiledShaft& shaft, const Bounds& solids, std::vector<std::uint32_t>& blocking,
                           const Query& query) {
  const Asked asked("list_occluders", {&shaft, 1}, solids, Question::blocking, query, takes_limit_alone);
  require_indices(asked, "blocking", blocking, false);
  return list_growing(asked, blocking);
}

void list_occluders_many(std::span<const CompiledShaft> shafts, const Bounds& solids, IndexLists& lists,
                         const Query& query) {
  const Asked asked("list_occluders_many", shafts, solids, Question::blocking, query, takes_limit_alone);
  require_lists(asked, "lists", lists);
  list_kept(asked, lists);
}

}  // namespace shaftcull
