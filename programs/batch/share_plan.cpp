// SPDX-License-Identifier: MIT
#include "batch/share_plan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace shaftcull::batch {
namespace {

bool before(const ShareKey& a, const ShareKey& b, std::size_t axis) noexcept {
  if (a.middle[axis] != b.middle[axis]) return a.middle[axis] < b.middle[axis];
  return a.position < b.position;
}

std::size_t widest_axis(std::span<const ShareKey> keys) noexcept {
  Vec3 lo = keys.front().middle;
  Vec3 hi = lo;
  for (const ShareKey& key : keys) {
    for (std::size_t axis = 0; axis != 3; ++axis) {
      lo[axis] = std::min(lo[axis], key.middle[axis]);
      hi[axis] = std::max(hi[axis], key.middle[axis]);
    }
  }
  std::size_t widest = 0;
  for (std::size_t axis = 1; axis != 3; ++axis) {
    // Halves, which do not overflow; infinite ones compare as any other.
    if (hi[axis] / 2 - lo[axis] / 2 > hi[widest] / 2 - lo[widest] / 2) widest = axis;
  }
  return widest;
}

}  // namespace

Vec3 middle_of(const Box& box) noexcept {
  Vec3 middle{};
  for (std::size_t axis = 0; axis != 3; ++axis) {
    const float half = box.lo[axis] / 2 + box.hi[axis] / 2;
    middle[axis] = std::isnan(half) ? 0 : half;
  }
  return middle;
}

SharePlan::SharePlan(std::vector<ShareKey> sample, std::size_t shares) : shares_(shares) {
  cuts_.reserve(shares);
  if (shares > 1) cut(sample, shares);
}

void SharePlan::cut(std::span<ShareKey> keys, std::size_t shares) {
  const std::size_t left_shares = shares / 2;
  const std::size_t axis = widest_axis(keys);
  const std::size_t left = keys.size() * left_shares / shares;
  std::ranges::nth_element(keys, keys.begin() + static_cast<std::ptrdiff_t>(left),
                           [&](const ShareKey& a, const ShareKey& b) { return before(a, b, axis); });
  const std::size_t here = cuts_.size();
  cuts_.push_back({axis, keys[left], left_shares, 0});
  if (left_shares > 1) cut(keys.first(left), left_shares);
  cuts_[here].right = cuts_.size();
  if (shares - left_shares > 1) cut(keys.subspan(left), shares - left_shares);
}

std::size_t SharePlan::share_of(const ShareKey& key) const noexcept {
  std::size_t first = 0;
  std::size_t shares = shares_;
  std::size_t at = 0;
  while (shares > 1) {
    const Cut& cut = cuts_[at];
    if (before(key, cut.at, cut.axis)) {
      shares = cut.left_shares;
      ++at;
    } else {
      first += cut.left_shares;
      shares -= cut.left_shares;
      at = cut.right;
    }
  }
  return first;
}

}  // namespace shaftcull::batch
