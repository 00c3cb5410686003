// SPDX-License-Identifier: MIT
#include "visibility/patch_facings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace shaftcull::kernel {
namespace {

constexpr std::size_t most_sampled = 4096;
constexpr std::size_t rarest_part = 64;  // fewer than one in so many that face one way are no part of their own
/// Normals that agree in each coordinate to about this are one way to face: corners of a turned wall are rounded.
constexpr float steps_per_unit = 64;

/// The way that a patch faces, as a number.
std::uint32_t facing_of(const PatchItem& item) noexcept {
  float largest[4];
  float normal_yz[4];
  item.extent.largest.store(largest);
  item.extent.normal_yz.store(normal_yz);
  std::uint32_t facing = 0;
  for (const float n : {largest[3], normal_yz[0], normal_yz[1]}) {
    facing = 256 * facing + static_cast<std::uint32_t>(std::lround(n * steps_per_unit) + 128);
  }
  return facing;
}

/// The ways that most of `items` face, at most `most` of them, the most frequent ones first; none if a quarter of
/// `items` or more faces other ways. Of many items, some are looked at.
std::vector<std::uint32_t> frequent_facings(std::span<const PatchItem> items, std::size_t most) {
  struct Facing {
    std::uint32_t facing;
    std::size_t count;
  };
  const std::size_t step = items.size() / most_sampled + 1;
  std::vector<std::uint32_t> sampled;
  sampled.reserve(items.size() / step + 1);
  std::size_t at = 0;
  // Not at equal distances, since patches that face alike may come at every sixth place.
  for (std::size_t i = 0; at < items.size(); ++i, at = i * step + i * 7 % step) sampled.push_back(facing_of(items[at]));
  std::sort(sampled.begin(), sampled.end());
  std::vector<Facing> facings;
  for (const std::uint32_t facing : sampled) {
    if (facings.empty() || facings.back().facing != facing) facings.push_back({facing, 0});
    ++facings.back().count;
  }
  std::stable_sort(facings.begin(), facings.end(), [](const Facing& a, const Facing& b) { return a.count > b.count; });
  std::vector<std::uint32_t> frequent;
  std::size_t count = 0;
  for (const Facing& facing : facings) {
    if (frequent.size() == most || rarest_part * facing.count < sampled.size()) break;
    frequent.push_back(facing.facing);
    count += facing.count;
  }
  if (4 * count <= 3 * sampled.size()) frequent.clear();
  return frequent;
}

}  // namespace

std::vector<std::size_t> sort_by_facing(std::span<PatchItem> items, std::size_t most_parts) {
  const std::vector<std::uint32_t> facings = frequent_facings(items, most_parts - 1);
  if (facings.empty()) return {items.size()};
  const auto part_of = [&](const PatchItem& item) {
    return static_cast<std::size_t>(std::find(facings.begin(), facings.end(), facing_of(item)) - facings.begin());
  };
  std::vector<std::size_t> counts(facings.size() + 1);
  std::vector<std::uint8_t> parts(items.size());
  for (std::size_t i = 0; i != items.size(); ++i) {
    const std::size_t part = part_of(items[i]);
    parts[i] = static_cast<std::uint8_t>(part);
    ++counts[part];
  }
  std::vector<std::size_t> next(counts.size());
  std::exclusive_scan(counts.begin(), counts.end(), next.begin(), std::size_t{0});
  std::vector<PatchItem> sorted(items.size());
  for (std::size_t i = 0; i != items.size(); ++i) sorted[next[parts[i]]++] = items[i];
  std::copy(sorted.begin(), sorted.end(), items.begin());
  std::erase(counts, std::size_t{0});
  return counts;
}

}  // namespace shaftcull::kernel
