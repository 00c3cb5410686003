// SPDX-License-Identifier: MIT
/// Into which shares bounds are dealt that do not fit into memory at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shaftcull/bounds.hpp"

namespace shaftcull::batch {

/// What a bound is dealt by: the middle of its box, and its position, which parts those with the same middle.
struct ShareKey {
  Vec3 middle;
  std::uint64_t position;
};

/// The middle of a box; 0 on an axis where it has none, as an empty box or one without ends.
[[nodiscard]] Vec3 middle_of(const Box& box) noexcept;

/// The top of a tree over all bounds: cuts of space across one axis, each of which halves the shares below it. Bounds
/// of a share are neighbours in space. The same keys give the same plan.
class SharePlan {
 public:
  /// One share for all.
  SharePlan() = default;
  /// Cuts at the medians of a sample of the keys, along the axis where they spread the widest, until there are `shares`
  /// of them, of equally many keys as nearly as can be. `shares` is at least 1 and at most the number of keys.
  SharePlan(std::vector<ShareKey> sample, std::size_t shares);

  [[nodiscard]] std::size_t shares() const noexcept { return shares_; }
  /// The share that a bound belongs to. O(log shares).
  [[nodiscard]] std::size_t share_of(const ShareKey& key) const noexcept;

 private:
  struct Cut {
    std::size_t axis;
    ShareKey at;              ///< what is below it goes to the left
    std::size_t left_shares;  ///< how many shares are on the left: they come first
    std::size_t right;        ///< the cut on the right, if there are two shares or more; that on the left is the next
  };

  void cut(std::span<ShareKey> keys, std::size_t shares);

  std::vector<Cut> cuts_;
  std::size_t shares_ = 1;
};

}  // namespace shaftcull::batch
