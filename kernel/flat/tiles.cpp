// SPDX-License-Identifier: MIT
/// for_each_tile() and for_each_classified_tile(): tasks work in parallel, their answers leave in order.
#include <algorithm>
#include <memory>

#include "flat/batch_job.hpp"
#include "parallel/parallel.hpp"
#include "shaftcull/many.hpp"
#include "support/fail.hpp"

namespace shaftcull {
namespace {

/// Tasks in flight for every thread: enough that a thread seldom waits for the callback's turn.
constexpr std::size_t tasks_per_thread = 4;

template <class View>
void deliver_tiles(std::span<const CompiledShaft> shafts, const View& bounds, TileCallback callback, bool inside) {
  const kernel::BatchJob<View> job(shafts, bounds, inside ? kernel::Bits::kept_and_inside : kernel::Bits::kept);
  if (!callback) kernel::fail(InvalidArgument("the tile callback is empty; pass something that can be called"));
  const kernel::Tiling tiling = kernel::Tiling::ordered(job.bounds(), job.shafts());
  const std::size_t tasks = tiling.blocks() * tiling.groups();
  if (tasks == 0) return;

  const std::size_t slots = std::min(tasks, tasks_per_thread * static_cast<std::size_t>(kernel::threads_here()));
  const std::size_t slot_words = kernel::task_words * (inside ? 2 : 1);
  const auto memory = std::make_unique_for_overwrite<std::uint64_t[]>(slots * slot_words);

  const auto work = [&](std::size_t task, std::size_t slot) {
    const kernel::IndexRange block = tiling.block(task / tiling.groups());
    const kernel::IndexRange group = tiling.group(task % tiling.groups());
    const std::size_t words = words_for(block.size);
    std::uint64_t* const kept = memory.get() + slot * slot_words;
    job.test(block, group, {kept, words}, {inside ? kept + kernel::task_words : nullptr, words});
  };
  const auto deliver = [&](std::size_t task, std::size_t slot) {
    const kernel::IndexRange block = tiling.block(task / tiling.groups());
    const kernel::IndexRange group = tiling.group(task % tiling.groups());
    const std::size_t words = words_for(block.size);
    const std::uint64_t* const kept = memory.get() + slot * slot_words;
    for (std::size_t tile = 0; tile < block.size; tile += kernel::tile_bounds) {
      const std::size_t count = std::min(kernel::tile_bounds, block.size - tile);
      for (std::size_t s = 0; s != group.size; ++s) {
        const std::span<const std::uint64_t> tile_kept(kept + s * words + tile / 64, words_for(count));
        const std::span<const std::uint64_t> tile_inside =
            inside ? std::span<const std::uint64_t>(tile_kept.data() + kernel::task_words, words_for(count))
                   : std::span<const std::uint64_t>();
        callback({group.first + s, block.first + tile, count, tile_kept, tile_inside});
      }
    }
  };
  kernel::ordered_pipeline(tasks, slots, work, deliver);
}

}  // namespace

void for_each_tile(std::span<const CompiledShaft> shafts, const BoxView& boxes, TileCallback callback) {
  deliver_tiles(shafts, boxes, callback, false);
}

void for_each_tile(std::span<const CompiledShaft> shafts, const SphereView& spheres, TileCallback callback) {
  deliver_tiles(shafts, spheres, callback, false);
}

void for_each_classified_tile(std::span<const CompiledShaft> shafts, const BoxView& boxes, TileCallback callback) {
  deliver_tiles(shafts, boxes, callback, true);
}

void for_each_classified_tile(std::span<const CompiledShaft> shafts, const SphereView& spheres, TileCallback callback) {
  deliver_tiles(shafts, spheres, callback, true);
}

int concurrency() noexcept { return kernel::threads_here(); }

}  // namespace shaftcull
