// SPDX-License-Identifier: MIT
#include "shaftcull/visibility.hpp"

#include <algorithm>

#include "visibility/run.hpp"
#include "visibility/visibility_arguments.hpp"

namespace shaftcull {
namespace {

/// Runs a call of two sets, or of one with itself.
SightCounts run(const PatchSet& a, const PatchSet& b, bool is_of_one_set, const Occluders& occluders,
                const VisibilityOptions& options, const FunctionRef<void(const SightBatch&)>* deliver) {
  kernel::require_options(options);
  return kernel::run_visibility(a.tree(), b.tree(), is_of_one_set, occluders.data(), options, deliver);
}

Visibility collect(const PatchSet& a, const PatchSet& b, bool is_of_one_set, const Occluders& occluders,
                   const VisibilityOptions& options) {
  Visibility all;
  all.first_candidate.push_back(0);
  const auto append = [&](const SightBatch& batch) {
    const UndecidedPairs& undecided = batch.undecided;
    all.blocks.insert(all.blocks.end(), batch.blocks.begin(), batch.blocks.end());
    all.undecided.insert(all.undecided.end(), undecided.pairs.begin(), undecided.pairs.end());
    const std::size_t before = all.candidates.size();
    all.candidates.insert(all.candidates.end(), undecided.candidates.begin(), undecided.candidates.end());
    for (std::size_t i = 1; i < undecided.first_candidate.size(); ++i) {
      all.first_candidate.push_back(before + undecided.first_candidate[i]);
    }
  };
  const FunctionRef<void(const SightBatch&)> deliver = append;
  all.counts = run(a, b, is_of_one_set, occluders, options, &deliver);
  if (!options.candidates) all.first_candidate.clear();
  return all;
}

SightCounts write_bits(const PatchSet& a, const PatchSet& b, bool is_of_one_set, const Occluders& occluders,
                       Sight sight, std::span<std::uint64_t> bits, const VisibilityOptions& options) {
  if (sight > Sight::facing_away) kernel::refuse_sight("sight", sight);
  const std::size_t words = bit_words(b.size());
  kernel::require_rows(bits, a.size(), b.size());
  std::fill(bits.begin(), bits.end(), 0);
  const auto set = [&](std::size_t i, std::size_t j) { bits[i * words + j / 64] |= std::uint64_t{1} << j % 64; };
  const auto set_pair = [&](std::size_t i, std::size_t j) {
    set(i, j);
    if (is_of_one_set) set(j, i);
  };
  const auto write = [&](const SightBatch& batch) {
    for (const PairBlock& block : batch.blocks) {
      if (block.sight != sight) continue;
      for (const std::uint32_t i : a.order().subspan(block.a.first, block.a.count)) {
        for (const std::uint32_t j : b.order().subspan(block.b.first, block.b.count)) set_pair(i, j);
      }
    }
    if (sight != Sight::undecided) return;
    for (const PatchPair& pair : batch.undecided.pairs) set_pair(pair.a, pair.b);
  };
  VisibilityOptions without_candidates = options;
  without_candidates.candidates = options.candidates && options.resolve;
  const FunctionRef<void(const SightBatch&)> deliver = write;
  return run(a, b, is_of_one_set, occluders, without_candidates, &deliver);
}

}  // namespace

std::string_view name(Sight sight) noexcept {
  switch (sight) {
    case Sight::undecided:
      return "undecided";
    case Sight::clear:
      return "clear";
    case Sight::occluded:
      return "occluded";
    case Sight::facing_away:
      return "facing_away";
  }
  return "unknown";
}

Cancelled::~Cancelled() = default;

SightCounts count_visibility(const PatchSet& a, const PatchSet& b, const Occluders& occluders,
                             const VisibilityOptions& options) {
  return run(a, b, false, occluders, options, nullptr);
}
SightCounts count_visibility(const PatchSet& patches, const Occluders& occluders, const VisibilityOptions& options) {
  return run(patches, patches, true, occluders, options, nullptr);
}

SightCounts visibility(const PatchSet& a, const PatchSet& b, const Occluders& occluders,
                       FunctionRef<void(const SightBatch&)> deliver, const VisibilityOptions& options) {
  kernel::require_callback(deliver);
  return run(a, b, false, occluders, options, &deliver);
}
SightCounts visibility(const PatchSet& patches, const Occluders& occluders,
                       FunctionRef<void(const SightBatch&)> deliver, const VisibilityOptions& options) {
  kernel::require_callback(deliver);
  return run(patches, patches, true, occluders, options, &deliver);
}

Visibility collect_visibility(const PatchSet& a, const PatchSet& b, const Occluders& occluders,
                              const VisibilityOptions& options) {
  return collect(a, b, false, occluders, options);
}
Visibility collect_visibility(const PatchSet& patches, const Occluders& occluders, const VisibilityOptions& options) {
  return collect(patches, patches, true, occluders, options);
}

SightCounts visibility_bits(const PatchSet& a, const PatchSet& b, const Occluders& occluders, Sight sight,
                            std::span<std::uint64_t> bits, const VisibilityOptions& options) {
  return write_bits(a, b, false, occluders, sight, bits, options);
}
SightCounts visibility_bits(const PatchSet& patches, const Occluders& occluders, Sight sight,
                            std::span<std::uint64_t> bits, const VisibilityOptions& options) {
  return write_bits(patches, patches, true, occluders, sight, bits, options);
}

}  // namespace shaftcull
