// SPDX-License-Identifier: MIT
#include "running_program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <stdexcept>

namespace shaftcull::test {

RunningProgram::RunningProgram(const std::vector<std::string>& arguments) {
  std::string program = program_path();
  std::vector<std::string> words = arguments;
  std::vector<char*> argv{program.data()};
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("cannot make a pipe");
  error_pipe_ = ends[0];

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, folder_.path("out").c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  // Whoever runs the tests may ignore signals, as shells do for what they run in the background.
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGINT);
  sigaddset(&defaults, SIGTERM);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  const int failure = posix_spawn(&process_, program.c_str(), &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (failure != 0) throw std::runtime_error("cannot run " + program);
}

RunningProgram::~RunningProgram() {
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  close(error_pipe_);
}

bool RunningProgram::wait_for(std::string_view text) {
  while (error_.find(text) == std::string::npos) {
    if (!read_error()) return false;
  }
  return true;
}

bool RunningProgram::read_error() {
  std::array<char, 4096> buffer{};
  const ssize_t size = read(error_pipe_, buffer.data(), buffer.size());
  if (size <= 0) return false;
  error_.append(buffer.data(), static_cast<std::size_t>(size));
  return true;
}

void RunningProgram::send(int signal) const { kill(process_, signal); }

Outcome RunningProgram::finish() {
  while (read_error()) continue;
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, bytes_of_file(folder_.path("out")), error_};
}

}  // namespace shaftcull::test
