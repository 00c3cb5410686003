// SPDX-License-Identifier: MIT
#include "output_place.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

constexpr int most_links = 40;  ///< as many as Linux follows

/// The number of an open file, if that is what a path like /dev/fd/5 names. What such a path leads to may have no name.
std::optional<int> descriptor_of(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::path folder =
      std::filesystem::canonical(path.has_parent_path() ? path.parent_path() : std::filesystem::path("."), ignored);
  if (folder != "/dev/fd" && folder != fmt::format("/proc/{}/fd", getpid())) return std::nullopt;
  const std::string number = path.filename().string();
  int descriptor = -1;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), descriptor);
  if (error != std::errc() || end != number.data() + number.size() || descriptor < 0) return std::nullopt;
  return descriptor;
}

[[noreturn]] void refuse(const std::string& path, int error) {
  throw InvalidArgument(refusal_to_write(path, std::strerror(error)));
}

OutputPlace open_file(int descriptor) {
  return {.path = {},
          .descriptor = descriptor,
          .is_standard_output = descriptor == STDOUT_FILENO,
          .is_stream = true,
          .is_replaced = false,
          .rights = {}};
}

/// The same open file. Negative if there is none that can be written.
int duplicate(int descriptor) {
  const int flags = fcntl(descriptor, F_GETFL);
  if (flags < 0) return -1;
  if ((flags & O_ACCMODE) != O_RDONLY) return fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
  errno = EBADF;
  return -1;
}

int create(const std::filesystem::path& name, mode_t mode) {
  return open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
}

/// Gives a file the owner of another one, as far as that is allowed, and its permissions.
void take_after(int file, const FileRights& old) {
  mode_t mode = old.mode & 0777;
  if (fchown(file, old.owner, old.group) != 0 && fchown(file, static_cast<uid_t>(-1), old.group) != 0) {
    mode &= ~mode_t{070} | (mode & 07) << 3;  // another group may do what everyone may
  }
  static_cast<void>(fchmod(file, mode));  // some file systems know no permissions
}

/// The stream of an open file, which is closed if there can be none.
std::FILE* stream_of(int file, const char* mode) {
  std::FILE* const stream = file < 0 ? nullptr : fdopen(file, mode);
  if (stream == nullptr && file >= 0) {
    const int error = errno;
    close(file);
    errno = error;
  }
  return stream;
}

}  // namespace

OutputPlace output_place(const std::string& name) {
  if (name == "-") return open_file(STDOUT_FILENO);
  std::filesystem::path path = name;
  for (int links = 0;; ++links) {
    if (const std::optional<int> descriptor = descriptor_of(path)) return open_file(*descriptor);
    std::error_code is_no_link;
    const std::filesystem::path to = std::filesystem::read_symlink(path, is_no_link);
    if (is_no_link) break;
    if (links == most_links) refuse(name, ELOOP);
    path = path.parent_path() / to;
  }
  OutputPlace place{.path = path};
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) {
    if (errno != ENOENT) refuse(name, errno);
    return place;
  }
  if (S_ISDIR(status.st_mode)) throw InvalidArgument(refusal_to_write(name, "it is a directory"));
  place.is_stream = !S_ISREG(status.st_mode);
  if (place.is_stream) return place;
  if (faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0) refuse(name, errno);
  place.is_replaced = true;
  place.rights = {status.st_uid, status.st_gid, status.st_mode};
  return place;
}

std::FILE* open_stream(const OutputPlace& place) {
  std::signal(SIGPIPE, SIG_IGN);
  return stream_of(
      place.descriptor >= 0 ? duplicate(place.descriptor) : open(place.path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC),
      "wb");
}

std::FILE* create_part(const std::filesystem::path& name, const OutputPlace& place) {
  const int file = create(name, place.is_replaced ? 0600 : 0666);
  if (file >= 0 && place.is_replaced) take_after(file, place.rights);
  std::FILE* const stream = stream_of(file, "wb");
  if (stream == nullptr && file >= 0) remove_file(name);
  return stream;
}

std::FILE* create_temporary(const std::filesystem::path& name) {
  const int file = create(name, 0600);
  if (file >= 0) static_cast<void>(unlink(name.c_str()));
  return stream_of(file, "w+b");
}

bool replace_file(const std::filesystem::path& part, const OutputPlace& place) {
  return std::rename(part.c_str(), place.path.c_str()) == 0;
}

void remove_file(const std::filesystem::path& path) { static_cast<void>(unlink(path.c_str())); }

}  // namespace shaftcull::cli
