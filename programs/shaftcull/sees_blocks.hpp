// SPDX-License-Identifier: MIT
/// What sees what in units of work: patches in blocks that lie together, and of these each two, or one with itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sees_scene.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull::cli {

class SeesBlocks {
 public:
  explicit SeesBlocks(const SeesScene& scene);

  [[nodiscard]] std::size_t size() const noexcept { return order_.size(); }
  /// How many pairs of patches there are.
  [[nodiscard]] std::uint64_t pairs() const noexcept;
  /// As that of a PatchSet of all patches: what runs of answers count in.
  [[nodiscard]] std::span<const std::uint32_t> order() const noexcept { return order_; }

  [[nodiscard]] std::size_t units() const noexcept { return units_.size(); }
  [[nodiscard]] std::uint64_t pairs_of(std::size_t unit) const noexcept;

  /// As count_visibility() of the pairs of one unit, with numbers of all patches.
  SightCounts count(std::size_t unit, const Occluders& occluders, const VisibilityOptions& options) const;
  /// As visibility(), likewise.
  SightCounts answer(std::size_t unit, const Occluders& occluders, FunctionRef<void(const SightBatch&)> deliver,
                     const VisibilityOptions& options) const;

 private:
  /// Patches that lie together: patch i of the set is patches_[first + i].
  struct Block {
    std::uint32_t first;
    PatchSet set;
  };

  /// Calls back with numbers of all patches where `options` calls with those of a unit.
  [[nodiscard]] VisibilityOptions translated(std::size_t unit, const VisibilityOptions& options) const;
  void translate(std::size_t unit, std::span<const PatchPair> pairs, std::vector<PatchPair>& to) const;

  std::vector<std::uint32_t> patches_;
  std::vector<std::uint32_t> order_;
  std::vector<Block> blocks_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> units_;
};

}  // namespace shaftcull::cli
