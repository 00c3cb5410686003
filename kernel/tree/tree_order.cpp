// SPDX-License-Identifier: MIT
/// A k-d tree whose leaves are nodes of 64: halves are split at the median of the axis on which they are spread out
/// most, moved to a multiple of a whole node, so that nodes of all levels are cells of it.
#include "tree/tree_order.hpp"

#include "parallel/parallel.hpp"
#include "tree/parts.hpp"
#include "tree/split.hpp"

namespace shaftcull::kernel {
namespace {

/// Parts this small are finished by one task.
constexpr std::size_t most_in_one_task = 16384;

/// Where to cut what is at some places: the middle, moved so that every node of the largest possible size is in one
/// part. 0 for parts within one node of leaves.
std::size_t cut_of(std::size_t first, std::size_t last) noexcept {
  std::size_t grain = fanout;
  const auto cuts_at = [&](std::size_t size) { return (first / size + 1) * size < last; };
  if (!cuts_at(grain)) return 0;
  while (cuts_at(grain * fanout)) grain *= fanout;
  const std::size_t middle = first + (last - first) / 2;
  const std::size_t cut = (middle + grain / 2) / grain * grain;
  if (cut <= first) return cut + grain;
  return cut < last ? cut : cut - grain;
}

/// Writes the indices of a part's entries.
void write_indices(const Part& part, std::uint32_t* indices) noexcept {
  for (std::size_t i = part.first - part.origin; i != part.last - part.origin; ++i) {
    indices[i] = index_of(*part.entries, i);
  }
}

/// Writes the order of a part: that of one half and then that of the other, or of both at once. Not level by level, so
/// that a part that fits a cache stays there. Parts of at most `most` entries stay as they are. `parts` of this size,
/// or so, are worked on at once.
void order_part(const Part& part, std::size_t most, std::size_t parts, const Kernels& kernels, std::uint32_t* order) {
  const std::size_t cut = part.size() <= most ? 0 : cut_of(part.first, part.last);
  if (cut == 0) return write_indices(part, order);
  const bool threads_are_idle =
      part.size() >= fewest_for_parallel_split && parts < static_cast<std::size_t>(threads_here());
  const Halves halves = threads_are_idle ? split_in_parallel(part, cut, kernels) : split(part, cut, kernels);
  if (part.size() <= most_in_one_task) {
    order_part(halves.low, most, 2 * parts, kernels, order);
    order_part(halves.high, most, 2 * parts, kernels, order);
  } else {
    parallel_for_nested(2, 1, [&](std::size_t half, std::size_t) {
      order_part(half == 0 ? halves.low : halves.high, most, 2 * parts, kernels, order);
    });
  }
}

void order_alone(const Part& part, const Kernels& kernels, std::uint32_t* order) noexcept {
  const std::size_t cut = cut_of(part.first, part.last);
  if (cut == 0) return write_indices(part, order);
  const Halves halves = split(part, cut, kernels);
  order_alone(halves.low, kernels, order);
  order_alone(halves.high, kernels, order);
}

void add_regions(std::size_t first, std::size_t last, std::size_t most, std::vector<IndexRange>& regions) {
  const std::size_t cut = last - first <= most ? 0 : cut_of(first, last);
  if (cut == 0) return regions.push_back({first, last - first});
  add_regions(first, cut, most, regions);
  add_regions(cut, last, most, regions);
}

}  // namespace

void write_tree_order(const EntryStreams& entries, const EntryStreams& spare, const ClassBounds& class_first,
                      const Kernels& kernels, std::uint32_t* order, std::size_t most) {
  parallel_for(size_classes, 1, [&](std::size_t c, std::size_t) {
    if (class_first[c] != class_first[c + 1]) {
      order_part({class_first[c], class_first[c + 1], &entries, &spare}, most, 1, kernels, order);
    }
  });
}

std::vector<IndexRange> regions_of(const ClassBounds& class_first, std::size_t most) {
  std::vector<IndexRange> regions;
  for (unsigned c = 0; c != size_classes; ++c) {
    if (class_first[c] != class_first[c + 1]) add_regions(class_first[c], class_first[c + 1], most, regions);
  }
  return regions;
}

void write_order_within(const IndexRange& region, const EntryStreams& entries, const EntryStreams& spare,
                        const Kernels& kernels, std::uint32_t* order) noexcept {
  order_alone({region.first, region.end(), &entries, &spare, region.first}, kernels, order);
}

}  // namespace shaftcull::kernel
