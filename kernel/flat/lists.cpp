/// list_many(): one pass over the bounds. Tasks list what they keep in memory of their own, and once
/// all counts are known the pieces are copied to their places.
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "flat/batch_job.hpp"
#include "parallel/parallel.hpp"
#include "parallel/task_memory.hpp"
#include "shaftcull/many.hpp"
#include "support/list_memory.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

/// What a task lists, of its first shaft, then of the second, …: positions within its block.
using Piece = kernel::TaskMemory<std::uint32_t>;

/// Turns counts, one row of shafts for every block, into the places in `indices` where they go; fills `offsets`.
void place(std::vector<std::uint64_t>& counts, std::size_t blocks, std::size_t shafts,
           std::vector<std::uint64_t>& offsets) {
  offsets.assign(shafts + 1, 0);
  for (std::size_t b = 0; b != blocks; ++b) {
    for (std::size_t s = 0; s != shafts; ++s) offsets[s + 1] += counts[b * shafts + s];
  }
  for (std::size_t s = 0; s != shafts; ++s) offsets[s + 1] += offsets[s];
  std::vector<std::uint64_t> next(offsets.begin(), offsets.end() - 1);
  for (std::size_t b = 0; b != blocks; ++b) {
    for (std::size_t s = 0; s != shafts; ++s) next[s] += std::exchange(counts[b * shafts + s], next[s]);
  }
}

template <class View, class Index>
void list_rows(std::span<const CompiledShaft> shafts, const View& bounds, IndexListsOf<Index>& lists, Form form) {
  const kernel::Job<View> job(shafts, bounds, false, form);
  if constexpr (sizeof(Index) < sizeof(bounds.count)) {
    constexpr std::uint64_t last_index = std::numeric_limits<Index>::max();
    if (bounds.count > last_index + 1) {
      throw InvalidArgument("list_many() got " + std::to_string(bounds.count) + " bounds, but 32-bit indices reach " +
                            std::to_string(last_index) + "; use IndexListsOf<std::uint64_t>");
    }
  }

  const kernel::Cut cut = kernel::Cut::free(job.bounds(), job.shafts());
  std::vector<Piece> pieces(cut.blocks() * cut.groups());
  std::vector<std::uint64_t> places(cut.blocks() * job.shafts());  // counts at first
  const kernel::SetBits& set_bits = job.set_bits();
  kernel::parallel_for(cut.blocks(), cut.groups(), [&](std::size_t b, std::size_t g) {
    const kernel::IndexRange block = cut.block(b);
    const kernel::IndexRange group = cut.group(g);
    const std::size_t words = words_for(block.size);
    kernel::TaskRoom<std::uint64_t, 4 * kernel::tile_words> bits(group.size * words);
    std::uint64_t* const kept = bits.get();
    job.test(block, group, {kept, words});
    std::uint64_t* const counts = places.data() + b * job.shafts() + group.first;
    std::size_t total = 0;
    for (std::size_t s = 0; s != group.size; ++s) total += counts[s] = set_bits.count(kept + s * words, words);
    if (total == 0) return;
    Piece piece(total + kernel::set_bits_slack);
    std::uint32_t* out = piece.get();
    for (std::size_t s = 0; s != group.size; ++s) {
      set_bits.write(kept + s * words, words, counts[s], out);
      out += counts[s];
    }
    pieces[b * cut.groups() + g] = std::move(piece);
  });

  kernel::IncompleteLists in_progress(lists.offsets, lists.indices);
  place(places, cut.blocks(), job.shafts(), lists.offsets);
  in_progress.resize_items(lists.offsets.back());
  kernel::parallel_for(cut.blocks(), cut.groups(), [&](std::size_t b, std::size_t g) {
    const Piece piece = std::move(pieces[b * cut.groups() + g]);
    const std::uint32_t* from = piece.get();
    const std::uint64_t* const here = places.data() + b * job.shafts();
    const std::uint64_t* const next = b + 1 == cut.blocks() ? lists.offsets.data() + 1 : here + job.shafts();
    for (std::size_t s = cut.group(g).first; s != cut.group(g).end(); ++s) {
      const auto size = static_cast<std::size_t>(next[s] - here[s]);
      std::transform(from, from + size, lists.indices.data() + here[s],
                     [first = static_cast<Index>(cut.block(b).first)](std::uint32_t i) { return first + i; });
      from += size;
    }
  });
  in_progress.complete();
}

}  // namespace

template <BoundIndex Index>
void list_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, IndexListsOf<Index>& lists, Form form) {
  list_rows(shafts, boxes, lists, form);
}
template <BoundIndex Index>
void list_many(std::span<const CompiledShaft> shafts, const SphereView& spheres, IndexListsOf<Index>& lists,
               Form form) {
  list_rows(shafts, spheres, lists, form);
}

template void list_many(std::span<const CompiledShaft>, const BoxView&, IndexListsOf<std::uint32_t>&, Form);
template void list_many(std::span<const CompiledShaft>, const BoxView&, IndexListsOf<std::uint64_t>&, Form);
template void list_many(std::span<const CompiledShaft>, const SphereView&, IndexListsOf<std::uint32_t>&, Form);
template void list_many(std::span<const CompiledShaft>, const SphereView&, IndexListsOf<std::uint64_t>&, Form);

}  // namespace shaftcull
