// SPDX-License-Identifier: MIT
#include "output_place.hpp"

#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#include <windows.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <system_error>

#include "file_path.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

constexpr int standard_output = 1;

/// What GetLastError() says, in numbers of errno.
int last_error() {
  const std::error_code error(static_cast<int>(GetLastError()), std::system_category());
  const std::error_condition known = error.default_error_condition();
  return known.category() == std::generic_category() ? known.value() : EIO;
}

[[noreturn]] void refuse(const std::string& path, int error) {
  throw InvalidArgument(refusal_to_write(path, std::strerror(error)));
}

struct Close {
  void operator()(void* handle) const noexcept { CloseHandle(handle); }
};

/// The file behind all symbolic links.
std::filesystem::path behind_links(const std::filesystem::path& path, const std::string& name) {
  const std::unique_ptr<void, Close> file(CreateFileW(
      path.c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr, OPEN_EXISTING, 0, nullptr));
  if (file.get() == INVALID_HANDLE_VALUE) refuse(name, last_error());
  std::array<wchar_t, 32768> target{};  // as long as paths may be
  if (GetFinalPathNameByHandleW(file.get(), target.data(), static_cast<DWORD>(target.size()), 0) == 0) {
    refuse(name, last_error());
  }
  return target.data();
}

int create(const std::filesystem::path& name, int more) {
  return _wopen(name.c_str(), _O_RDWR | _O_CREAT | _O_EXCL | _O_BINARY | _O_NOINHERIT | more, _S_IREAD | _S_IWRITE);
}

/// The stream of an open file, which is closed if there can be none.
std::FILE* stream_of(int file, const char* mode) {
  std::FILE* const stream = file < 0 ? nullptr : _fdopen(file, mode);
  if (stream == nullptr && file >= 0) {
    const int error = errno;
    _close(file);
    errno = error;
  }
  return stream;
}

}  // namespace

OutputPlace output_place(const std::string& name) {
  if (name == "-") {
    return {.path = {},
            .descriptor = standard_output,
            .is_standard_output = true,
            .is_stream = true,
            .is_replaced = false,
            .rights = {}};
  }
  OutputPlace place{.path = file_path(name)};
  if (place.path.native().starts_with(L"\\\\.\\")) {  // NUL and other devices, named pipes
    place.is_stream = true;
    return place;
  }
  const DWORD attributes = GetFileAttributesW(place.path.c_str());
  if (attributes == INVALID_FILE_ATTRIBUTES) {
    if (const int error = last_error(); error != ENOENT) refuse(name, error);
    return place;
  }
  if ((attributes & FILE_ATTRIBUTE_DIRECTORY) != 0) {
    throw InvalidArgument(refusal_to_write(name, "it is a directory"));
  }
  if ((attributes & FILE_ATTRIBUTE_READONLY) != 0) refuse(name, EACCES);
  if ((attributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0) place.path = behind_links(place.path, name);
  place.is_replaced = true;
  return place;
}

std::FILE* open_stream(const OutputPlace& place) {
  return stream_of(
      place.descriptor >= 0 ? _dup(place.descriptor) : _wopen(place.path.c_str(), _O_WRONLY | _O_BINARY | _O_NOINHERIT),
      "wb");
}

std::FILE* create_part(const std::filesystem::path& name, const OutputPlace& /*place*/) {
  return stream_of(create(name, 0), "wb");
}

std::FILE* create_temporary(const std::filesystem::path& name) { return stream_of(create(name, _O_TEMPORARY), "w+b"); }

bool replace_file(const std::filesystem::path& part, const OutputPlace& place) {
  // ReplaceFileW() keeps rights and attributes of what it replaces. Not every file system has it, and that of wine 8
  // fails for paths of some lengths.
  const bool done =
      (place.is_replaced && ReplaceFileW(place.path.c_str(), part.c_str(), nullptr, 0, nullptr, nullptr) != 0) ||
      MoveFileExW(part.c_str(), place.path.c_str(), MOVEFILE_REPLACE_EXISTING) != 0;
  if (!done) errno = last_error();
  return done;
}

// std::filesystem asks for the status of a file before, and finds none where a path begins with "\\\\?\\".
void remove_file(const std::filesystem::path& path) { DeleteFileW(path.c_str()); }

}  // namespace shaftcull::cli
