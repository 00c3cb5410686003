// SPDX-License-Identifier: MIT
/// Files that the program writes: whole, or not at all. What is no file, a device or a pipe, it writes into.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "output_place.hpp"

namespace shaftcull::cli {

/// Closes a file, whatever comes of it.
struct CloseFile {
  void operator()(std::FILE* file) const noexcept { static_cast<void>(std::fclose(file)); }
};

/// Whether output to `path` goes to standard output: "-", /dev/stdout.
[[nodiscard]] bool is_standard_output(const std::string& path);

/// Whether output to `path` is written straight into what is there: standard output, /dev/fd/5, a device, a pipe.
[[nodiscard]] bool is_stream(const std::string& path);

/// Throws InvalidArgument if two of these options name the same file, or one names a file that is read. A path may be
/// empty.
void require_different_files(std::initializer_list<std::pair<const char*, const std::string&>> files,
                             std::span<const std::string> read);

/// The file that output to `path` replaces or makes: behind all symbolic links. Not of a stream.
[[nodiscard]] std::string file_behind(const std::string& path);

/// What is written to a path.
///
/// A file is written under another name in the same folder until it is finished, then renamed; if it never is, it is
/// removed. It has the permissions of the file that it replaces, if there is one, or else the usual ones. A symbolic
/// link stays, and the file that it leads to is replaced. A stream is written into; from then on the program ignores
/// SIGPIPE, so that a pipe that nobody reads is an error as others are.
class OutputFile {
 public:
  /// Opening a pipe with a name waits for its reader. Throws InvalidArgument, which names the file and the reason, if
  /// it cannot be made.
  explicit OutputFile(std::string path);
  /// Of a file that others write into, under the name `part` on the same file system, until it is finished. What is
  /// called so is removed before.
  OutputFile(std::string path, const std::string& part);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// Both throw std::runtime_error, which names the file and the reason, if it cannot be written.
  void write(std::string_view bytes);
  /// All was written. If it throws, a file that was to be replaced is as it was.
  void finish();

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  /// Where bytes that will be part of it may be kept: beside it, or if it is a stream where temporary files are.
  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }

 private:
  /// If it could not be opened, says why.
  void begin();

  std::string path_;
  OutputPlace place_;
  std::filesystem::path folder_;
  std::filesystem::path part_;  ///< the name until it is finished; empty if there is none to remove
  std::unique_ptr<std::FILE, CloseFile> file_;
};

/// Bytes that are kept on disk, beside the file that they will be part of, and have no name there.
class Spool {
 public:
  /// Throws InvalidArgument if there can be none.
  explicit Spool(const OutputFile& whole);

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
