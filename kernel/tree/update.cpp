// SPDX-License-Identifier: MIT
#include "tree/update.hpp"

#include <algorithm>
#include <string>

#include "dispatch/active_kernels.hpp"
#include "shaftcull/error.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/text.hpp"
#include "tree/write_leaves.hpp"

namespace shaftcull::kernel {
namespace {

void require_count(std::size_t count, std::size_t size) {
  if (count == size) return;
  kernel::fail(InvalidArgument("update of a tree of " + counted(size, "bound") + " got " + std::to_string(count) +
                               "; give one for each, or the indices of those that changed"));
}

/// Tree order reads and writes all over both, so a part of the leaves cannot be their new value.
template <class Bound, class Source>
void require_other_memory(const TreeLevels<Bound>& parts, const Source& source) {
  if (source.overlaps(StreamAccess::memory(parts.leaves))) {
    refuse_shared_memory("update", "the new bounds", "the tree's leaves");
  }
}

}  // namespace

template <class Bound, class Source>
void update_all(TreeParts<Bound>& parts, const Source& source) {
  require_count(source.count(), parts.size);
  require_other_memory(parts, source);
  require_legal<Bound>(source);
  const Kernels& kernels = active_kernels();
  parts.mark_all_dirty();
  parallel_for(chunk_count(parts.size, gap_leaves), 1, [&](std::size_t b, std::size_t) {
    const IndexRange block = chunk_at(parts.size, gap_leaves, b);
    write_leaves(parts, kernels, parts.order.data() + block.first, parts.size - block.first, block, source);
  });
  fit_upper(parts, kernels);
}

template <class Bound, class Source>
void update_some(TreeParts<Bound>& parts, std::span<const std::uint32_t> indices, const Source& source) {
  if (indices.size() != source.count()) {
    kernel::fail(InvalidArgument("update got " + counted_indices(indices.size()) + " and " +
                                 counted(source.count(), "bound") + "; every index needs one bound"));
  }
  require_below("update: indices", indices, parts.size);
  require_other_memory(parts, source);
  require_legal<Bound>(source);
  if (indices.empty()) return;
  const std::uint32_t* const place = parts.places.of(parts.order);
  parts.dirty.resize(bit_words(bit_words(parts.size)));
  // Nothing from here on throws.
  const auto row = parts.leaf_rows();
  for (std::size_t i = 0; i != indices.size(); ++i) {
    const std::size_t p = place[indices[i]];
    float bound[Source::rows];
    source.read(i, bound);
    for (std::size_t s = 0; s != Source::rows; ++s) row[s][p] = bound[s];
    std::uint64_t& word = parts.dirty[p / fanout / 64];
    const std::uint64_t bit = std::uint64_t{1} << p / fanout % 64;
    parts.dirty_words += (word & bit) == 0;
    word |= bit;
  }
}

template void update_all(TreeParts<Box>& parts, const ViewSource<Box>& source);
template void update_all(TreeParts<Box>& parts, const RecordSource<Box>& source);
template void update_all(TreeParts<Box>& parts, const CentreExtentSource& source);
template void update_all(TreeParts<Sphere>& parts, const ViewSource<Sphere>& source);
template void update_all(TreeParts<Sphere>& parts, const RecordSource<Sphere>& source);
template void update_some(TreeParts<Box>& parts, std::span<const std::uint32_t> indices, const ViewSource<Box>& source);
template void update_some(TreeParts<Box>& parts, std::span<const std::uint32_t> indices,
                          const RecordSource<Box>& source);
template void update_some(TreeParts<Box>& parts, std::span<const std::uint32_t> indices,
                          const CentreExtentSource& source);
template void update_some(TreeParts<Sphere>& parts, std::span<const std::uint32_t> indices,
                          const ViewSource<Sphere>& source);
template void update_some(TreeParts<Sphere>& parts, std::span<const std::uint32_t> indices,
                          const RecordSource<Sphere>& source);

}  // namespace shaftcull::kernel
