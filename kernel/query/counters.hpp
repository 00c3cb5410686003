// SPDX-License-Identifier: MIT
/// Results that are one value per shaft: how many bounds, and whether any. A counter sees what a scan or a walk finds.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kernels/kernel_table.hpp"
#include "shaftcull/results.hpp"

namespace shaftcull::kernel {

/// Words of bounds that a scan or a walk has found: of the bounds 64 · word[i] … 64 · word[i] + 63, kept[i] are kept
/// and inside[i] are inside, maybe none. `inside` is null for Question::kept and Question::blocking. `word` is null for
/// counters: they do not read where bounds are.
struct FoundWords {
  const std::uint32_t* word;
  const std::uint64_t* kept;
  const std::uint64_t* inside;
  std::size_t words;
};

// Each counter has
//   words(found)        takes words of bounds
//   range(first, size)  takes bounds that are all inside
//   result()            the value
// and may have
//   is_done()           whether the value is final: the scan or the walk ends there

/// Whether a scan or a walk may end before it has found everything.
template <class Visitor>
concept EndsEarly = requires(const Visitor& visitor) {
  visitor.is_done();
};

template <class Visitor>
[[nodiscard]] bool is_done(const Visitor& visitor) noexcept {
  if constexpr (EndsEarly<Visitor>) return visitor.is_done();
  return false;
}

/// Whether any bound is kept.
class Finder {
 public:
  void words(const FoundWords& found) noexcept {
    found_ = found_ || std::any_of(found.kept, found.kept + found.words, [](std::uint64_t word) { return word != 0; });
  }
  void range(std::size_t /*first*/, std::size_t size) noexcept { found_ |= size != 0; }
  [[nodiscard]] bool is_done() const noexcept { return found_; }
  [[nodiscard]] bool result() const noexcept { return found_; }

 private:
  bool found_ = false;
};

/// How many bounds are kept.
class Counter {
 public:
  explicit Counter(const Kernels& kernels) noexcept : count_bits_(kernels.set_bits.count) {}

  void words(const FoundWords& found) noexcept { count_ += count_bits_(found.kept, found.words); }
  void range(std::size_t /*first*/, std::size_t size) noexcept { count_ += size; }
  [[nodiscard]] std::size_t result() const noexcept { return count_; }

 private:
  decltype(SetBits::count) count_bits_;
  std::size_t count_ = 0;
};

/// How many bounds are kept, `limit` at most.
class LimitedCounter {
 public:
  LimitedCounter(const Kernels& kernels, std::size_t limit) noexcept : counter_(kernels), limit_(limit) {}

  void words(const FoundWords& found) noexcept { counter_.words(found); }
  void range(std::size_t first, std::size_t size) noexcept { counter_.range(first, size); }
  [[nodiscard]] bool is_done() const noexcept { return counter_.result() >= limit_; }
  [[nodiscard]] std::size_t result() const noexcept { return std::min(counter_.result(), limit_); }

 private:
  Counter counter_;
  std::size_t limit_;
};

/// How many bounds overlap, and how many are inside.
class ClassCounter {
 public:
  explicit ClassCounter(const Kernels& kernels) noexcept : count_bits_(kernels.set_bits.count) {}

  void words(const FoundWords& found) noexcept {
    const std::size_t inside = count_bits_(found.inside, found.words);
    counts_.overlap += count_bits_(found.kept, found.words) - inside;  // bounds that are inside are kept
    counts_.inside += inside;
  }
  void range(std::size_t /*first*/, std::size_t size) noexcept { counts_.inside += size; }
  [[nodiscard]] const KeptCounts& result() const noexcept { return counts_; }

 private:
  decltype(SetBits::count) count_bits_;
  KeptCounts counts_{};
};

}  // namespace shaftcull::kernel
