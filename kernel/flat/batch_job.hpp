// SPDX-License-Identifier: MIT
/// A batch job: many shafts × many bounds, checked, and tested block by block.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "compiled/answers.hpp"
#include "dispatch/active_kernels.hpp"
#include "flat/grid_group.hpp"
#include "flat/tiling.hpp"
#include "kernels/shared/word.hpp"
#include "kernels/table.hpp"
#include "parallel/task_memory.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/streams.hpp"
#include "streams/rows.hpp"
#include "support/arguments.hpp"
#include "support/compiler.hpp"
#include "support/float_environment.hpp"
#include "support/prefetch.hpp"

namespace shaftcull::kernel {

/// Rows of words in which tasks leave their bits: the row of shaft s, from the word of bound 0 on, is at words + s *
/// stride.
struct Rows {
  std::uint64_t* words = nullptr;
  std::size_t stride = 0;

  [[nodiscard]] std::uint64_t* at(std::size_t shaft) const noexcept {
    return words == nullptr ? nullptr : words + shaft * stride;
  }
  /// The rows from another word on.
  [[nodiscard]] Rows from(std::size_t word) const noexcept {
    return {words == nullptr ? nullptr : words + word, stride};
  }
};

/// The bits that a call wants. For `blocking`, of boxes only, *kept* are those that block the shaft.
enum class Bits : std::uint8_t { kept, kept_and_inside, inside, blocking };

/// Throws InvalidArgument for shafts or bounds that cannot be used, naming the first such.
template <class View>
void require_valid_query(std::span<const ShaftData> shafts, const View& bounds, Bits bits) {
  require_memory("shafts", shafts, "shafts");
  require_view(bounds);
  for (std::size_t s = 0; s != shafts.size(); ++s) {
    if (bits == Bits::blocking) {
      require_two_ends(shafts[s], s);
    } else {
      require_answers(shafts[s], bits != Bits::inside, bits != Bits::kept, std::is_same_v<View, SphereView>, s);
    }
  }
}

template <class View>
class BatchJob {
 public:
  /// Throws InvalidArgument as require_valid_query().
  BatchJob(std::span<const CompiledShaft> shafts, const View& bounds, Bits bits)
      : shafts_(data_of(shafts)), bounds_(bounds), kernels_(active_kernels()), bits_(bits) {
    require_valid_query(shafts_, bounds, bits);
    if (shafts_.size() <= group_shafts) form_on_grid(only_group_, shafts_, bounds, bounds.count);
  }

  [[nodiscard]] std::size_t shafts() const noexcept { return shafts_.size(); }
  [[nodiscard]] const SetBits& set_bits() const noexcept { return kernels_.set_bits; }
  [[nodiscard]] std::size_t bounds() const noexcept { return bounds_.count; }
  [[nodiscard]] std::size_t row_words() const noexcept { return words_for(bounds_.count); }

  /// Tests a block of bounds against a group of shafts, tiles outside and shafts inside, so that a tile is read from
  /// memory once. Bits go to the rows of the shafts counted from the group's first, the words from the block's first.
  void test(IndexRange block, IndexRange group, Rows kept, Rows inside = {}) const {
    if (shafts_.size() <= group_shafts) {
      if (only_group_.exists()) return test_on_grid(only_group_, block, group, kept, inside);
    } else if (forms_and_tests_on_grid(block, group, kept, inside)) {
      return;
    }
    // Planes, which decide what is inside, take so long a bound that it does not matter which cache the bounds come
    // from.
    const bool is_long = group.size == 1 || bits_ == Bits::inside;
    const std::size_t size = even_tile(block.size, is_long ? tile_bounds : float_tile_bounds);
    for (std::size_t first = block.first; first < block.end(); first += size) {
      const std::size_t word = (first - block.first) / 64;
      test_tile_in_floats(bounds_.slice(first, std::min(size, block.end() - first)), first, group, kept.from(word),
                          inside.from(word));
    }
  }

 private:
  static constexpr bool is_sphere = std::is_same_v<View, SphereView>;
  static_assert(most_tile_bounds <= most_block_words * word_bits);

  /// From how many shafts on it pays to make boxes around spheres: from 2 on for sets without a grid, whose vectors are
  /// narrow or none, else from 5 on.
  [[nodiscard]] std::size_t fewest_for_boxes() const noexcept { return kernels_.grid.frame == nullptr ? 2 : 5; }

  void form_on_grid(GroupOnGrid& group, std::span<const ShaftData> shafts, const View& bounds,
                    std::size_t tested) const noexcept {
    if (bits_ == Bits::inside || bits_ == Bits::blocking) return;
    const FloatEnvironment environment;
    group.form(kernels_.grid, shafts, bounds, tested, is_sphere);
  }

  // Not inlined, so that the memory of grids is not on the stack of tests in floats.

  /// Forms a group's shafts on a grid and tests a block there. Returns false, and does nothing, if they have none.
  SHAFTCULL_NOINLINE bool forms_and_tests_on_grid(IndexRange block, IndexRange group, Rows kept, Rows inside) const {
    GroupOnGrid this_group;
    form_on_grid(this_group, shafts_.subspan(group.first, group.size), bounds_, block.size);
    if (!this_group.exists()) return false;
    test_on_grid(this_group, block, group, kept, inside);
    return true;
  }

  SHAFTCULL_NOINLINE void test_on_grid(const GroupOnGrid& on_grid, IndexRange block, IndexRange group, Rows kept,
                                       Rows inside) const {
    const std::size_t size = even_tile(block.size, block.size <= most_tile_bounds ? most_tile_bounds : tile_bounds);
    // Coordinates on the grid are made once for all shafts.
    TaskScratch<CacheLine, 64> scratch(words_for(size) * lines_a_word);
    for (std::size_t first = block.first; first < block.end(); first += size) {
      const std::size_t word = (first - block.first) / 64;
      test_tile_on_grid(on_grid, bounds_.slice(first, std::min(size, block.end() - first)), first, group,
                        kept.from(word), inside.from(word), scratch.get());
    }
  }

  void test_tile_in_floats(const View& tile, std::size_t first, IndexRange group, Rows kept,
                           Rows inside) const noexcept {
    if constexpr (is_sphere) {
      if (bits_ != Bits::inside && group.size >= fewest_for_boxes())
        return test_boxed_tile(tile, first, group, kept, inside);
    }
    Test* const kernel = bits_ == Bits::blocking ? kernels_.blocking.boxes : kernels_.test(tile);
    test_tile(kernel, tile.stream.data(), first, tile.count, group, kept, inside);
  }

  void test_tile(Test* kernel, const float* const* stream, std::size_t first, std::size_t count, IndexRange group,
                 Rows kept, Rows inside) const noexcept {
    for (std::size_t s = 0; s != group.size; ++s) {
      prefetch_share_of_next(first + count, count, s, group.size);
      kernel(shafts_[group.first + s], stream, count, kept.at(s), inside.at(s));
    }
  }

  // Not inlined, so that the memory of one is not on the stack of the other.
  SHAFTCULL_NOINLINE void test_boxed_tile(const View& tile, std::size_t first, IndexRange group, Rows kept,
                                          Rows inside) const noexcept {
    alignas(64) float box[6][float_tile_bounds];
    kernels_.boxes_around_spheres(tile.stream.data(), tile.count, rows_in(box).data());
    const float* const stream[10] = {tile.stream[0], tile.stream[1], tile.stream[2], tile.stream[3], box[0],
                                     box[1],         box[2],         box[3],         box[4],         box[5]};
    test_tile(kernels_.boxed_spheres, stream, first, tile.count, group, kept, inside);
  }

  SHAFTCULL_NOINLINE void test_tile_on_grid(const GroupOnGrid& on_grid, const View& tile, std::size_t first,
                                            IndexRange group, Rows kept, Rows inside,
                                            CacheLine* scratch) const noexcept {
    const std::size_t row = words_for(tile.count) * 64;
    auto* const snapped = reinterpret_cast<std::int16_t*>(scratch);
    auto* const undecided = reinterpret_cast<UndecidedWord*>(snapped + 6 * row);
    std::int16_t* const grid[6] = {snapped,           snapped + row,     snapped + 2 * row,
                                   snapped + 3 * row, snapped + 4 * row, snapped + 5 * row};
    if constexpr (is_sphere) {
      snap_spheres(on_grid.frame, tile, grid);
    } else {
      kernels_.grid.snap_boxes(on_grid.frame, tile.stream.data(), tile.count, grid);
    }
    TileExtent extent{};
    if (on_grid.has_cuts) extent = kernels_.grid.extent(grid, words_for(tile.count));
    for (std::size_t b = 0; b != chunk_count(group.size, batch_shafts); ++b) {
      test_batch_on_grid(on_grid, chunk_at(group.size, batch_shafts, b), extent, tile, grid, undecided, first, group,
                         kept, inside);
    }
  }

  /// So many shafts are tested on the grid, one after the other, before what that leaves undecided is tested in floats.
  /// With every shaft in turn, integers and floats would drive each other out of the L1 cache.
  static constexpr std::size_t batch_shafts = 16;

  /// Scratch memory of a task that tests tiles on a grid, in cache lines for each word of bounds: their coordinates on
  /// the grid, and all words that a batch of shafts may leave undecided.
  static constexpr std::size_t lines_a_word =
      (64 * 6 * sizeof(std::int16_t) + batch_shafts * sizeof(UndecidedWord)) / sizeof(CacheLine);

  SHAFTCULL_ALWAYS_INLINE void test_batch_on_grid(const GroupOnGrid& on_grid, IndexRange batch,
                                                  const TileExtent& extent, const View& tile,
                                                  const std::int16_t* const* grid, UndecidedWord* undecided,
                                                  std::size_t first, IndexRange group, Rows kept,
                                                  Rows inside) const noexcept {
    const ShaftData* shaft[batch_shafts];
    std::uint64_t* kept_row[batch_shafts];
    std::uint64_t* inside_row[batch_shafts];
    const std::size_t words = words_for(tile.count);
    std::uint32_t tested = 0;
    std::size_t listed = 0;
    for (std::size_t s = batch.first; s != batch.end(); ++s) {
      prefetch_share_of_next(first + tile.count, tile.count, s, group.size);
      if (s + batch_shafts < group.size) prefetch_rows(kept.at(s + batch_shafts), inside.at(s + batch_shafts), words);
      const ShaftData& its_shaft = shafts_[group.first + s];
      if (!on_grid.shaft[s].exists || (on_grid.has_cuts && may_pass_cut(on_grid.shaft[s], extent))) {
        kernels_.test(tile)(its_shaft, tile.stream.data(), tile.count, kept.at(s), inside.at(s));
        continue;
      }
      shaft[tested] = &its_shaft;
      kept_row[tested] = kept.at(s);
      inside_row[tested] = inside.at(s);
      listed += kernels_.grid.test(on_grid.shaft[s], grid, words, kept.at(s), tested, undecided + listed);
      ++tested;
    }
    if (!is_sphere) kernels_.grid.resolve(shaft, tile.stream.data(), tile.count, undecided, listed, kept_row);
    for (std::size_t i = 0; i != tested; ++i) {
      const bool is_tested = !is_sphere && shaft[i]->added_count == 0 && shaft[i]->still_faces == 0;
      if (is_tested && inside_row[i] == nullptr) continue;
      kernels_.grid.finish(tile)(*shaft[i], tile.stream.data(), tile.count, kept_row[i], inside_row[i]);
    }
  }

  /// Prefetches the rows that a later shaft will write. Rows are far apart, often by a power of two, so that caches
  /// soon evict them.
  SHAFTCULL_ALWAYS_INLINE static void prefetch_rows(const std::uint64_t* kept, const std::uint64_t* inside,
                                                    std::size_t words) noexcept {
    constexpr std::size_t line = 64 / sizeof(std::uint64_t);
    for (std::size_t w = 0; w < words; w += line) {
      prefetch_to_write(kept + w);
      if (inside != nullptr) prefetch_to_write(inside + w);
    }
  }

  /// Snaps the boxes around a tile's spheres, a few at a time.
  SHAFTCULL_NOINLINE void snap_spheres(const GridFrame& frame, const View& tile,
                                       std::int16_t* const* grid) const noexcept {
    constexpr std::size_t some = tile_bounds / 8;
    alignas(64) float box[6][some];
    const RowsOf<BoxView> boxes = rows_in(box);
    for (std::size_t i = 0; i < tile.count; i += some) {
      const View part = tile.slice(i, std::min(some, tile.count - i));
      std::int16_t* const out[6] = {grid[0] + i, grid[1] + i, grid[2] + i, grid[3] + i, grid[4] + i, grid[5] + i};
      kernels_.boxes_around_spheres(part.stream.data(), part.count, boxes.data());
      kernels_.grid.snap_boxes(frame, boxes.data(), words_for(part.count) * 64, out);
    }
  }

  /// Whether the bounds take more than a second-level cache holds.
  [[nodiscard]] bool is_beyond_caches() const noexcept {
    constexpr std::size_t bytes_a_bound = row_count<View> * sizeof(float);
    return bounds_.count > (std::size_t{1} << 21) / bytes_a_bound;
  }

  /// Prefetches the share `i` of `shares` of the next tile, which begins at `next` and has at most `count` bounds, into
  /// the second-level cache, while the tile before it is tested: otherwise the first shaft of each group waits for
  /// memory. Four shafts or fewer read a tile about as fast as it comes, and the processor's own prefetching does
  /// better; for less than eight it does so, too, where a view may be in a cache. Inlined, as
  /// prefetch_to_second_level() is.
  SHAFTCULL_ALWAYS_INLINE void prefetch_share_of_next(std::size_t next, std::size_t count, std::size_t i,
                                                      std::size_t shares) const noexcept {
    constexpr std::size_t line = 64 / sizeof(float);
    if (shares < (is_beyond_caches() ? fewest_that_prefetch_from_memory : fewest_that_prefetch)) return;
    const std::size_t lines = std::min(count, bounds_.count - next) / line;
    for (std::size_t l = i * lines / shares; l != (i + 1) * lines / shares; ++l) {
      for (const float* stream : bounds_.stream) prefetch_to_second_level(stream + next + l * line, line);
    }
  }

  static constexpr std::size_t fewest_that_prefetch = 8;
  static constexpr std::size_t fewest_that_prefetch_from_memory = 5;

  std::span<const ShaftData> shafts_;
  View bounds_;
  const Kernels& kernels_;
  Bits bits_;
  GroupOnGrid only_group_;  // if there is only one, it is formed once for all tasks
};

}  // namespace shaftcull::kernel
