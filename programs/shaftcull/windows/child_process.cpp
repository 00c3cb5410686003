// SPDX-License-Identifier: MIT
#include "child_process.hpp"

#include <io.h>
#include <process.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

namespace shaftcull::cli {
namespace {

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

bool run_child(std::vector<std::string> words, const ChildStreams& streams) {
  std::vector<const char*> arguments;
  for (const std::string& word : words) arguments.push_back(word.c_str());
  arguments.push_back(nullptr);
  const Redirection input(stdin, streams.in);
  const Redirection output(stdout, streams.out);
  const Redirection errors(stderr, streams.error);
  errno = 0;
  const std::intptr_t status = _spawnvp(_P_WAIT, arguments[0], arguments.data());
  if (status == -1 && errno != 0) throw std::system_error(errno, std::generic_category());
  return status == 0;
}

}  // namespace shaftcull::cli
