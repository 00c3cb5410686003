// SPDX-License-Identifier: MIT
#include "shaftcull/refine.hpp"

#include <algorithm>
#include <bit>
#include <string>

#include "compiled/answers.hpp"
#include "compiled/with_planes.hpp"
#include "dispatch/active_kernels.hpp"
#include "kernels/table.hpp"
#include "parallel/parallel.hpp"
#include "refine/positions.hpp"
#include "streams/access.hpp"
#include "support/arguments.hpp"
#include "support/float_environment.hpp"
#include "support/index_range.hpp"
#include "support/list_memory.hpp"
#include "support/prefetch.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

/// How far ahead of the candidate that is gathered bounds are prefetched, and for trees the positions of leaves.
constexpr std::size_t prefetched_bounds = 16;
constexpr std::size_t prefetched_places = 32;

/// Gathers the bounds of candidates [first, first + size).
template <class View, class Position>
void gather(const View& view, std::span<const std::uint32_t> candidates, const Position& position, std::size_t first,
            std::size_t size, const kernel::RowsOf<View>& row) noexcept {
  for (std::size_t i = 0; i != size; ++i) {
    if (first + i + prefetched_places < candidates.size()) position.prefetch(candidates[first + i + prefetched_places]);
    if (first + i + prefetched_bounds < candidates.size()) {
      const std::size_t soon = position(candidates[first + i + prefetched_bounds]);
      for (const float* stream : view.stream) kernel::prefetch_to_second_level(stream + soon, 1);
    }
    const std::size_t at = position(candidates[first + i]);
    for (std::size_t s = 0; s != row.size(); ++s) row[s][i] = view.stream[s][at];
  }
}

/// Checks what is asked of one shaft, but for the view or tree.
void require_refinable(const kernel::ShaftData& shaft, bool spheres, std::size_t count,
                       std::span<const std::uint32_t> candidates, std::span<const std::uint32_t> kept) {
  kernel::require_answers(shaft, true, false, spheres, 0);
  kernel::require_below("candidates", candidates, count);
  kernel::require_memory("kept", kept, "indices");
  if (kept.data() != candidates.data()) {  // the same beginning is fine: see below
    kernel::require_apart("refine", "kept", kernel::bytes_of(kept.first(std::min(kept.size(), candidates.size()))),
                          "candidates", kernel::bytes_of(candidates));
  }
}

template <class View, class Position>
std::size_t refine_list(const kernel::ShaftData& shaft, const View& view, std::span<const std::uint32_t> candidates,
                        const Position& position, std::span<std::uint32_t> kept) {
  kernel::Test* const test = kernel::active_kernels().test(view);
  const kernel::WithPlanes with_planes(  // once, not block by block
      shaft, kernel::outside_needs_planes(shaft, std::is_same_v<View, SphereView>));
  const kernel::FloatEnvironment environment;
  constexpr std::size_t block = 1024;
  float memory[kernel::row_count<View>][block];
  const kernel::RowsOf<View> row = kernel::rows_in(memory);
  View some = kernel::view_of<View>(row, 0);
  std::size_t count = 0;
  for (std::size_t first = 0; first < candidates.size(); first += block) {
    some.count = std::min(block, candidates.size() - first);
    gather(view, candidates, position, first, some.count, row);
    std::uint64_t bits[block / 64];
    test(with_planes.shaft(), some.stream.data(), some.count, bits, nullptr);
    for (std::size_t w = 0; w != words_for(some.count); ++w) {
      for (std::uint64_t left = bits[w]; left != 0; left &= left - 1) {
        // Never ahead of what is read, so `kept` may be the candidates' own memory.
        const std::uint32_t candidate = candidates[first + w * 64 + static_cast<std::size_t>(std::countr_zero(left))];
        if (count < kept.size()) kept[count] = candidate;
        ++count;
      }
    }
  }
  return count;
}

void require_apart(std::span<const std::uint32_t> candidates, const IndexLists& lists) {
  const auto bytes = kernel::bytes_of(candidates);
  kernel::require_apart("refine_many", "lists", kernel::bytes_of(lists.indices), "candidates", bytes);
  kernel::require_apart("refine_many", "lists", kernel::bytes_of(lists.offsets), "candidates", bytes);
}

template <class View, class Position>
void refine_lists(std::span<const CompiledShaft> shafts, const View& view, std::span<const std::uint32_t> candidates,
                  const Position& position, IndexLists& lists) {
  auto packed = StreamAccess::not_written<kernel::StreamOf<View>>(candidates.size());
  constexpr std::size_t block = 16384;
  kernel::parallel_for(kernel::chunk_count(candidates.size(), block), 1, [&](std::size_t b, std::size_t) {
    const kernel::IndexRange task = kernel::chunk_at(candidates.size(), block, b);
    gather(view, candidates, position, task.first, task.size, StreamAccess::rows(packed, task.first));
  });
  list_many(shafts, packed.view(), lists);
  kernel::IncompleteLists in_progress(lists.offsets, lists.indices);
  kernel::parallel_for(kernel::chunk_count(lists.indices.size(), block), 1, [&](std::size_t b, std::size_t) {
    const kernel::IndexRange task = kernel::chunk_at(lists.indices.size(), block, b);
    for (std::size_t i = task.first; i != task.end(); ++i) lists.indices[i] = candidates[lists.indices[i]];
  });
  in_progress.complete();
}

template <class View>
std::size_t refine_view(const CompiledShaft& shaft, const View& view, std::span<const std::uint32_t> candidates,
                        std::span<std::uint32_t> kept) {
  kernel::require_view(view);
  const kernel::ShaftData& data = kernel::data_of(shaft);
  require_refinable(data, std::is_same_v<View, SphereView>, view.count, candidates, kept);
  return refine_list(data, view, candidates, kernel::PositionInView(), kept);
}

template <class View>
void refine_view_lists(std::span<const CompiledShaft> shafts, const View& view,
                       std::span<const std::uint32_t> candidates, IndexLists& lists) {
  kernel::require_view(view);
  kernel::require_below("candidates", candidates, view.count);
  require_apart(candidates, lists);
  refine_lists(shafts, view, candidates, kernel::PositionInView(), lists);
}

}  // namespace

std::size_t refine(const CompiledShaft& shaft, const BoxView& boxes, std::span<const std::uint32_t> candidates,
                   std::span<std::uint32_t> kept) {
  return refine_view(shaft, boxes, candidates, kept);
}
std::size_t refine(const CompiledShaft& shaft, const SphereView& spheres, std::span<const std::uint32_t> candidates,
                   std::span<std::uint32_t> kept) {
  return refine_view(shaft, spheres, candidates, kept);
}

void refine_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, std::span<const std::uint32_t> candidates,
                 IndexLists& lists) {
  refine_view_lists(shafts, boxes, candidates, lists);
}
void refine_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                 std::span<const std::uint32_t> candidates, IndexLists& lists) {
  refine_view_lists(shafts, spheres, candidates, lists);
}

template <class Bound>
std::size_t refine(const CompiledShaft& shaft, const BoundsTree<Bound>& tree, std::span<const std::uint32_t> candidates,
                   std::span<std::uint32_t> kept) {
  kernel::require_refitted("refine", tree);
  const kernel::ShaftData& data = kernel::data_of(shaft);
  require_refinable(data, std::is_same_v<Bound, Sphere>, tree.size(), candidates, kept);
  return refine_list(data, tree.leaves(), candidates, kernel::places_of(tree), kept);
}
template <class Bound>
void refine_many(std::span<const CompiledShaft> shafts, const BoundsTree<Bound>& tree,
                 std::span<const std::uint32_t> candidates, IndexLists& lists) {
  kernel::require_refitted("refine", tree);
  kernel::require_below("candidates", candidates, tree.size());
  require_apart(candidates, lists);
  refine_lists(shafts, tree.leaves(), candidates, kernel::places_of(tree), lists);
}

#define SHAFTCULL_REFINE(Bound)                                                                                       \
  template std::size_t refine(const CompiledShaft&, const BoundsTree<Bound>&, std::span<const std::uint32_t>,         \
                              std::span<std::uint32_t>);                                                              \
  template void refine_many(std::span<const CompiledShaft>, const BoundsTree<Bound>&, std::span<const std::uint32_t>, \
                            IndexLists&);
SHAFTCULL_REFINE(Box)
SHAFTCULL_REFINE(Sphere)
#undef SHAFTCULL_REFINE

}  // namespace shaftcull
