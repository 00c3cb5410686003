// SPDX-License-Identifier: MIT
/// View factors of all pairs of a set.
#include "shaftcull/view_factors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "parallel/parallel.hpp"
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

using kernel::RadiatingPatch;

/// What two patches exchange.
struct Exchange {
  PatchPair pair;
  double area;  ///< A₁ F₁₂
  double error;
};

/// Some at a time, so that many are never copied.
using Found = std::vector<std::vector<Exchange>>;

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
  kernel::require_options(asked);
  if (!(options.least >= 0)) {
    kernel::fail(InvalidArgument("least is " + std::to_string(options.least) + "; it is 0 or more"));
  }
  const kernel::PatchTree& tree = patches.tree();
  if (patches.size() == 0 || tree.has_planes()) return;
  kernel::fail(InvalidArgument(tree.has_both_sides()
                                   ? "patches are seen from both sides; a view factor is of one side: add each side as "
                                     "a patch of its own"
                                   : "patches have no planes; a view factor is of patches that face one side"));
}

/// One call.
class Exchanges {
 public:
  Exchanges(const PatchSet& patches, const Occluders& occluders, const ViewFactorOptions& options)
      : set_(patches),
        occluders_(occluders),
        options_(options),
        rays_(patches.tree(), patches.tree(), occluders.data(), options.tolerance, options.rays, options.seed) {
    std::vector<std::size_t> place(patches.size());
    for (std::size_t p = 0; p != place.size(); ++p) place[patches.order()[p]] = p;
    patches_.reserve(place.size());
    for (const std::size_t p : place) patches_.add(kernel::outline_of(patches.tree(), p).all());
  }

  /// Finds all of them, in no particular order. The user's callback runs in these modes.
  SightCounts find(const kernel::CallersModes& modes) {
    VisibilityOptions ask;
    ask.tolerance = options_.tolerance;
    ask.memory = options_.memory;
    if (options_.progress) {
      ask.progress = [&](const VisibilityProgress& now) { return modes([&] { return options_.progress(now); }); };
    }
    ask.resolve = [this](const UndecidedPairs& undecided, std::span<Sight>) { cast(undecided); };
    const SightCounts counts = visibility(
        set_, occluders_, [this](const SightBatch& batch) { take(batch.blocks); }, ask);
    integrate();
    return counts;
  }

  [[nodiscard]] std::span<const RadiatingPatch> patches() const noexcept { return patches_.all(); }
  [[nodiscard]] Found exchanges() noexcept { return std::move(exchanges_); }

 private:
  /// Pairs that are worth a loop in parallel.
  static constexpr std::size_t most_waiting = std::size_t{1} << 17;

  [[nodiscard]] double unobstructed(PatchPair pair) const noexcept { return patches_.exchange_between(pair.a, pair.b); }

  void cast(const UndecidedPairs& undecided) {
    std::vector<Exchange> found;
    kernel::in_float_environment([&] {
      for (std::size_t i = 0; i != undecided.pairs.size(); ++i) {
        const PatchPair pair = undecided.pairs[i];
        const double most = unobstructed(pair);
        if (most == 0) continue;
        const double areas = patches_[pair.a].area * patches_[pair.b].area;
        const double factor = most / std::min(patches_[pair.a].area, patches_[pair.b].area);
        const double mean_weight = kernel::pi * most / areas;
        const std::size_t first = undecided.first_candidate[i];
        const kernel::RayTally tally = rays_.cast(
            pair, undecided.candidates.subspan(first, undecided.first_candidate[i + 1] - first), options_.rays,
            [&](const kernel::RayTally& so_far) {
              return options_.error != 0 && factor * kernel::SeenShare(so_far, mean_weight).error <= options_.error;
            });
        const kernel::SeenShare seen(tally, mean_weight);
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
  kernel::RadiatingPatches patches_;
  std::vector<ClearRow> clear_;
  std::size_t waiting_ = 0;
  kernel::Mutex mutex_;
  Found exchanges_;
};

/// A factor in a row.
struct Cell {
  std::uint32_t column;
  float error;  ///< its sign says whether the factor is left out
  double factor;
};

/// Makes rows of what patches exchange: columns ascend, so sums do not depend on the order in which pairs were found.
class Rows {
 public:
  /// Pairs neither of whose factors reaches `least` are left out.
  Rows(Found exchanges, std::span<const RadiatingPatch> patches, double least)
      : patches_(patches), end_(patches.size() + 1) {
    for (const std::vector<Exchange>& some : exchanges) {
      for (const Exchange& exchange : some) {
        ++end_[exchange.pair.a + 1];
        ++end_[exchange.pair.b + 1];
      }
    }
    for (std::size_t i = 1; i != end_.size(); ++i) end_[i] += end_[i - 1];
    cells_.resize(end_.back());
    // A row's place moves on to its end as it is filled.
    std::vector<std::size_t> next(end_.begin(), end_.end() - 1);
    for (std::vector<Exchange>& some : exchanges) {
      for (const auto& [pair, area, error] : some) {
        const bool is_left_out = area / std::min(patches[pair.a].area, patches[pair.b].area) < least;
        for (const auto& [row, column] : {std::pair{pair.a, pair.b}, std::pair{pair.b, pair.a}}) {
          const double own = patches[row].area;
          const auto error_of_factor = static_cast<float>(error / own);
          cells_[next[row]++] = {column, is_left_out ? -error_of_factor : error_of_factor, std::min(1.0, area / own)};
        }
      }
      some = {};
    }
  }

  void sort() {
    for_each_row([&](std::size_t i) {
      std::sort(row(i).begin(), row(i).end(), [](const Cell& p, const Cell& q) { return p.column < q.column; });
    });
  }

  /// Multiplies what patches i and j exchange by a number of i and one of j, so that rows that are not empty sum to 1.
  /// Throws InvalidArgument for a row that is far from it.
  void close() {
    constexpr double far = 0.1;
    constexpr double near = 1e-12;
    constexpr int most_steps = 1000;
    const std::size_t count = patches_.size();
    std::vector<double> scale(count, 1.0);
    std::vector<double> next(count);
    std::vector<double> sum(count);
    for (int step = 0; step != most_steps; ++step) {
      for_each_row([&](std::size_t i) {
        double of_row = 0;
        for (const Cell& cell : row(i)) of_row += cell.factor * scale[cell.column];
        sum[i] = scale[i] * of_row;
        next[i] = sum[i] > 0 ? scale[i] / std::sqrt(sum[i]) : scale[i];
      });
      double worst = 0;
      for (std::size_t i = 0; i != count; ++i) {
        const double off = sum[i] > 0 ? std::fabs(sum[i] - 1) : 0;
        if (step == 0 && off > far) {
          kernel::fail(InvalidArgument("close_rows: the factors of patch " + std::to_string(i) + " sum to " +
                                       std::to_string(sum[i]) + "; only rows of an enclosure can be closed"));
        }
        worst = std::max(worst, off);
      }
      if (worst <= near) break;
      scale.swap(next);
    }
    for_each_row([&](std::size_t i) {
      for (Cell& cell : row(i)) cell.factor *= scale[i] * scale[cell.column];
    });
  }

  void fill(ViewFactors& factors) {
    const std::size_t count = patches_.size();
    std::vector<std::size_t> kept(count);
    for_each_row([&](std::size_t i) {
      double variance = 0;
      std::size_t next = 0;
      for (const Cell& cell : row(i)) {
        factors.sum[i] += cell.factor;
        variance += double{cell.error} * cell.error;
        if (cell.factor == 0) continue;  // rays found nothing, as far as they can tell
        if (std::signbit(cell.error)) {
          factors.left_out[i] += cell.factor;
        } else {
          row(i)[next++] = cell;
        }
      }
      factors.error[i] = std::sqrt(variance);
      kept[i] = next;
    });
    factors.first.reserve(count + 1);
    for (const std::size_t n : kept) factors.first.push_back(factors.first.back() + n);
    factors.column.reserve(factors.first.back());
    factors.factor.reserve(factors.first.back());
    for (std::size_t i = 0; i != count; ++i) {
      for (const Cell& cell : row(i).first(kept[i])) {
        factors.column.push_back(cell.column);
        factors.factor.push_back(cell.factor);
      }
    }
  }

 private:
  [[nodiscard]] std::span<Cell> row(std::size_t i) noexcept { return {cells_.data() + end_[i], end_[i + 1] - end_[i]}; }

  template <class Body>
  void for_each_row(const Body& body) {
    constexpr std::size_t chunk = 64;
    const std::size_t count = patches_.size();
    const auto some = [&](std::size_t part, std::size_t) {
      kernel::in_float_environment([&] {
        for (std::size_t i = part * chunk; i != std::min((part + 1) * chunk, count); ++i) body(i);
      });
    };
    kernel::parallel_for((count + chunk - 1) / chunk, 1, some);
  }

  std::span<const RadiatingPatch> patches_;
  std::vector<std::size_t> end_;  ///< of the row before each; then that of the last
  std::vector<Cell> cells_;
};

}  // namespace

double ViewFactors::operator()(std::size_t i, std::size_t j) const noexcept {
  const auto at = [&](std::size_t k) { return column.begin() + static_cast<std::ptrdiff_t>(k); };
  const auto found = std::lower_bound(at(first[i]), at(first[i + 1]), j);
  return found == at(first[i + 1]) || *found != j ? 0 : factor[static_cast<std::size_t>(found - column.begin())];
}

ViewFactors view_factors(const PatchSet& patches, const Occluders& occluders, const ViewFactorOptions& options) {
  const kernel::CallersModes modes;
  ViewFactors factors;
  kernel::in_float_environment([&] {
    require(patches, options);
    if (patches.size() == 0) return;
    Exchanges exchanges(patches, occluders, options);
    factors.counts = exchanges.find(modes);
    for (const RadiatingPatch& patch : exchanges.patches()) factors.area.push_back(patch.area);
    for (std::vector<double>* of_rows : {&factors.sum, &factors.error, &factors.left_out}) {
      of_rows->resize(patches.size());
    }
    Rows rows(exchanges.exchanges(), exchanges.patches(), options.least);
    rows.sort();
    if (options.close_rows) rows.close();
    rows.fill(factors);
  });
  return factors;
}

}  // namespace shaftcull
