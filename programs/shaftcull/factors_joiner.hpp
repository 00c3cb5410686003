// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "shaftcull/view_factors.hpp"

namespace shaftcull::cli {

/// Joins parts of all view factors as they come, so that few are in memory at once. Each part has arrays as long as the
/// number of patches, even if most of its rows are empty.
class FactorsJoiner {
 public:
  void add(ViewFactors part) {
    for (std::size_t level = 0;; ++level) {
      if (levels_.size() == level) levels_.emplace_back();
      levels_[level].push_back(std::move(part));
      if (levels_[level].size() < most) return;
      part = join_view_factors(std::exchange(levels_[level], {}));
    }
  }

  [[nodiscard]] ViewFactors all(bool close_rows) {
    std::vector<ViewFactors> left;
    for (std::vector<ViewFactors>& level : levels_) {
      for (ViewFactors& part : level) left.push_back(std::move(part));
    }
    return join_view_factors(left, close_rows);
  }

 private:
  static constexpr std::size_t most = 16;
  std::vector<std::vector<ViewFactors>> levels_;  ///< a matrix in level i joins `most` to the power of i parts
};

}  // namespace shaftcull::cli
