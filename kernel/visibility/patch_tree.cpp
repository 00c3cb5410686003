// SPDX-License-Identifier: MIT
#include "visibility/patch_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "exact/polygon.hpp"
#include "simd/baseline_four_floats.hpp"
#include "support/exact_floats.hpp"
#include "visibility/corner_lists.hpp"
#include "visibility/lanes.hpp"
#include "visibility/patch_facings.hpp"
#include "visibility/patch_halving.hpp"

namespace shaftcull::kernel {
namespace {

/// Fewer patches are grouped by place alone: there are few groups of them, and those as wide as the set cost more.
constexpr std::size_t fewest_by_facing = 4096;

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

/// The parts of the group of all patches: those that face one way each, if there are few of these and many patches.
std::vector<Part> first_parts_of(std::span<PatchItem> items, PatchHalving& halving) {
  if (items.size() > fewest_by_facing) {
    const std::vector<std::size_t> counts = sort_by_facing(items, PatchTree::most_children);
    if (counts.size() != 1) {
      std::vector<Part> parts;
      for (std::size_t first = 0; const std::size_t count : counts) {
        parts.push_back({first, count, 0});
        first += count;
      }
      return parts;
    }
  }
  return parts_of(items, 0, items.size(), halving);
}

/// At most 64 bits of words, from one on.
std::uint64_t bits_at(const std::vector<std::uint64_t>& words, std::size_t from, unsigned count) noexcept {
  const std::size_t word = from / 64;
  const unsigned shift = from % 64;
  std::uint64_t bits = words[word] >> shift;
  if (shift != 0 && word + 1 != words.size()) bits |= words[word + 1] << (64 - shift);
  return bits & first_lanes(count);
}

/// A plane near those of corners; its normal is 0 if they have none.
Plane plane_near(std::span<const Vec3> corners) noexcept {
  const PatchNormals normals(corners);
  if (normals.all().empty()) return {{0, 0, 0}, 0};
  const auto& n = normals.all().front();
  const double offset = n[0] * corners[0][0] + n[1] * corners[0][1] + n[2] * corners[0][2];
  const double largest = double{std::numeric_limits<float>::max()};
  return {{static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])},
          static_cast<float>(std::clamp(offset, -largest, largest))};
}

/// Corners of polygons that are seen from both sides, in the order in which planes that are nearly parallel face alike.
std::vector<Vec3> facing_alike(std::span<const Vec3> corners, std::span<const std::size_t> first_corner) {
  constexpr double towards[3] = {0.2673, 0.5345, 0.8018};  // across few walls that there are
  std::vector<Vec3> alike(corners.begin(), corners.end());
  for (std::size_t i = 1; i != first_corner.size(); ++i) {
    const std::size_t first = first_corner[i - 1];
    const Plane plane = plane_near(corners.subspan(first, first_corner[i] - first));
    double along = 0;
    for (std::size_t k = 0; k != 3; ++k) along += towards[k] * double{plane.normal[k]};
    const auto at = [&](std::size_t c) { return alike.begin() + static_cast<std::ptrdiff_t>(c); };
    if (along < 0) std::reverse(at(first + 1), at(first_corner[i]));
  }
  return alike;
}

}  // namespace

void PatchStreams::Free::operator()(float* memory) const noexcept { ::operator delete[](memory, std::align_val_t{64}); }

PatchStreams::PatchStreams(std::size_t count, bool has_planes, bool are_groups)
    : count_(count), stride_((count + most_siblings + 15) / 16 * 16), has_planes_(has_planes), are_groups_(are_groups) {
  const std::size_t rows = !has_planes ? 6 : are_groups ? 13 : 10;
  memory_.reset(static_cast<float*>(::operator new[](rows* stride_ * sizeof(float), std::align_val_t{64})));
  std::fill_n(memory_.get(), rows * stride_, 0.0F);
}

CornerStreams::CornerStreams(std::size_t patches, unsigned corners) {
  const std::size_t stride = patches + most_siblings;
  memory_.resize(3 * corners * stride);
  for (unsigned s = 0; s != 3 * corners; ++s) streams_.push_back(memory_.data() + s * stride);
}

void CornerStreams::set(std::size_t patch, std::span<const Vec3> corners) noexcept {
  for (std::size_t s = 0; s != streams_.size(); ++s) {
    streams_[s][patch] = corners[std::min(s / 3, corners.size() - 1)][s % 3];
  }
}

PatchCorners CornerStreams::of(std::size_t patch) const noexcept {
  PatchCorners corners;
  for (std::size_t c = 0; c != streams_.size(); c += 3) {
    const Vec3 corner{streams_[c][patch], streams_[c + 1][patch], streams_[c + 2][patch]};
    if (c < 9 || corner != corners.all().back()) corners.add(corner);
  }
  return corners;
}

PatchCorners corners_of_box(const Box& box) noexcept {
  PatchCorners corners;
  const BoxCorners all({box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]});
  for (const Vec3& corner : all.get()) corners.add(corner);
  return corners;
}

bool are_corners_of_box(std::span<const Vec3> corners, const Box& box) noexcept {
  const PatchCorners all = corners_of_box(box);
  return std::all_of(all.all().begin(), all.all().end(), [&](const Vec3& corner) {
    return std::find(corners.begin(), corners.end(), corner) != corners.end();
  });
}

PatchCorners PatchTree::corners_of(std::size_t position) const noexcept {
  if (has_corners()) return corner_streams_.of(position);
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    box.lo[k] = patch_streams_.stream(k)[position];
    box.hi[k] = patch_streams_.stream(k + 3)[position];
  }
  return corners_of_box(box);
}

std::uint64_t PatchTree::not_boxes(std::size_t position, unsigned count) const noexcept {
  return not_boxes_.empty() ? 0 : bits_at(not_boxes_, position, count);
}

std::uint64_t PatchTree::groups_of_others(std::size_t group, unsigned count) const noexcept {
  return groups_of_others_.empty() ? 0 : bits_at(groups_of_others_, group, count);
}

PatchTree::PatchTree(std::span<const Vec3> corners, std::span<const std::size_t> first_corner, PatchSides sides) {
  if (first_corner.size() < 2) return;
  const std::size_t count = first_corner.size() - 1;
  std::vector<Vec3> alike;
  if (sides == PatchSides::both) corners = alike = facing_alike(corners, first_corner);
  const auto corners_at = [&](std::size_t i) {
    return corners.subspan(first_corner[i], first_corner[i + 1] - first_corner[i]);
  };
  std::vector<Box> boxes;
  std::vector<Plane> planes;
  boxes.reserve(count);
  std::size_t most = 0;
  for (std::size_t i = 0; i != count; ++i) {
    boxes.push_back(box_around_corners(corners_at(i)));
    planes.push_back(plane_near(corners_at(i)));
    most = std::max(most, corners_at(i).size());
  }
  *this = PatchTree(BoxStream(boxes).view(), planes);
  has_both_sides_ = sides == PatchSides::both;
  corner_streams_ = CornerStreams(count, static_cast<unsigned>(most));
  not_boxes_.resize(bit_words(count));
  for (std::size_t i = 0; i != count; ++i) {
    corner_streams_.set(i, corners_at(order_[i]));
    if (!are_corners_of_box(corners_at(order_[i]), boxes[order_[i]])) not_boxes_[i / 64] |= bit(i % 64);
  }
  groups_of_others_.resize(bit_words(groups_.size()));
  for (std::size_t g = groups_.size(); g-- > 0;) {  // children come after their parents
    const PatchGroup& group = groups_[g];
    const auto& children = group.has_patches ? not_boxes_ : groups_of_others_;
    if (bits_at(children, group.first_child, group.children) != 0) groups_of_others_[g / 64] |= bit(g % 64);
  }
  turned_groups_ = kernel::turned_groups(*this);
}

PatchTree::PatchTree(const BoxView& boxes, std::span<const Plane> planes) {
  if (boxes.count == 0) return;
  ray_patches_ = std::make_shared<MadeOnce<RayPatches>>();
  radiating_patches_ = std::make_shared<MadeOnce<RadiatingPatches>>();
  sight_planes_ = std::make_shared<MadeForKey<SightKey, SightPlanes>>();
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
      const std::vector<Part> parts =
          g == 0 && has_planes ? first_parts_of(items, halving) : parts_of(items, group.first, group.count, halving);
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
