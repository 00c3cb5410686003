// SPDX-License-Identifier: MIT
#include "batch/dealing.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <future>
#include <utility>
#include <vector>

#include "batch/own_thread.hpp"

namespace shaftcull::batch {
namespace {

constexpr auto pause_between_polls = std::chrono::milliseconds(1);

/// Counters behind those of the piles.
/// finished() knows the first of them by its place.
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

void Dealing::wait_for(std::future<void>& task, const std::function<void()>& meanwhile) const {
  try {
    while (task.wait_for(pause_between_polls) != std::future_status::ready) {
      ranks_.poll();
      meanwhile();
    }
  } catch (...) {
    task.wait();  // it uses what the caller has
    throw;
  }
  task.get();
}

void Dealing::each(std::size_t pile, std::uint64_t pieces, const std::function<Rest(std::uint64_t)>& work,
                   const std::function<void()>& meanwhile, const std::function<void(std::uint64_t)>& prepare) {
  struct Begun {
    Rest rest;
    std::future<void> working;
  };
  std::deque<Begun> begun;  // outlives the threads
  OwnThread worker;
  OwnThread finisher;
  std::future<void> finishing;
  const auto finish = [&] {
    if (!finishing.valid()) return;
    wait_for(finishing, meanwhile);
    ranks_.add(piles_ + finished_counter, 1);
  };
  // A second piece waits for the first, so that the threads go on with it at once; not where so few are left that other
  // ranks would lack it.
  std::size_t most_begun = 2;
  const auto begin = [&] {
    const std::uint64_t piece = ranks_.add(pile, 1);
    if (piece + static_cast<std::uint64_t>(2 * ranks_.size()) >= pieces) most_begun = 1;
    if (piece >= pieces) return false;
    if (prepare) prepare(piece);
    Begun& here = begun.emplace_back();
    here.working =
        worker.start([this, &here, &work, piece] { surroundings_.on_threads([&] { here.rest = work(piece); }); });
    return true;
  };
  bool may_begin = true;
  while (true) {
    while (may_begin && begun.size() < most_begun) may_begin = !must_stop() && begin();
    if (begun.empty()) break;
    wait_for(begun.front().working, meanwhile);
    finish();
    finishing = finisher.start([rest = std::move(begun.front().rest)] {
      if (rest) rest();
    });
    begun.pop_front();
  }
  finish();
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
