// SPDX-License-Identifier: MIT
/// A k-d tree whose leaves are nodes of 64: halves are split at the median of the axis on which they are spread out
/// most, moved to a multiple of a whole node, so that nodes of all levels are cells of it.
#include "tree/order.hpp"

#include "parallel/parallel.hpp"
#include "tree/parts.hpp"
#include "tree/split.hpp"

namespace shaftcull::kernel {
namespace {

/// Parts this small are finished by one task.
constexpr std::size_t most_in_one_task = 16384;

/// Where to cut: the middle, moved so that every node of the largest possible size is in one part. 0 for parts within
/// one node of leaves.
template <class Index>
std::size_t cut_of(const Part<Index>& part) noexcept {
  std::size_t grain = fanout;
  const auto cuts_at = [&](std::size_t size) { return (part.first / size + 1) * size < part.last; };
  if (!cuts_at(grain)) return 0;
  while (cuts_at(grain * fanout)) grain *= fanout;
  const std::size_t middle = part.first + part.size() / 2;
  const std::size_t cut = (middle + grain / 2) / grain * grain;
  if (cut <= part.first) return cut + grain;
  return cut < part.last ? cut : cut - grain;
}

/// Writes the order of a part: that of one half and then that of the other, or of both at once. Not level by level, so
/// that a part that fits a cache stays there. `parts` of this size, or so, are worked on at once.
template <class Index>
void order_part(const Part<Index>& part, std::size_t parts, const Kernels& kernels, Index* order) {
  const std::size_t cut = cut_of(part);
  if (cut == 0) {
    for (std::size_t i = part.first; i != part.last; ++i) order[i] = index_of<Index>(*part.entries, i);
    return;
  }
  const bool threads_are_idle =
      part.size() >= fewest_for_parallel_split && parts < static_cast<std::size_t>(threads_here());
  const Halves<Index> halves = threads_are_idle ? split_in_parallel(part, cut, kernels) : split(part, cut, kernels);
  if (part.size() <= most_in_one_task) {
    order_part(halves.low, 2 * parts, kernels, order);
    order_part(halves.high, 2 * parts, kernels, order);
  } else {
    parallel_for_nested(2, 1, [&](std::size_t half, std::size_t) {
      order_part(half == 0 ? halves.low : halves.high, 2 * parts, kernels, order);
    });
  }
}

}  // namespace

template <class Index>
void write_tree_order(const EntryStreams<Index>& entries, const EntryStreams<Index>& spare,
                      const ClassBounds& class_first, const Kernels& kernels, Index* order) {
  parallel_for(size_classes, 1, [&](std::size_t c, std::size_t) {
    if (class_first[c] != class_first[c + 1]) {
      order_part<Index>({class_first[c], class_first[c + 1], &entries, &spare}, 1, kernels, order);
    }
  });
}

template void write_tree_order(const EntryStreams<std::uint32_t>& entries, const EntryStreams<std::uint32_t>& spare,
                               const ClassBounds& class_first, const Kernels& kernels, std::uint32_t* order);
template void write_tree_order(const EntryStreams<std::uint64_t>& entries, const EntryStreams<std::uint64_t>& spare,
                               const ClassBounds& class_first, const Kernels& kernels, std::uint64_t* order);

}  // namespace shaftcull::kernel
