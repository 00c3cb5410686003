// SPDX-License-Identifier: MIT
#include "batch/work_log.hpp"

#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include "shaftcull/error.hpp"

namespace shaftcull::batch {

WorkLog::WorkLog(const std::string& path, int rank) {
  if (path.empty()) return;
  const std::string own = fmt::format("{}.{}", path, rank);
  file_.open(own);
  if (!file_) throw InvalidArgument(fmt::format("{}: cannot be made: {}", own, std::strerror(errno)));
  file_ << "what,share,block,begin,seconds\n";
}

void WorkLog::time(const char* what, std::uint64_t share, std::uint64_t block, const std::function<void()>& work) {
  const auto begin = Clock::now();
  work();
  if (!file_.is_open()) return;
  const std::chrono::duration<double> before = begin - begin_;
  const std::chrono::duration<double> taken = Clock::now() - begin;
  const std::lock_guard lock(mutex_);
  file_ << fmt::format("{},{},{},{:.6f},{:.6f}\n", what, share, block, before.count(), taken.count());
}

}  // namespace shaftcull::batch
