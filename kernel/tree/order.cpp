#include "tree/order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "run/parallel.hpp"
#include "tree/parts.hpp"

namespace shaftcull::kernel {
namespace {

/// Entries [first, last).
struct Part {
  std::size_t first;
  std::size_t last;
};

/// Parts this small are finished by one task.
constexpr std::size_t task_entries = 16384;

/// Where to cut: the middle, moved so that every node of the largest possible size is in one piece. 0 for parts within
/// one node of leaves.
std::size_t cut_of(const Part& part) noexcept {
  std::size_t unit = fanout;
  const auto cuts_at = [&](std::size_t size) { return (part.first / size + 1) * size < part.last; };
  if (!cuts_at(unit)) return 0;
  while (cuts_at(unit * fanout)) unit *= fanout;
  const std::size_t middle = part.first + (part.last - part.first) / 2;
  const std::size_t cut = (middle + unit / 2) / unit * unit;
  if (cut <= part.first) return cut + unit;
  return cut < part.last ? cut : cut - unit;
}

/// The axis on which the centres are spread out most.
unsigned widest_axis(const OrderEntry* first, const OrderEntry* last) noexcept {
  Vec3 lo = first->centre;
  Vec3 hi = first->centre;
  for (const OrderEntry* e = first; e != last; ++e) {
    for (std::size_t k = 0; k != 3; ++k) {
      lo[k] = std::min(lo[k], e->centre[k]);
      hi[k] = std::max(hi[k], e->centre[k]);
    }
  }
  unsigned axis = 0;
  for (unsigned k = 1; k != 3; ++k) {
    if (hi[k] - lo[k] > hi[axis] - lo[axis]) axis = k;
  }
  return axis;
}

/// Moves the entries below the cut on one axis before it, and returns the cut; 0 if there is none to make.
std::size_t split(std::vector<OrderEntry>& entries, const Part& part) {
  const std::size_t cut = cut_of(part);
  if (cut == 0) return 0;
  OrderEntry* const start = entries.data();
  const unsigned axis = widest_axis(start + part.first, start + part.last);
  std::nth_element(start + part.first, start + cut, start + part.last, [axis](const OrderEntry& a, const OrderEntry& b) {
    return a.centre[axis] < b.centre[axis];
  });
  return cut;
}

void split_to_leaves(std::vector<OrderEntry>& entries, const Part& part) {
  const std::size_t cut = split(entries, part);
  if (cut == 0) return;
  split_to_leaves(entries, {part.first, cut});
  split_to_leaves(entries, {cut, part.last});
}

}  // namespace

void sort_into_tree_order(std::vector<OrderEntry>& entries, const std::size_t (&class_first)[size_classes + 1]) {
  std::vector<Part> parts;
  for (unsigned c = 0; c != size_classes; ++c) {
    if (class_first[c] != class_first[c + 1]) parts.push_back({class_first[c], class_first[c + 1]});
  }
  std::vector<Part> small;
  while (!parts.empty()) {
    std::vector<std::size_t> cut(parts.size());
    parallel_for(parts.size(), 1, [&](std::size_t i, std::size_t) {
      if (parts[i].last - parts[i].first > task_entries) cut[i] = split(entries, parts[i]);
    });
    std::vector<Part> halves;
    for (std::size_t i = 0; i != parts.size(); ++i) {
      if (cut[i] == 0) {
        small.push_back(parts[i]);
      } else {
        halves.push_back({parts[i].first, cut[i]});
        halves.push_back({cut[i], parts[i].last});
      }
    }
    parts.swap(halves);
  }
  parallel_for(small.size(), 1, [&](std::size_t i, std::size_t) { split_to_leaves(entries, small[i]); });
}

}  // namespace shaftcull::kernel
