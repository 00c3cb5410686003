// SPDX-License-Identifier: MIT
#include "output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <optional>
#include <random>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

constexpr std::size_t bytes_at_once = std::size_t{1} << 20;
constexpr int most_links = 40;  ///< as many as Linux follows

std::string refusal(const std::string& path, const char* why) {
  return fmt::format("{} cannot be written: {}", path == "-" ? std::string("standard output") : path + ":", why);
}

[[noreturn]] void refuse_path(const std::string& path, int error) {
  throw InvalidArgument(refusal(path, std::strerror(error)));
}

[[noreturn]] void fail(const std::string& path, int error) {
  throw std::runtime_error(refusal(path, std::strerror(error)));
}

void write_bytes(std::FILE* file, std::string_view bytes, const std::string& path) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size()) fail(path, errno);
}

/// What a path stands for.
struct Target {
  std::filesystem::path path;       ///< behind all symbolic links
  std::optional<int> descriptor;    ///< of a file that is open already
  std::optional<struct stat> file;  ///< the regular file that is to be replaced, if there is one
  bool is_stream = false;
};

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

/// Throws InvalidArgument for what can be neither written into nor replaced.
Target target_of(const std::string& name) {
  if (name == "-") return {{}, STDOUT_FILENO, {}, true};
  std::filesystem::path path = name;
  for (int links = 0;; ++links) {
    if (const std::optional<int> descriptor = descriptor_of(path)) return {{}, descriptor, {}, true};
    std::error_code is_no_link;
    const std::filesystem::path to = std::filesystem::read_symlink(path, is_no_link);
    if (is_no_link) break;
    if (links == most_links) refuse_path(name, ELOOP);
    path = path.parent_path() / to;
  }
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) {
    if (errno != ENOENT) refuse_path(name, errno);
    return {path, {}, {}, false};
  }
  if (S_ISDIR(status.st_mode)) throw InvalidArgument(refusal(name, "it is a directory"));
  if (!S_ISREG(status.st_mode)) return {path, {}, {}, true};
  if (faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) != 0) refuse_path(name, errno);
  return {path, {}, status, false};
}

std::string folder_of(const Target& target) {
  if (!target.is_stream) return target.path.has_parent_path() ? target.path.parent_path().string() : ".";
  std::error_code none;
  const std::filesystem::path temporary = std::filesystem::temp_directory_path(none);
  return none ? "." : temporary.string();
}

/// The same open file, to be closed by itself. Negative if there is none that can be written.
int duplicate(int descriptor) {
  const int flags = fcntl(descriptor, F_GETFL);
  if (flags < 0) return -1;
  if ((flags & O_ACCMODE) != O_RDONLY) return fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
  errno = EBADF;
  return -1;
}

/// Makes a file: nothing that is there is opened. Negative if it cannot.
int create_file(const std::string& name, mode_t mode) {
  return open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
}

/// Makes a file with a name of its own. Sets `name`. Negative if it cannot.
int make_file(const std::string& folder, mode_t mode, std::string& name) {
  std::random_device random;
  int file = -1;
  do {
    name = fmt::format("{}/.shaftcull-{:08x}.part", folder, random());
    file = create_file(name, mode);
  } while (file < 0 && errno == EEXIST);
  return file;
}

/// Gives a file the owner of another one, as far as that is allowed, and its permissions.
void take_after(int file, const struct stat& old) {
  mode_t mode = old.st_mode & 0777;
  if (fchown(file, old.st_uid, old.st_gid) != 0 && fchown(file, static_cast<uid_t>(-1), old.st_gid) != 0) {
    mode &= ~mode_t{070} | (mode & 07) << 3;  // another group may do what everyone may
  }
  static_cast<void>(fchmod(file, mode));  // some file systems know no permissions
}

}  // namespace

bool is_standard_output(const std::string& path) { return target_of(path).descriptor == STDOUT_FILENO; }

bool is_stream(const std::string& path) { return target_of(path).is_stream; }

std::string file_behind(const std::string& path) { return target_of(path).path.string(); }

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  const Target target = target_of(path_);
  folder_ = folder_of(target);
  int file = -1;
  if (target.is_stream) {
    std::signal(SIGPIPE, SIG_IGN);
    file =
        target.descriptor ? duplicate(*target.descriptor) : open(target.path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
  } else {
    final_ = target.path.string();
    file = make_file(folder_, target.file ? 0600 : 0666, part_);
    if (file >= 0 && target.file) take_after(file, *target.file);
  }
  begin(file);
}

OutputFile::OutputFile(std::string path, std::string part) : path_(std::move(path)), part_(std::move(part)) {
  const Target target = target_of(path_);
  folder_ = folder_of(target);
  final_ = target.path.string();
  static_cast<void>(unlink(part_.c_str()));
  const int file = create_file(part_, target.file ? 0600 : 0666);
  if (file >= 0 && target.file) take_after(file, *target.file);
  begin(file);
}

void OutputFile::begin(int file) {
  if (file >= 0) file_.reset(fdopen(file, "wb"));
  if (file_) return;
  const int error = errno;
  if (file >= 0) {
    close(file);
    if (!part_.empty()) static_cast<void>(unlink(part_.c_str()));
  }
  refuse_path(path_, error);
}

OutputFile::~OutputFile() {
  if (!part_.empty()) static_cast<void>(unlink(part_.c_str()));
}

void OutputFile::write(std::string_view bytes) { write_bytes(file_.get(), bytes, path_); }

void OutputFile::finish() {
  int error = std::fflush(file_.get()) == 0 ? 0 : errno;
  if (std::fclose(file_.release()) != 0 && error == 0) error = errno;
  if (error == 0 && !part_.empty() && std::rename(part_.c_str(), final_.c_str()) != 0) error = errno;
  if (error != 0) fail(path_, error);
  part_.clear();
}

Spool::Spool(const OutputFile& whole) : path_(whole.path()) {
  std::string name;
  const int file = make_file(whole.folder(), 0600, name);
  if (file < 0) refuse_path(path_, errno);
  static_cast<void>(unlink(name.c_str()));
  file_.reset(fdopen(file, "w+b"));
  if (!file_) {
    const int error = errno;
    close(file);
    refuse_path(path_, error);
  }
}

void Spool::write(std::string_view bytes) {
  write_bytes(file_.get(), bytes, path_);
  size_ += bytes.size();
}

void Spool::rewind() {
  if (std::fflush(file_.get()) != 0 || std::fseek(file_.get(), 0, SEEK_SET) != 0) fail(path_, errno);
  taken_ = 0;
}

std::string_view Spool::next() {
  buffer_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(bytes_at_once, size_ - taken_)));
  if (std::fread(buffer_.data(), 1, buffer_.size(), file_.get()) != buffer_.size()) fail(path_, errno);
  taken_ += buffer_.size();
  return buffer_;
}

}  // namespace shaftcull::cli
