// SPDX-License-Identifier: MIT
#include "visibility/patch_tree.hpp"

#include <algorithm>
#include <cmath>
#include <new>

#include "simd/baseline_four_floats.hpp"
#include "support/exact_floats.hpp"
#include "visibility/patch_halving.hpp"

namespace shaftcull::kernel {
namespace {

/// Items side by side that are to be a group.
struct Part {
  std::size_t first;
  std::size_t count;
  float cost;
};

/// The parts of a group: halves of halves, the dearest first, until there are as many as may be.
std::vector<Part> parts_of(std::span<PatchItem> items, std::size_t first, std::size_t count, PatchHalving& halving) {
  const PatchCosts costs(extent_of(items.subspan(first, count)));
  std::vector<Part> parts;
  parts.reserve(PatchTree::most_children);
  parts.push_back({first, count, 0});
  while (parts.size() < PatchTree::most_children) {
    const auto dearest = std::max_element(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
      const bool a_is_group = a.count > PatchTree::most_patches;
      const bool b_is_group = b.count > PatchTree::most_patches;
      return a_is_group != b_is_group ? b_is_group : a.cost < b.cost;
    });
    if (dearest->count <= PatchTree::most_patches) break;
    const std::span<PatchItem> both = items.subspan(dearest->first, dearest->count);
    const std::size_t half = halving.halve(both, costs);
    const PatchExtent extent[4] = {extent_of(both.first(half)), extent_of(both.subspan(half))};
    float cost[4];
    costs.of(extent).store(cost);
    const Part second{dearest->first + half, dearest->count - half, cost[1] * static_cast<float>(both.size() - half)};
    *dearest = {dearest->first, half, cost[0] * static_cast<float>(half)};
    parts.insert(dearest + 1, second);
  }
  return parts;
}

/// The least, or the largest, of `count` floats by better(), which is minimum() or maximum().
template <class Better>
float best_of(const float* from, std::size_t count, const Better& better) noexcept {
  FourFloats best = FourFloats::all(from[0]);
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) best = better(FourFloats::load(from + i), best);
  for (; i != count; ++i) best = better(FourFloats::all(from[i]), best);
  float of[4];
  best.store(of);
  for (std::size_t k = 1; k != 4; ++k) best = better(FourFloats::all(of[k]), best);
  best.store(of);
  return of[0];
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
  std::vector<PatchItem> items(boxes.count);
  for (std::size_t i = 0; i != boxes.count; ++i) {
    const Box box = boxes[i];
    const Vec3 normal = has_planes ? planes[i].normal : Vec3{};
    items[i] = {extent_of(box, {normal[0], normal[1], normal[2]}), static_cast<std::uint32_t>(i)};
    for (std::size_t k = 0; k != 3; ++k) {
      largest_coordinate_ = std::max({largest_coordinate_, std::fabs(box.lo[k]), std::fabs(box.hi[k])});
    }
  }

  PatchHalving halving(items.size(), has_planes);
  groups_.push_back({0, static_cast<std::uint32_t>(boxes.count), 0, 0, false});
  for (std::size_t g = 0; g != groups_.size(); ++g) {
    PatchGroup group = groups_[g];
    if (group.count <= most_patches) {
      group.has_patches = true;
      group.first_child = group.first;
      group.children = static_cast<std::uint8_t>(group.count);
    } else {
      const std::vector<Part> parts = parts_of(items, group.first, group.count, halving);
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
  for (std::vector<float>& inward : group_inward_) inward.resize(groups_.size() + most_siblings);
  for (std::size_t g = groups_.size(); g-- > 0;) {
    const PatchGroup& group = groups_[g];
    const PatchStreams& children = group.has_patches ? patch_streams_ : group_streams_;
    const auto fold = [&](std::size_t s, const auto& better) {
      group_streams_.stream(s)[g] = best_of(children.stream(s) + group.first_child, group.children, better);
    };
    const auto least = [](FourFloats a, FourFloats b) { return minimum(a, b); };
    const auto largest = [](FourFloats a, FourFloats b) { return maximum(a, b); };
    for (std::size_t k = 0; k != 3; ++k) fold(k, least);
    for (std::size_t k = 3; k != 6; ++k) fold(k, largest);
    for (std::size_t f = 0; f != 6; ++f) {
      const float face = group_streams_.stream(f)[g];
      const float opposite = group_streams_.stream((f + 3) % 6)[g];
      const float* const child = children.stream(f) + group.first_child;
      const float* const inward =
          (group.has_patches ? patch_streams_.stream((f + 3) % 6) : group_inward_[f].data()) + group.first_child;
      bool is_left_out = true;
      for (std::size_t i = 0; i != group.children; ++i) is_left_out &= child[i] != face || inward[i] != face;
      group_inward_[f][g] = is_left_out ? opposite : face;
    }
    if (!has_planes) continue;
    for (std::size_t k = 6; k != 9; ++k) fold(k, least);
    for (std::size_t k = 9; k != 12; ++k) fold(k, largest);
    fold(12, least);
  }
}

}  // namespace shaftcull::kernel
