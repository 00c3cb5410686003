// SPDX-License-Identifier: MIT
#include "batch/ranks.hpp"

#include <cstdlib>
#include <exception>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "batch/checksum.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::batch {
namespace {

class OneRank : public Ranks {
 public:
  [[nodiscard]] int rank() const override { return 0; }
  [[nodiscard]] int size() const override { return 1; }
  void sum(std::span<std::uint64_t> /*numbers*/) override {}
  void make_counters(std::size_t count) override { counters_.assign(count, 0); }
  std::uint64_t add(std::size_t counter, std::uint64_t number) override {
    const std::uint64_t before = counters_[counter];
    counters_[counter] += number;
    return before;
  }
  [[nodiscard]] int ranks_here() const override { return 1; }
  [[nodiscard]] bool is_first_here() const override { return true; }
  [[nodiscard]] std::span<std::byte> shared_memory(std::size_t /*bytes*/) override { return {}; }
  void meet_here() override {}
  void poll() override {}
  [[noreturn]] void abort(int code) override { std::_Exit(code); }

 private:
  std::vector<std::uint64_t> counters_;
};

}  // namespace

std::unique_ptr<Ranks> one_rank() { return std::make_unique<OneRank>(); }

int exit_code_of(const std::exception_ptr& failure) noexcept {
  try {
    std::rethrow_exception(failure);
  } catch (const OtherRankFailed& other) {
    return other.code();
  } catch (const Stopped& stopped) {
    constexpr int exit_of_signal = 128;
    return exit_of_signal + stopped.signal();
  } catch (const std::invalid_argument&) {
    return 2;
  } catch (...) {
    return 1;
  }
}

void on_all(Ranks& ranks, const std::function<void()>& work) {
  std::exception_ptr failure;
  try {
    work();
  } catch (...) {
    failure = std::current_exception();
  }
  std::vector<std::uint64_t> codes(static_cast<std::size_t>(ranks.size()));
  const auto own = static_cast<std::size_t>(ranks.rank());
  if (failure) codes[own] = static_cast<std::uint64_t>(exit_code_of(failure));
  ranks.sum(codes);
  for (std::size_t rank = 0; rank != codes.size(); ++rank) {
    if (codes[rank] == 0) continue;
    ranks.failed_ = true;
    if (rank == own) std::rethrow_exception(failure);
    throw OtherRankFailed(static_cast<int>(codes[rank]));
  }
}

void on_first(Ranks& ranks, const std::function<void()>& work) {
  on_all(ranks, [&] {
    if (ranks.rank() == 0) work();
  });
}

void agree_on(Ranks& ranks, std::uint64_t number, const std::string& what) {
  std::vector<std::uint64_t> numbers(static_cast<std::size_t>(ranks.size()));
  numbers[static_cast<std::size_t>(ranks.rank())] = number;
  ranks.sum(numbers);
  on_first(ranks, [&] {
    for (std::size_t rank = 1; rank < numbers.size(); ++rank) {
      if (numbers[rank] != numbers[0]) throw InvalidArgument(fmt::format("rank {}: {}", rank, what));
    }
  });
}

void agree_on_version(Ranks& ranks, const std::string& version) {
  agree_on(ranks, checksum(std::as_bytes(std::span(version))),
           fmt::format("runs another version of this program than rank 0, which is {}", version));
}

}  // namespace shaftcull::batch
