// SPDX-License-Identifier: MIT
#include "output_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "file_path.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

constexpr std::size_t bytes_at_once = std::size_t{1} << 20;

[[noreturn]] void refuse_path(const std::string& path, int error) {
  throw InvalidArgument(refusal_to_write(path, std::strerror(error)));
}

[[noreturn]] void fail(const std::string& path, int error) {
  throw std::runtime_error(refusal_to_write(path, std::strerror(error)));
}

void write_bytes(std::FILE* file, std::string_view bytes, const std::string& path) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size()) fail(path, errno);
}

std::filesystem::path folder_of(const OutputPlace& place) {
  if (!place.is_stream) return place.path.has_parent_path() ? place.path.parent_path() : ".";
  std::error_code none;
  const std::filesystem::path temporary = std::filesystem::temp_directory_path(none);
  return none ? "." : temporary;
}

/// Calls make(name), which makes a file, with names until one is not taken yet.
template <class Make>
std::FILE* with_a_new_name(const std::filesystem::path& folder, const Make& make) {
  std::random_device random;
  std::FILE* file = nullptr;
  do {
    file = make(folder / fmt::format(".shaftcull-{:08x}.part", random()));
  } while (file == nullptr && errno == EEXIST);
  return file;
}

}  // namespace

std::string refusal_to_write(const std::string& path, const std::string& why) {
  return fmt::format("{} cannot be written: {}", path == "-" ? std::string("standard output") : path + ":", why);
}

void require_different_files(std::initializer_list<std::pair<const char*, const std::string&>> files,
                             std::span<const std::string> read) {
  for (auto one = files.begin(); one != files.end(); ++one) {
    for (const std::string& path : read) {
      if (one->second.empty() || is_stream(one->second) || path == "-") continue;
      std::error_code ignored;
      if (!std::filesystem::equivalent(file_path(one->second), file_path(path), ignored)) continue;
      throw InvalidArgument(fmt::format("{} {}: this file is also an input, and would be replaced; give another name",
                                        one->first, one->second));
    }
    for (auto other = one + 1; other != files.end(); ++other) {
      if (one->second.empty() || other->second.empty()) continue;
      if (one->second != other->second && !(is_standard_output(one->second) && is_standard_output(other->second)))
        continue;
      throw InvalidArgument(fmt::format("{} {} {} {}: one file cannot be both; give two files", one->first, one->second,
                                        other->first, other->second));
    }
  }
}

bool is_standard_output(const std::string& path) { return output_place(path).is_standard_output; }

bool is_stream(const std::string& path) { return output_place(path).is_stream; }

std::string file_behind(const std::string& path) { return file_name(output_place(path).path); }

OutputFile::OutputFile(std::string path)
    : path_(std::move(path)), place_(output_place(path_)), folder_(folder_of(place_)) {
  if (place_.is_stream) {
    file_.reset(open_stream(place_));
  } else {
    file_.reset(with_a_new_name(folder_, [&](const std::filesystem::path& name) {
      part_ = name;
      return create_part(name, place_);
    }));
  }
  begin();
}

OutputFile::OutputFile(std::string path, const std::string& part)
    : path_(std::move(path)), place_(output_place(path_)), folder_(folder_of(place_)), part_(file_path(part)) {
  remove_file(part_);
  file_.reset(create_part(part_, place_));
  begin();
}

void OutputFile::begin() {
  if (!file_) refuse_path(path_, errno);
}

OutputFile::~OutputFile() {
  file_.reset();  // where a file that is open cannot be removed
  if (!part_.empty()) remove_file(part_);
}

void OutputFile::write(std::string_view bytes) { write_bytes(file_.get(), bytes, path_); }

void OutputFile::finish() {
  int error = std::fflush(file_.get()) == 0 ? 0 : errno;
  if (std::fclose(file_.release()) != 0 && error == 0) error = errno;
  if (error == 0 && !part_.empty() && !replace_file(part_, place_)) error = errno;
  if (error != 0) fail(path_, error);
  part_.clear();
}

Spool::Spool(const OutputFile& whole) : path_(whole.path()) {
  file_.reset(with_a_new_name(whole.folder(), create_temporary));
  if (!file_) refuse_path(path_, errno);
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
