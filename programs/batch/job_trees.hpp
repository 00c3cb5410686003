// SPDX-License-Identifier: MIT
/// The trees of a job: who builds which, where it is kept, and who reads it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "batch/block_store.hpp"
#include "batch/bounds_source.hpp"
#include "batch/checksum.hpp"
#include "batch/dealing.hpp"
#include "batch/dealt_bounds.hpp"
#include "batch/planned_shares.hpp"
#include "batch/ranks.hpp"
#include "batch/share_tree.hpp"
#include "batch/work_log.hpp"

namespace shaftcull::batch {

/// A tree of all bounds is built once on each machine, by the first of its ranks, in memory that its ranks share; a
/// rank that is alone on its machine, or on one without room for that, builds one of its own when it first needs it.
/// Trees of shares are built once in a job, by whoever is free, and are kept in files.
class JobTrees {
 public:
  /// What all ranks know alike. References are to what stays for longer.
  struct Given {
    const BoundsSource& bounds;
    const PlannedShares& plan;
    std::string folder;  ///< of the job
    Fingerprint job;
    Ranks& ranks;
    const Surroundings& surroundings;
    WorkLog& log;
  };
  explicit JobTrees(Given given);

  /// All: the shares among those that no file has yet, the same for all ranks. None if there is only one share. Throws
  /// as on_all() does.
  [[nodiscard]] std::vector<std::uint64_t> missing(std::span<const std::uint64_t> wanted);
  /// All, before trees of shares are built: the stretches of the bounds that are not dealt yet, the same for all ranks.
  /// Throws as on_all() does.
  [[nodiscard]] std::vector<std::uint64_t> stretches_to_deal();
  /// Deals a stretch to its shares.
  void deal(std::uint64_t stretch);
  /// Builds the tree of a share, when all stretches are dealt, and stores it.
  void store(std::uint64_t share);
  /// All, when trees of all shares are stored: removes what was dealt. Throws as on_all() does.
  void have_dealt();
  /// All: builds the tree of all bounds where ranks can share it. Throws as on_all() does.
  void share_in_memory();

  /// The tree of a share; it is there until that of another one is asked for. Throws std::runtime_error if its file is
  /// damaged.
  [[nodiscard]] const ShareTree& of(std::uint64_t share);

 private:
  void build(std::uint64_t share);

  Given given_;
  DealtBounds dealt_;
  BlockStore store_;                   ///< of trees: block i is that of share i
  std::optional<MappedBlock> mapped_;  ///< of share `mapped_share_`, which tree_ then lies in
  std::uint64_t mapped_share_ = 0;
  std::optional<ShareTree> tree_;
};

}  // namespace shaftcull::batch
