// SPDX-License-Identifier: MIT
/// Files written by a rank that may end at any moment.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace shaftcull::batch {

/// An open file to write to. All calls throw std::runtime_error, which names the file and the reason, if they fail.
class WrittenFile {
 public:
  /// Opens the file, and makes it anew if `fresh`.
  WrittenFile(std::string path, bool fresh);
  WrittenFile(const WrittenFile&) = delete;
  WrittenFile& operator=(const WrittenFile&) = delete;
  ~WrittenFile();

  void write_at(std::uint64_t offset, std::span<const std::byte> bytes);
  /// Waits until all that was written is on disk.
  void sync();
  /// Closes the file. Some file systems tell only then that something could not be written.
  void close();

 private:
  [[noreturn]] void fail() const;

  std::string path_;
  int file_;
};

/// Gives a file its name, in place of what had it. Throws std::runtime_error.
void rename_file(const std::string& from, const std::string& to);

}  // namespace shaftcull::batch
