// SPDX-License-Identifier: MIT
#include "batch/job_trees.hpp"

#include <tuple>
#include <utility>

namespace shaftcull::batch {
namespace {

/// What is stored of a share.
struct StoredTree {
  std::vector<std::byte> image;

  static std::tuple<const std::vector<std::byte>&> arrays(const StoredTree& tree) { return {tree.image}; }
};

}  // namespace

JobTrees::JobTrees(Given given)
    : given_(std::move(given)),
      dealt_(given_.bounds, given_.plan, given_.folder, given_.job, given_.ranks.rank()),
      store_(given_.folder + "/trees", given_.job, given_.ranks.rank()) {}

std::vector<std::uint64_t> JobTrees::missing(std::span<const std::uint64_t> wanted) {
  if (given_.plan.count() == 1) return {};
  return missing_blocks(store_, wanted, given_.ranks);
}

std::vector<std::uint64_t> JobTrees::stretches_to_deal() { return dealt_.missing(given_.ranks); }

void JobTrees::deal(std::uint64_t stretch) {
  given_.log.time("deal", 0, stretch, [&] { dealt_.store(stretch); });
}

void JobTrees::have_dealt() {
  on_first(given_.ranks, [&] { dealt_.remove(); });
}

void JobTrees::build(std::uint64_t share) {
  given_.log.time("tree", share, 0, [&] {
    if (given_.plan.count() == 1) {
      tree_.emplace(given_.bounds);
    } else {
      tree_.emplace(given_.bounds, dealt_.of(share));
    }
  });
}

void JobTrees::store(std::uint64_t share) {
  build(share);
  given_.log.time("keep", share, 0, [&] {
    // Tree and image take less than building the tree did.
    StoredTree stored{std::vector<std::byte>(tree_->image_bytes())};
    tree_->write_image(stored.image);
    store_.write(0, share, stored);
  });
  tree_.reset();
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
  const std::span<std::byte> image = ranks.shared_memory(is_builder ? tree_->image_bytes() : 0);
  if (image.empty()) return;
  if (is_builder) given_.surroundings.on_threads([&] { tree_->write_image(image); });
  ranks.meet_here();
  tree_.emplace(given_.bounds.kind(), image);
}

const ShareTree& JobTrees::of(std::uint64_t share) {
  if (given_.plan.count() == 1) {
    if (!tree_) build(0);
    return *tree_;
  }
  if (!mapped_ || mapped_share_ != share) {
    tree_.reset();
    mapped_ = store_.map(0, share, BlockStore::Check::all);
    if (!mapped_) store_.give_up(0, share);
    mapped_share_ = share;
    tree_.emplace(given_.bounds.kind(), mapped_->array(0));
  }
  return *tree_;
}

}  // namespace shaftcull::batch
