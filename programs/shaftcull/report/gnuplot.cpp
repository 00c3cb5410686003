// SPDX-License-Identifier: MIT
#include "report/gnuplot.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <random>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "child_process.hpp"
#include "output_place.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

struct Close {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

/// Unlike two pipes, two files cannot block each other.
File temporary_file() {
  std::random_device random;
  File file(create_temporary(std::filesystem::temp_directory_path() / fmt::format("shaftcull-{:08x}.part", random())));
  if (!file) throw std::runtime_error(fmt::format("cannot make a temporary file: {}", std::strerror(errno)));
  return file;
}

std::string content_of(std::FILE* file) {
  std::rewind(file);
  std::string text;
  std::array<char, 4096> buffer{};
  for (std::size_t size = 0; (size = std::fread(buffer.data(), 1, buffer.size(), file)) > 0;) {
    text.append(buffer.data(), size);
  }
  std::erase(text, '\r');  // of ends of lines on Windows
  return text;
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  const File in = temporary_file();
  const File out = temporary_file();
  const File complaints = temporary_file();
  if (std::fwrite(script.data(), 1, script.size(), in.get()) != script.size() || std::fflush(in.get()) != 0) {
    throw std::runtime_error("a temporary file cannot be written");
  }
  std::rewind(in.get());
  try {
    // -d: no settings of the user's.
    if (!run_child({"gnuplot", "-d"}, {in.get(), out.get(), complaints.get()})) {
      throw std::runtime_error(fmt::format("gnuplot failed: {}", content_of(complaints.get())));
    }
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::no_such_file_or_directory || error.code() == std::errc::permission_denied) {
      throw InvalidArgument(
          "there is no gnuplot to draw the plots with; install it (Debian: gnuplot-nox) or put it on the PATH");
    }
    throw std::runtime_error(fmt::format("cannot run gnuplot: {}", error.code().message()));
  }
  return content_of(out.get());
}

}  // namespace shaftcull::cli
