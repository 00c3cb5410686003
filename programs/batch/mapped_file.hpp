// SPDX-License-Identifier: MIT
/// A file in memory, read when it is looked at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace shaftcull::batch {

/// A whole file, mapped for reading. Ranks of one machine that map the same file share its pages.
class MappedFile {
 public:
  /// Throws InvalidArgument, which names the file and the reason, if it cannot be read.
  explicit MappedFile(const std::string& path);
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  [[nodiscard]] const std::byte* data() const noexcept { return data_; }
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }

  /// Has the system read bytes [first, first + count) while this thread goes on: they are looked at soon.
  void read_ahead(std::uint64_t first, std::uint64_t count) const noexcept;

 private:
  const std::byte* data_ = nullptr;
  std::uint64_t size_ = 0;
};

}  // namespace shaftcull::batch
