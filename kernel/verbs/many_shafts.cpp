// SPDX-License-Identifier: MIT
/// The verbs for many shafts (shaftcull/many.hpp). Bounds in streams are cut into tiles (flat/batch_job.hpp); a tree,
/// and queries that end early, are asked shaft by shaft.
#include <algorithm>
#include <array>
#include <optional>

#include "flat/batch_job.hpp"
#include "flat/list_rows.hpp"
#include "flat/packed.hpp"
#include "flat/shaft_bits.hpp"
#include "parallel/parallel.hpp"
#include "parallel/shared_number.hpp"
#include "parallel/task_memory.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/occluded.hpp"
#include "support/arguments.hpp"
#include "tree/tree_answers.hpp"
#include "verbs/asked.hpp"
#include "verbs/each_shaft.hpp"
#include "verbs/task_lists.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

using kernel::Asked;
using kernel::BatchJob;
using kernel::bytes_of;
using kernel::for_each_shaft;
using kernel::IndexRange;
using kernel::Question;
using kernel::ShaftTests;
using kernel::task_walks;
using kernel::Tiling;
using kernel::TreeQuery;

/// The tests of all shafts against bounds in streams: those of a view, or a copy of the candidates.
class StreamTests {
 public:
  explicit StreamTests(const Asked& asked)
      : tests_(asked.shafts(), asked.options().only() ? packed_.emplace(asked.scanned()).bounds() : asked.scanned(),
               asked.question(), asked.options(), asked.kernels()) {}

  [[nodiscard]] const ShaftTests& get() const noexcept { return tests_; }

 private:
  std::optional<kernel::PackedCandidates> packed_;
  ShaftTests tests_;
};

void require_rows(const Asked& asked, const char* name, std::span<const std::uint64_t> words) {
  kernel::require_rows(name, words, asked.shafts().size(), asked.row_words());
  asked.options().require_apart(name, bytes_of(words));
}
template <class Count>
void require_counts(const Asked& asked, const char* name, std::span<Count> counts) {
  kernel::require_counts(name, counts, asked.shafts().size());
  asked.options().require_apart(name, bytes_of(counts));
}
void require_lists(const Asked& asked, const char* name, const IndexLists& lists) {
  asked.require_index_width();
  asked.options().require_apart(name, bytes_of(lists.offsets));
  asked.options().require_apart(name, bytes_of(lists.indices));
}

/// Bits of a view: every task writes its words straight into the user's rows.
void write_rows_of_view(const Asked& asked, std::uint64_t* kept, std::uint64_t* inside) {
  const StreamTests tests(asked);
  const BatchJob job(tests.get());
  const Tiling tiling(asked.size(), asked.shafts().size());
  kernel::parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    const IndexRange block = tiling.block(b);
    const IndexRange group = tiling.group(g);
    const std::size_t first = group.first * asked.row_words() + block.first / 64;
    const kernel::Rows all_kept{kept, asked.row_words()};
    const kernel::Rows all_inside{inside, asked.row_words()};
    job.test(block, group, all_kept.from(first), all_inside.from(first));
  });
}

void write_rows(const Asked& asked, std::uint64_t* kept, std::uint64_t* inside) {
  const std::size_t words = asked.row_words();
  if (words == 0) return;
  const auto row = [words](std::uint64_t* rows, std::size_t s) { return rows == nullptr ? nullptr : rows + s * words; };
  if (const TreeQuery* const walks = asked.walks()) {
    for_each_shaft(asked.shafts().size(), task_walks,
                   [&](std::size_t s) { kernel::write_bits(*walks, s, row(kept, s), row(inside, s)); });
  } else if (asked.options().only()) {
    for_each_shaft(asked.shafts().size(), 1,
                   [&](std::size_t s) { asked.scan(s).write_bits(row(kept, s), row(inside, s)); });
  } else {
    write_rows_of_view(asked, kept, inside);
  }
}

/// Calls use(s, kept, inside, words) for every shaft with bits of some of its bounds; `inside` is null unless the
/// question asks for it. Tasks call it at the same time, for the same shaft, too.
template <class Use>
void for_each_block(const Asked& asked, const Use& use) {
  const StreamTests tests(asked);
  const BatchJob job(tests.get());
  const bool both = kernel::asks_for_inside(asked.question());
  const Tiling tiling(job.bounds().count, job.shafts());
  kernel::parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    const IndexRange block = tiling.block(b);
    const IndexRange group = tiling.group(g);
    const std::size_t words = bit_words(block.size);
    kernel::TaskScratch<std::uint64_t, 4 * kernel::tile_words> bits((both ? 2 : 1) * group.size * words);
    std::uint64_t* const kept = bits.get();
    std::uint64_t* const inside = both ? kept + group.size * words : nullptr;
    job.test(block, group, {kept, words}, {inside, words});
    for (std::size_t s = 0; s != group.size; ++s) {
      use(group.first + s, kept + s * words, both ? inside + s * words : nullptr, words);
    }
  });
}

/// Lists of bounds in streams of one kind, those kept, or of two: those that overlap and those inside.
template <std::size_t kinds>
void list_streams(const Asked& asked, const std::array<IndexLists*, kinds>& lists) {
  const StreamTests tests(asked);
  kernel::list_rows(BatchJob(tests.get()), lists);
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
  kernel::TaskLists<kernel::KeptLeavesOutput> all(walks.shafts(), task_walks, lists);
  all.for_each_shaft([&](std::size_t s, kernel::KeptLeavesOutput& output) {
    if (limit == Query::no_limit) {
      kernel::KeptLister lister(list_to(output));
      walks.walk(s, lister);
    } else if (limit != 0) {
      kernel::LimitedLister lister(list_to(output), limit);
      walks.walk(s, lister);
    }
  });
  all.concatenate([&](const auto& output, std::uint32_t* out) { output.write(walks.indices(), out); });
  all.complete();
}

/// The first bounds of streams that each shaft keeps: shaft by shaft, since each ends somewhere else.
void list_first(const Asked& asked, IndexLists& lists) {
  kernel::TaskLists<kernel::GrowingOutput<std::uint32_t>> all(asked.shafts().size(), 1, lists);
  all.for_each_shaft([&](std::size_t s, auto& output) { asked.scan(s).list(output, asked.options().limit()); });
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

void find_any(const Asked& asked, std::span<std::uint64_t> any) {
  const TreeQuery* const walks = asked.walks();
  if (walks == nullptr) return kernel::find_by_shaft(StreamTests(asked).get(), any);
  for_each_shaft(any.size(), 1, [&](std::size_t w) {  // a task for each word, so that no two share one
    std::uint64_t bits = 0;
    for (std::size_t s = 64 * w; s != std::min(asked.shafts().size(), 64 * (w + 1)); ++s) {
      bits |= std::uint64_t{kernel::any(*walks, s)} << s % 64;
    }
    any[w] = bits;
  });
}

}  // namespace

void cull_many(std::span<const CompiledShaft> shafts, const Bounds& bounds, std::span<std::uint64_t> kept_rows,
               const Query& query) {
  const Asked asked("cull_many", shafts, bounds, Question::kept, query, kernel::takes_candidates);
  require_rows(asked, "kept_rows", kept_rows);
  write_rows(asked, kept_rows.data(), nullptr);
}

void classify_many(std::span<const CompiledShaft> shafts, const Bounds& bounds, std::span<std::uint64_t> kept_rows,
                   std::span<std::uint64_t> inside_rows, const Query& query) {
  const bool wants_kept = !kept_rows.empty();
  const Asked asked("classify_many", shafts, bounds, wants_kept ? Question::kept_and_inside : Question::inside, query,
                    kernel::takes_candidates);
  if (wants_kept) require_rows(asked, "kept_rows", kept_rows);
  require_rows(asked, "inside_rows", inside_rows);
  kernel::require_apart("classify_many", "kept_rows", bytes_of(kept_rows), "inside_rows", bytes_of(inside_rows));
  write_rows(asked, wants_kept ? kept_rows.data() : nullptr, inside_rows.data());
}

void count_many(std::span<const CompiledShaft> shafts, const Bounds& bounds, std::span<std::uint64_t> kept_counts,
                const Query& query) {
  const Asked asked("count_many", shafts, bounds, Question::kept, query, kernel::takes_limit);
  require_counts(asked, "kept_counts", kept_counts);
  const std::size_t limit = asked.options().limit();
  if (const TreeQuery* const walks = asked.walks()) {
    return for_each_shaft(shafts.size(), task_walks,
                          [&](std::size_t s) { kept_counts[s] = kernel::count(*walks, s, limit); });
  }
  if (asked.options().has_limit()) {
    return for_each_shaft(shafts.size(), 1, [&](std::size_t s) { kept_counts[s] = asked.scan(s).count(limit); });
  }
  std::fill(kept_counts.begin(), kept_counts.end(), 0);
  for_each_block(asked, [&](std::size_t s, const std::uint64_t* kept, const std::uint64_t*, std::size_t words) {
    // Sums of integers do not depend on the order in which tasks get here.
    kernel::SharedNumber<std::uint64_t>(kept_counts[s]).add(asked.kernels().set_bits.count(kept, words));
  });
}

void count_classified_many(std::span<const CompiledShaft> shafts, const Bounds& bounds, std::span<KeptCounts> counts,
                           const Query& query) {
  const Asked asked("count_classified_many", shafts, bounds, Question::kept_and_inside, query,
                    kernel::takes_candidates);
  require_counts(asked, "counts", counts);
  if (const TreeQuery* const walks = asked.walks()) {
    return for_each_shaft(shafts.size(), task_walks,
                          [&](std::size_t s) { counts[s] = kernel::count_classified(*walks, s); });
  }
  std::fill(counts.begin(), counts.end(), KeptCounts{});
  const auto count_bits = asked.kernels().set_bits.count;
  for_each_block(asked, [&](std::size_t s, const std::uint64_t* kept, const std::uint64_t* inside, std::size_t words) {
    const std::size_t insides = count_bits(inside, words);
    kernel::SharedNumber(counts[s].overlap).add(count_bits(kept, words) - insides);  // bounds that are inside are kept
    kernel::SharedNumber(counts[s].inside).add(insides);
  });
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
  kernel::TaskLists<kernel::KeptLeavesOutput> overlaps(shafts.size(), task_walks, overlap);
  kernel::TaskLists<kernel::KeptLeavesOutput> insides(shafts.size(), task_walks, inside);
  kernel::parallel_for(overlaps.tasks(), 1, [&](std::size_t t, std::size_t) {
    const IndexRange task = overlaps.shafts_of(t);
    for (std::size_t s = task.first; s != task.end(); ++s) {
      kernel::ClassLister lister(list_to(overlaps[t]), list_to(insides[t]));
      walks->walk(s, lister);
      overlaps.end_list(t, s);
      insides.end_list(t, s);
    }
  });
  const auto write = [&](const auto& output, std::uint32_t* out) { output.write(walks->indices(), out); };
  overlaps.concatenate(write);
  insides.concatenate(write);
  overlaps.complete();
  insides.complete();
}

void any_many(std::span<const CompiledShaft> shafts, const Bounds& bounds, std::span<std::uint64_t> any,
              const Query& query) {
  const Asked asked("any_many", shafts, bounds, Question::kept, query, kernel::takes_candidates);
  kernel::require_shaft_bits("any", any, shafts.size());
  asked.options().require_apart("any", bytes_of(any));
  find_any(asked, any);
}

void occluded_many(std::span<const CompiledShaft> shafts, const Bounds& solids, std::span<std::uint64_t> occluded,
                   const Query& query) {
  const Asked asked("occluded_many", shafts, solids, Question::blocking, query, {.only = false});
  kernel::require_shaft_bits("occluded", occluded, shafts.size());
  asked.options().require_apart("occluded", bytes_of(occluded));
  find_any(asked, occluded);
}

void list_occluders_many(std::span<const CompiledShaft> shafts, const Bounds& solids, IndexLists& lists,
                         const Query& query) {
  const Asked asked("list_occluders_many", shafts, solids, Question::blocking, query, {.limit = true, .only = false});
  require_lists(asked, "lists", lists);
  list_kept(asked, lists);
}

int concurrency() noexcept { return kernel::threads_here(); }

}  // namespace shaftcull
