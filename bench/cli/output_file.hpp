// SPDX-License-Identifier: MIT
/// Files that the program writes: whole, or not at all.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace shaftcull::cli {

/// Closes a file, whatever comes of it.
struct CloseFile {
  void operator()(std::FILE* file) const noexcept { static_cast<void>(std::fclose(file)); }
};

/// A file under another name, path and ".part", until it is finished; if it never is, it is removed.
class OutputFile {
 public:
  /// Throws InvalidArgument, which names the file and the reason, if it cannot be made.
  explicit OutputFile(std::string path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// Both throw std::runtime_error, which names the file and the reason, if it cannot be written.
  void write(std::string_view bytes);
  void finish();

  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  std::string path_;
  std::string part_;
  std::unique_ptr<std::FILE, CloseFile> file_;
};

/// Bytes that are kept on disk, beside the file that they will be part of, and have no name there.
class Spool {
 public:
  /// Throws InvalidArgument if there can be none beside `path`.
  explicit Spool(const std::string& path);

  /// Throws std::runtime_error if it cannot be written.
  void write(std::string_view bytes);
  /// Calls take(bytes) until all was taken.
  template <class Take>
  void read_all(const Take& take) {
    rewind();
    for (std::string_view bytes = next(); !bytes.empty(); bytes = next()) take(bytes);
  }

  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }

 private:
  void rewind();
  std::string_view next();

  std::string path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::uint64_t size_ = 0;
  std::uint64_t taken_ = 0;
  std::string buffer_;
};

}  // namespace shaftcull::cli
