// SPDX-License-Identifier: MIT
/// A phase of a job, in which pieces of work are dealt to ranks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
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

/// Pieces lie in piles. Whoever is free takes the next one of a pile; a rank says when it has finished one. A signal to
/// a rank, or a failure, ends the phase on all of them after the pieces that they are at.
class Dealing {
 public:
  /// All: begins a phase. Ends the one before.
  Dealing(Ranks& ranks, const Surroundings& surroundings, std::size_t piles);

  /// How many pieces of a pile were taken, and how many ranks wanted one since it is empty.
  [[nodiscard]] std::uint64_t taken(std::size_t pile) { return ranks_.add(pile, 0); }
  /// Takes the next piece: returns its position.
  [[nodiscard]] std::uint64_t take(std::size_t pile) { return ranks_.add(pile, 1); }
  /// One more is finished.
  void finish() { ranks_.add(piles_, 1); }
  /// How many are, of all piles and by all ranks.
  [[nodiscard]] std::uint64_t finished() { return ranks_.add(piles_, 0); }

  /// Whether the phase is to end.
  [[nodiscard]] bool must_stop();

  /// Does some work on the threads, while this one lets other ranks go on and calls meanwhile() again and again.
  void apart(const std::function<void()>& work, const std::function<void()>& meanwhile) const;

  /// All: `work` of each rank, which takes pieces. Throws as on_all() does; and Stopped with this text after a signal
  /// to any rank.
  void on_all_until_stopped(const std::function<void()>& work, const std::string& stopped);

 private:
  Ranks& ranks_;
  const Surroundings& surroundings_;
  std::size_t piles_;
};

}  // namespace shaftcull::batch
