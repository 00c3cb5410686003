// SPDX-License-Identifier: MIT
#include "flat/batch_job.hpp"

#include <algorithm>

#include "kernels/shared/word.hpp"
#include "streams/rows.hpp"
#include "support/compiler.hpp"
#include "support/float_environment.hpp"
#include "support/prefetch.hpp"

namespace shaftcull::kernel {
namespace {

static_assert(most_tile_bounds <= most_block_words * word_bits);

/// So many shafts are tested on the grid, one after the other, before the bounds that this leaves undecided are tested
/// in floats. With every shaft in turn, integers and floats would drive each other out of the L1 cache.
constexpr std::size_t batch_shafts = 16;

/// Scratch memory of a task that tests tiles on a grid, in cache lines for each word of bounds: their coordinates on
/// the grid, and all words that a batch of shafts may leave undecided.
constexpr std::size_t lines_a_word =
    (64 * 6 * sizeof(std::int16_t) + batch_shafts * sizeof(UndecidedWord)) / sizeof(CacheLine);

constexpr std::size_t fewest_that_prefetch = 8;
constexpr std::size_t fewest_that_prefetch_from_memory = 5;

/// Prefetches the rows that a later shaft will write. Rows are far apart, often by a power of two, so that caches soon
/// evict them.
SHAFTCULL_ALWAYS_INLINE inline void prefetch_rows(const std::uint64_t* kept, const std::uint64_t* inside,
                                                  std::size_t words) noexcept {
  constexpr std::size_t line = 64 / sizeof(std::uint64_t);
  for (std::size_t w = 0; w < words; w += line) {
    prefetch_to_write(kept + w);
    if (inside != nullptr) prefetch_to_write(inside + w);
  }
}

}  // namespace

BatchJob::BatchJob(const ShaftTests& tests) noexcept : tests_(tests) {
  if (shafts() <= group_shafts) form_on_grid(only_group_, tests.shafts(), bounds().count);
}

void BatchJob::test(IndexRange block, IndexRange group, Rows kept, Rows inside) const {
  test_all(block, group, kept, inside);
  if (!tests_.leaves_out()) return;
  for (std::size_t s = 0; s != group.size; ++s) {
    const LeftOut out = tests_.left_out(group.first + s);
    out.clear(block.first, block.size, kept.at(s));
    out.clear(block.first, block.size, inside.at(s));
  }
}

/// Whether the bounds take more than a second-level cache holds.
bool BatchJob::is_beyond_caches() const noexcept {
  const std::size_t bytes_a_bound = bounds().rows * sizeof(float);
  return bounds().count > (std::size_t{1} << 21) / bytes_a_bound;
}

/// Prefetches the share `i` of `shares` of the next tile, which begins at `next` and has at most `count` bounds, into
/// the second-level cache, while the tile before it is tested: otherwise the first shaft of each group waits for
/// memory. Four shafts or fewer read a tile about as fast as it comes, and the processor's own prefetching does better;
/// for less than eight it does so, too, where a view may be in a cache. Inlined, as prefetch_to_second_level() is.
SHAFTCULL_ALWAYS_INLINE inline void BatchJob::prefetch_share_of_next(std::size_t next, std::size_t count, std::size_t i,
                                                                     std::size_t shares) const noexcept {
  constexpr std::size_t line = 64 / sizeof(float);
  if (shares < (is_beyond_caches() ? fewest_that_prefetch_from_memory : fewest_that_prefetch)) return;
  const std::size_t lines = std::min(count, bounds().count - next) / line;
  for (std::size_t l = i * lines / shares; l != (i + 1) * lines / shares; ++l) {
    for (std::size_t r = 0; r != bounds().rows; ++r)
      prefetch_to_second_level(bounds().stream[r] + next + l * line, line);
  }
}

/// Tiles outside and shafts inside, so that a tile is read from memory once.
void BatchJob::test_all(IndexRange block, IndexRange group, Rows kept, Rows inside) const {
  if (shafts() <= group_shafts) {
    if (only_group_.exists()) return test_on_grid(only_group_, block, group, kept, inside);
  } else if (forms_and_tests_on_grid(block, group, kept, inside)) {
    return;
  }
  // Planes, which decide about inside, take so long a bound that it does not matter which cache the bounds come from.
  const bool is_long = group.size == 1 || tests_.question() == Question::inside;
  const std::size_t size = even_tile(block.size, is_long ? tile_bounds : float_tile_bounds);
  for (std::size_t first = block.first; first < block.end(); first += size) {
    const std::size_t word = (first - block.first) / 64;
    test_tile_in_floats(bounds().slice(first, std::min(size, block.end() - first)), first, group, kept.from(word),
                        inside.from(word));
  }
}

/// From how many shafts on it pays to make boxes around spheres: from 2 on for sets without a grid, whose vectors are
/// narrow or none, else from 5 on.
std::size_t BatchJob::fewest_for_boxes() const noexcept { return tests_.kernels().grid.frame == nullptr ? 2 : 5; }

void BatchJob::form_on_grid(GroupOnGrid& group, std::span<const ShaftData> shafts, std::size_t tested) const noexcept {
  if (tests_.question() == Question::inside || tests_.question() == Question::blocking) return;
  if (bounds().kind == BoundKind::triangles) return;
  const FloatEnvironment environment;
  group.form(tests_.kernels().grid, shafts, bounds(), tested);
}

// Not inlined, so that the memory of grids is not on the stack of tests in floats.

/// Forms a group's shafts on a grid and tests a block there. Returns false, and does nothing, if they have none.
SHAFTCULL_NOINLINE bool BatchJob::forms_and_tests_on_grid(IndexRange block, IndexRange group, Rows kept,
                                                          Rows inside) const {
  GroupOnGrid this_group;
  form_on_grid(this_group, tests_.shafts().subspan(group.first, group.size), block.size);
  if (!this_group.exists()) return false;
  test_on_grid(this_group, block, group, kept, inside);
  return true;
}

SHAFTCULL_NOINLINE void BatchJob::test_on_grid(const GroupOnGrid& on_grid, IndexRange block, IndexRange group,
                                               Rows kept, Rows inside) const {
  const std::size_t size = even_tile(block.size, block.size <= most_tile_bounds ? most_tile_bounds : tile_bounds);
  // Coordinates on the grid are made once for all shafts.
  TaskScratch<CacheLine, 64> scratch(bit_words(size) * lines_a_word);
  for (std::size_t first = block.first; first < block.end(); first += size) {
    const std::size_t word = (first - block.first) / 64;
    test_tile_on_grid(on_grid, bounds().slice(first, std::min(size, block.end() - first)), first, group,
                      kept.from(word), inside.from(word), scratch.get());
  }
}

void BatchJob::test_tile_in_floats(const BoundStreams& tile, std::size_t first, IndexRange group, Rows kept,
                                   Rows inside) const noexcept {
  if (tile.are_spheres() && tests_.question() != Question::inside && group.size >= fewest_for_boxes()) {
    return test_boxed_tile(tile, first, group, kept, inside);
  }
  test_with(tests_.test(), tile.stream, first, tile.count, group, kept, inside);
}

template <class Kernel>
void BatchJob::test_with(const Kernel& kernel, const float* const* stream, std::size_t first, std::size_t count,
                         IndexRange group, Rows kept, Rows inside) const noexcept {
  for (std::size_t s = 0; s != group.size; ++s) {
    prefetch_share_of_next(first + count, count, s, group.size);
    kernel(tests_.shafts()[group.first + s], stream, count, kept.at(s), inside.at(s));
  }
}

// Not inlined, so that the memory of one is not on the stack of the other.
SHAFTCULL_NOINLINE void BatchJob::test_boxed_tile(const BoundStreams& tile, std::size_t first, IndexRange group,
                                                  Rows kept, Rows inside) const noexcept {
  alignas(64) float box[6][float_tile_bounds];
  tests_.kernels().boxes_around_spheres(tile.stream, tile.count, rows_in(box).data());
  const float* const stream[10] = {tile.stream[0], tile.stream[1], tile.stream[2], tile.stream[3], box[0],
                                   box[1],         box[2],         box[3],         box[4],         box[5]};
  test_with(*tests_.kernels().boxed_spheres, stream, first, tile.count, group, kept, inside);
}

SHAFTCULL_ALWAYS_INLINE inline void BatchJob::test_batch_on_grid(const GroupOnGrid& on_grid, IndexRange batch,
                                                                 const TileExtent& extent, const BoundStreams& tile,
                                                                 const std::int16_t* const* grid,
                                                                 UndecidedWord* undecided, std::size_t first,
                                                                 IndexRange group, Rows kept,
                                                                 Rows inside) const noexcept {
  const ShaftData* shaft[batch_shafts];
  std::uint64_t* kept_row[batch_shafts];
  std::uint64_t* inside_row[batch_shafts];
  const std::size_t words = bit_words(tile.count);
  std::uint32_t tested = 0;
  std::size_t listed = 0;
  for (std::size_t s = batch.first; s != batch.end(); ++s) {
    prefetch_share_of_next(first + tile.count, tile.count, s, group.size);
    if (s + batch_shafts < group.size) prefetch_rows(kept.at(s + batch_shafts), inside.at(s + batch_shafts), words);
    const ShaftData& its_shaft = tests_.shafts()[group.first + s];
    if (!on_grid.shaft[s].exists || (on_grid.has_cuts && may_pass_cut(on_grid.shaft[s], extent))) {
      tests_.test()(its_shaft, tile.stream, tile.count, kept.at(s), inside.at(s));
      continue;
    }
    shaft[tested] = &its_shaft;
    kept_row[tested] = kept.at(s);
    inside_row[tested] = inside.at(s);
    listed += tests_.kernels().grid.test(on_grid.shaft[s], grid, words, kept.at(s), tested, undecided + listed);
    ++tested;
  }
  const bool are_spheres = tile.are_spheres();
  if (!are_spheres) tests_.kernels().grid.resolve(shaft, tile.stream, tile.count, undecided, listed, kept_row);
  GridKernels::Finish* const finish =
      are_spheres ? tests_.kernels().grid.finish_spheres : tests_.kernels().grid.finish_boxes;
  for (std::size_t i = 0; i != tested; ++i) {
    const bool is_tested = !are_spheres && shaft[i]->added_count == 0 && shaft[i]->still_faces == 0;
    if (is_tested && inside_row[i] == nullptr) continue;
    finish(*shaft[i], tile.stream, tile.count, kept_row[i], inside_row[i]);
  }
}

SHAFTCULL_NOINLINE void BatchJob::test_tile_on_grid(const GroupOnGrid& on_grid, const BoundStreams& tile,
                                                    std::size_t first, IndexRange group, Rows kept, Rows inside,
                                                    CacheLine* scratch) const noexcept {
  const std::size_t row = bit_words(tile.count) * 64;
  auto* const snapped = reinterpret_cast<std::int16_t*>(scratch);
  auto* const undecided = reinterpret_cast<UndecidedWord*>(snapped + 6 * row);
  std::int16_t* const grid[6] = {snapped,           snapped + row,     snapped + 2 * row,
                                 snapped + 3 * row, snapped + 4 * row, snapped + 5 * row};
  if (tile.are_spheres()) {
    snap_spheres(on_grid.frame, tile, grid);
  } else {
    tests_.kernels().grid.snap_boxes(on_grid.frame, tile.stream, tile.count, grid);
  }
  TileExtent extent{};
  if (on_grid.has_cuts) extent = tests_.kernels().grid.extent(grid, bit_words(tile.count));
  for (std::size_t b = 0; b != chunk_count(group.size, batch_shafts); ++b) {
    test_batch_on_grid(on_grid, chunk_at(group.size, batch_shafts, b), extent, tile, grid, undecided, first, group,
                       kept, inside);
  }
}

/// Snaps the boxes around a tile's spheres, a few at a time.
SHAFTCULL_NOINLINE void BatchJob::snap_spheres(const GridFrame& frame, const BoundStreams& tile,
                                               std::int16_t* const* grid) const noexcept {
  constexpr std::size_t some = tile_bounds / 8;
  alignas(64) float box[6][some];
  const RowsOf<BoxView> boxes = rows_in(box);
  for (std::size_t i = 0; i < tile.count; i += some) {
    const BoundSlice part = tile.slice(i, std::min(some, tile.count - i));
    std::int16_t* const out[6] = {grid[0] + i, grid[1] + i, grid[2] + i, grid[3] + i, grid[4] + i, grid[5] + i};
    tests_.kernels().boxes_around_spheres(part.stream, part.count, boxes.data());
    tests_.kernels().grid.snap_boxes(frame, boxes.data(), bit_words(part.count) * 64, out);
  }
}

}  // namespace shaftcull::kernel
