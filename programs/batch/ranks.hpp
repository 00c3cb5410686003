// SPDX-License-Identifier: MIT
/// The processes that share a job.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

namespace shaftcull::batch {

/// Processes with the same program and the same command line, numbered from 0. Calls that say *all* return when all
/// ranks have made them. Only the thread that made the object may use it.
class Ranks {
 public:
  Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  virtual ~Ranks() = default;

  [[nodiscard]] virtual int rank() const = 0;
  [[nodiscard]] virtual int size() const = 0;

  /// All: numbers become their sums over the ranks.
  virtual void sum(std::span<std::uint64_t> numbers) = 0;

  /// All: there are so many counters, each 0. In place of those that there were.
  virtual void make_counters(std::size_t count) = 0;
  /// Adds to a counter, and returns what it was before. No other rank need do anything for it.
  virtual std::uint64_t add(std::size_t counter, std::uint64_t number) = 0;

  /// How many ranks are on this machine, this one among them, and whether this is the first of them.
  [[nodiscard]] virtual int ranks_here() const = 0;
  [[nodiscard]] virtual bool is_first_here() const = 0;
  /// All ranks of this machine: memory that they share, of so many bytes as the first of them says, from a multiple of
  /// 64 bytes on. Empty, for all of them, where the machine has no room for it. In place of what there was.
  [[nodiscard]] virtual std::span<std::byte> shared_memory(std::size_t bytes) = 0;
  /// All ranks of this machine: returns when all are here. What one has written to shared memory, others see then.
  virtual void meet_here() = 0;

  /// Lets calls of other ranks go on. To be called now and then while this rank computes on other threads.
  virtual void poll() = 0;

  /// Ends all ranks at once, whatever they do.
  [[noreturn]] virtual void abort(int code) = 0;

  /// All: returns when all are here.
  void meet() {
    std::uint64_t nothing = 0;
    sum({&nothing, 1});
  }

  /// Whether on_all() has failed, so that all ranks know of the exception under way.
  [[nodiscard]] bool have_failed() const noexcept { return failed_; }

 private:
  friend void on_all(Ranks& ranks, const std::function<void()>& work);
  bool failed_ = false;
};

/// One process that has all work to itself.
[[nodiscard]] std::unique_ptr<Ranks> one_rank();

/// The ranks that a launcher of MPI started; one_rank() where none did. Throws InvalidArgument if the launcher started
/// several and this program, or the way it was launched, knows nothing of the others.
[[nodiscard]] std::unique_ptr<Ranks> launched_ranks();

/// Whether this program was built with MPI.
[[nodiscard]] bool has_mpi() noexcept;

/// Another rank has failed, and tells why. This one ends without a word.
class OtherRankFailed : public std::runtime_error {
 public:
  explicit OtherRankFailed(int code) : std::runtime_error("another rank has failed"), code_(code) {}
  /// The exit code of all ranks.
  [[nodiscard]] int code() const noexcept { return code_; }

 private:
  int code_;
};

/// The run was asked to end by a signal, and has stored what was finished.
class Stopped : public std::runtime_error {
 public:
  Stopped(int signal, const std::string& what) : std::runtime_error(what), signal_(signal) {}
  [[nodiscard]] int signal() const noexcept { return signal_; }

 private:
  int signal_;
};

/// The exit code that an exception stands for: 2 for what the user gave, 128 + the signal for Stopped, 1 else.
[[nodiscard]] int exit_code_of(const std::exception_ptr& failure) noexcept;

/// All: does the work, and returns on all ranks if it went well on all. Otherwise throws on all: on the first rank
/// where it failed what the work threw, on the others OtherRankFailed with its code. `work` makes no calls of Ranks
/// that all have to make.
void on_all(Ranks& ranks, const std::function<void()>& work);

/// All: as on_all(), but only rank 0 does the work.
void on_first(Ranks& ranks, const std::function<void()>& work);

/// All: throws unless all ranks have the same number. Rank 0 throws InvalidArgument, "rank 3: " and then `what`.
void agree_on(Ranks& ranks, std::uint64_t number, const std::string& what);
/// All: likewise of versions of the program.
void agree_on_version(Ranks& ranks, const std::string& version);

}  // namespace shaftcull::batch
