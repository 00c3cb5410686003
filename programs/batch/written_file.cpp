// SPDX-License-Identifier: MIT
#include "batch/written_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace shaftcull::batch {

WrittenFile::WrittenFile(std::string path, bool fresh)
    : path_(std::move(path)), file_(open(path_.c_str(), O_WRONLY | O_CLOEXEC | (fresh ? O_CREAT | O_TRUNC : 0), 0666)) {
  if (file_ < 0) fail();
}

WrittenFile::~WrittenFile() {
  if (file_ >= 0) ::close(file_);
}

void WrittenFile::close() {
  if (::close(std::exchange(file_, -1)) != 0) fail();
}

void WrittenFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
  constexpr std::size_t most_at_once = std::size_t{1} << 30;
  while (!bytes.empty()) {
    const ssize_t written =
        pwrite(file_, bytes.data(), std::min(bytes.size(), most_at_once), static_cast<off_t>(offset));
    if (written < 0) {
      if (errno == EINTR) continue;
      fail();
    }
    offset += static_cast<std::uint64_t>(written);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void WrittenFile::sync() {
  // Some file systems have none; they say so.
  if (fsync(file_) != 0 && errno != EINVAL && errno != ENOTSUP) fail();
}

void WrittenFile::fail() const {
  throw std::runtime_error(fmt::format("{}: cannot be written: {}", path_, std::strerror(errno)));
}

void rename_file(const std::string& from, const std::string& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) {
    throw std::runtime_error(fmt::format("{}: cannot be renamed {}: {}", from, to, std::strerror(errno)));
  }
}

}  // namespace shaftcull::batch
