// SPDX-License-Identifier: MIT
/// Answers of `shaftcull sees` as lines of text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sees_run.hpp"

namespace shaftcull::cli {

/// Throws InvalidArgument if a CSV file may not have all pairs of so many patches. The file is called `path`.
void require_pairs_for_csv(const std::string& path, std::uint64_t patches);
/// Throws InvalidArgument if candidates are wanted, which have no place in a CSV file.
void require_no_candidates(const std::string& path, const SightContent& content);

/// The line that a file begins with.
[[nodiscard]] std::string_view csv_heading(std::uint32_t rays);

/// Makes a line of each pair: two patches, what they see, and with rays how many arrive. `order` is that of the
/// patches. Pairs that are certain and pairs that are undecided go different ways: how they are mixed depends on how
/// much memory answers may take, and lines of a file must not.
class CsvLines final : public SightSink {
 public:
  using Write = std::function<void(std::string_view)>;

  /// Text of lines, some at a time.
  CsvLines(std::span<const std::uint32_t> order, std::uint32_t rays, Write certain, Write undecided)
      : order_(order), has_rays_(rays != 0), certain_(std::move(certain)), undecided_(std::move(undecided)) {}

  void take(const SightBatch& batch, std::span<const std::uint32_t> seen) override;
  void finish() override {}

 private:
  /// Hands the text on if it is longer than `most`.
  void write_out(const Write& write, std::size_t most);

  std::span<const std::uint32_t> order_;
  bool has_rays_;
  Write certain_;
  Write undecided_;
  std::string text_;
  std::string rests_;  ///< of lines of a block, one for each patch of its second run
  std::vector<std::size_t> rest_ends_;
};

/// How many bytes the lines have that CsvLines makes. Does not make them: a block takes as long as it has patches,
/// not pairs.
class CsvLength final : public SightSink {
 public:
  CsvLength(std::span<const std::uint32_t> order, std::uint32_t rays) : order_(order), has_rays_(rays != 0) {}

  void take(const SightBatch& batch, std::span<const std::uint32_t> seen) override;
  void finish() override {}

  [[nodiscard]] std::uint64_t certain() const noexcept { return certain_; }
  [[nodiscard]] std::uint64_t undecided() const noexcept { return undecided_; }

 private:
  std::span<const std::uint32_t> order_;
  bool has_rays_;
  std::uint64_t certain_ = 0;
  std::uint64_t undecided_ = 0;
};

}  // namespace shaftcull::cli
