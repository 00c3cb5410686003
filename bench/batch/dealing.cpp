// SPDX-License-Identifier: MIT
#include "batch/dealing.hpp"

#include <algorithm>
#include <chrono>
#include <future>
#include <vector>

namespace shaftcull::batch {
namespace {

constexpr auto pause_between_polls = std::chrono::milliseconds(1);

/// Counters behind those of the piles.
/// finish() and finished() know the first of them by its place.
enum OtherCounter : std::size_t { finished_counter, stop_counter, other_counters };
static_assert(finished_counter == 0);

}  // namespace

Dealing::Dealing(Ranks& ranks, const Surroundings& surroundings, std::size_t piles)
    : ranks_(ranks), surroundings_(surroundings), piles_(piles) {
  ranks.make_counters(piles + other_counters);
}

bool Dealing::must_stop() {
  const bool is_interrupted = surroundings_.interrupted() != 0;
  return ranks_.add(piles_ + stop_counter, is_interrupted ? 1 : 0) != 0 || is_interrupted;
}

void Dealing::apart(const std::function<void()>& work, const std::function<void()>& meanwhile) const {
  std::future<void> task = std::async(std::launch::async, [&] { surroundings_.on_threads(work); });
  while (task.wait_for(pause_between_polls) != std::future_status::ready) {
    ranks_.poll();
    meanwhile();
  }
  task.get();
}

void Dealing::on_all_until_stopped(const std::function<void()>& work, const std::string& stopped) {
  on_all(ranks_, [&] {
    try {
      work();
    } catch (...) {
      ranks_.add(piles_ + stop_counter, 1);
      throw;
    }
  });
  // A signal ends a rank's work as the end of work does: without an exception.
  std::vector<std::uint64_t> signals(static_cast<std::size_t>(ranks_.size()));
  signals[static_cast<std::size_t>(ranks_.rank())] = static_cast<std::uint64_t>(surroundings_.interrupted());
  ranks_.sum(signals);
  const std::uint64_t signal = std::ranges::max(signals);
  if (signal == 0) return;
  on_first(ranks_, [&] { throw Stopped(static_cast<int>(signal), stopped); });
}

}  // namespace shaftcull::batch
