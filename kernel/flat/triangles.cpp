// SPDX-License-Identifier: MIT
/// Triangles of views: cull(), count(), any() and list(), for one shaft and for many.
#include "shaftcull/triangles.hpp"

#include <algorithm>

#include "compiled/answers.hpp"
#include "dispatch/active_kernels.hpp"
#include "flat/batch_job.hpp"
#include "flat/index_writer.hpp"
#include "flat/list_rows.hpp"
#include "flat/shaft_bits.hpp"
#include "kernels/table.hpp"
#include "parallel/parallel.hpp"
#include "parallel/shared_number.hpp"
#include "parallel/task_memory.hpp"
#include "support/arguments.hpp"
#include "support/float_environment.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

using kernel::IndexRange;

/// Most triangles in a chunk, whose bits stay on the stack.
constexpr std::size_t chunk_triangles = 16384;
/// In the first chunk of a call that may end early; each has twice as many as the one before.
constexpr std::size_t first_triangles = 512;

kernel::Test* kernel_of(TriangleTest test) noexcept {
  const kernel::Kernels& kernels = kernel::active_kernels();
  return test == TriangleTest::exact ? kernels.triangles_exactly : kernels.triangles_by_vertices;
}

/// Throws InvalidArgument for shafts, triangles or a test that cannot be used, naming the first such.
std::span<const kernel::ShaftData> checked(std::span<const CompiledShaft> shafts, const TriangleView& triangles,
                                           TriangleTest test) {
  kernel::require_memory("shafts", shafts, "shafts");
  kernel::require_triangle_test(test);
  kernel::require_view(triangles);
  const std::span<const kernel::ShaftData> data = kernel::data_of(shafts);
  for (std::size_t s = 0; s != data.size(); ++s) {
    kernel::require_triangle_answers(data[s], test == TriangleTest::exact, s);
  }
  return data;
}

/// Calls visit(first, bits, words) for chunk after chunk, the bits of triangles from `first` on that the shaft keeps,
/// until it returns false. The first chunk has `chunk` triangles at most.
template <class Visit>
void for_each_chunk(const kernel::ShaftData& shaft, const TriangleView& triangles, TriangleTest test, std::size_t chunk,
                    const Visit& visit) {
  kernel::Test* const keep = kernel_of(test);
  const kernel::FloatEnvironment environment;
  std::uint64_t kept[words_for(chunk_triangles)];
  for (std::size_t first = 0; first != triangles.count;) {
    const TriangleView part = triangles.slice(first, std::min(chunk, triangles.count - first));
    keep(shaft, part.stream.data(), part.count, kept, nullptr);
    if (!visit(first, kept, words_for(part.count))) return;
    first += part.count;
    chunk = std::min(2 * chunk, chunk_triangles);
  }
}

std::size_t list_kept(const CompiledShaft& shaft, const TriangleView& triangles, std::span<std::uint32_t> kept,
                      TriangleTest test) {
  const auto shafts = checked({&shaft, 1}, triangles, test);
  kernel::require_index_width("list()", triangles.count);
  kernel::require_memory("kept", kept, "indices");
  kernel::IndexWriter listed(kernel::active_kernels().set_bits, kept);
  for_each_chunk(shafts[0], triangles, test, chunk_triangles,
                 [&](std::size_t first, const std::uint64_t* bits, std::size_t words) {
                   listed.add(first, bits, words);
                   return true;
                 });
  return listed.count();
}

/// Many shafts × many triangles, checked, and tested block by block: as BatchJob.
class TriangleJob {
 public:
  TriangleJob(std::span<const CompiledShaft> shafts, const TriangleView& triangles, TriangleTest test)
      : shafts_(checked(shafts, triangles, test)), triangles_(triangles), keep_(kernel_of(test)) {}

  [[nodiscard]] std::size_t shafts() const noexcept { return shafts_.size(); }
  [[nodiscard]] std::size_t bounds() const noexcept { return triangles_.count; }
  [[nodiscard]] std::size_t row_words() const noexcept { return words_for(triangles_.count); }
  [[nodiscard]] const kernel::SetBits& set_bits() const noexcept { return set_bits_; }

  /// Tile by tile, each with all shafts while it is in the cache.
  void test(IndexRange block, IndexRange group, kernel::Rows kept) const noexcept {
    for (std::size_t first = block.first; first < block.end(); first += kernel::float_tile_bounds) {
      const TriangleView tile = triangles_.slice(first, std::min(kernel::float_tile_bounds, block.end() - first));
      const kernel::Rows rows = kept.from((first - block.first) / 64);
      for (std::size_t s = 0; s != group.size; ++s) {
        keep_(shafts_[group.first + s], tile.stream.data(), tile.count, rows.at(s), nullptr);
      }
    }
  }
  /// One shaft, one tile.
  void test_tile(std::size_t s, const TriangleView& tile, std::uint64_t* kept) const noexcept {
    keep_(shafts_[s], tile.stream.data(), tile.count, kept, nullptr);
  }

 private:
  std::span<const kernel::ShaftData> shafts_;
  TriangleView triangles_;
  kernel::Test* keep_;
  const kernel::SetBits& set_bits_ = kernel::active_kernels().set_bits;
};

}  // namespace

void cull(const CompiledShaft& shaft, const TriangleView& triangles, std::span<std::uint64_t> kept, TriangleTest test) {
  const auto shafts = checked({&shaft, 1}, triangles, test);
  kernel::require_words("kept", kept, triangles.count);
  const kernel::FloatEnvironment environment;
  kernel_of(test)(shafts[0], triangles.stream.data(), triangles.count, kept.data(), nullptr);
}

bool cull(const CompiledShaft& shaft, const Triangle& triangle, TriangleTest test) {
  TriangleView view;
  for (std::size_t s = 0; s != view.stream.size(); ++s) view.stream[s] = &triangle.vertex[s / 3][s % 3];
  view.count = 1;
  const auto shafts = checked({&shaft, 1}, view, test);
  std::uint64_t kept = 0;
  const kernel::FloatEnvironment environment;
  kernel_of(test)(shafts[0], view.stream.data(), 1, &kept, nullptr);
  return kept != 0;
}

std::size_t count(const CompiledShaft& shaft, const TriangleView& triangles, TriangleTest test) {
  const kernel::SetBits& set_bits = kernel::active_kernels().set_bits;
  std::size_t count = 0;
  for_each_chunk(checked({&shaft, 1}, triangles, test)[0], triangles, test, chunk_triangles,
                 [&](std::size_t, const std::uint64_t* kept, std::size_t words) {
                   count += set_bits.count(kept, words);
                   return true;
                 });
  return count;
}

bool any(const CompiledShaft& shaft, const TriangleView& triangles, TriangleTest test) {
  bool is_any = false;
  for_each_chunk(checked({&shaft, 1}, triangles, test)[0], triangles, test, first_triangles,
                 [&](std::size_t, const std::uint64_t* kept, std::size_t words) {
                   is_any = std::any_of(kept, kept + words, [](std::uint64_t word) { return word != 0; });
                   return !is_any;
                 });
  return is_any;
}

std::size_t list(const CompiledShaft& shaft, const TriangleView& triangles, std::span<std::uint32_t> kept,
                 TriangleTest test) {
  return list_kept(shaft, triangles, kept, test);
}

void cull_many(std::span<const CompiledShaft> shafts, const TriangleView& triangles, std::span<std::uint64_t> kept_rows,
               TriangleTest test) {
  const TriangleJob job(shafts, triangles, test);
  kernel::require_rows("kept_rows", kept_rows, job.shafts(), job.row_words());
  const kernel::Tiling tiling = kernel::Tiling::unordered(job.bounds(), job.shafts());
  kernel::parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    const IndexRange block = tiling.block(b);
    const IndexRange group = tiling.group(g);
    const kernel::Rows rows{kept_rows.data(), job.row_words()};
    job.test(block, group, rows.from(group.first * job.row_words() + block.first / 64));
  });
}

void count_many(std::span<const CompiledShaft> shafts, const TriangleView& triangles,
                std::span<std::uint64_t> kept_counts, TriangleTest test) {
  const TriangleJob job(shafts, triangles, test);
  kernel::require_counts("kept_counts", kept_counts, job.shafts());
  std::fill(kept_counts.begin(), kept_counts.end(), 0);
  const kernel::Tiling tiling = kernel::Tiling::unordered(job.bounds(), job.shafts());
  kernel::parallel_for(tiling.blocks(), tiling.groups(), [&](std::size_t b, std::size_t g) {
    const IndexRange block = tiling.block(b);
    const IndexRange group = tiling.group(g);
    const std::size_t words = words_for(block.size);
    kernel::TaskScratch<std::uint64_t, 4 * kernel::tile_words> bits(group.size * words);
    job.test(block, group, {bits.get(), words});
    for (std::size_t s = 0; s != group.size; ++s) {
      const kernel::SharedNumber<std::uint64_t> sum(kept_counts[group.first + s]);
      sum.add(job.set_bits().count(bits.get() + s * words, words));
    }
  });
}

void any_many(std::span<const CompiledShaft> shafts, const TriangleView& triangles, std::span<std::uint64_t> any,
              TriangleTest test) {
  const TriangleJob job(shafts, triangles, test);
  kernel::require_shaft_bits("any", any, job.shafts());
  kernel::find_by_shaft(
      job.shafts(), triangles, any,
      [&](std::size_t s, const TriangleView& tile, std::uint64_t* kept) { job.test_tile(s, tile, kept); });
}

void list_many(std::span<const CompiledShaft> shafts, const TriangleView& triangles, IndexLists& lists,
               TriangleTest test) {
  const TriangleJob job(shafts, triangles, test);
  kernel::require_index_width("list_many()", triangles.count);
  kernel::list_rows(job, std::array<IndexLists*, 1>{&lists});
}

}  // namespace shaftcull
