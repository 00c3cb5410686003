/// A k-d tree whose leaves are nodes of 64: halves are split at the median of the axis on which they are spread out
/// most, moved to a multiple of a whole node, so that nodes of all levels are cells of it.
#include "tree/order.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

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

/// Some of a part's entries, evenly spaced: about half of √n of n, at least 9.
class Sample {
 public:
  Sample(const OrderEntry* entries, const Part& part) noexcept {
    const std::size_t n = part.last - part.first;
    size_ = std::clamp(static_cast<std::size_t>(0.5 * std::sqrt(static_cast<double>(n))), std::min<std::size_t>(n, 9),
                       most);
    for (std::size_t i = 0; i != size_; ++i) key_[i] = entries[part.first + i * n / size_].key;
  }

  /// The axis on which the sample is spread out most.
  [[nodiscard]] unsigned widest_axis() const noexcept {
    unsigned axis = 0;
    float most_width = -1;
    for (unsigned k = 0; k != 3; ++k) {
      std::uint32_t lo = key_[0][k];
      std::uint32_t hi = key_[0][k];
      for (std::size_t i = 1; i < size_; ++i) {
        lo = std::min(lo, key_[i][k]);
        hi = std::max(hi, key_[i][k]);
      }
      const float width = coordinate_of(hi) - coordinate_of(lo);
      if (width > most_width) {
        axis = k;
        most_width = width;
      }
    }
    return axis;
  }

  /// The key below which about `share` of the part is.
  [[nodiscard]] std::uint32_t quantile(unsigned axis, double share) const noexcept {
    std::uint32_t key[most];
    for (std::size_t i = 0; i != size_; ++i) key[i] = key_[i][axis];
    const std::size_t rank = std::min(static_cast<std::size_t>(share * static_cast<double>(size_)), size_ - 1);
    std::nth_element(key, key + rank, key + size_);
    return key[rank];
  }

 private:
  static constexpr std::size_t most = 255;
  std::array<std::uint32_t, 3> key_[most];
  std::size_t size_;
};

/// Moves entries with keys below `limit` to the front, and returns where they end. Every entry is swapped whether it
/// must be or not: a branch that depends on the key would be mispredicted half of the time.
std::size_t partition(OrderEntry* entries, const Part& part, unsigned axis, std::uint64_t limit) noexcept {
  std::size_t end = part.first;
  for (std::size_t i = part.first; i != part.last; ++i) {
    const std::uint64_t key = entries[i].key[axis];
    const OrderEntry entry = entries[i];
    entries[i] = entries[end];
    entries[end] = entry;
    end += (key - limit) >> 63;
  }
  return end;
}

/// Orders the entries of a part so that none before `cut` has a larger key than any from there on: quickselect with
/// pivots from samples (Floyd and Rivest, "Expected time bounds for selection", 1975).
void select(OrderEntry* entries, Part part, std::size_t cut, unsigned axis) noexcept {
  constexpr std::size_t few = 24;
  while (part.last - part.first > few) {
    const double share = (static_cast<double>(cut - part.first) + 0.5) / static_cast<double>(part.last - part.first);
    const std::uint64_t pivot = Sample(entries, part).quantile(axis, share);
    std::size_t end = partition(entries, part, axis, pivot);
    if (cut < end) {
      part.last = end;
      continue;
    }
    if (end == part.first) {  // the pivot is the smallest: set all that equal it apart
      end = partition(entries, part, axis, pivot + 1);
      if (cut <= end) return;
    }
    part.first = end;
    if (cut == end) return;
  }
  std::nth_element(entries + part.first, entries + cut, entries + part.last,
                   [axis](const OrderEntry& a, const OrderEntry& b) { return a.key[axis] < b.key[axis]; });
}

/// Moves the entries below the cut before it, and returns the cut; 0 if there is none to make.
std::size_t split(OrderEntry* entries, const Part& part) noexcept {
  const std::size_t cut = cut_of(part);
  if (cut != 0) select(entries, part, cut, Sample(entries, part).widest_axis());
  return cut;
}

void split_to_leaves(OrderEntry* entries, const Part& part) noexcept {
  const std::size_t cut = split(entries, part);
  if (cut == 0) return;
  split_to_leaves(entries, {part.first, cut});
  split_to_leaves(entries, {cut, part.last});
}

}  // namespace

void sort_into_tree_order(OrderEntry* entries, const std::size_t (&class_first)[size_classes + 1]) {
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
