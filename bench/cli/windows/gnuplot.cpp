// SPDX-License-Identifier: MIT
#include "report/gnuplot.hpp"

#include <io.h>
#include <process.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <random>
#include <stdexcept>

#include <fmt/format.h>

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
    for (std::size_t i = 0; i != size; ++i) {
      if (buffer[i] != '\r') text += buffer[i];  // lines end as on other systems
    }
  }
  return text;
}

/// While in scope, a standard stream is another file. Programs that are started meanwhile inherit it.
class Redirection {
 public:
  Redirection(std::FILE* stream, std::FILE* file) : stream_(_fileno(stream)), before_(_dup(stream_)) {
    std::fflush(stream);
    _dup2(_fileno(file), stream_);
  }
  Redirection(const Redirection&) = delete;
  Redirection& operator=(const Redirection&) = delete;
  ~Redirection() {
    _dup2(before_, stream_);
    _close(before_);
  }

 private:
  int stream_;
  int before_;
};

}  // namespace

std::string run_gnuplot(const std::string& script) {
  const File in = temporary_file();
  const File out = temporary_file();
  const File complaints = temporary_file();
  if (std::fwrite(script.data(), 1, script.size(), in.get()) != script.size() || std::fflush(in.get()) != 0) {
    throw std::runtime_error("a temporary file cannot be written");
  }
  std::rewind(in.get());

  constexpr std::array<const char*, 3> arguments{"gnuplot", "-d", nullptr};  // no settings of the user's
  std::intptr_t status = 0;
  int error = 0;
  {
    const Redirection input(stdin, in.get());
    const Redirection output(stdout, out.get());
    const Redirection errors(stderr, complaints.get());
    errno = 0;
    status = _spawnvp(_P_WAIT, arguments[0], arguments.data());
    error = errno;
  }
  if (status == -1 && (error == ENOENT || error == EACCES)) {
    throw InvalidArgument("there is no gnuplot to draw the plots with; install it or put it on the PATH");
  }
  if (status == -1 && error != 0) throw std::runtime_error(fmt::format("cannot run gnuplot: {}", std::strerror(error)));
  if (status != 0) throw std::runtime_error(fmt::format("gnuplot failed: {}", content_of(complaints.get())));
  return content_of(out.get());
}

}  // namespace shaftcull::cli
