// SPDX-License-Identifier: MIT
#include "batch/planned_shares.hpp"

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "batch/parallel.hpp"
#include "batch/share_tree.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::batch {
namespace {

constexpr std::uint64_t most_shares = 10'000;
constexpr std::uint64_t sampled_a_share = 4000;  ///< of the bounds, from whose middles shares are cut
constexpr std::uint64_t least_in_sample = 10'000;
constexpr std::size_t bounds_a_task = std::size_t{1} << 14;
constexpr std::uint64_t most_in_stretch = std::uint64_t{1} << 24;

/// How many bounds a share may have.
std::uint64_t room(BoundKind kind, std::uint64_t memory, bool several) {
  if (memory == 0) return most_bounds_a_share;
  return std::clamp<std::uint64_t>(memory / bytes_a_bound(kind, several), 1, most_bounds_a_share);
}

/// Some of the bounds, evenly from the first to the last.
std::vector<ShareKey> sample_of(const BoundsSource& bounds, std::uint64_t wanted) {
  std::vector<ShareKey> sample;
  std::vector<std::byte> scratch;
  for (std::uint64_t i = 0; i < bounds.size(); i += bounds.size() / wanted + 1) {
    sample.push_back({middle_of(bounds.box_around(bounds.read(i, 1, scratch).data())), i});
  }
  return sample;
}

/// How many bounds each share has, of those [first, first + count). Parallel.
std::vector<std::uint64_t> share_sizes(const BoundsSource& bounds, const SharePlan& cuts, std::uint64_t first,
                                       std::uint64_t count) {
  std::vector<std::uint64_t> sizes(cuts.shares());
  std::mutex mutex;
  const std::size_t columns = bounds.array().columns();
  bounds.for_pieces(first, count, [&](std::uint64_t at, const float* floats, std::size_t size) {
    for_chunks(size, bounds_a_task, [&](std::size_t begin, std::size_t some) {
      std::vector<std::uint64_t> here(sizes.size());
      for (std::size_t i = begin; i != begin + some; ++i) {
        ++here[cuts.share_of({middle_of(bounds.box_around(floats + i * columns)), at + i})];
      }
      const std::lock_guard lock(mutex);
      for (std::size_t s = 0; s != here.size(); ++s) sizes[s] += here[s];
    });
  });
  return sizes;
}

}  // namespace

PlannedShares plan_shares(const BoundsSource& bounds, std::uint64_t memory, Ranks& ranks,
                          const Surroundings& surroundings) {
  const std::uint64_t size = bounds.size();
  PlannedShares plan{{}, {size}, size};
  if (size <= room(bounds.kind(), memory, false)) return plan;
  const std::uint64_t most = room(bounds.kind(), memory, true);
  const std::uint64_t aimed_at = most - most / 16;  // a sample does not cut all bounds as it does itself
  std::uint64_t shares = (size + aimed_at - 1) / aimed_at;
  // Each rank counts its part of the bounds.
  const auto rank = static_cast<std::uint64_t>(ranks.rank());
  const auto parts = static_cast<std::uint64_t>(ranks.size());
  const std::uint64_t first = size / parts * rank + std::min(rank, size % parts);
  const std::uint64_t count = size / parts + (rank < size % parts ? 1 : 0);
  while (true) {
    on_all(ranks, [&] {
      // The sample is that of so many shares, whatever memory asked for them.
      std::vector<ShareKey> sample = sample_of(bounds, std::max(least_in_sample, shares * sampled_a_share));
      if (const std::uint64_t limit = std::min<std::uint64_t>(most_shares, sample.size()); shares > limit) {
        throw InvalidArgument(
            fmt::format("--memory: {} bounds would be divided into {} shares, more than {}; allow more memory", size,
                        shares, limit));
      }
      plan.cuts = SharePlan(std::move(sample), static_cast<std::size_t>(shares));
      surroundings.on_threads([&] { plan.sizes = share_sizes(bounds, plan.cuts, first, count); });
    });
    ranks.sum(plan.sizes);
    if (std::ranges::max(plan.sizes) <= most) break;
    shares += shares / 8 + 1;
  }
  plan.bounds_a_stretch = std::min(most_in_stretch, (size + shares - 1) / shares);
  return plan;
}

}  // namespace shaftcull::batch
