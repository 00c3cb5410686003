// SPDX-License-Identifier: MIT
#include "report/gnuplot.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

struct Close {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

/// A file without a name: unlike two pipes, two files cannot block each other.
File temporary_file() {
  File file(std::tmpfile());
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

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(in.get()), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(out.get()), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(complaints.get()), STDERR_FILENO);
  std::array<char, 8> name{"gnuplot"};
  std::array<char, 3> from_input{"-d"};  // no settings of the user's
  const std::array<char*, 3> arguments{name.data(), from_input.data(), nullptr};
  pid_t child = 0;
  const int failure = posix_spawnp(&child, name.data(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure == ENOENT || failure == EACCES) {
    throw InvalidArgument(
        "there is no gnuplot to draw the plots with; install it (Debian: gnuplot-nox) or put it on the PATH");
  }
  if (failure != 0) throw std::runtime_error(fmt::format("cannot run gnuplot: {}", std::strerror(failure)));

  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw std::runtime_error(fmt::format("lost sight of gnuplot: {}", std::strerror(errno)));
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error(fmt::format("gnuplot failed: {}", content_of(complaints.get())));
  }
  return content_of(out.get());
}

}  // namespace shaftcull::cli
