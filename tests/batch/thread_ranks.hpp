// SPDX-License-Identifier: MIT
/// Ranks that are threads of one process, to test what ranks do together without a launcher.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "batch/ranks.hpp"

namespace shaftcull::test {

/// What the threads share.
class RankThreads {
 public:
  explicit RankThreads(int size) : size_(size) {}

  /// Runs `work(ranks)` in so many threads, each with its own ranks, and waits for all.
  void run(const std::function<void(batch::Ranks&)>& work) {
    std::vector<std::thread> threads;
    for (int rank = 0; rank != size_; ++rank) {
      threads.emplace_back([this, rank, &work] {
        One one(*this, rank);
        work(one);
      });
    }
    for (std::thread& thread : threads) thread.join();
  }

 private:
  class One : public batch::Ranks {
   public:
    One(RankThreads& all, int rank) : all_(all), rank_(rank) {}
    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int size() const override { return all_.size_; }
    void sum(std::span<std::uint64_t> numbers) override { all_.sum(numbers); }
    void make_counters(std::size_t count) override {
      all_.meet();
      if (rank_ == 0) all_.counters_.assign(count, 0);
      all_.meet();
    }
    std::uint64_t add(std::size_t counter, std::uint64_t number) override {
      const std::lock_guard lock(all_.mutex_);
      const std::uint64_t before = all_.counters_.at(counter);
      all_.counters_[counter] += number;
      return before;
    }
    [[nodiscard]] int ranks_here() const override { return all_.size_; }
    [[nodiscard]] bool is_first_here() const override { return rank_ == 0; }
    [[nodiscard]] std::span<std::byte> shared_memory(std::size_t bytes) override {
      return all_.shared_memory(rank_, bytes);
    }
    void meet_here() override { all_.meet(); }
    void poll() override {}
    [[noreturn]] void abort(int code) override { std::_Exit(code); }

   private:
    RankThreads& all_;
    int rank_;
  };

  /// Waits for all threads.
  void meet() {
    std::unique_lock lock(mutex_);
    const std::uint64_t round = round_;
    if (++here_ == size_) {
      here_ = 0;
      ++round_;
      all_here_.notify_all();
      return;
    }
    all_here_.wait(lock, [&] { return round_ != round; });
  }

  void sum(std::span<std::uint64_t> numbers) {
    {
      const std::lock_guard lock(mutex_);
      sums_.resize(numbers.size());
      for (std::size_t i = 0; i != numbers.size(); ++i) sums_[i] += numbers[i];
    }
    meet();
    {
      const std::lock_guard lock(mutex_);
      std::ranges::copy(sums_, numbers.begin());
    }
    meet();
    {
      const std::lock_guard lock(mutex_);
      sums_.clear();
    }
    meet();
  }

  std::span<std::byte> shared_memory(int rank, std::size_t bytes) {
    meet();
    if (rank == 0) shared_.assign(bytes / sizeof(Line), Line());
    meet();
    return std::as_writable_bytes(std::span(shared_));
  }

  struct alignas(64) Line {
    std::byte bytes[64];
  };

  int size_;
  std::mutex mutex_;
  std::condition_variable all_here_;
  int here_ = 0;
  std::uint64_t round_ = 0;
  std::vector<std::uint64_t> sums_;
  std::vector<std::uint64_t> counters_;
  std::vector<Line> shared_;
};

}  // namespace shaftcull::test
