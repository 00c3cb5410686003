// SPDX-License-Identifier: MIT
#include "program.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace shaftcull::test {
namespace {

std::string program_path() {
  const char* path = std::getenv("SHAFTCULL_CLI");
  return path != nullptr ? path : SHAFTCULL_CLI;
}

std::string quoted(const std::string& argument) {
  std::string text = "'";
  for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + '\'';
}

std::string content_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
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
  outcome.error = content_of(error_file);
  return outcome;
}

std::string output_of(const std::vector<std::string>& arguments) {
  const Outcome outcome = run_program(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  return outcome.out;
}

void expect_refusal(const Outcome& outcome) {
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(lines(outcome.error), testing::SizeIs(1)) << outcome.error;
  EXPECT_THAT(outcome.out, testing::IsEmpty());
}

std::string refusal_of(const std::vector<std::string>& arguments) {
  const Outcome outcome = run_program(arguments);
  expect_refusal(outcome);
  return outcome.error;
}

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::vector<std::string> lines(std::string_view text) {
  std::vector<std::string> result;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    result.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return result;
}

std::vector<std::string> words_after(const std::string& text, const std::string& begin) {
  for (const std::string& line : lines(text)) {
    if (!line.starts_with(begin)) continue;
    std::istringstream stream(line.substr(begin.size()));
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
  }
  ADD_FAILURE() << "no line starts with '" << begin << "' in\n" << text;
  return {"0", "0", "0", "0", "0", "0"};
}

std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  const std::regex number("-?[0-9.]+(e[-+]?[0-9]+)?");
  for (std::sregex_iterator at(text.begin(), text.end(), number), end; at != end; ++at) {
    numbers.push_back(std::stod(at->str()));
  }
  return numbers;
}

std::string attribute(const std::string& svg, const std::string& element, const std::string& name) {
  const std::size_t begin = svg.find(element);
  const std::size_t value = svg.find(' ' + name + "=\"", begin) + name.size() + 3;
  return svg.substr(value, svg.find('"', value) - value);
}

ScratchFolder::ScratchFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "shaftcull-test-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make a folder " + pattern);
  folder_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string ScratchFolder::write(const std::string& name, std::string_view content) const {
  std::ofstream(path(name), std::ios::binary) << content;
  return path(name);
}

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
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(folder_.path("out")), error_};
}

}  // namespace shaftcull::test
