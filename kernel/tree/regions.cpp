// SPDX-License-Identifier: MIT
#include "tree/regions.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "dispatch/active_kernels.hpp"
#include "parallel/parallel.hpp"
#include "support/compiler.hpp"
#include "support/index_range.hpp"
#include "support/large_memory.hpp"
#include "tree/build.hpp"
#include "tree/entries.hpp"
#include "tree/source.hpp"
#include "tree/tree_order.hpp"
#include "tree/write_leaves.hpp"

namespace shaftcull::kernel {
namespace {

/// Tasks a thread that carry bounds: each searches every region for its first bound.
constexpr std::size_t carrying_tasks = 8;

/// Regions that are in the works at once have one bound in so many, so that their memory is bounded.
constexpr std::size_t bounds_in_works = 8;

/// Runs ahead of the one written whose leaves are prefetched.
constexpr std::size_t prefetched_runs = 3;

/// Indices of bounds, as counted from one of them.
struct IndicesFrom {
  const std::uint32_t* index;
  std::size_t origin;

  [[nodiscard]] std::size_t operator[](std::size_t i) const noexcept { return index[i] - origin; }
  [[nodiscard]] IndicesFrom operator+(std::size_t i) const noexcept { return {index + i, origin}; }
};

/// Some bounds of a source, one record after the other.
template <class Bound>
class RecordBlock {
 public:
  RecordBlock() : records_(source_block * rows_of<Bound>) {}

  template <class Source>
  void read(const Source& source, const IndexRange& block) noexcept {
    for (std::size_t first = block.first; first < block.end(); first += fanout) {
      const std::size_t count = std::min(fanout, block.end() - first);
      float row[rows_of<Bound>][fanout];
      read_rows(source, InOrder{first}, count, rows_in(row).data());
      float* record = records_.data() + (first - block.first) * rows_of<Bound>;
      for (std::size_t i = 0; i != count; ++i) {
        for (std::size_t s = 0; s != rows_of<Bound>; ++s) *record++ = row[s][i];
      }
    }
    count_ = block.size;
  }
  [[nodiscard]] RecordSource<Bound> records() const {
    return RecordSource<Bound>(records_in<Bound>(records_.data(), count_));
  }

 private:
  std::vector<float> records_;
  std::size_t count_ = 0;
};

/// Cuts regions where their indices do not ascend. They mostly do, as halvings keep the order of entries, but for those
/// that equal the pivot: an upper half begins with these. So k halvings make at most 3ᵏ runs.
std::vector<IndexRange> ascending_runs(std::span<const IndexRange> regions, const std::uint32_t* index) {
  std::vector<std::vector<IndexRange>> of_region(regions.size());
  parallel_for(regions.size(), 1, [&](std::size_t r, std::size_t) {
    std::size_t first = regions[r].first;
    for (std::size_t i = first + 1; i != regions[r].end(); ++i) {
      if (index[i] > index[i - 1]) continue;
      of_region[r].push_back({first, i - first});
      first = i;
    }
    of_region[r].push_back({first, regions[r].end() - first});
  });
  std::vector<IndexRange> runs;
  for (const std::vector<IndexRange>& some : of_region) runs.insert(runs.end(), some.begin(), some.end());
  return runs;
}

/// Carries all bounds of a source to where their indices are, in runs that ascend.
template <class Bound, class Source>
void carry(const Source& source, std::span<const IndexRange> runs, const std::uint32_t* index,
           TreeLevels<Bound>& parts) {
  const std::size_t blocks = chunk_count(parts.size, source_block);
  const std::size_t blocks_in_task =
      chunk_count(blocks, carrying_tasks * static_cast<std::size_t>(std::max(1, threads_here())));
  const RowsOf<ViewOf<Bound>> leaf = parts.leaf_rows();
  parallel_for(chunk_count(blocks, blocks_in_task), 1, [&](std::size_t t, std::size_t) {
    const IndexRange task = chunk_at(blocks, blocks_in_task, t);
    RecordBlock<Bound> copy;
    std::vector<std::size_t> next;  // of each run: its first bound that is not carried
    next.reserve(runs.size());
    for (const IndexRange& run : runs) {
      const std::uint32_t* const first = index + run.first;
      const std::uint32_t* const own = std::lower_bound(first, first + run.size, task.first * source_block);
      next.push_back(run.first + static_cast<std::size_t>(own - first));
    }
    for (std::size_t b = task.first; b != task.end(); ++b) {
      const IndexRange block = chunk_at(parts.size, source_block, b);
      copy.read(source, block);
      const RecordSource<Bound> records = copy.records();
      for (std::size_t r = 0; r != runs.size(); ++r) {
        if (r + prefetched_runs < runs.size()) {
          const std::size_t soon = next[r + prefetched_runs];
          const std::size_t count = runs[r + prefetched_runs].size / blocks + 1;
          for (float* const at : leaf) {
            for (std::size_t i = 0; i < count + 16; i += 16) prefetch_to_write_later(at + soon + i);
          }
        }
        const std::size_t first = next[r];
        std::size_t end = first;
        while (end != runs[r].end() && index[end] < block.end()) ++end;
        if (end == first) continue;
        RowsOf<ViewOf<Bound>> row = leaf;
        for (float*& at : row) at += first;
        read_rows(records, IndicesFrom{index + first, block.first}, end - first, row.data());
        next[r] = end;
      }
    }
  });
}

/// Memory for the bounds of a region that one task orders and writes.
template <class Bound>
struct RegionScratch {
  BuildScratch<Bound, LargeMemory> bounds;
  LargeMemory<std::uint32_t> indices;

  explicit RegionScratch(std::size_t most) : bounds(most), indices(2 * most) {}
};

/// The blocks of gap_leaves that are all of one region.
IndexRange whole_blocks(const IndexRange& region, std::size_t size) noexcept {
  const std::size_t first = chunk_count(region.first, gap_leaves) * gap_leaves;
  const std::size_t end = region.end() == size ? size : region.end() / gap_leaves * gap_leaves;
  return {first, end < first ? 0 : end - first};
}

/// Orders a region, whose bounds are where its leaves are to be, and writes these. Nodes are fitted, and least indices
/// found, in whole blocks only.
template <class Bound>
void write_region(const IndexRange& region, const std::uint32_t* index, const RegionScratch<Bound>& scratch,
                  const Kernels& kernels, TreeParts<Bound>& parts) {
  const EntryStreams entries = scratch.bounds.entries();
  const EntryPlace place{entries, scratch.bounds.records(), 0};
  write_entries_and_records<Bound>(parts.leaves.view().slice(region.first, region.size), place);
  std::uint32_t* const order = scratch.indices.get();  // within the region
  write_order_within(region, entries, scratch.bounds.spare(), kernels, order);
  std::uint32_t* const indices = order + region.size;
  std::copy_n(index + region.first, region.size, indices);  // order may be written where they are
  std::uint32_t* const of_all = parts.order.data() + region.first;
  for (std::size_t i = 0; i != region.size; ++i) of_all[i] = indices[order[i]];

  const RecordSource<Bound> records(records_in<Bound>(scratch.bounds.records(), region.size));
  const IndexRange whole = whole_blocks(region, parts.size);
  const auto row = parts.leaf_rows();
  const auto write_alone = [&](std::size_t first, std::size_t end) {
    for (std::size_t p = first; p < end; ++p) {
      float bound[rows_of<Bound>];
      records.read(order[p - region.first], bound);
      for (std::size_t s = 0; s != rows_of<Bound>; ++s) row[s][p] = bound[s];
    }
  };
  if (whole.size == 0) return write_alone(region.first, region.end());
  write_alone(region.first, whole.first);
  write_leaves(parts, kernels, order + (whole.first - region.first), region.end() - whole.first, whole, records);
  write_alone(whole.end(), region.end());
  find_least_indices(parts, whole);
}

/// What write_region() leaves out: blocks that regions share.
template <class Bound>
void finish_shared_blocks(std::span<const IndexRange> regions, const Kernels& kernels,
                          TreeParts<Bound>& parts) noexcept {
  std::size_t done = 0;
  for (const IndexRange& region : regions) {
    if (region.end() == parts.size || region.end() % gap_leaves == 0) continue;
    const std::size_t first = region.end() / gap_leaves * gap_leaves;
    if (first < done) continue;
    done = std::min(first + gap_leaves, parts.size);
    for (std::size_t p = first; parts.levels > 1 && p < done; p += fanout) {
      fit_leaf_word(parts, kernels, p / fanout, parts.leaf_words(p, 1));
    }
    find_least_indices(parts, IndexRange{first, done - first});
  }
}

}  // namespace

bool are_regions_worth_it(std::size_t bounds, const RegionSizes& sizes) noexcept {
  return bounds >= sizes.fewest_bounds;
}

template <class Bound, class Source>
TreeParts<Bound> build_by_regions(const Source& source, const RegionSizes& sizes) {
  const Kernels& kernels = active_kernels();
  const std::size_t size = source.count();
  const auto threads = static_cast<std::size_t>(threads_here());
  const std::size_t most =
      std::min(sizes.most_in_region, std::max(sizes.least_in_region, size / (bounds_in_works * threads)));
  TreeParts<Bound> parts;
  lay_out(parts, size);
  const RowsOf<ViewOf<Bound>> row = parts.leaf_rows();
  ask_for_huge_pages(row[0], parts.leaves.memory_bytes());
  parts.order = TreeArray<std::uint32_t>(size);
  parts.least_index = TreeArray<std::uint32_t>(bit_words(size));

  std::vector<IndexRange> regions;
  std::uint32_t* const index = parts.order.data();  // those in regions are where tree order will be
  {
    // Entries are where leaves will be. Spheres have two streams too few for that.
    const std::size_t stride = bit_words(size) * fanout;
    const LargeMemory<float> more((6 - rows_of<Bound>)*stride);
    std::array<float*, 6> centre{};
    for (std::size_t k = 0; k != 6; ++k)
      centre[k] = k < rows_of<Bound> ? row[k] : more.get() + (k - rows_of<Bound>)*stride;
    const LargeMemory<std::uint32_t> spare_index(size);
    const EntryStreams entries{centre[0], centre[1], centre[2], reinterpret_cast<float*>(index)};
    const EntryStreams spare{centre[3], centre[4], centre[5], reinterpret_cast<float*>(spare_index.get())};
    const EntryPlace place{entries, nullptr, parts.leaves.memory_bytes()};
    const ClassBounds class_first = write_entries<Bound>(source, place);
    write_tree_order(entries, spare, class_first, kernels, index, most);
    regions = regions_of(class_first, most);
  }
  carry(source, ascending_runs(regions, index), index, parts);

  std::size_t largest = 0;
  for (const IndexRange& region : regions) largest = std::max(largest, region.size);
  std::atomic<std::size_t> next = 0;
  parallel_for(std::clamp<std::size_t>(size / (bounds_in_works * most), 1, threads), 1, [&](std::size_t, std::size_t) {
    const RegionScratch<Bound> scratch(largest);
    for (std::size_t r = next++; r < regions.size(); r = next++) {
      write_region(regions[r], index, scratch, kernels, parts);
    }
  });
  finish_shared_blocks(regions, kernels, parts);
  fit_upper(parts, kernels);
  parts.surface_when_built = surface(parts);
  return parts;
}

#define SHAFTCULL_REGIONS(Bound)                                                                   \
  template TreeParts<Bound> build_by_regions<Bound>(const ViewSource<Bound>&, const RegionSizes&); \
  template TreeParts<Bound> build_by_regions<Bound>(const RecordSource<Bound>&, const RegionSizes&);
SHAFTCULL_REGIONS(Box)
SHAFTCULL_REGIONS(Sphere)
#undef SHAFTCULL_REGIONS
template TreeParts<Box> build_by_regions(const CentreExtentSource&, const RegionSizes&);

}  // namespace shaftcull::kernel
