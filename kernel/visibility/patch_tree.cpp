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

namespace shaftcull::kernel {
namespace {

/// What a patch is sorted by: the middle of its box, and its unit normal.
constexpr std::size_t keys = 6;

/// A box in up to six dimensions: three of space, three of normals.
struct Extent {
  std::array<float, keys> lo;
  std::array<float, keys> hi;

  Extent() noexcept {
    lo.fill(std::numeric_limits<float>::infinity());
    hi.fill(-std::numeric_limits<float>::infinity());
  }
  void join(const Extent& other) noexcept {
    for (std::size_t k = 0; k != keys; ++k) {
      lo[k] = std::min(lo[k], other.lo[k]);
      hi[k] = std::max(hi[k], other.hi[k]);
    }
  }
  [[nodiscard]] double length(std::size_t k) const noexcept { return hi[k] >= lo[k] ? double{hi[k]} - lo[k] : 0; }
};

/// A patch on its way to its group.
struct Item {
  std::array<float, keys> key;
  Extent extent;
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

constexpr std::size_t bins = 32;

/// Halves items where it costs least. Returns how many are in the first half: never none or all.
std::size_t halve(std::span<Item> items, std::size_t most_keys) {
  Extent centres;
  for (const Item& item : items) {
    for (std::size_t k = 0; k != most_keys; ++k) {
      centres.lo[k] = std::min(centres.lo[k], item.key[k]);
      centres.hi[k] = std::max(centres.hi[k], item.key[k]);
    }
  }
  double least = std::numeric_limits<double>::infinity();
  std::size_t best_key = keys;
  std::size_t best_bin = 0;
  const auto bin_of = [&](const Item& item, std::size_t k) {
    const double at = (double{item.key[k]} - centres.lo[k]) / centres.length(k) * bins;
    return std::min(static_cast<std::size_t>(at), bins - 1);
  };
  for (std::size_t k = 0; k != most_keys; ++k) {
    if (!(centres.length(k) > 0)) continue;
    std::array<Extent, bins> extent;
    std::array<std::size_t, bins> count{};
    for (const Item& item : items) {
      const std::size_t b = bin_of(item, k);
      extent[b].join(item.extent);
      ++count[b];
    }
    std::array<double, bins> behind{};
    Extent joined;
    std::size_t joined_count = 0;
    for (std::size_t b = bins; b-- > 1;) {
      joined.join(extent[b]);
      joined_count += count[b];
      behind[b] = joined_count == 0 ? 0 : cost(joined) * static_cast<double>(joined_count);
    }
    joined = Extent();
    joined_count = 0;
    for (std::size_t b = 1; b != bins; ++b) {
      joined.join(extent[b - 1]);
      joined_count += count[b - 1];
      if (joined_count == 0 || joined_count == items.size()) continue;
      const double total = cost(joined) * static_cast<double>(joined_count) + behind[b];
      if (total < least) {
        least = total;
        best_key = k;
        best_bin = b;
      }
    }
  }
  if (best_key == keys) return items.size() / 2;  // all alike
  const auto middle = std::stable_partition(items.begin(), items.end(),
                                            [&](const Item& item) { return bin_of(item, best_key) < best_bin; });
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
      item.extent.lo[k] = box.lo[k];
      item.extent.hi[k] = box.hi[k];
      item.key[k] = 0.5F * box.lo[k] + 0.5F * box.hi[k];
      largest_coordinate_ = std::max({largest_coordinate_, std::fabs(box.lo[k]), std::fabs(box.hi[k])});
      item.key[k + 3] = item.extent.lo[k + 3] = item.extent.hi[k + 3] = 0;
    }
    if (!has_planes) continue;
    const Vec3& n = planes[i].normal;
    const double length = std::sqrt(double{n[0]} * n[0] + double{n[1]} * n[1] + double{n[2]} * n[2]);
    for (std::size_t k = 0; k != 3; ++k) {
      item.key[k + 3] = item.extent.lo[k + 3] = item.extent.hi[k + 3] = static_cast<float>(n[k] / length);
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
