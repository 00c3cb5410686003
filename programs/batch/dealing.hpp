// SPDX-License-Identifier: MIT
/// A phase of a job, in which pieces of work are dealt to ranks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <future>
#include <string>

#include "batch/ranks.hpp"
#include "shaftcull/version.hpp"

namespace shaftcull::batch {

/// What a run is given by its process.
struct Surroundings {
  std::function<void(const std::function<void()>&)> on_threads;  ///< does some work where it is parallel
  std::function<int()> interrupted;                              ///< the signal that asks the run to end, or 0
  std::string version = SHAFTCULL_VERSION_STRING;                ///< of the program; ranks must have the same
};

/// Pieces lie in piles. Whoever is free takes the next one of a pile. A signal to a rank, or a failure, ends the phase
/// on all of them after the pieces that they are at.
class Dealing {
 public:
  /// All: begins a phase. Ends the one before.
  Dealing(Ranks& ranks, const Surroundings& surroundings, std::size_t piles);

  /// What is left to do with a piece when its work is done: storing it. Empty if there is nothing.
  using Rest = std::function<void()>;

  /// How many pieces of a pile were taken, and how many ranks wanted one since it is empty.
  [[nodiscard]] std::uint64_t taken(std::size_t pile) { return ranks_.add(pile, 0); }
  /// How many pieces are finished, of all piles and by all ranks.
  [[nodiscard]] std::uint64_t finished() { return ranks_.add(piles_, 0); }

  /// Takes pieces 0 … `pieces` − 1 of a pile until none is left or the phase is to end. work(piece) is called on the
  /// threads, for one after the other, and before that prepare(piece) on this one, while others may be at work; what it
  /// returns is called on a thread of its own, during the work of the next piece, one at a time and in order. All that
  /// were begun are finished then. This thread lets other ranks go on, and calls meanwhile() again and again. Throws
  /// what any of them throws.
  void each(std::size_t pile, std::uint64_t pieces, const std::function<Rest(std::uint64_t piece)>& work,
            const std::function<void()>& meanwhile, const std::function<void(std::uint64_t piece)>& prepare = {});

  /// Whether the phase is to end.
  [[nodiscard]] bool must_stop();

  /// All: `work` of each rank, which takes pieces. Throws as on_all() does; and Stopped with this text after a signal
  /// to any rank.
  void on_all_until_stopped(const std::function<void()>& work, const std::string& stopped);

 private:
  /// Until a task ends, lets other ranks go on and calls meanwhile().
  void wait_for(std::future<void>& task, const std::function<void()>& meanwhile) const;

  Ranks& ranks_;
  const Surroundings& surroundings_;
  std::size_t piles_;
};

}  // namespace shaftcull::batch
