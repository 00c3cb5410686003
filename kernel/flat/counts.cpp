/// count_many(): a task counts its own bits and adds the counts to the user's at the end.
#include <algorithm>
#include <atomic>

#include "flat/batch_job.hpp"
#include "parallel/parallel.hpp"
#include "parallel/task_memory.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull {
namespace {

template <class View>
void count_rows(std::span<const CompiledShaft> shafts, const View& bounds, std::span<std::uint64_t> counts, Form form) {
  const kernel::Job<View> job(shafts, bounds, false, form);
  kernel::require_counts("kept_counts", counts, shafts.size());
  std::fill(counts.begin(), counts.end(), 0);
  const kernel::Cut cut = kernel::Cut::free(job.bounds(), job.shafts());
  const kernel::SetBits& set_bits = job.set_bits();
  kernel::parallel_for(cut.blocks(), cut.groups(), [&](std::size_t b, std::size_t g) {
    const kernel::IndexRange block = cut.block(b);
    const kernel::IndexRange group = cut.group(g);
    const std::size_t words = words_for(block.size);
    kernel::TaskRoom<std::uint64_t, 4 * kernel::tile_words> bits(group.size * words);
    std::uint64_t* const kept = bits.get();
    job.test(block, group, {kept, words});
    for (std::size_t s = 0; s != group.size; ++s) {
      // Sums of integers do not depend on the order in which tasks get here.
      const std::atomic_ref<std::uint64_t> sum(counts[group.first + s]);
      sum.fetch_add(set_bits.count(kept + s * words, words), std::memory_order_relaxed);
    }
  });
}

}  // namespace

void count_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, std::span<std::uint64_t> kept_counts,
                Form form) {
  count_rows(shafts, boxes, kept_counts, form);
}

void count_many(std::span<const CompiledShaft> shafts, const SphereView& spheres, std::span<std::uint64_t> kept_counts,
                Form form) {
  count_rows(shafts, spheres, kept_counts, form);
}

}  // namespace shaftcull
