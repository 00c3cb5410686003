// SPDX-License-Identifier: MIT
#include "tree/build.hpp"

#include <algorithm>
#include <cstdint>

#include "dispatch/active_kernels.hpp"
#include "support/compiler.hpp"
#include "support/large_memory.hpp"
#include "tree/entries.hpp"
#include "tree/regions.hpp"
#include "tree/tree_order.hpp"
#include "tree/write_leaves.hpp"

namespace shaftcull::kernel {

template <class Bound>
std::size_t lay_out_levels(TreeLevels<Bound>& parts, std::size_t size) noexcept {
  parts.size = size;
  if (size == 0) return 0;
  std::size_t nodes = 0;
  parts.level[0] = {size, 0};
  parts.levels = 1;
  while (parts.level[parts.levels - 1].words() > top_words) {
    TreeLevel& level = parts.level[parts.levels];
    level = {parts.level[parts.levels - 1].words(), nodes};
    nodes += level.words() * 64;
    ++parts.levels;
  }
  return nodes;
}

template <class Bound>
void lay_out(TreeLevels<Bound>& parts, std::size_t size) {
  parts.leaves = StreamAccess::not_written<StreamOf<ViewOf<Bound>>>(size);
  const std::size_t nodes = lay_out_levels(parts, size);
  parts.nodes = BoxStream(nodes);
  parts.gaps = {nodes / 64, ~std::uint64_t{0}};
}

namespace {

static_assert(source_block % gap_leaves == 0, "tasks that write leaves must not share a word of gaps");

/// The least of some indices, at least one. A loop without branches, which becomes vectors.
std::uint32_t least(const std::uint32_t* index, std::size_t count) noexcept {
  std::uint32_t least = *index;
  for (std::size_t i = 1; i < count; ++i) least = std::min(least, index[i]);
  return least;
}

/// Builds a tree of the bounds of a source, which may be the scratch's own records.
template <class Bound, class Source>
TreeParts<Bound> build_in(const BuildScratch<Bound>& scratch, const Source& source) {
  const Kernels& kernels = active_kernels();
  const ClassBounds class_first = write_entries<Bound>(source, scratch.place());
  TreeParts<Bound> parts;
  lay_out(parts, source.count());
  parts.order = TreeArray<std::uint32_t>(parts.size);
  parts.least_index = TreeArray<std::uint32_t>(bit_words(parts.size));
  write_tree_order(scratch.entries(), scratch.spare(), class_first, kernels, parts.order.data());
  const RecordSource<Bound> all(records_in<Bound>(scratch.records(), parts.size));
  parallel_for(chunk_count(parts.size, source_block), 1, [&](std::size_t b, std::size_t) {
    const IndexRange block = chunk_at(parts.size, source_block, b);
    write_leaves(parts, kernels, parts.order.data() + block.first, parts.size - block.first, block, all);
    find_least_indices(parts, block);
  });
  fit_upper(parts, kernels);
  parts.surface_when_built = surface(parts);
  return parts;
}

/// Records ahead of the one written that are prefetched: they are all over memory. It saves 6 ms of 51 for a million
/// boxes.
constexpr std::size_t prefetched_records = 16;

/// Writes a tree's bounds as records in the user's order.
template <class Bound>
void put_back(const TreeParts<Bound>& parts, float* records) {
  parallel_for(chunk_count(parts.size, source_block), 1, [&](std::size_t b, std::size_t) {
    const IndexRange block = chunk_at(parts.size, source_block, b);
    const auto stream = parts.leaves.view().stream;
    for (std::size_t p = block.first; p != block.end(); ++p) {
      if (p + prefetched_records < block.end()) {
        const float* const soon = records + parts.order[p + prefetched_records] * rows_of<Bound>;
        prefetch_to_write(soon);
        prefetch_to_write(soon + stream.size() - 1);  // may be in the next cache line
      }
      float* const record = records + parts.order[p] * rows_of<Bound>;
      for (std::size_t s = 0; s != stream.size(); ++s) record[s] = stream[s][p];
    }
  });
}

}  // namespace

template <class Bound>
void find_least_indices(TreeParts<Bound>& parts, const IndexRange& leaves) noexcept {
  for (std::size_t first = leaves.first; first < leaves.end(); first += fanout) {
    parts.least_index[first / fanout] = least(parts.order.data() + first, std::min(fanout, leaves.end() - first));
  }
}

template <class Bound, class Source>
TreeParts<Bound> build(const Source& source, const RegionSizes& sizes) {
  if (are_regions_worth_it(source.count(), sizes)) return build_by_regions<Bound>(source, sizes);
  return build_in(BuildScratch<Bound>(source.count()), source);
}

template <class Bound>
TreeParts<Bound> rebuild(const TreeParts<Bound>& parts, const RegionSizes& sizes) {
  // Bounds are put back into the user's order, so that nothing depends on where they are now.
  TreeParts<Bound> rebuilt = [&] {
    if (are_regions_worth_it(parts.size, sizes)) {
      const LargeMemory<float> records(parts.size * rows_of<Bound>);
      put_back(parts, records.get());
      const RecordSource<Bound> source(records_in<Bound>(records.get(), parts.size));
      return build_by_regions<Bound>(source, sizes);
    }
    const BuildScratch<Bound> scratch(parts.size);
    put_back(parts, scratch.records());
    return build_in(scratch, RecordSource<Bound>(records_in<Bound>(scratch.records(), parts.size)));
  }();
  if (parts.layers.exist()) {
    rebuilt.layers = layers_of<Bound>(rebuilt, rebuilt.order, layers_by_index<Bound>(parts, parts.order));
  }
  return rebuilt;
}

template std::size_t lay_out_levels(TreeLevels<Box>&, std::size_t) noexcept;
template std::size_t lay_out_levels(TreeLevels<Sphere>&, std::size_t) noexcept;
#define SHAFTCULL_BUILD(Bound)                                                     \
  template void find_least_indices(TreeParts<Bound>&, const IndexRange&) noexcept; \
  template TreeParts<Bound> build(const ViewSource<Bound>&, const RegionSizes&);   \
  template TreeParts<Bound> build(const RecordSource<Bound>&, const RegionSizes&); \
  template TreeParts<Bound> rebuild(const TreeParts<Bound>&, const RegionSizes&);
SHAFTCULL_BUILD(Box)
SHAFTCULL_BUILD(Sphere)
#undef SHAFTCULL_BUILD
template TreeParts<Box> build(const CentreExtentSource&, const RegionSizes&);

}  // namespace shaftcull::kernel
