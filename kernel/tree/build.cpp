#include "tree/build.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "tree/order.hpp"
#include "tree/size_class.hpp"

namespace shaftcull::kernel {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// What lies in padding: outside of everything without a second look.
constexpr float nowhere[6] = {infinity, infinity, infinity, -infinity, -infinity, -infinity};
constexpr float no_sphere[4] = {0, 0, 0, -1};

template <std::size_t rows>
void fill_from(const StreamMemory& memory, std::size_t from, const float (&value)[rows]) {
  for (std::size_t s = 0; s != rows; ++s)
    std::fill(memory.row(s) + from, memory.row(s) + memory.row_length(), value[s]);
}

/// Some of the legal bounds' centres, evenly spaced in the user's order.
template <class Bound>
std::vector<Vec3> sample_of(const RecordSource<Bound>& source) {
  constexpr std::size_t most = 1024;
  const std::size_t step = source.count() / most + 1;
  std::vector<Vec3> sample;
  for (std::size_t i = 0; i < source.count(); i += step) {
    float bound[rows_of<Bound>];
    source.read(i, bound);
    const Placement place = placement(bound);
    if (ReaderOf<Bound>::is_legal(bound) && place.extent >= 0) sample.push_back(place.centre);
  }
  return sample;
}

/// Entries for all bounds, sorted by size class; where each class begins goes to class_first. Throws BadBound for the
/// first illegal bound.
template <class Bound>
std::unique_ptr<OrderEntry[]> entries_by_class(const RecordSource<Bound>& source,
                                               std::size_t (&class_first)[size_classes + 1]) {
  const std::size_t count = source.count();
  const float node_size = usual_node_size(sample_of(source), count);
  const std::size_t blocks = pieces(count, source_block);
  auto entries = std::make_unique_for_overwrite<OrderEntry[]>(count);
  std::vector<std::array<std::size_t, size_classes>> places(blocks);  // counts at first
  std::atomic<bool> all_legal = true;
  parallel_for(blocks, 1, [&](std::size_t b, std::size_t) {
    const Run block = piece(count, source_block, b);
    std::array<std::size_t, size_classes> counts{};
    bool is_legal = true;
    for (std::size_t i = block.first; i != block.end(); ++i) {
      float bound[rows_of<Bound>];
      source.read(i, bound);
      is_legal &= ReaderOf<Bound>::is_legal(bound);
      const Placement where = placement(bound);
      entries[i] = OrderEntry(where.centre, static_cast<std::uint32_t>(i));  // its place, if there is one class only
      ++counts[size_class(where.extent, node_size)];
    }
    places[b] = counts;
    if (!is_legal) all_legal.store(false, std::memory_order_relaxed);
  });
  if (!all_legal.load(std::memory_order_relaxed)) require_legal<Bound>(source);

  std::size_t next = 0;
  bool one_class = false;
  for (unsigned c = 0; c != size_classes; ++c) {
    class_first[c] = next;
    for (std::size_t b = 0; b != blocks; ++b) next += std::exchange(places[b][c], next);
    one_class = one_class || next - class_first[c] == count;
  }
  class_first[size_classes] = next;
  if (one_class) return entries;

  parallel_for(blocks, 1, [&](std::size_t b, std::size_t) {
    const Run block = piece(count, source_block, b);
    std::array<std::size_t, size_classes> place = places[b];
    for (std::size_t i = block.first; i != block.end(); ++i) {
      float bound[rows_of<Bound>];
      source.read(i, bound);
      const Placement where = placement(bound);
      entries[place[size_class(where.extent, node_size)]++] = OrderEntry(where.centre, static_cast<std::uint32_t>(i));
    }
  });
  return entries;
}

}  // namespace

template <class Bound>
void lay_out(TreeParts<Bound>& parts, std::size_t size) {
  parts.size = size;
  parts.leaves = StreamMemory(rows_of<Bound>, words_for(size) * 64);
  if constexpr (std::is_same_v<Bound, Box>) {
    fill_from(parts.leaves, size, nowhere);
  } else {
    fill_from(parts.leaves, size, no_sphere);
  }
  if (size == 0) return;
  std::size_t nodes = 0;
  parts.level[0] = {size, 0};
  parts.levels = 1;
  while (parts.level[parts.levels - 1].words() > top_words) {
    TreeLevel& level = parts.level[parts.levels];
    level = {parts.level[parts.levels - 1].words(), nodes};
    nodes += level.words() * 64;
    ++parts.levels;
  }
  parts.nodes = StreamMemory(6, nodes);
  fill_from(parts.nodes, 0, nowhere);
  parts.gaps.assign(nodes / 64, ~std::uint64_t{0});
}

template <class Bound>
TreeParts<Bound> build(const RecordSource<Bound>& source) {
  std::size_t class_first[size_classes + 1];
  const std::unique_ptr<OrderEntry[]> entries = entries_by_class(source, class_first);
  TreeParts<Bound> parts;
  lay_out(parts, source.count());
  sort_into_tree_order(entries.get(), class_first);

  parts.order.resize(parts.size);
  const auto row = parts.leaf_rows();
  parallel_for(pieces(parts.size, source_block), 1, [&](std::size_t b, std::size_t) {
    const Run block = piece(parts.size, source_block, b);
    for (std::size_t p = block.first; p != block.end(); ++p) {
      if (p + prefetched_bounds < parts.size) source.prefetch(entries[p + prefetched_bounds].index);
      const std::uint32_t i = parts.order[p] = entries[p].index;
      float bound[rows_of<Bound>];
      source.read(i, bound);
      for (std::size_t s = 0; s != rows_of<Bound>; ++s) row[s][p] = bound[s];
    }
  });
  fit_all(parts);
  parts.surface_when_built = surface(parts);
  return parts;
}

template TreeParts<Box> build(const RecordSource<Box>& source);
template TreeParts<Sphere> build(const RecordSource<Sphere>& source);

}  // namespace shaftcull::kernel
