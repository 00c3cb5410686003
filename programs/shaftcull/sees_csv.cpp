// SPDX-License-Identifier: MIT
#include "sees_csv.hpp"

#include <iterator>

#include <fmt/format.h>

#include "shaftcull/error.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

constexpr std::uint64_t most_csv_pairs = 100'000'000;
constexpr std::size_t text_at_once = std::size_t{1} << 20;

std::uint64_t digits_of(std::uint32_t number) {
  std::uint64_t digits = 1;
  for (; number >= 10; number /= 10) ++digits;
  return digits;
}

}  // namespace

void require_pairs_for_csv(const std::string& path, std::uint64_t patches) {
  const std::uint64_t pairs = patches == 0 ? 0 : patches * (patches - 1) / 2;
  if (pairs <= most_csv_pairs) return;
  throw InvalidArgument(fmt::format(
      "--out {}: there are {} pairs, but a CSV file may have at most {}; give an .npz file, or larger patches", path,
      grouped(pairs), grouped(most_csv_pairs)));
}

void require_no_candidates(const std::string& path, const SightContent& content) {
  if (!content.candidates) return;
  throw InvalidArgument(fmt::format("--out {} --candidates: a CSV file has no candidates; give an .npz file", path));
}

std::string_view csv_heading(std::uint32_t rays) { return rays != 0 ? "a,b,sight,seen\n" : "a,b,sight\n"; }

void CsvLines::take(const SightBatch& batch, std::span<const std::uint32_t> seen) {
  for (const PairBlock& block : batch.blocks) {
    // What follows the first patch of a line is the same for each of them.
    rests_.clear();
    rest_ends_.clear();
    for (const std::uint32_t b : order_.subspan(block.b.first, block.b.count)) {
      fmt::format_to(std::back_inserter(rests_), ",{},{}{}\n", b, name(block.sight), has_rays_ ? "," : "");
      rest_ends_.push_back(rests_.size());
    }
    for (const std::uint32_t a : order_.subspan(block.a.first, block.a.count)) {
      const fmt::format_int digits(a);
      std::size_t begin = 0;
      for (const std::size_t end : rest_ends_) {
        text_.append(digits.data(), digits.size());
        text_.append(rests_, begin, end - begin);
        begin = end;
      }
      write_out(certain_, text_at_once);
    }
  }
  write_out(certain_, 0);
  for (std::size_t i = 0; i < batch.undecided.pairs.size(); ++i) {
    const PatchPair& pair = batch.undecided.pairs[i];
    fmt::format_to(std::back_inserter(text_), "{},{},{}", pair.a, pair.b, name(Sight::undecided));
    if (has_rays_) fmt::format_to(std::back_inserter(text_), ",{}", seen[i]);
    text_ += '\n';
    write_out(undecided_, text_at_once);
  }
  write_out(undecided_, 0);
}

void CsvLines::write_out(const Write& write, std::size_t most) {
  if (text_.size() <= most) return;
  write(text_);
  text_.clear();
}

void CsvLength::take(const SightBatch& batch, std::span<const std::uint32_t> seen) {
  const std::uint64_t separators = has_rays_ ? 4 : 3;  // of a line, its end among them
  const auto digits_in = [&](const PatchRun& run) {
    std::uint64_t digits = 0;
    for (const std::uint32_t patch : order_.subspan(run.first, run.count)) digits += digits_of(patch);
    return digits;
  };
  for (const PairBlock& block : batch.blocks) {
    const std::uint64_t lines = std::uint64_t{block.a.count} * block.b.count;
    certain_ += digits_in(block.a) * block.b.count + digits_in(block.b) * block.a.count +
                lines * (std::string_view(name(block.sight)).size() + separators);
  }
  const std::uint64_t rest = std::string_view(name(Sight::undecided)).size() + separators;
  for (std::size_t i = 0; i < batch.undecided.pairs.size(); ++i) {
    const PatchPair& pair = batch.undecided.pairs[i];
    undecided_ += digits_of(pair.a) + digits_of(pair.b) + rest + (has_rays_ ? digits_of(seen[i]) : 0);
  }
}

}  // namespace shaftcull::cli
