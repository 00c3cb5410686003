// SPDX-License-Identifier: MIT
#include "batch/job_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "batch/written_file.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::batch {
namespace {

JobDescription description_in(const std::string& text) {
  JobDescription job;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t space = line.find(' ');
    job.emplace_back(line.substr(0, space), space == std::string::npos ? "" : line.substr(space + 1));
  }
  return job;
}

/// Whether a name in the folder is one that jobs give: of this class, of results, and of folders of blocks.
bool is_own(const std::string& name) {
  return name == "job" || name == "job.new" || name == "lock" || name == "result" || name == "result.h5" ||
         name == "bounds" || name == "trees" || name.starts_with("share-");
}

/// Throws InvalidArgument for a folder that holds anything, but no job.
void require_own(const std::string& folder) {
  if (std::filesystem::exists(folder + "/job")) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (is_own(name)) continue;
    throw InvalidArgument(
        fmt::format("{} holds {}, which is of no job: move it away, or choose another output file", folder, name));
  }
}

std::string value_in(const JobDescription& job, const std::string& name) {
  for (const auto& [key, value] : job) {
    if (key == name) return value;
  }
  return "nothing";
}

}  // namespace

std::string text_of(const JobDescription& job) {
  std::string text;
  for (const auto& [name, value] : job) text += fmt::format("{} {}\n", name, value);
  return text;
}

JobFolder::JobFolder(std::string path) : path_(std::move(path)) {}

JobFolder::~JobFolder() {
  if (lock_ >= 0) close(lock_);
}

void JobFolder::lock() {
  std::error_code error;
  std::filesystem::create_directory(path_, error);
  if (error) throw InvalidArgument(fmt::format("{}: cannot be made: {}", path_, error.message()));
  require_own(path_);
  lock_ = open((path_ + "/lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock_ < 0) throw InvalidArgument(fmt::format("{}/lock: cannot be made: {}", path_, std::strerror(errno)));
  if (flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    throw std::runtime_error(fmt::format("{}: another run is working on this job", path_));
  }
}

void JobFolder::begin(const JobDescription& job) {
  const std::string file = path_ + "/job";
  const std::string text = text_of(job);
  std::ifstream there(file, std::ios::binary);
  if (there) {
    std::ostringstream before;
    before << there.rdbuf();
    const JobDescription known = description_in(before.str());
    for (const auto& [name, value] : job) {
      if (const std::string was = value_in(known, name); was != value) {
        throw InvalidArgument(
            fmt::format("{} holds an unfinished job with other input: {} was {}, and is {} now; give its original "
                        "input, or remove {} to start over",
                        path_, name, was, value, path_));
      }
    }
    resumed_ = true;
    return;
  }
  {
    WrittenFile fresh(file + ".new", true);
    fresh.write_at(0, std::as_bytes(std::span(text)));
    fresh.sync();
    fresh.close();
  }
  rename_file(file + ".new", file);
}

void JobFolder::remove() noexcept {
  std::error_code ignored;
  std::vector<std::filesystem::path> own;
  for (auto entry = std::filesystem::directory_iterator(path_, ignored); !ignored && entry != end(entry);
       entry.increment(ignored)) {
    if (is_own(entry->path().filename().string())) own.push_back(entry->path());
  }
  for (const std::filesystem::path& path : own) std::filesystem::remove_all(path, ignored);
  std::filesystem::remove(path_, ignored);  // fails, and is to, if it holds anything else
  if (lock_ >= 0) close(std::exchange(lock_, -1));
}

}  // namespace shaftcull::batch
