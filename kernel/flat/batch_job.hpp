// SPDX-License-Identifier: MIT
/// A batch job: many shafts × many bounds in streams, tested block by block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "compiled/shaft_data.hpp"
#include "flat/grid_group.hpp"
#include "flat/shaft_tests.hpp"
#include "flat/tiling.hpp"
#include "kernels/kernel_table.hpp"
#include "parallel/task_memory.hpp"

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

/// Refers to the tests, which outlive it.
class BatchJob {
 public:
  explicit BatchJob(const ShaftTests& tests) noexcept;

  [[nodiscard]] std::size_t shafts() const noexcept { return tests_.shafts().size(); }
  [[nodiscard]] const SetBits& set_bits() const noexcept { return tests_.kernels().set_bits; }
  [[nodiscard]] const BoundStreams& bounds() const noexcept { return tests_.bounds(); }
  [[nodiscard]] std::size_t row_words() const noexcept { return tests_.row_words(); }

  /// Tests a block of bounds against a group of shafts. Bits go to the rows of the shafts counted from the group's
  /// first, the words from the block's first.
  void test(IndexRange block, IndexRange group, Rows kept, Rows inside = {}) const;

 private:
  void test_all(IndexRange block, IndexRange group, Rows kept, Rows inside) const;
  [[nodiscard]] std::size_t fewest_for_boxes() const noexcept;
  void form_on_grid(GroupOnGrid& group, std::span<const ShaftData> shafts, std::size_t tested) const noexcept;
  bool forms_and_tests_on_grid(IndexRange block, IndexRange group, Rows kept, Rows inside) const;
  void test_on_grid(const GroupOnGrid& on_grid, IndexRange block, IndexRange group, Rows kept, Rows inside) const;
  void test_tile_in_floats(const BoundStreams& tile, std::size_t first, IndexRange group, Rows kept,
                           Rows inside) const noexcept;
  template <class Kernel>
  void test_with(const Kernel& kernel, const float* const* stream, std::size_t first, std::size_t count,
                 IndexRange group, Rows kept, Rows inside) const noexcept;
  void test_boxed_tile(const BoundStreams& tile, std::size_t first, IndexRange group, Rows kept,
                       Rows inside) const noexcept;
  void test_tile_on_grid(const GroupOnGrid& on_grid, const BoundStreams& tile, std::size_t first, IndexRange group,
                         Rows kept, Rows inside, CacheLine* scratch) const noexcept;
  void test_batch_on_grid(const GroupOnGrid& on_grid, IndexRange batch, const TileExtent& extent,
                          const BoundStreams& tile, const std::int16_t* const* grid, UndecidedWord* undecided,
                          std::size_t first, IndexRange group, Rows kept, Rows inside) const noexcept;
  void snap_spheres(const GridFrame& frame, const BoundStreams& tile, std::int16_t* const* grid) const noexcept;
  [[nodiscard]] bool is_beyond_caches() const noexcept;
  void prefetch_share_of_next(std::size_t next, std::size_t count, std::size_t i, std::size_t shares) const noexcept;

  const ShaftTests& tests_;
  GroupOnGrid only_group_;  // if there is only one, it is formed once for all tasks
};

}  // namespace shaftcull::kernel
