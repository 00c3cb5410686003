// SPDX-License-Identifier: MIT
/// One thread halves a part in place, which moves half of it. Many threads cut it into chunks: they first count which
/// of their entries go where, and then scatter them, out of place.
#include "tree/split.hpp"

#include <vector>

#include "parallel/parallel.hpp"
#include "support/index_range.hpp"

namespace shaftcull::kernel {
namespace {

/// Entries in a chunk, which one task handles.
constexpr std::size_t chunk_entries = 16384;

[[nodiscard]] EntryStreams moved_by(const EntryStreams& streams, std::size_t entries) noexcept {
  EntryStreams moved = streams;
  for (float*& stream : moved) stream += entries;
  return moved;
}

/// A pivot, and what each chunk has of keys before it and equal to it.
struct PivotOfChunks {
  unsigned axis;
  float key;
  std::vector<KeyCounts> counts;
};

/// Finds the key that `rank` entries of a part are less than.
PivotOfChunks find_pivot(const Part& part, std::size_t rank, const SplitKernels& kernels) {
  const std::size_t count = part.size();
  const EntryStreams entries = moved_by(*part.entries, part.first - part.origin);
  const EntryStreams scratch = moved_by(*part.scratch, part.first - part.origin);
  const SampleBracket bracket = kernels.bracket(entries.data(), count, rank, scratch.data());
  const float* const key = entries[bracket.axis];
  float* const some = scratch[bracket.axis];  // what a chunk has within the bracket is where the chunk is
  const std::size_t chunks = chunk_count(count, chunk_entries);
  std::vector<BracketCounts> found(chunks);
  parallel_for_nested(chunks, 1, [&](std::size_t c, std::size_t) {
    const IndexRange chunk = chunk_at(count, chunk_entries, c);
    found[c] = kernels.collect_in_bracket(key + chunk.first, chunk.size, bracket, some + chunk.first);
  });
  std::size_t below = 0;
  std::size_t all_between = 0;
  for (const BracketCounts& of_chunk : found) all_between += of_chunk.between;
  std::vector<float> between;
  between.reserve(all_between);
  for (std::size_t c = 0; c != chunks; ++c) {
    const float* const here = some + chunk_at(count, chunk_entries, c).first;
    between.insert(between.end(), here, here + found[c].between);
    below += found[c].below;
  }

  PivotOfChunks pivot{bracket.axis, 0, std::vector<KeyCounts>(chunks)};
  const bool is_between = rank >= below && rank < below + between.size();
  if (is_between) {
    pivot.key = kernels.pivot(between.data(), between.size(), rank - below);
  } else {  // the sample was not like the rest
    pivot.key = kernels.pivot(key, count, rank);
  }
  parallel_for_nested(chunks, 1, [&](std::size_t c, std::size_t) {
    const IndexRange chunk = chunk_at(count, chunk_entries, c);
    if (is_between) {
      pivot.counts[c] = kernels.count_keys(some + chunk.first, found[c].between, pivot.key);
      pivot.counts[c].less += found[c].below;
    } else {
      pivot.counts[c] = kernels.count_keys(key + chunk.first, chunk.size, pivot.key);
    }
  });
  return pivot;
}

}  // namespace

Halves split(const Part& part, std::size_t cut, const Kernels& kernels) noexcept {
  const EntryStreams entries = moved_by(*part.entries, part.first - part.origin);
  const EntryStreams scratch = moved_by(*part.scratch, part.first - part.origin);
  kernels.split.halve(entries.data(), scratch.data(), part.size(), cut - part.first);
  return {{part.first, cut, part.entries, part.scratch, part.origin},
          {cut, part.last, part.scratch, part.entries, part.origin}};
}

Halves split_in_parallel(const Part& part, std::size_t cut, const Kernels& kernels) {
  const SplitKernels& its_kernels = kernels.split;
  const std::size_t rank = cut - part.first;
  const PivotOfChunks pivot = find_pivot(part, rank, its_kernels);
  const unsigned axis = pivot.axis;
  const float key = pivot.key;
  const std::vector<KeyCounts>& of_chunks = pivot.counts;

  // Where each chunk's entries go: those less than the pivot, then, if the cut is among them, those that equal it, then
  // the others, chunk after chunk.
  struct Places {
    std::size_t less;
    std::size_t equal;
    std::size_t larger;
  };
  const std::size_t start = part.first - part.origin;
  Places next{start, start, start};
  for (const KeyCounts& counts : of_chunks) {
    next.equal += counts.less;
    next.larger += counts.less + counts.equal;
  }
  const bool are_apart = next.equal != cut - part.origin;
  if (!are_apart) next.larger = next.equal;
  std::vector<Places> places;
  for (std::size_t c = 0; c != of_chunks.size(); ++c) {
    const KeyCounts& counts = of_chunks[c];
    const std::size_t equal = are_apart ? counts.equal : 0;
    places.push_back(next);
    next.less += counts.less;
    next.equal += equal;
    next.larger += chunk_at(part.size(), chunk_entries, c).size - counts.less - equal;
  }

  parallel_for_nested(places.size(), 1, [&](std::size_t c, std::size_t) {
    const std::size_t first = start + chunk_at(part.size(), chunk_entries, c).first;
    const std::size_t size = chunk_at(part.size(), chunk_entries, c).size;
    const EntryStreams chunk = moved_by(*part.entries, first);
    const EntryStreams less = moved_by(*part.scratch, places[c].less);
    const EntryStreams equal = moved_by(*part.scratch, places[c].equal);
    const EntryStreams larger = moved_by(*part.scratch, places[c].larger);
    its_kernels.scatter(chunk.data(), size, axis, key, of_chunks[c], less.data(), are_apart ? equal.data() : nullptr,
                        larger.data());
  });
  return {{part.first, cut, part.scratch, part.entries, part.origin},
          {cut, part.last, part.scratch, part.entries, part.origin}};
}

}  // namespace shaftcull::kernel
