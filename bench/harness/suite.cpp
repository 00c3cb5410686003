// SPDX-License-Identifier: MIT
#include "harness/suite.hpp"

#include <utility>

#include "harness/threads.hpp"

namespace shaftcull::bench {
namespace {

constexpr int brief_repetitions = 3;
constexpr double brief_seconds = 0.05;

}  // namespace

void Suite::add(const std::string& name, const std::string& paper, std::function<void(benchmark::State&)> body,
                RunOptions options) {
  entries_.push_back({name, paper});
  const unsigned threads = options.threads;
  auto* const entry = benchmark::RegisterBenchmark(
      name.c_str(),
      [run = std::move(body), threads](benchmark::State& state) { run_on(threads, [&] { run(state); }); });
  if (options.wall_clock) entry->UseRealTime();
  if (options.once) entry->Repetitions(1)->Iterations(1);
  if (options.brief) entry->Repetitions(brief_repetitions)->MinTime(quick_ ? brief_seconds / 2 : brief_seconds);
}

void Suite::add_target(const std::string& measured, const std::string& against, double ratio) {
  targets_.push_back({measured, against, ratio, Target::Kind::speed_ratio});
}

void Suite::add_time_ratio_target(const std::string& measured, const std::string& against, double ratio) {
  targets_.push_back({measured, against, ratio, Target::Kind::time_ratio});
}

void Suite::add_time_target(const std::string& measured, double nanoseconds) {
  targets_.push_back({measured, {}, nanoseconds, Target::Kind::nanoseconds});
}

void Suite::limit(const std::string& path, const std::string& by, double units, const std::string& what) {
  limits_.push_back({path, by, units, what});
}

void Suite::note(const std::string& text) { notes_.push_back(text); }

}  // namespace shaftcull::bench
