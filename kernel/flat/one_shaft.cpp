// SPDX-License-Identifier: MIT
/// count(), list(), any() and their like for one shaft.
#include <algorithm>

#include "flat/chunks.hpp"
#include "flat/index_writer.hpp"

namespace shaftcull {
namespace {

using kernel::chunk_bounds;
using kernel::Chunks;
using kernel::first_chunk_bounds;
using kernel::IndexWriter;

template <class View>
std::size_t count_kept(const CompiledShaft& shaft, const View& bounds) {
  const Chunks<View> chunks(shaft, bounds, false);
  std::size_t count = 0;
  chunks.for_each(chunk_bounds, [&](std::size_t, std::size_t words, const std::uint64_t* kept, const std::uint64_t*) {
    count += chunks.set_bits().count(kept, words);
    return true;
  });
  return count;
}

template <class View>
KeptCounts count_classes(const CompiledShaft& shaft, const View& bounds) {
  const Chunks<View> chunks(shaft, bounds, true);
  KeptCounts counts{};
  chunks.for_each(chunk_bounds,
                  [&](std::size_t, std::size_t words, const std::uint64_t* kept, const std::uint64_t* inside) {
                    const std::size_t insides = chunks.set_bits().count(inside, words);
                    counts.inside += insides;
                    counts.overlap += chunks.set_bits().count(kept, words) - insides;  // what is inside is kept
                    return true;
                  });
  return counts;
}

template <class View>
bool any_kept(const CompiledShaft& shaft, const View& bounds) {
  const Chunks<View> chunks(shaft, bounds, false);
  bool any = false;
  chunks.for_each(first_chunk_bounds,
                  [&](std::size_t, std::size_t words, const std::uint64_t* kept, const std::uint64_t*) {
                    any = std::any_of(kept, kept + words, [](std::uint64_t word) { return word != 0; });
                    return !any;
                  });
  return any;
}

template <class View>
std::size_t count_some(const CompiledShaft& shaft, const View& bounds, std::size_t most) {
  const Chunks<View> chunks(shaft, bounds, false);
  std::size_t count = 0;
  if (most == 0) return 0;
  chunks.for_each(first_chunk_bounds,
                  [&](std::size_t, std::size_t words, const std::uint64_t* kept, const std::uint64_t*) {
                    count += chunks.set_bits().count(kept, words);
                    return count < most;
                  });
  return std::min(count, most);
}

template <class View>
std::size_t list_some(const CompiledShaft& shaft, const View& bounds, std::span<std::uint32_t> kept) {
  const Chunks<View> chunks(shaft, bounds, false);
  kernel::require_index_width("list_at_most()", bounds.count);
  kernel::require_memory("kept", kept, "indices");
  if (kept.empty()) return 0;
  IndexWriter listed(chunks.set_bits(), kept);
  chunks.for_each(first_chunk_bounds,
                  [&](std::size_t first, std::size_t words, const std::uint64_t* bits, const std::uint64_t*) {
                    listed.add(first, bits, words);
                    return listed.count() < kept.size();
                  });
  return std::min(listed.count(), kept.size());
}

template <class View>
std::size_t list_kept(const CompiledShaft& shaft, const View& bounds, std::span<std::uint32_t> kept) {
  const Chunks<View> chunks(shaft, bounds, false);
  kernel::require_index_width("list()", bounds.count);
  kernel::require_memory("kept", kept, "indices");
  IndexWriter listed(chunks.set_bits(), kept);
  chunks.for_each(chunk_bounds,
                  [&](std::size_t first, std::size_t words, const std::uint64_t* bits, const std::uint64_t*) {
                    listed.add(first, bits, words);
                    return true;
                  });
  return listed.count();
}

template <class View>
KeptCounts list_classes(const CompiledShaft& shaft, const View& bounds, std::span<std::uint32_t> overlap,
                        std::span<std::uint32_t> inside) {
  const Chunks<View> chunks(shaft, bounds, true);
  kernel::require_index_width("list_classified()", bounds.count);
  kernel::require_memory("overlap", overlap, "indices");
  kernel::require_memory("inside", inside, "indices");
  kernel::require_apart("list_classified", "overlap", kernel::bytes_of(overlap), "inside", kernel::bytes_of(inside));
  IndexWriter overlaps(chunks.set_bits(), overlap);
  IndexWriter insides(chunks.set_bits(), inside);
  chunks.for_each(chunk_bounds,
                  [&](std::size_t first, std::size_t words, std::uint64_t* kept, const std::uint64_t* inside_bits) {
                    for (std::size_t w = 0; w != words; ++w) kept[w] &= ~inside_bits[w];
                    overlaps.add(first, kept, words);
                    insides.add(first, inside_bits, words);
                    return true;
                  });
  return {overlaps.count(), insides.count()};
}

}  // namespace

std::size_t count(const CompiledShaft& shaft, const BoxView& boxes) { return count_kept(shaft, boxes); }
std::size_t count(const CompiledShaft& shaft, const SphereView& spheres) { return count_kept(shaft, spheres); }

std::size_t count_at_most(const CompiledShaft& shaft, const BoxView& boxes, std::size_t most) {
  return count_some(shaft, boxes, most);
}
std::size_t count_at_most(const CompiledShaft& shaft, const SphereView& spheres, std::size_t most) {
  return count_some(shaft, spheres, most);
}

KeptCounts count_classified(const CompiledShaft& shaft, const BoxView& boxes) { return count_classes(shaft, boxes); }
KeptCounts count_classified(const CompiledShaft& shaft, const SphereView& spheres) {
  return count_classes(shaft, spheres);
}

bool any(const CompiledShaft& shaft, const BoxView& boxes) { return any_kept(shaft, boxes); }
bool any(const CompiledShaft& shaft, const SphereView& spheres) { return any_kept(shaft, spheres); }

std::size_t list(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint32_t> kept) {
  return list_kept(shaft, boxes, kept);
}
std::size_t list(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint32_t> kept) {
  return list_kept(shaft, spheres, kept);
}

std::size_t list_at_most(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint32_t> kept) {
  return list_some(shaft, boxes, kept);
}
std::size_t list_at_most(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint32_t> kept) {
  return list_some(shaft, spheres, kept);
}

KeptCounts list_classified(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint32_t> overlap,
                           std::span<std::uint32_t> inside) {
  return list_classes(shaft, boxes, overlap, inside);
}
KeptCounts list_classified(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint32_t> overlap,
                           std::span<std::uint32_t> inside) {
  return list_classes(shaft, spheres, overlap, inside);
}

}  // namespace shaftcull
