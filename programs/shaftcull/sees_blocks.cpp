// SPDX-License-Identifier: MIT
#include "sees_blocks.hpp"

#include <algorithm>
#include <numeric>

namespace shaftcull::cli {
namespace {

/// Patches of a block: so many that handing out pairs of blocks costs nothing, and so few that there is work for many
/// machines. It depends on the number of patches alone, so that answers come in one order everywhere.
std::size_t block_size(std::size_t patches) {
  constexpr std::size_t smallest = 4096;
  constexpr std::size_t largest = 65'536;
  return std::clamp(patches / 32, smallest, largest);
}

}  // namespace

SeesBlocks::SeesBlocks(const SeesScene& scene) {
  std::vector<std::uint32_t> each(scene.patches.size());
  std::iota(each.begin(), each.end(), 0U);
  const PatchSet all = scene.patch_set(each);
  patches_.assign(all.order().begin(), all.order().end());
  order_.reserve(patches_.size());
  const std::size_t size = block_size(patches_.size());
  for (std::size_t first = 0; first < patches_.size(); first += size) {
    const auto members = std::span(patches_).subspan(first, std::min(size, patches_.size() - first));
    PatchSet set = scene.patch_set(members);
    for (const std::uint32_t i : set.order()) order_.push_back(members[i]);
    blocks_.push_back({static_cast<std::uint32_t>(first), std::move(set)});
  }
  for (std::uint32_t i = 0; i != blocks_.size(); ++i) {
    for (std::uint32_t j = i; j != blocks_.size(); ++j) units_.emplace_back(i, j);
  }
}

std::uint64_t SeesBlocks::pairs() const noexcept {
  return patches_.empty() ? 0 : std::uint64_t{patches_.size()} * (patches_.size() - 1) / 2;
}

std::uint64_t SeesBlocks::pairs_of(std::size_t unit) const noexcept {
  const auto [i, j] = units_[unit];
  const std::uint64_t a = blocks_[i].set.size();
  return i == j ? a * (a - 1) / 2 : a * blocks_[j].set.size();
}

void SeesBlocks::translate(std::size_t unit, std::span<const PatchPair> pairs, std::vector<PatchPair>& to) const {
  const std::uint32_t first_a = blocks_[units_[unit].first].first;
  const std::uint32_t first_b = blocks_[units_[unit].second].first;
  to.clear();
  for (const PatchPair& pair : pairs) to.push_back({patches_[first_a + pair.a], patches_[first_b + pair.b]});
}

VisibilityOptions SeesBlocks::translated(std::size_t unit, const VisibilityOptions& options) const {
  VisibilityOptions own = options;
  if (options.resolve) {
    own.resolve = [this, unit, &options](const UndecidedPairs& undecided, std::span<Sight> verdict) {
      std::vector<PatchPair> pairs;
      translate(unit, undecided.pairs, pairs);
      options.resolve({pairs, undecided.first_candidate, undecided.candidates}, verdict);
    };
  }
  return own;
}

SightCounts SeesBlocks::count(std::size_t unit, const Occluders& occluders, const VisibilityOptions& options) const {
  const auto [i, j] = units_[unit];
  const VisibilityOptions own = translated(unit, options);
  return i == j ? count_visibility(blocks_[i].set, occluders, own)
                : count_visibility(blocks_[i].set, blocks_[j].set, occluders, own);
}

SightCounts SeesBlocks::answer(std::size_t unit, const Occluders& occluders,
                               FunctionRef<void(const SightBatch&)> deliver, const VisibilityOptions& options) const {
  const auto [i, j] = units_[unit];
  std::vector<PairBlock> blocks;
  std::vector<PatchPair> pairs;
  const auto deliver_translated = [&](const SightBatch& batch) {
    blocks.assign(batch.blocks.begin(), batch.blocks.end());
    for (PairBlock& block : blocks) {
      block.a.first += blocks_[units_[unit].first].first;
      block.b.first += blocks_[units_[unit].second].first;
    }
    translate(unit, batch.undecided.pairs, pairs);
    deliver({blocks, {pairs, batch.undecided.first_candidate, batch.undecided.candidates}});
  };
  const VisibilityOptions own = translated(unit, options);
  return i == j ? visibility(blocks_[i].set, occluders, deliver_translated, own)
                : visibility(blocks_[i].set, blocks_[j].set, occluders, deliver_translated, own);
}

}  // namespace shaftcull::cli
