// SPDX-License-Identifier: MIT
/// The trees of a job: who builds which, where it is kept, and who reads it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "batch/bounds_source.hpp"
#include "batch/checksum.hpp"
#include "batch/dealing.hpp"
#include "batch/ranks.hpp"
#include "batch/share_file.hpp"
#include "batch/share_plan.hpp"
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
    const SharePlan& plan;
    const std::vector<std::uint64_t>& sizes;  ///< of the shares
    std::string folder;                       ///< of the job
    Fingerprint job;
    Ranks& ranks;
    const Surroundings& surroundings;
    WorkLog& log;
  };
  explicit JobTrees(Given given) : given_(std::move(given)) {}

  /// The shares that no file has yet: all ranks get the same. None if there is only one share.
  [[nodiscard]] std::vector<std::uint64_t> missing(std::span<const std::uint64_t> wanted);
  /// Builds the tree of a share, and stores it.
  void store(std::uint64_t share);
  /// All: builds the tree of all bounds where ranks can share it. Throws as on_all() does.
  void share_in_memory();

  /// The tree of a share; it is there until that of another one is asked for. Throws std::runtime_error if its file is
  /// damaged.
  [[nodiscard]] const ShareTree& of(std::uint64_t share);

 private:
  void build(std::uint64_t share);
  [[nodiscard]] std::string path(std::uint64_t share) const;

  Given given_;
  std::optional<ShareTree> own_;  ///< built here, or in memory that ranks share
  std::optional<MappedShare> mapped_;
  std::uint64_t mapped_share_ = 0;
};

}  // namespace shaftcull::batch
