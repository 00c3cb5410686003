// SPDX-License-Identifier: MIT
/// Verbs with one value per shaft: how many bounds, and whether any. Bounds in streams are cut into tiles
/// (flat/batch_job.hpp). A tree, and queries that end early, are asked shaft by shaft.
#include <algorithm>

#include "flat/batch_job.hpp"
#include "flat/shaft_bits.hpp"
#include "flat/tiling.hpp"
#include "parallel/parallel.hpp"
#include "parallel/shared_number.hpp"
#include "parallel/task_memory.hpp"
#include "query/counters.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/occluded.hpp"
#include "support/arguments.hpp"
#include "support/compiler.hpp"
#include "verbs/asked.hpp"
#include "verbs/each_shaft.hpp"
#include "verbs/plain_boxes.hpp"
#include "verbs/stream_tests.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

using kernel::Asked;
using kernel::bytes_of;
using kernel::ClassCounter;
using kernel::Counter;
using kernel::Finder;
using kernel::IndexRange;
using kernel::LimitedCounter;
using kernel::Question;
using kernel::SharedNumber;

// Tasks add what their bounds count. Sums of integers do not depend on the order in which tasks get here.

void add(std::uint64_t& sum, std::size_t count) noexcept { SharedNumber<std::uint64_t>(sum).add(count); }
void add(KeptCounts& sum, const KeptCounts& counts) noexcept {
  SharedNumber(sum.overlap).add(counts.overlap);
  SharedNumber(sum.inside).add(counts.inside);
}

/// The counts of bounds in streams. Each task counts its bounds with copies of a counter, which has seen none.
template <class AnyCounter, class Count>
void count_in_streams(const Asked& asked, const AnyCounter& none, std::span<Count> counts) {
  std::fill(counts.begin(), counts.end(), Count{});
  const kernel::StreamTests tests(asked);
  const kernel::BatchJob job(tests.get());
  const bool both = kernel::asks_for_inside(asked.question());
  const kernel::Tiling tiling(job.bounds().count, job.shafts());
  kernel::parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    const IndexRange block = tiling.block(b);
    const IndexRange group = tiling.group(g);
    const std::size_t words = bit_words(block.size);
    kernel::TaskScratch<std::uint64_t, 4 * kernel::tile_words> bits((both ? 2 : 1) * group.size * words);
    std::uint64_t* const kept = bits.get();
    std::uint64_t* const inside = both ? kept + group.size * words : nullptr;
    job.test(block, group, {kept, words}, {inside, words});
    for (std::size_t s = 0; s != group.size; ++s) {
      AnyCounter counter = none;
      counter.words({nullptr, kept + s * words, both ? inside + s * words : nullptr, words});
      add(counts[group.first + s], counter.result());
    }
  });
}

/// Checks that there is room for a count per shaft, and writes the result of the counter for each.
template <class AnyCounter, class Count>
void write_counts(const Asked& asked, const char* name, const AnyCounter& none, std::span<Count> counts) {
  kernel::require_counts(name, counts, asked.shafts().size());
  asked.options().require_apart(name, bytes_of(counts));
  if (asked.walks() == nullptr && !kernel::EndsEarly<AnyCounter>) return count_in_streams(asked, none, counts);
  kernel::for_each_shaft(asked, [&](std::size_t s) { counts[s] = asked.counted(s, none).result(); });
}

void find_any(const Asked& asked, const char* name, std::span<std::uint64_t> any) {
  kernel::require_shaft_bits(name, any, asked.shafts().size());
  asked.options().require_apart(name, bytes_of(any));
  if (asked.walks() == nullptr) return kernel::find_by_shaft(kernel::StreamTests(asked).get(), any);
  kernel::parallel_for(any.size(), 1, [&](std::size_t w, std::size_t) {  // a task for each word: no two share one
    std::uint64_t bits = 0;
    for (std::size_t s = 64 * w; s != std::min(asked.shafts().size(), 64 * (w + 1)); ++s) {
      bits |= std::uint64_t{asked.counted(s, Finder()).result()} << s % 64;
    }
    any[w] = bits;
  });
}

// Not inlined, so that queries about plain boxes have no large stack.

SHAFTCULL_NOINLINE std::size_t count_bounds(const CompiledShaft& shaft, const Bounds& bounds, const Query& query) {
  const Asked asked("count", {&shaft, 1}, bounds, Question::kept, query, kernel::takes_limit);
  if (!asked.options().has_limit()) return asked.counted(0, Counter(asked.kernels())).result();
  return asked.counted(0, LimitedCounter(asked.kernels(), asked.options().limit())).result();
}

SHAFTCULL_NOINLINE bool any_bounds(const CompiledShaft& shaft, const Bounds& bounds, const Query& query) {
  const Asked asked("any", {&shaft, 1}, bounds, Question::kept, query, kernel::takes_candidates);
  return asked.counted(0, Finder()).result();
}

/// The result of a counter of the boxes of a view.
template <class AnyCounter>
auto count_plain(const CompiledShaft& shaft, const BoxView& boxes, const kernel::Kernels& kernels,
                 const AnyCounter& none) {
  kernel::require_plain(shaft, boxes);
  return kernel::plain_counted(shaft, boxes, kernels, none).result();
}

}  // namespace

std::size_t count(const CompiledShaft& shaft, const Bounds& bounds, const Query& query) {
  if (const BoxView* const boxes = kernel::plain_boxes(bounds, query)) [[likely]] {
    const kernel::Kernels& kernels = kernel::active_kernels();
    return count_plain(shaft, *boxes, kernels, Counter(kernels));
  }
  return count_bounds(shaft, bounds, query);
}

void count_many(std::span<const CompiledShaft> shafts, const Bounds& bounds, std::span<std::uint64_t> kept_counts,
                const Query& query) {
  const Asked asked("count_many", shafts, bounds, Question::kept, query, kernel::takes_limit);
  if (!asked.options().has_limit()) return write_counts(asked, "kept_counts", Counter(asked.kernels()), kept_counts);
  write_counts(asked, "kept_counts", LimitedCounter(asked.kernels(), asked.options().limit()), kept_counts);
}

KeptCounts count_classified(const CompiledShaft& shaft, const Bounds& bounds, const Query& query) {
  const Asked asked("count_classified", {&shaft, 1}, bounds, Question::kept_and_inside, query,
                    kernel::takes_candidates);
  return asked.counted(0, ClassCounter(asked.kernels())).result();
}

void count_classified_many(std::span<const CompiledShaft> shafts, const Bounds& bounds, std::span<KeptCounts> counts,
                           const Query& query) {
  const Asked asked("count_classified_many", shafts, bounds, Question::kept_and_inside, query,
                    kernel::takes_candidates);
  write_counts(asked, "counts", ClassCounter(asked.kernels()), counts);
}

bool any(const CompiledShaft& shaft, const Bounds& bounds, const Query& query) {
  if (const BoxView* const boxes = kernel::plain_boxes(bounds, query)) [[likely]] {
    return count_plain(shaft, *boxes, kernel::active_kernels(), Finder());
  }
  return any_bounds(shaft, bounds, query);
}

void any_many(std::span<const CompiledShaft> shafts, const Bounds& bounds, std::span<std::uint64_t> any,
              const Query& query) {
  find_any(Asked("any_many", shafts, bounds, Question::kept, query, kernel::takes_candidates), "any", any);
}

bool occluded(const CompiledShaft& shaft, const Bounds& solids, const Query& query) {
  const Asked asked("occluded", {&shaft, 1}, solids, Question::blocking, query, {.only = false});
  return asked.counted(0, Finder()).result();
}

void occluded_many(std::span<const CompiledShaft> shafts, const Bounds& solids, std::span<std::uint64_t> occluded,
                   const Query& query) {
  find_any(Asked("occluded_many", shafts, solids, Question::blocking, query, {.only = false}), "occluded", occluded);
}

}  // namespace shaftcull
