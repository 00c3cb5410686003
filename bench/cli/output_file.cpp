// SPDX-License-Identifier: MIT
#include "output_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

constexpr std::size_t bytes_at_once = std::size_t{1} << 20;

[[noreturn]] void refuse_path(const std::string& path) {
  throw InvalidArgument(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
}

[[noreturn]] void fail(const std::string& path) {
  throw std::runtime_error(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
}

void write_bytes(std::FILE* file, std::string_view bytes, const std::string& path) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size()) fail(path);
}

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)), part_(path_ + ".part") {
  std::error_code ignored;
  if (std::filesystem::is_directory(path_, ignored)) {
    throw InvalidArgument(fmt::format("{}: cannot be written: it is a directory", path_));
  }
  file_.reset(std::fopen(part_.c_str(), "wb"));
  if (!file_) refuse_path(path_);
}

OutputFile::~OutputFile() {
  if (file_) static_cast<void>(unlink(part_.c_str()));
}

void OutputFile::write(std::string_view bytes) { write_bytes(file_.get(), bytes, path_); }

void OutputFile::finish() {
  if (std::fflush(file_.get()) != 0 || std::rename(part_.c_str(), path_.c_str()) != 0) fail(path_);
  if (std::fclose(file_.release()) != 0) fail(path_);
}

Spool::Spool(const std::string& path) : path_(path) {
  std::string name = path + ".XXXXXX";
  const int file = mkstemp(name.data());
  if (file < 0) refuse_path(path);
  static_cast<void>(unlink(name.c_str()));
  file_.reset(fdopen(file, "w+b"));
  if (!file_) {
    close(file);
    refuse_path(path);
  }
}

void Spool::write(std::string_view bytes) {
  write_bytes(file_.get(), bytes, path_);
  size_ += bytes.size();
}

void Spool::rewind() {
  if (std::fflush(file_.get()) != 0 || std::fseek(file_.get(), 0, SEEK_SET) != 0) fail(path_);
  taken_ = 0;
}

std::string_view Spool::next() {
  buffer_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(bytes_at_once, size_ - taken_)));
  if (std::fread(buffer_.data(), 1, buffer_.size(), file_.get()) != buffer_.size()) fail(path_);
  taken_ += buffer_.size();
  return buffer_;
}

}  // namespace shaftcull::cli
