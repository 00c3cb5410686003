#include "shaftcull/refine.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <tuple>

#include "dispatch/active_kernels.hpp"
#include "flat/tiling.hpp"
#include "kernels/table.hpp"
#include "parallel/parallel.hpp"
#include "shaftcull/error.hpp"
#include "support/arguments.hpp"
#include "support/float_environment.hpp"
#include "support/list_memory.hpp"
#include "support/prefetch.hpp"
#include "support/text.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

template <class View>
inline constexpr std::size_t rows_of = std::tuple_size_v<decltype(View::stream)>;

/// Candidates ahead of the one collected whose bounds are fetched.
constexpr std::size_t fetched_candidates = 16;

/// Copies the bounds of candidates [first, first + size) side by side.
template <class View, class Index>
void collect(const View& view, std::span<const Index> candidates, std::size_t first, std::size_t size,
             const std::array<float*, rows_of<View>>& row) noexcept {
  for (std::size_t i = 0; i != size; ++i) {
    if (first + i + fetched_candidates < candidates.size()) {
      for (const float* stream : view.stream)
        kernel::fetch_to_second_level(stream + candidates[first + i + fetched_candidates], 1);
    }
    for (std::size_t s = 0; s != row.size(); ++s) row[s][i] = view.stream[s][candidates[first + i]];
  }
}

template <class View, class Index>
std::size_t refine_list(const CompiledShaft& shaft, const View& view, std::span<const Index> candidates,
                        std::span<Index> kept) {
  kernel::require_answers(shaft, true, false, std::is_same_v<View, SphereView>, 0);
  kernel::require_view(view);
  kernel::require_below("candidates", candidates, view.count);
  if (kept.size() < candidates.size()) {
    throw InvalidArgument("refine: kept has room for " + kernel::counted_indices(kept.size()) +
                          "; it needs as much as the " + kernel::counted(candidates.size(), "candidate"));
  }
  kernel::require_memory("kept", kept, "indices");
  if (kept.data() != candidates.data()) {  // the same beginning is fine: see below
    kernel::require_apart("refine", "kept", kernel::bytes_of(kept.data(), candidates.size()), "candidates",
                          kernel::bytes_of(candidates));
  }
  kernel::Test* const test = kernel::active_kernels().test(view, Form::fastest);  // for all blocks
  CompiledShaft ready = shaft;                                                    // planes once, not block by block
  if constexpr (std::is_same_v<View, SphereView>) complete(ready);
  const kernel::FloatEnvironment environment;
  constexpr std::size_t block = 1024;
  float memory[rows_of<View>][block];
  std::array<float*, rows_of<View>> row;
  for (std::size_t s = 0; s != row.size(); ++s) row[s] = memory[s];
  View some;
  for (std::size_t s = 0; s != row.size(); ++s) some.stream[s] = memory[s];
  std::size_t count = 0;
  for (std::size_t first = 0; first < candidates.size(); first += block) {
    some.count = std::min(block, candidates.size() - first);
    collect(view, candidates, first, some.count, row);
    std::uint64_t bits[block / 64];
    test(ready, some.stream.data(), some.count, bits, nullptr);
    for (std::size_t w = 0; w != words_for(some.count); ++w) {
      for (std::uint64_t left = bits[w]; left != 0; left &= left - 1) {
        // Never ahead of what is read, so `kept` may be the candidates' own memory.
        kept[count++] = candidates[first + w * 64 + static_cast<std::size_t>(std::countr_zero(left))];
      }
    }
  }
  return count;
}

template <class View, class Index>
void refine_lists(std::span<const CompiledShaft> shafts, const View& view, std::span<const Index> candidates,
                  IndexListsOf<Index>& lists) {
  kernel::require_view(view);
  kernel::require_below("candidates", candidates, view.count);
  kernel::require_apart("refine_many", "lists", kernel::bytes_of(lists.indices), "candidates",
                        kernel::bytes_of(candidates));
  kernel::require_apart("refine_many", "lists", kernel::bytes_of(lists.offsets), "candidates",
                        kernel::bytes_of(candidates));
  const StreamMemory memory(rows_of<View>, words_for(candidates.size()) * 64);
  View packed;
  packed.count = candidates.size();
  for (std::size_t s = 0; s != rows_of<View>; ++s) packed.stream[s] = memory.row(s);
  constexpr std::size_t block = 16384;
  kernel::parallel_for(kernel::chunk_count(candidates.size(), block), 1, [&](std::size_t b, std::size_t) {
    const kernel::IndexRange task = kernel::chunk_at(candidates.size(), block, b);
    std::array<float*, rows_of<View>> row;
    for (std::size_t s = 0; s != row.size(); ++s) row[s] = memory.row(s) + task.first;
    collect(view, candidates, task.first, task.size, row);
  });
  list_many(shafts, packed, lists);
  kernel::IncompleteLists in_progress(lists.offsets, lists.indices);
  kernel::parallel_for(kernel::chunk_count(lists.indices.size(), block), 1, [&](std::size_t b, std::size_t) {
    const kernel::IndexRange task = kernel::chunk_at(lists.indices.size(), block, b);
    for (std::size_t i = task.first; i != task.end(); ++i) lists.indices[i] = candidates[lists.indices[i]];
  });
  in_progress.complete();
}

}  // namespace

std::size_t refine(const CompiledShaft& shaft, const BoxView& boxes, std::span<const std::uint32_t> candidates,
                   std::span<std::uint32_t> kept) {
  return refine_list(shaft, boxes, candidates, kept);
}
std::size_t refine(const CompiledShaft& shaft, const BoxView& boxes, std::span<const std::uint64_t> candidates,
                   std::span<std::uint64_t> kept) {
  return refine_list(shaft, boxes, candidates, kept);
}
std::size_t refine(const CompiledShaft& shaft, const SphereView& spheres, std::span<const std::uint32_t> candidates,
                   std::span<std::uint32_t> kept) {
  return refine_list(shaft, spheres, candidates, kept);
}
std::size_t refine(const CompiledShaft& shaft, const SphereView& spheres, std::span<const std::uint64_t> candidates,
                   std::span<std::uint64_t> kept) {
  return refine_list(shaft, spheres, candidates, kept);
}

template <BoundIndex Index>
void refine_many(std::span<const CompiledShaft> shafts, const BoxView& boxes,
                 std::type_identity_t<std::span<const Index>> candidates, IndexListsOf<Index>& lists) {
  refine_lists(shafts, boxes, candidates, lists);
}
template <BoundIndex Index>
void refine_many(std::span<const CompiledShaft> shafts, const SphereView& spheres,
                 std::type_identity_t<std::span<const Index>> candidates, IndexListsOf<Index>& lists) {
  refine_lists(shafts, spheres, candidates, lists);
}

template void refine_many(std::span<const CompiledShaft>, const BoxView&, std::span<const std::uint32_t>,
                          IndexListsOf<std::uint32_t>&);
template void refine_many(std::span<const CompiledShaft>, const BoxView&, std::span<const std::uint64_t>,
                          IndexListsOf<std::uint64_t>&);
template void refine_many(std::span<const CompiledShaft>, const SphereView&, std::span<const std::uint32_t>,
                          IndexListsOf<std::uint32_t>&);
template void refine_many(std::span<const CompiledShaft>, const SphereView&, std::span<const std::uint64_t>,
                          IndexListsOf<std::uint64_t>&);

}  // namespace shaftcull
