// SPDX-License-Identifier: MIT
/// Finished blocks of a job, on disk.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "batch/block_answer.hpp"
#include "batch/checksum.hpp"

namespace shaftcull::batch {

/// A file for each block and share, in a folder: a header, then the answers, both with a checksum. It is written under
/// another name and renamed, so that a run that is killed leaves whole blocks, or none. Nobody waits for the disk: what
/// a machine that goes down has not written, checksums tell.
class BlockStore {
 public:
  /// `job` tells whose blocks these are: others count as damaged. `rank` keeps names of those that write apart.
  BlockStore(std::string folder, const Fingerprint& job, int rank);

  /// Makes the folders that blocks of so many shares go to. Throws std::runtime_error.
  void make_folders(std::size_t shares) const;

  /// Throws std::runtime_error if it cannot be written; then the block is not there.
  void write(std::uint64_t share, std::uint64_t block, const BlockAnswer& answer) const;

  /// The answers of a block, or nothing if it is not there, torn or damaged.
  [[nodiscard]] std::optional<BlockAnswer> read(std::uint64_t share, std::uint64_t block) const;

  /// How many indices the lists of a block have, by its header alone. Nothing if that is not there or damaged.
  [[nodiscard]] std::optional<std::array<std::uint64_t, 2>> list_totals(std::uint64_t share, std::uint64_t block) const;

  [[nodiscard]] std::string path(std::uint64_t share, std::uint64_t block) const;

 private:
  std::string folder_;
  Fingerprint job_;
  int rank_;
};

}  // namespace shaftcull::batch
