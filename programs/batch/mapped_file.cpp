// SPDX-License-Identifier: MIT
#include "batch/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include "shaftcull/error.hpp"

namespace shaftcull::batch {

MappedFile::MappedFile(const std::string& path) {
  const auto refuse = [&](int file) {
    const int why = errno;
    if (file >= 0) close(file);
    throw InvalidArgument(fmt::format("{}: cannot be read: {}", path, std::strerror(why)));
  };
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) refuse(file);
  struct stat status {};
  if (fstat(file, &status) != 0) refuse(file);
  if (!S_ISREG(status.st_mode)) {
    close(file);
    throw InvalidArgument(fmt::format("{}: cannot be read: it is not a regular file", path));
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
  if (size_ != 0) {
    void* const memory = mmap(nullptr, size_, PROT_READ, MAP_SHARED, file, 0);
    if (memory == MAP_FAILED) refuse(file);
    data_ = static_cast<const std::byte*>(memory);
  }
  close(file);
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) munmap(const_cast<std::byte*>(data_), size_);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

void MappedFile::read_ahead(std::uint64_t first, std::uint64_t count) const noexcept {
  if (count == 0) return;
  const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  const std::uint64_t begin = first / page * page;
  madvise(const_cast<std::byte*>(data_) + begin, first + count - begin, MADV_WILLNEED);  // NOLINT: it is only read
}

}  // namespace shaftcull::batch
