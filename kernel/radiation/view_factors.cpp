// SPDX-License-Identifier: MIT
/// View factors of all pairs of a set.
#include "shaftcull/view_factors.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "parallel/parallel.hpp"
#include "radiation/factor_matrix.hpp"
#include "radiation/radiating_patch.hpp"
#include "support/elementary.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"
#include "support/threads.hpp"
#include "visibility/callers_modes.hpp"
#include "visibility/patch_outline.hpp"
#include "visibility/patch_tree.hpp"
#include "visibility/sight_rays.hpp"
#include "visibility/visibility_arguments.hpp"

namespace shaftcull {
namespace {

using kernel::Exchange;
using kernel::ExchangeLists;
using kernel::RadiatingPatch;

/// A patch, and all of a run: they are clear.
struct ClearRow {
  std::uint32_t patch;
  PatchRun run;
  std::size_t before;  ///< pairs of earlier rows
};

void require(const PatchSet& patches, const ViewFactorOptions& options) {
  kernel::require_rays(options.rays, options.error, options.tolerance);
  VisibilityOptions asked;
  asked.memory = options.memory;
  asked.part = options.part;
  asked.parts = options.parts;
  kernel::require_options(asked);
  if (!(options.least >= 0)) {
    kernel::fail(InvalidArgument("least is " + std::to_string(options.least) + "; it is 0 or more"));
  }
  if (options.close_rows && options.parts != 1) {
    kernel::fail(InvalidArgument("close_rows takes all pairs, and parts is " + std::to_string(options.parts) +
                                 "; in C++, join_view_factors() closes the rows of all parts"));
  }
  const kernel::PatchTree& tree = patches.tree();
  if (patches.size() == 0 || tree.has_planes()) return;
  kernel::fail(InvalidArgument(tree.has_both_sides()
                                   ? "patches are seen from both sides; a view factor is of one side: add each side as "
                                     "a patch of its own"
                                   : "patches have no planes; a view factor is of patches that face one side"));
}

/// By their indices.
kernel::RadiatingPatches radiating(const PatchSet& patches) {
  std::vector<std::size_t> place(patches.size());
  for (std::size_t p = 0; p != place.size(); ++p) place[patches.order()[p]] = p;
  kernel::RadiatingPatches all(place.size());
  for (const std::size_t p : place) all.add(kernel::outline_of(patches.tree(), p).all());
  return all;
}

/// One call.
class Exchanges {
 public:
  Exchanges(const PatchSet& patches, const Occluders& occluders, const ViewFactorOptions& options)
      : set_(patches),
        occluders_(occluders),
        options_(options),
        rays_(patches.tree(), patches.tree(), occluders.data(), options.tolerance, options.rays, options.seed),
        patches_(patches.tree().radiating_patches()->of([&] { return radiating(patches); })) {}

  /// Finds all of them, in no particular order. The user's callback runs in these modes.
  SightCounts find(const kernel::CallersModes& modes) {
    VisibilityOptions ask;
    ask.tolerance = options_.tolerance;
    ask.memory = options_.memory;
    ask.part = options_.part;
    ask.parts = options_.parts;
    if (options_.progress) {
      ask.progress = [&](const VisibilityProgress& now) { return modes([&] { return options_.progress(now); }); };
    }
    ask.resolve = [this](const UndecidedPairs& undecided, std::span<Sight>) { cast(undecided); };
    const SightCounts counts = visibility(
        set_, occluders_, [this](const SightBatch& batch) { take(batch.blocks); }, ask);
    integrate();
    return counts;
  }

  [[nodiscard]] std::span<const RadiatingPatch> patches() const noexcept { return patches_->all(); }
  [[nodiscard]] ExchangeLists exchanges() noexcept { return std::move(exchanges_); }

 private:
  /// Pairs that are worth a loop in parallel.
  static constexpr std::size_t most_waiting = std::size_t{1} << 17;

  [[nodiscard]] double unobstructed(PatchPair pair) const noexcept {
    return patches_->exchange_between(pair.a, pair.b);
  }

  void cast(const UndecidedPairs& undecided) {
    std::vector<Exchange> found;
    kernel::in_float_environment([&] {
      for (std::size_t i = 0; i != undecided.pairs.size(); ++i) {
        const PatchPair pair = undecided.pairs[i];
        const double most = unobstructed(pair);
        if (most == 0) continue;
        const double area_a = (*patches_)[pair.a].area;
        const double area_b = (*patches_)[pair.b].area;
        const double factor = most / std::min(area_a, area_b);
        const double mean_weight = kernel::pi * most / (area_a * area_b);
        const std::size_t first = undecided.first_candidate[i];
        kernel::RayWeights weights;
        const kernel::RayTally tally =
            rays_.cast(pair, undecided.candidates.subspan(first, undecided.first_candidate[i + 1] - first),
                       options_.rays, &weights, [&](const kernel::RayTally& so_far) {
                         const kernel::RayPrecision precision(so_far, weights, mean_weight);
                         return options_.error != 0 && factor * precision.expected_error() <= options_.error;
                       });
        const kernel::SeenShare seen(tally, weights, mean_weight);
        found.push_back({pair, most * seen.part, most * seen.error});
      }
    });
    const kernel::Lock lock(mutex_);
    exchanges_.push_back(std::move(found));
  }

  void take(std::span<const PairBlock> blocks) {
    for (const PairBlock& block : blocks) {
      if (block.sight != Sight::clear) continue;
      for (const std::uint32_t patch : set_.order().subspan(block.a.first, block.a.count)) {
        clear_.push_back({patch, block.b, waiting_});
        waiting_ += block.b.count;
        if (waiting_ >= most_waiting) kernel::in_float_environment([&] { integrate(); });
      }
    }
  }

  /// Integrates over clear pairs that wait.
  void integrate() {
    if (waiting_ == 0) return;
    std::vector<Exchange> found(waiting_);
    constexpr std::size_t chunk = 32;
    const auto fill = [&](std::size_t part, std::size_t) {
      for (std::size_t r = part * chunk; r != std::min((part + 1) * chunk, clear_.size()); ++r) {
        const ClearRow& row = clear_[r];
        Exchange* next = &found[row.before];
        for (const std::uint32_t other : set_.order().subspan(row.run.first, row.run.count)) {
          const PatchPair pair{row.patch, other};
          *next++ = {pair, unobstructed(pair), 0};
        }
      }
    };
    const auto fill_in_modes = [&](std::size_t part, std::size_t column) {
      kernel::in_float_environment([&] { fill(part, column); });
    };
    kernel::parallel_for((clear_.size() + chunk - 1) / chunk, 1, fill_in_modes);
    clear_.clear();
    waiting_ = 0;
    std::erase_if(found, [](const Exchange& exchange) { return exchange.area == 0; });
    const kernel::Lock lock(mutex_);
    exchanges_.push_back(std::move(found));
  }

  const PatchSet& set_;
  const Occluders& occluders_;
  const ViewFactorOptions& options_;
  kernel::SightRays rays_;
  kernel::MadeOnce<kernel::RadiatingPatches>::Shared patches_;
  std::vector<ClearRow> clear_;
  std::size_t waiting_ = 0;
  kernel::Mutex mutex_;
  ExchangeLists exchanges_;
};

}  // namespace

ViewFactors view_factors(const PatchSet& patches, const Occluders& occluders, const ViewFactorOptions& options) {
  const kernel::CallersModes modes;
  ViewFactors factors;
  kernel::in_float_environment([&] {
    require(patches, options);
    if (patches.size() == 0) return;
    Exchanges exchanges(patches, occluders, options);
    factors.counts = exchanges.find(modes);
    for (const RadiatingPatch& patch : exchanges.patches()) factors.area.push_back(patch.area);
    kernel::fill_rows(factors, exchanges.exchanges(), options.least);
    if (options.close_rows) kernel::close_rows(factors);
  });
  return factors;
}

}  // namespace shaftcull
