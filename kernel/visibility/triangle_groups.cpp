// SPDX-License-Identifier: MIT
#include "visibility/triangle_groups.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "support/exact_floats.hpp"
#include "visibility/patch_halving.hpp"

namespace shaftcull::kernel {
namespace {

constexpr std::size_t most_triangles = 32;

PatchItem item_of(const Triangle& triangle, std::size_t index) noexcept {
  const auto& [p, q, r] = triangle.vertex;
  Box around{};
  double edge[2][3];
  for (std::size_t k = 0; k != 3; ++k) {
    around.lo[k] = std::min({p[k], q[k], r[k]});
    around.hi[k] = std::max({p[k], q[k], r[k]});
    edge[0][k] = double{q[k]} - double{p[k]};
    edge[1][k] = double{r[k]} - double{p[k]};
  }
  double normal[3];
  for (std::size_t k = 0; k != 3; ++k) {
    const std::size_t i = (k + 1) % 3;
    const std::size_t j = (k + 2) % 3;
    normal[k] = edge[0][i] * edge[1][j] - edge[0][j] * edge[1][i];
  }
  return {extent_of(around, normal), static_cast<std::uint32_t>(index)};
}

}  // namespace

TriangleGroups triangle_groups(const TriangleView& triangles) {
  TriangleGroups groups;
  groups.first.push_back(0);
  if (triangles.count == 0) return groups;
  std::vector<PatchItem> items(triangles.count);
  for (std::size_t i = 0; i != items.size(); ++i) items[i] = item_of(triangles[i], i);

  PatchHalving halving(items.size(), true);
  // Parts that are still to be cut, the first of them last. Both halves of a part are compared by its own measure.
  std::vector<std::span<PatchItem>> parts{items};
  while (!parts.empty()) {
    const std::span<PatchItem> part = parts.back();
    parts.pop_back();
    if (part.size() <= most_triangles) {
      groups.first.push_back(groups.first.back() + part.size());
      continue;
    }
    const std::size_t half = halving.halve(part, PatchCosts(extent_of(part)));
    parts.push_back(part.subspan(half));
    parts.push_back(part.first(half));
  }
  groups.order.resize(items.size());
  for (std::size_t i = 0; i != items.size(); ++i) groups.order[i] = items[i].index;
  return groups;
}

}  // namespace shaftcull::kernel
