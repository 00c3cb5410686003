// SPDX-License-Identifier: MIT
/// Many shafts, checked, and the bounds in streams that they are tested against.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "compiled/shaft_data.hpp"
#include "flat/scan.hpp"
#include "kernels/kernel_table.hpp"
#include "query/bound_test.hpp"
#include "query/options.hpp"

namespace shaftcull::kernel {

/// Refers to all that it is made of.
class ShaftTests {
 public:
  /// Checked by who makes it. Of bounds with candidates, the streams hold the candidates themselves.
  ShaftTests(std::span<const ShaftData> shafts, const ScannedBounds& bounds, Question question, const Options& options,
             const Kernels& kernels) noexcept
      : shafts_(shafts),
        scanned_(bounds),
        options_(options),
        kernels_(kernels),
        test_(kernels, question, bounds.streams.kind, options.triangle_test()),
        question_(question) {}

  [[nodiscard]] std::span<const ShaftData> shafts() const noexcept { return shafts_; }
  [[nodiscard]] const BoundStreams& bounds() const noexcept { return scanned_.streams; }
  [[nodiscard]] std::size_t row_words() const noexcept { return bit_words(bounds().count); }
  [[nodiscard]] const Kernels& kernels() const noexcept { return kernels_; }
  [[nodiscard]] Question question() const noexcept { return question_; }

  /// The test of a shaft, without options.
  [[nodiscard]] const BoundTest& test() const noexcept { return test_; }
  [[nodiscard]] bool leaves_out() const noexcept { return options_.leave_out(); }
  /// The bounds that are left out for shaft s.
  [[nodiscard]] LeftOut left_out(std::size_t s) const noexcept { return {options_, s, scanned_, kernels_}; }

  /// Kept bits of shaft s, of `count` bounds from bound `first` on, a multiple of 64.
  void test_tile(std::size_t s, std::size_t first, std::size_t count, std::uint64_t* kept) const noexcept {
    const BoundSlice tile = bounds().slice(first, count);
    test_(shafts_[s], tile.stream, count, kept, nullptr);
    if (leaves_out()) left_out(s).clear(first, count, kept);
  }

 private:
  std::span<const ShaftData> shafts_;
  const ScannedBounds& scanned_;
  const Options& options_;
  const Kernels& kernels_;
  BoundTest test_;
  Question question_;
};

}  // namespace shaftcull::kernel
