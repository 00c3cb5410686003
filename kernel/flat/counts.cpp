// SPDX-License-Identifier: MIT
/// count_many() and count_classified_many(): a task counts its own bits and adds the counts to the user's at the end.
#include <algorithm>

#include "flat/batch_job.hpp"
#include "parallel/parallel.hpp"
#include "parallel/shared_number.hpp"
#include "parallel/task_memory.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull {
namespace {

template <class View>
void count_rows(std::span<const CompiledShaft> shafts, const View& bounds, std::span<std::uint64_t> counts) {
  const kernel::BatchJob<View> job(shafts, bounds, kernel::Bits::kept);
  kernel::require_counts("kept_counts", counts, shafts.size());
  std::fill(counts.begin(), counts.end(), 0);
  const kernel::Tiling tiling = kernel::Tiling::unordered(job.bounds(), job.shafts());
  const kernel::SetBits& set_bits = job.set_bits();
  kernel::parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    const kernel::IndexRange block = tiling.block(b);
    const kernel::IndexRange group = tiling.group(g);
    const std::size_t words = words_for(block.size);
    kernel::TaskScratch<std::uint64_t, 4 * kernel::tile_words> bits(group.size * words);
    std::uint64_t* const kept = bits.get();
    job.test(block, group, {kept, words});
    for (std::size_t s = 0; s != group.size; ++s) {
      // Sums of integers do not depend on the order in which tasks get here.
      const kernel::SharedNumber<std::uint64_t> sum(counts[group.first + s]);
      sum.add(set_bits.count(kept + s * words, words));
    }
  });
}

template <class View>
void count_classes(std::span<const CompiledShaft> shafts, const View& bounds, std::span<KeptCounts> counts) {
  const kernel::BatchJob<View> job(shafts, bounds, kernel::Bits::kept_and_inside);
  kernel::require_counts("counts", counts, shafts.size());
  std::fill(counts.begin(), counts.end(), KeptCounts{});
  const kernel::Tiling tiling = kernel::Tiling::unordered(job.bounds(), job.shafts());
  const kernel::SetBits& set_bits = job.set_bits();
  kernel::parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    const kernel::IndexRange block = tiling.block(b);
    const kernel::IndexRange group = tiling.group(g);
    const std::size_t words = words_for(block.size);
    kernel::TaskScratch<std::uint64_t, 4 * kernel::tile_words> bits(2 * group.size * words);
    std::uint64_t* const kept = bits.get();
    std::uint64_t* const inside = kept + group.size * words;
    job.test(block, group, {kept, words}, {inside, words});
    for (std::size_t s = 0; s != group.size; ++s) {
      const std::size_t insides = set_bits.count(inside + s * words, words);
      const std::size_t overlaps = set_bits.count(kept + s * words, words) - insides;  // what is inside is kept
      KeptCounts& sums = counts[group.first + s];
      kernel::SharedNumber(sums.overlap).add(overlaps);
      kernel::SharedNumber(sums.inside).add(insides);
    }
  });
}

}  // namespace

void count_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, std::span<std::uint64_t> kept_counts) {
  count_rows(shafts, boxes, kept_counts);
}

void count_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                std::span<std::uint64_t> kept_counts) {
  count_rows(shafts, spheres, kept_counts);
}

void count_classified_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, std::span<KeptCounts> counts) {
  count_classes(shafts, boxes, counts);
}

void count_classified_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                           std::span<KeptCounts> counts) {
  count_classes(shafts, spheres, counts);
}

}  // namespace shaftcull
