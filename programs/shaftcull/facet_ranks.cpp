// SPDX-License-Identifier: MIT
#include "facet_ranks.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "facet_parts.hpp"
#include "factors_joiner.hpp"
#include "part_count.hpp"

namespace shaftcull::cli {
namespace {

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

class FactorsInParts {
 public:
  static constexpr const char* verb = "factors";
  using Part = FactorsOfPart;

  FactorsInParts(const FactorsOptions& options, std::optional<FactorsResult>&& scene)
      : options_(options), result_(std::move(scene)) {}

  [[nodiscard]] const FactorsOptions& options() const noexcept { return options_; }
  void check() const { require_factor_files(options_); }

  FacetResult& prepare() {
    if (!result_) result_.emplace(factors_scene(options_));
    patches_.emplace(result_->patches.corners, result_->patches.first);
    ask_ = factors_question(options_, *result_);
    ask_.parts = part_count(patches_->size(), parts_of_factors);
    ask_.close_rows = false;
    return *result_;
  }

  void describe(batch::JobDescription& description) const {
    description.emplace_back("--rays", fmt::format("{}", ask_.rays));
    description.emplace_back("--error", fmt::format("{}", ask_.error));
    description.emplace_back("--min", fmt::format("{}", ask_.least));
    description.emplace_back("--seed", fmt::format("{}", ask_.seed));
  }

  [[nodiscard]] std::size_t parts() const noexcept { return ask_.parts; }
  [[nodiscard]] std::uint64_t pairs() const noexcept { return pair_count(patches_->size()); }

  [[nodiscard]] Part answer(std::size_t part) const {
    ViewFactorOptions ask = ask_;
    ask.part = static_cast<std::uint32_t>(part);
    return kept_of(view_factors(*patches_, result_->scene.occluders, ask), part == 0);
  }

  void add(std::size_t part, Part some) {
    if (part == 0) area_ = some.area;
    joiner_.add(factors_of(std::move(some), area_));
  }
  void join() { result_->factors = joiner_.all(options_.ask.close_rows); }
  void write() const { write_factors(*result_, options_); }

 private:
  const FactorsOptions& options_;
  std::optional<FactorsResult> result_;
  std::optional<PatchSet> patches_;
  ViewFactorOptions ask_;
  FactorsJoiner joiner_;
  std::vector<double> area_;
};

/// The lit fractions of one part of all positions of the sun, as stored.
struct LitPart {
  std::vector<float> lit;

  template <class Self>
  [[nodiscard]] static auto arrays(Self& self) {
    return std::tie(self.lit);
  }
};

class SunInParts {
 public:
  static constexpr const char* verb = "sun";
  using Part = LitPart;

  SunInParts(const SunOptions& options, std::optional<SunResult>&& scene)
      : options_(options), result_(std::move(scene)) {}

  [[nodiscard]] const SunOptions& options() const noexcept { return options_; }
  void check() const { require_sun_files(options_); }

  FacetResult& prepare() {
    if (!result_) result_.emplace(sun_scene(options_));
    patches_.emplace(result_->patches.corners, result_->patches.first);
    return *result_;
  }

  void describe(batch::JobDescription& description) const {
    std::vector<double> positions;
    for (const auto& [towards, hours] : result_->positions) {
      positions.insert(positions.end(), {towards[0], towards[1], towards[2], hours});
    }
    description.emplace_back("positions",
                             fmt::format("{}, {:016x}", result_->positions.size(), checksum_of<double>(positions)));
    description.emplace_back("--rays", fmt::format("{}", options_.ask.rays));
    description.emplace_back("--error", fmt::format("{}", options_.ask.error));
    description.emplace_back("--seed", fmt::format("{}", options_.scene.seed));
  }

  [[nodiscard]] std::size_t parts() const noexcept { return sun_parts(*result_); }
  [[nodiscard]] std::uint64_t pairs() const noexcept { return patches_->size() * result_->positions.size(); }

  [[nodiscard]] Part answer(std::size_t part) const { return {lit_by(*result_, *patches_, part, options_)}; }
  void add(std::size_t part, const Part& some) { add_lit(*result_, part, some.lit, options_); }
  void join() const noexcept {}
  void write() const { write_sun(*result_, options_); }

 private:
  const SunOptions& options_;
  std::optional<SunResult> result_;
  std::optional<PatchSet> patches_;
};

}  // namespace

bool can_keep_parts() noexcept { return true; }

void run_factors_in_parts(const FactorsOptions& options, std::optional<FactorsResult>&& scene) {
  FactorsInParts job(options, std::move(scene));
  run_facet_parts(job);
}

void run_sun_in_parts(const SunOptions& options, std::optional<SunResult>&& scene) {
  SunInParts job(options, std::move(scene));
  run_facet_parts(job);
}

}  // namespace shaftcull::cli
