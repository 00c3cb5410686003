// SPDX-License-Identifier: MIT
#include "batch/job_trees.hpp"

#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace shaftcull::batch {
namespace {

/// What is stored of a share.
struct StoredTree {
  std::vector<std::byte> image;

  static std::tuple<const std::vector<std::byte>&> arrays(const StoredTree& tree) { return {tree.image}; }
};

}  // namespace

JobTrees::JobTrees(Given given)
    : given_(std::move(given)), store_(given_.folder + "/trees", given_.job, given_.ranks.rank()) {}

std::vector<std::uint64_t> JobTrees::missing(std::span<const std::uint64_t> wanted) {
  std::vector<std::uint64_t> missing;
  if (given_.plan.count() == 1) return missing;
  std::vector<std::uint64_t> is_missing(wanted.size());
  on_first(given_.ranks, [&] {
    store_.make_folders(1);
    for (std::size_t i = 0; i != wanted.size(); ++i) is_missing[i] = store_.sizes(0, wanted[i]) ? 0 : 1;
  });
  given_.ranks.sum(is_missing);
  for (std::size_t i = 0; i != wanted.size(); ++i) {
    if (is_missing[i] != 0) missing.push_back(wanted[i]);
  }
  return missing;
}

void JobTrees::build(std::uint64_t share) {
  const auto which = static_cast<std::size_t>(share);
  given_.log.time("tree", share, 0,
                  [&] { tree_.emplace(given_.bounds, given_.plan.cuts, which, given_.plan.sizes[which]); });
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
    mapped_ = store_.map(0, share);
    if (!mapped_) {
      // The next run builds it again.
      const std::string path = store_.path(0, share);
      std::error_code ignored;
      std::filesystem::remove(path, ignored);
      throw std::runtime_error(fmt::format("{}: is damaged; the same command does it again", path));
    }
    mapped_share_ = share;
    tree_.emplace(given_.bounds.kind(), mapped_->bytes());
  }
  return *tree_;
}

}  // namespace shaftcull::batch
