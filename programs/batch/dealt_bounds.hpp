// SPDX-License-Identifier: MIT
/// Bounds of a job on disk, share by share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "batch/block_store.hpp"
#include "batch/bounds_source.hpp"
#include "batch/checksum.hpp"
#include "batch/planned_shares.hpp"
#include "batch/ranks.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::batch {

/// The bounds of a share.
struct ShareBounds {
  std::vector<float> floats;
  std::vector<std::uint64_t> positions;  ///< in the file of bounds, ascending
  Box box;                               ///< around them all
};

/// Bounds that were read once, from one end of their file to the other, and written down share by share. The file is
/// cut into stretches, which ranks deal in any order; each is a block, and its bounds lie share after share. So a share
/// reads a piece of each block, and nothing that is not its own.
class DealtBounds {
 public:
  /// References are to what stays for longer. `folder` is that of the job.
  DealtBounds(const BoundsSource& bounds, const PlannedShares& plan, const std::string& folder, const Fingerprint& job,
              int rank);

  /// All: the stretches that are not there yet, the same for all ranks. Makes their folder. Throws as on_all() does.
  [[nodiscard]] std::vector<std::uint64_t> missing(Ranks& ranks);
  /// Deals a stretch; parallel. It takes 32 bytes a box in memory, 24 a sphere, 44 a triangle, and 24, 16 or 36 more
  /// where its bounds cannot be mapped: less than building a share does. Throws std::runtime_error if it cannot be
  /// written.
  void store(std::uint64_t stretch) const;
  /// The bounds of a share, when all stretches are there. Throws std::runtime_error if one is damaged.
  [[nodiscard]] ShareBounds of(std::uint64_t share) const;
  /// Removes all stretches. What cannot be removed stays.
  void remove() const noexcept;

 private:
  [[nodiscard]] std::uint64_t stretches() const noexcept;

  const BoundsSource& bounds_;
  const PlannedShares& plan_;
  std::string folder_;
  BlockStore store_;  ///< block i of share 0 is stretch i
};

}  // namespace shaftcull::batch
