// SPDX-License-Identifier: MIT
#include "batch/job_trees.hpp"

#include <fmt/format.h>

namespace shaftcull::batch {

std::string JobTrees::path(std::uint64_t share) const {
  return fmt::format("{}/share-{:04}/tree", given_.folder, share);
}

std::vector<std::uint64_t> JobTrees::missing(std::span<const std::uint64_t> wanted) {
  std::vector<std::uint64_t> missing;
  if (given_.plan.shares() == 1) return missing;
  std::vector<std::uint64_t> is_missing(wanted.size());
  if (given_.ranks.rank() == 0) {
    for (std::size_t i = 0; i != wanted.size(); ++i) {
      is_missing[i] = is_share_there(path(wanted[i]), given_.job, wanted[i]) ? 0 : 1;
    }
  }
  given_.ranks.sum(is_missing);
  for (std::size_t i = 0; i != wanted.size(); ++i) {
    if (is_missing[i] != 0) missing.push_back(wanted[i]);
  }
  return missing;
}

void JobTrees::build(std::uint64_t share) {
  const auto which = static_cast<std::size_t>(share);
  given_.log.time("tree", share, 0, [&] { own_.emplace(given_.bounds, given_.plan, which, given_.sizes[which]); });
}

void JobTrees::store(std::uint64_t share) {
  build(share);
  given_.log.time("keep", share, 0, [&] {
    write_share(path(share), fmt::format("{}/tree-of-rank-{}", given_.folder, given_.ranks.rank()), given_.job, share,
                *own_);
  });
  own_.reset();
}

void JobTrees::share_in_memory() {
  Ranks& ranks = given_.ranks;
  std::uint64_t others_here = static_cast<std::uint64_t>(ranks.ranks_here() - 1);
  ranks.sum({&others_here, 1});
  if (others_here == 0) return;
  const bool is_builder = ranks.ranks_here() > 1 && ranks.is_first_here();
  on_all(ranks, [&] {
    if (is_builder) given_.surroundings.on_threads([&] { build(0); });
  });
  if (ranks.ranks_here() == 1) return;
  const std::span<std::byte> image = ranks.shared_memory(is_builder ? own_->image_bytes() : 0);
  if (image.empty()) return;
  if (is_builder) given_.surroundings.on_threads([&] { own_->write_image(image); });
  ranks.meet_here();
  own_.emplace(given_.bounds.kind(), image);
}

const ShareTree& JobTrees::of(std::uint64_t share) {
  if (given_.plan.shares() == 1) {
    if (!own_) build(0);
    return *own_;
  }
  if (!mapped_ || mapped_share_ != share) {
    mapped_.reset();
    mapped_.emplace(path(share), given_.job, share, given_.bounds.kind());
    mapped_share_ = share;
  }
  return mapped_->tree();
}

}  // namespace shaftcull::batch
