// SPDX-License-Identifier: MIT
#include "program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <regex>
#include <sstream>
#include <system_error>

#include "file_path.hpp"

namespace shaftcull::test {

std::string program_path() {
  const char* path = std::getenv("SHAFTCULL_CLI");
  return path != nullptr ? path : SHAFTCULL_CLI;
}

std::string bytes_of_file(const std::string& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(cli::file_path(path), std::ios::binary).rdbuf();
  return bytes.str();
}

std::size_t files_in(const std::string& folder) {
  const std::filesystem::directory_iterator files(cli::file_path(folder));
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
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
  std::random_device random;
  do {
    folder_ = std::filesystem::temp_directory_path() / ("shaftcull-test-" + std::to_string(random()));
  } while (!std::filesystem::create_directory(folder_));
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(cli::file_path(folder_.string()), ignored);
}

std::string ScratchFolder::write(const std::string& name, std::string_view content) const {
  std::ofstream(cli::file_path(path(name)), std::ios::binary) << content;
  return path(name);
}

}  // namespace shaftcull::test
