// SPDX-License-Identifier: MIT
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <stdexcept>

#include "program.hpp"

namespace shaftcull::test {
namespace {

std::string quoted(const std::string& argument) {
  std::string text = "'";
  for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + '\'';
}

}  // namespace

Outcome run_program(const std::vector<std::string>& arguments, const std::string& environment,
                    const std::string& redirection) {
  const ScratchFolder scratch;
  const std::string error_file = scratch.write("stderr", "");
  std::string command = environment.empty() ? "" : environment + ' ';
  command += quoted(program_path());
  for (const std::string& argument : arguments) command += ' ' + quoted(argument);
  command += " 2>" + quoted(error_file) + " </dev/null " + redirection;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  Outcome outcome{};
  std::array<char, 4096> buffer{};
  for (std::size_t size = 0; (size = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    outcome.out.append(buffer.data(), size);
  }
  const int status = pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.error = bytes_of_file(error_file);
  return outcome;
}

}  // namespace shaftcull::test
