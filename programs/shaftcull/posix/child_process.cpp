// SPDX-License-Identifier: MIT
#include "child_process.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace shaftcull::cli {

bool run_child(std::vector<std::string> words, const ChildStreams& streams) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(streams.in), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(streams.out), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(streams.error), STDERR_FILENO);
  pid_t child = 0;
  const int failure = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw std::system_error(failure, std::generic_category());

  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::generic_category());
  }
  // Where posix_spawn() cannot tell in time that there is no such program, its child ends so (as under qemu).
  constexpr int was_not_found = 127;
  if (WIFEXITED(status) && WEXITSTATUS(status) == was_not_found) {
    throw std::system_error(ENOENT, std::generic_category());
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace shaftcull::cli
