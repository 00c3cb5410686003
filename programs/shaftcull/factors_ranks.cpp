// SPDX-License-Identifier: MIT
#include "factors_ranks.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "batch/checksum.hpp"
#include "factors_joiner.hpp"
#include "output_file.hpp"
#include "part_count.hpp"
#include "peak_memory.hpp"
#include "ranked_parts.hpp"
#include "ranked_run.hpp"
#include "scene_checksum.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// The factors of one part of all pairs, as stored: only rows that have factors or an error.
struct FactorsOfPart {
  std::vector<std::uint32_t> row;
  std::vector<std::uint64_t> end;  ///< of the factors of each row
  std::vector<std::uint32_t> column;
  std::vector<double> factor;
  std::vector<double> sums;  ///< of each row: sum, error, left out
  std::vector<double> area;  ///< of all patches, in the first part only
  std::vector<std::uint64_t> counts;

  /// As batch::BlockStore wants them.
  template <class Self>
  [[nodiscard]] static auto arrays(Self& self) {
    return std::tie(self.row, self.end, self.column, self.factor, self.sums, self.area, self.counts);
  }
};

FactorsOfPart kept_of(const ViewFactors& factors, bool is_first) {
  FactorsOfPart part;
  for (std::size_t i = 0; i != factors.size(); ++i) {
    const double sums[] = {factors.sum[i], factors.error[i], factors.left_out[i]};
    if (sums[0] == 0 && sums[1] == 0) continue;
    part.row.push_back(static_cast<std::uint32_t>(i));
    part.end.push_back(factors.first[i + 1]);
    part.sums.insert(part.sums.end(), std::begin(sums), std::end(sums));
  }
  part.column = factors.column;
  part.factor = factors.factor;
  if (is_first) part.area = factors.area;
  for (const Sight sight : {Sight::undecided, Sight::clear, Sight::occluded, Sight::facing_away}) {
    part.counts.push_back(factors.counts.of(sight));
  }
  return part;
}

ViewFactors factors_of(FactorsOfPart part, const std::vector<double>& area) {
  ViewFactors factors;
  factors.area = area;
  for (std::vector<double>* of_rows : {&factors.sum, &factors.error, &factors.left_out}) {
    of_rows->resize(area.size());
  }
  factors.first.reserve(area.size() + 1);
  for (std::size_t k = 0; k != part.row.size(); ++k) {
    const std::size_t i = part.row[k];
    factors.first.resize(i + 1, factors.first.back());
    factors.first.push_back(part.end[k]);
    factors.sum[i] = part.sums[3 * k];
    factors.error[i] = part.sums[3 * k + 1];
    factors.left_out[i] = part.sums[3 * k + 2];
  }
  factors.first.resize(area.size() + 1, factors.first.back());
  factors.column = std::move(part.column);
  factors.factor = std::move(part.factor);
  std::size_t next = 0;
  for (const Sight sight : {Sight::undecided, Sight::clear, Sight::occluded, Sight::facing_away}) {
    factors.counts.of(sight) = part.counts[next++];
  }
  return factors;
}

class RankedFactors {
 public:
  RankedFactors(const FactorsOptions& options, std::optional<FactorsResult> scene, batch::Ranks& ranks,
                const batch::Surroundings& surroundings)
      : options_(options),
        ranks_(ranks),
        surroundings_(surroundings),
        parts_("factors", folder_beside(options.out), ranks, surroundings),
        result_(std::move(scene)) {}

  void run() {
    batch::agree_on_version(ranks_, surroundings_.version);
    batch::on_all(ranks_, [&] {
      if (!result_) result_.emplace(factors_scene(options_));
    });
    ask_ = factors_question(options_, *result_);
    const std::size_t patches = result_->patches.size();
    ask_.parts = part_count(patches, parts_of_factors);
    ask_.close_rows = false;
    describe();
    batch::on_first(ranks_, [&] { parts_.open(description_); });
    parts_.begin(description_, ask_.parts, pair_count(patches));
    compute();
    batch::on_first(ranks_, [&] { join(); });
    auto threads = static_cast<std::uint64_t>(threads_);
    ranks_.sum({&threads, 1});
    batch::on_first(ranks_, [&] {
      result_->threads = static_cast<int>(threads);
      result_->ranks = ranks_.size();
      result_->seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
      result_->memory = peak_memory();
      write_factors(*result_, options_);
      parts_.remove();
    });
  }

 private:
  void describe() {
    const std::string scene = scene_checksum(result_->scene);
    const auto checksum = [](const auto& values) { return batch::checksum(std::as_bytes(std::span(values))); };
    batch::agree_on(ranks_, checksum(scene), fmt::format("{} has other patches than on rank 0", result_->source));
    description_ = {{"command", "factors"},
                    {"version", surroundings_.version},
                    {"scene", scene},
                    {"facets", fmt::format("{}, {:016x}", result_->patches.size(), checksum(result_->patches.corners))},
                    {"--rays", fmt::format("{}", ask_.rays)},
                    {"--error", fmt::format("{}", ask_.error)},
                    {"--min", fmt::format("{}", ask_.least)},
                    {"--seed", fmt::format("{}", ask_.seed)}};
    const std::string text = batch::text_of(description_) + options_.out;
    batch::agree_on(ranks_, checksum(text), "was started with other options than rank 0");
  }

  void compute() {
    const PatchSet patches(result_->patches.corners, result_->patches.first);
    surroundings_.on_threads([&] { threads_ = concurrency(); });
    const std::function<FactorsOfPart(std::size_t)> answer = [&](std::size_t part) {
      ViewFactorOptions ask = ask_;
      ask.part = static_cast<std::uint32_t>(part);
      return kept_of(view_factors(patches, result_->scene.occluders, ask), part == 0);
    };
    const std::function<void(std::size_t, const FactorsOfPart&)> note = [](std::size_t, const FactorsOfPart&) {};
    parts_.find_finished(note);
    parts_.compute(answer, note);
  }

  void join() {
    FactorsJoiner joiner;
    std::vector<double> area;
    for (std::size_t part = 0; part != ask_.parts; ++part) {
      FactorsOfPart some = parts_.stored<FactorsOfPart>(part);
      if (part == 0) area = some.area;
      joiner.add(factors_of(std::move(some), area));
    }
    surroundings_.on_threads([&] { result_->factors = joiner.all(options_.ask.close_rows); });
  }

  const FactorsOptions& options_;
  batch::Ranks& ranks_;
  const batch::Surroundings& surroundings_;
  RankedParts parts_;
  Clock::time_point begin_ = Clock::now();
  std::optional<FactorsResult> result_;
  ViewFactorOptions ask_;
  batch::JobDescription description_;
  int threads_ = 0;
};

}  // namespace

bool can_find_factors_in_parts() noexcept { return true; }

void run_factors_in_parts(const FactorsOptions& options, std::optional<FactorsResult>&& scene) {
  const auto check = [&] {
    require_factor_files(options);
    if (options.out.empty()) {
      throw InvalidArgument(
          "factors: several processes need --out FILE, because finished parts are stored beside FILE");
    }
    require_file("--out", options.out);
    options.isa.select();
  };
  run_on_ranks(options.threads, check, [&](batch::Ranks& ranks, const batch::Surroundings& surroundings) {
    RankedFactors(options, std::move(scene), ranks, surroundings).run();
  });
}

}  // namespace shaftcull::cli
