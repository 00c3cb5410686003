// SPDX-License-Identifier: MIT
/// Trees of shares, on disk: whoever needs one maps it, and a run that goes on need not build it again.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "batch/checksum.hpp"
#include "batch/mapped_file.hpp"
#include "batch/question.hpp"
#include "batch/share_tree.hpp"

namespace shaftcull::batch {

/// Writes a share to `path`: under the name `temporary` first, so that a run that is killed leaves a whole file or
/// none. `job` and `which` tell whose it is. Throws std::runtime_error if it cannot be written.
void write_share(const std::string& path, const std::string& temporary, const Fingerprint& job, std::uint64_t which,
                 const ShareTree& share);

/// Whether a whole file of this share is there, by its header and size alone.
[[nodiscard]] bool is_share_there(const std::string& path, const Fingerprint& job, std::uint64_t which);

/// A share where its file is mapped. Ranks of one machine share its pages, which the system takes back when it needs
/// them.
class MappedShare {
 public:
  /// Throws std::runtime_error if the file is not there or damaged; then it is removed, so that the next run writes it.
  MappedShare(const std::string& path, const Fingerprint& job, std::uint64_t which, BoundKind kind);

  [[nodiscard]] const ShareTree& tree() const noexcept { return *tree_; }

 private:
  std::unique_ptr<MappedFile> file_;
  std::unique_ptr<ShareTree> tree_;
};

}  // namespace shaftcull::batch
