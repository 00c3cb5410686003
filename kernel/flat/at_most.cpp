// SPDX-License-Identifier: MIT
/// count_at_most_many() and list_at_most_many(): a task tests its bounds tile by tile, each with those shafts only that
/// have not found enough.
#include <algorithm>

#include "dispatch/active_kernels.hpp"
#include "flat/batch_job.hpp"
#include "flat/index_writer.hpp"
#include "parallel/parallel.hpp"
#include "parallel/shared_number.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull {
namespace {

template <class View>
void count_some(std::span<const kernel::ShaftData> shafts, const View& bounds, std::size_t most,
                std::span<std::uint64_t> counts) {
  kernel::require_valid_query(shafts, bounds, kernel::Bits::kept);
  kernel::require_counts("kept_counts", counts, shafts.size());
  std::fill(counts.begin(), counts.end(), 0);
  const kernel::Kernels& kernels = kernel::active_kernels();
  kernel::Test* const test = kernels.test(bounds);
  const kernel::Tiling tiling = kernel::Tiling::unordered(bounds.count, shafts.size());
  kernel::parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    const kernel::IndexRange block = tiling.block(b);
    const kernel::IndexRange group = tiling.group(g);
    for (std::size_t first = block.first; first != block.end();) {
      const View tile = bounds.slice(first, std::min(kernel::float_tile_bounds, block.end() - first));
      bool are_all_done = true;
      for (std::size_t s = group.first; s != group.end(); ++s) {
        const kernel::SharedNumber<std::uint64_t> sum(counts[s]);
        if (sum.load() >= most) continue;
        are_all_done = false;
        std::uint64_t kept[words_for(kernel::float_tile_bounds)];
        test(shafts[s], tile.stream.data(), tile.count, kept, nullptr);
        sum.add(kernels.set_bits.count(kept, words_for(tile.count)));
      }
      if (are_all_done) return;
      first += tile.count;
    }
  });
  // Which tiles were left out depends on threads; that so many were found does not.
  for (std::uint64_t& count : counts) count = std::min<std::uint64_t>(count, most);
}

/// Shafts in a task that lists: it sees all bounds in their order, since the first ones are listed.
constexpr std::size_t listing_shafts = 8;

template <class View>
void list_some(std::span<const kernel::ShaftData> shafts, const View& bounds, std::size_t most,
               std::span<std::uint32_t> kept, std::span<std::uint64_t> counts) {
  kernel::require_valid_query(shafts, bounds, kernel::Bits::kept);
  kernel::require_index_width("list_at_most_many()", bounds.count);
  kernel::require_room("kept", kept, shafts.size(), most);
  kernel::require_counts("kept_counts", counts, shafts.size());
  kernel::require_apart("list_at_most_many", "kept", kernel::bytes_of(kept), "kept_counts", kernel::bytes_of(counts));
  std::fill(counts.begin(), counts.end(), 0);
  const kernel::Kernels& kernels = kernel::active_kernels();
  kernel::Test* const test = kernels.test(bounds);
  kernel::parallel_for(kernel::chunk_count(shafts.size(), listing_shafts), 1, [&](std::size_t t, std::size_t) {
    const kernel::IndexRange group = kernel::chunk_at(shafts.size(), listing_shafts, t);
    bool are_all_done = most == 0;
    for (std::size_t first = 0; first != bounds.count && !are_all_done;) {
      const View tile = bounds.slice(first, std::min(kernel::float_tile_bounds, bounds.count - first));
      are_all_done = true;
      for (std::size_t s = group.first; s != group.end(); ++s) {
        const auto found = static_cast<std::size_t>(counts[s]);
        if (found == most) continue;
        std::uint64_t bits[words_for(kernel::float_tile_bounds)];
        test(shafts[s], tile.stream.data(), tile.count, bits, nullptr);
        kernel::IndexWriter listed(kernels.set_bits, kept.subspan(s * most + found, most - found));
        listed.add(first, bits, words_for(tile.count));
        counts[s] = std::min(found + listed.count(), most);
        are_all_done = are_all_done && counts[s] == most;
      }
      first += tile.count;
    }
  });
}

}  // namespace

void count_at_most_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, std::size_t most,
                        std::span<std::uint64_t> kept_counts) {
  count_some(kernel::data_of(shafts), boxes, most, kept_counts);
}

void count_at_most_many(std::span<const CompiledShaft> shafts, const SphereView& spheres, std::size_t most,
                        std::span<std::uint64_t> kept_counts) {
  count_some(kernel::data_of(shafts), spheres, most, kept_counts);
}

void list_at_most_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, std::size_t most,
                       std::span<std::uint32_t> kept, std::span<std::uint64_t> kept_counts) {
  list_some(kernel::data_of(shafts), boxes, most, kept, kept_counts);
}
void list_at_most_many(std::span<const CompiledShaft> shafts, const SphereView& spheres, std::size_t most,
                       std::span<std::uint32_t> kept, std::span<std::uint64_t> kept_counts) {
  list_some(kernel::data_of(shafts), spheres, most, kept, kept_counts);
}

}  // namespace shaftcull
