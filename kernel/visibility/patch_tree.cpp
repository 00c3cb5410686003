// SPDX-License-Identifier: MIT
/// Groups are halved where the sum of both halves' surface × spread of normals × number of patches is least, as trees
/// of rays are by surface alone (Goldsmith and Salmon, "Automatic Creation of Object Hierarchies for Ray Tracing",
/// 1987): patches that face alike turn away from others together.
#include "visibility/patch_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "support/exact_floats.hpp"
#include "support/float_environment.hpp"

namespace shaftcull::kernel {
namespace {

/// What a patch is sorted by: the middle of its box, and its unit normal.
constexpr std::size_t keys = 6;

/// A box in six dimensions, three of space and three of normals. Its lo is stored with the opposite sign, so that to
/// join two boxes is to take sixteen maxima, which compilers make a few vector operations of. The last two of each
/// eight mean nothing.
class alignas(64) Extent {
 public:
  Extent() noexcept { farthest_.fill(-std::numeric_limits<float>::infinity()); }

  void set(std::size_t k, float lo, float hi) noexcept {
    farthest_[k] = -lo;
    farthest_[k + 8] = hi;
  }
  void join(const Extent& other) noexcept {
    // Copies, so that compilers see that nothing is read after it was written.
    const std::array<float, 16> mine = farthest_;
    const std::array<float, 16> theirs = other.farthest_;
    for (std::size_t i = 0; i != 16; ++i) farthest_[i] = mine[i] > theirs[i] ? mine[i] : theirs[i];
  }
  [[nodiscard]] double length(std::size_t k) const noexcept {
    const double lo = -double{farthest_[k]};
    return farthest_[k + 8] >= lo ? farthest_[k + 8] - lo : 0;
  }

 private:
  std::array<float, 16> farthest_;
};

/// A patch on its way to its group.
struct Item {
  Extent extent;
  std::array<float, keys> key;
  std::uint32_t index;
};

/// What it costs to have a group: how much there is that it is compared with.
double cost(const Extent& extent) noexcept {
  // A line or a point is not free. Normals spread over half a sphere, 4 in this measure, make a group five times as
  // dear: figures by measurement (docs/measurements.md).
  constexpr double of_length = 0.01;
  constexpr double of_flatness = 1.0;
  const double x = extent.length(0);
  const double y = extent.length(1);
  const double z = extent.length(2);
  const double spread = extent.length(3) + extent.length(4) + extent.length(5);
  return (x * y + y * z + z * x + of_length * (x + y + z) * (x + y + z)) * (of_flatness + spread);
}

/// Which bin of equally long parts a key is in.
struct Binning {
  double lo;
  double per_length;
  std::size_t last;

  [[nodiscard]] std::size_t bin(float key) const noexcept {
    return std::min(static_cast<std::size_t>((double{key} - lo) * per_length), last);
  }
};

/// Where a set of items is cut in two: behind the bins up to `last_before`, by a key.
struct Cut {
  double cost = std::numeric_limits<double>::infinity();
  std::size_t key = keys;
  std::size_t last_before = 0;
};

constexpr std::size_t most_bins = 32;
constexpr std::size_t few_items = 256;  // for which half as many bins do as well, and of more so many say where to cut

/// What is in each bin of a key.
struct Bins {
  std::array<Extent, most_bins> extent;
  std::array<std::size_t, most_bins> count{};

  /// One of every `step` items.
  void fill(std::span<const Item> items, std::size_t step, std::size_t key, const Binning& binning) noexcept {
    behind_a_call([&] {  // inlined, compilers make no vectors of it
      for (std::size_t i = 0; i < items.size(); i += step) {
        const std::size_t b = binning.bin(items[i].key[key]);
        extent[b].join(items[i].extent);
        ++count[b];
      }
    });
  }

  /// The best cut between two bins, if it is better than what is known.
  void improve(Cut& best, std::size_t key, std::size_t bins, std::size_t items) const noexcept {
    std::array<double, most_bins> behind{};  // the cost of what is behind each bin
    Extent joined;
    std::size_t joined_count = 0;
    for (std::size_t b = bins; b-- > 1;) {
      behind[b - 1] = behind[b];
      if (count[b] == 0) continue;
      joined.join(extent[b]);
      joined_count += count[b];
      behind[b - 1] = cost(joined) * static_cast<double>(joined_count);
    }
    joined = Extent();
    joined_count = 0;
    for (std::size_t b = 0; b + 1 != bins; ++b) {
      if (count[b] == 0) continue;  // as the cut before it
      joined.join(extent[b]);
      joined_count += count[b];
      if (joined_count == items) break;
      const double total = cost(joined) * static_cast<double>(joined_count) + behind[b];
      if (total < best.cost) best = {total, key, b};
    }
  }
};

/// Halves items where it costs least. Returns how many are in the first half: never none or all.
std::size_t halve(std::span<Item> items, std::size_t most_keys) {
  const std::size_t bins = items.size() < few_items ? most_bins / 2 : most_bins;
  std::array<float, keys> lo;
  std::array<float, keys> hi;
  lo.fill(std::numeric_limits<float>::infinity());
  hi.fill(-std::numeric_limits<float>::infinity());
  for (const Item& item : items) {
    for (std::size_t k = 0; k != keys; ++k) {
      lo[k] = std::min(lo[k], item.key[k]);
      hi[k] = std::max(hi[k], item.key[k]);
    }
  }
  const std::size_t step = items.size() / few_items + 1;
  Cut best;
  std::array<Binning, keys> binning{};
  for (std::size_t k = 0; k != most_keys; ++k) {
    if (!(hi[k] > lo[k])) continue;
    binning[k] = {lo[k], static_cast<double>(bins) / (double{hi[k]} - lo[k]), bins - 1};
    Bins in;
    in.fill(items, step, k, binning[k]);
    in.improve(best, k, bins, (items.size() + step - 1) / step);
  }
  if (best.key == keys) return items.size() / 2;  // all alike
  const auto middle = std::stable_partition(items.begin(), items.end(), [&](const Item& item) {
    return binning[best.key].bin(item.key[best.key]) <= best.last_before;
  });
  return static_cast<std::size_t>(middle - items.begin());
}

Extent extent_of(std::span<const Item> items) noexcept {
  Extent extent;
  for (const Item& item : items) extent.join(item.extent);
  return extent;
}

/// Items side by side that are to be a group.
struct Part {
  std::size_t first;
  std::size_t count;
  double cost;
};

/// The parts of a group: halves of halves, the dearest first, until there are as many as may be.
std::vector<Part> parts_of(std::span<Item> items, std::size_t first, std::size_t count, std::size_t most_keys) {
  std::vector<Part> parts{{first, count, 0}};
  while (parts.size() < PatchTree::most_children) {
    const auto dearest = std::max_element(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
      const bool a_is_group = a.count > PatchTree::most_patches;
      const bool b_is_group = b.count > PatchTree::most_patches;
      return a_is_group != b_is_group ? b_is_group : a.cost < b.cost;
    });
    if (dearest->count <= PatchTree::most_patches) break;
    const std::size_t half = halve(items.subspan(dearest->first, dearest->count), most_keys);
    const auto part = [&](std::size_t from, std::size_t size) {
      return Part{from, size, cost(extent_of(items.subspan(from, size))) * static_cast<double>(size)};
    };
    const Part second = part(dearest->first + half, dearest->count - half);
    *dearest = part(dearest->first, half);
    parts.insert(dearest + 1, second);
  }
  return parts;
}

}  // namespace

void PatchStreams::Free::operator()(float* memory) const noexcept { ::operator delete[](memory, std::align_val_t{64}); }

PatchStreams::PatchStreams(std::size_t count, bool has_planes, bool are_groups)
    : count_(count), stride_((count + most_siblings + 15) / 16 * 16), has_planes_(has_planes), are_groups_(are_groups) {
  const std::size_t rows = !has_planes ? 6 : are_groups ? 13 : 10;
  memory_.reset(static_cast<float*>(::operator new[](rows* stride_ * sizeof(float), std::align_val_t{64})));
  std::fill_n(memory_.get(), rows * stride_, 0.0F);
}

PatchTree::PatchTree(const BoxView& boxes, std::span<const Plane> planes) {
  if (boxes.count == 0) return;
  const bool has_planes = !planes.empty();
  const std::size_t most_keys = has_planes ? keys : 3;
  std::vector<Item> items(boxes.count);
  for (std::size_t i = 0; i != boxes.count; ++i) {
    Item& item = items[i];
    item.index = static_cast<std::uint32_t>(i);
    const Box box = boxes[i];
    for (std::size_t k = 0; k != 3; ++k) {
      item.extent.set(k, box.lo[k], box.hi[k]);
      item.key[k] = 0.5F * box.lo[k] + 0.5F * box.hi[k];
      largest_coordinate_ = std::max({largest_coordinate_, std::fabs(box.lo[k]), std::fabs(box.hi[k])});
      item.key[k + 3] = 0;
    }
    if (!has_planes) continue;
    const Vec3& n = planes[i].normal;
    const double length = std::sqrt(double{n[0]} * n[0] + double{n[1]} * n[1] + double{n[2]} * n[2]);
    for (std::size_t k = 0; k != 3; ++k) {
      item.key[k + 3] = static_cast<float>(n[k] / length);
      item.extent.set(k + 3, item.key[k + 3], item.key[k + 3]);
    }
  }

  groups_.push_back({0, static_cast<std::uint32_t>(boxes.count), 0, 0, false});
  for (std::size_t g = 0; g != groups_.size(); ++g) {
    PatchGroup group = groups_[g];
    if (group.count <= most_patches) {
      group.has_patches = true;
      group.first_child = group.first;
      group.children = static_cast<std::uint8_t>(group.count);
    } else {
      const std::vector<Part> parts = parts_of(items, group.first, group.count, most_keys);
      group.first_child = static_cast<std::uint32_t>(groups_.size());
      group.children = static_cast<std::uint8_t>(parts.size());
      for (const Part& part : parts) {
        groups_.push_back(
            {static_cast<std::uint32_t>(part.first), static_cast<std::uint32_t>(part.count), 0, 0, false});
      }
    }
    groups_[g] = group;
  }

  order_.resize(boxes.count);
  patch_streams_ = PatchStreams(boxes.count, has_planes, false);
  for (std::size_t i = 0; i != boxes.count; ++i) {
    const std::uint32_t index = order_[i] = items[i].index;
    for (std::size_t s = 0; s != 6; ++s) patch_streams_.stream(s)[i] = boxes.stream[s][index];
    if (!has_planes) continue;
    for (std::size_t k = 0; k != 3; ++k) patch_streams_.stream(6 + k)[i] = planes[index].normal[k];
    patch_streams_.stream(12)[i] = planes[index].offset;
  }

  // Children come after their parents.
  group_streams_ = PatchStreams(groups_.size(), has_planes, true);
  for (std::size_t g = groups_.size(); g-- > 0;) {
    const PatchGroup& group = groups_[g];
    const PatchStreams& children = group.has_patches ? patch_streams_ : group_streams_;
    const auto fold = [&](std::size_t s, const auto& better) {
      const float* const from = children.stream(s) + group.first_child;
      group_streams_.stream(s)[g] = *std::min_element(from, from + group.children, better);
    };
    for (std::size_t k = 0; k != 3; ++k) fold(k, std::less<>());
    for (std::size_t k = 3; k != 6; ++k) fold(k, std::greater<>());
    if (!has_planes) continue;
    for (std::size_t k = 6; k != 9; ++k) fold(k, std::less<>());
    for (std::size_t k = 9; k != 12; ++k) fold(k, std::greater<>());
    fold(12, std::less<>());
  }
}

}  // namespace shaftcull::kernel
