// SPDX-License-Identifier: MIT
/// Rays and view factors.
#include "shaftcull/view_factors.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "objects.hpp"
#include "shaftcull/rays.hpp"
#include "sights.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::Occluders;
using shaftcull::PatchPair;
using shaftcull::PatchSet;
using shaftcull::RayOptions;
using shaftcull::ViewFactorOptions;
using shaftcull::ViewFactors;

struct shaftcull_factor_matrix {
  ViewFactors all;
  std::vector<std::uint64_t> first{};  ///< of numbers that have 64 bits on every machine
};

namespace {

RayOptions as_ray_options(const shaftcull_ray_options* options) {
  if (options == nullptr) return {};
  require_zero(options->reserved, "options");
  return {.rays = options->rays, .error = options->error, .seed = options->seed, .tolerance = options->tolerance};
}

ViewFactorOptions as_factor_options(const shaftcull_view_factor_options* options) {
  ViewFactorOptions out;
  if (options == nullptr) return out;
  require_zero(options->reserved, "options");
  const std::uint64_t too = options->reserved_padding;
  require_zero({&too, 1}, "options");
  out.rays = options->rays;
  out.error = options->error;
  out.seed = options->seed;
  out.least = options->least;
  out.close_rows = as_bool(options->close_rows, "options.close_rows");
  out.tolerance = options->tolerance;
  out.part = options->part;
  out.parts = options->parts;
  out.memory = as_size(options->memory, "options.memory");
  if (options->progress != nullptr) out.progress = as_progress(options->progress, options->user);
  return out;
}

/// Undecided pairs as those of the C++ interface.
class Pairs {
 public:
  explicit Pairs(const shaftcull_undecided_pairs& given) {
    const auto pairs = as_span(given.pairs, given.count, "pairs.pairs");
    pairs_.reserve(pairs.size());
    for (const shaftcull_index_pair& pair : pairs) pairs_.push_back({pair.a, pair.b});
    if (given.first_candidate == nullptr) return;
    const auto firsts = as_span(given.first_candidate, std::uint64_t{pairs.size()} + 1, "pairs.first_candidate");
    first_candidate_.reserve(firsts.size());
    for (const std::uint64_t first : firsts) first_candidate_.push_back(as_size(first, "pairs.first_candidate"));
    candidates_ = as_span(given.candidates, first_candidate_.back(), "pairs.candidates");
  }

  [[nodiscard]] shaftcull::UndecidedPairs all() const noexcept { return {pairs_, first_candidate_, candidates_}; }

 private:
  std::vector<PatchPair> pairs_;
  std::vector<std::size_t> first_candidate_;
  std::span<const std::uint32_t> candidates_;
};

}  // namespace

extern "C" {

shaftcull_status shaftcull_visible_fractions(const shaftcull_patches* a, const shaftcull_patches* b,
                                             const shaftcull_occluders* occluders,
                                             const shaftcull_undecided_pairs* pairs,
                                             const shaftcull_ray_options* options, float* fractions) {
  return guarded([&] {
    const PatchSet& from = given(a, "a").set;
    const Occluders& all = given(occluders, "occluders").all;
    const shaftcull_undecided_pairs& asked = given(pairs, "pairs");
    const std::span<float> out = as_span(fractions, asked.count, "fractions");
    shaftcull::visible_fractions(from, b == nullptr ? from : b->set, all, Pairs(asked).all(), out,
                                 as_ray_options(options));
  });
}

shaftcull_status shaftcull_lit_fractions(const shaftcull_patches* patches, const shaftcull_occluders* occluders,
                                         const float* directions, uint64_t direction_count,
                                         const shaftcull_ray_options* options, float* fractions) {
  return guarded([&] {
    const PatchSet& set = given(patches, "patches").set;
    const Occluders& all = given(occluders, "occluders").all;
    const std::vector<shaftcull::Vec3> lights = as_vectors(directions, direction_count, "directions");
    const std::span<float> out = as_span(fractions, set.size() * lights.size(), "fractions");
    shaftcull::lit_fractions(set, all, lights, out, as_ray_options(options));
  });
}

shaftcull_status shaftcull_view_factors(const shaftcull_patches* patches, const shaftcull_occluders* occluders,
                                        const shaftcull_view_factor_options* options,
                                        shaftcull_factor_matrix** matrix) {
  return guarded([&] {
    const PatchSet& set = given(patches, "patches").set;
    const Occluders& all = given(occluders, "occluders").all;
    shaftcull_factor_matrix*& out = given(matrix, "matrix");
    auto made = std::make_unique<shaftcull_factor_matrix>(
        shaftcull_factor_matrix{shaftcull::view_factors(set, all, as_factor_options(options))});
    made->first.assign(made->all.first.begin(), made->all.first.end());
    out = made.release();
  });
}

void shaftcull_factor_matrix_free(shaftcull_factor_matrix* matrix) { delete matrix; }

shaftcull_status shaftcull_factor_matrix_describe(const shaftcull_factor_matrix* matrix,
                                                  shaftcull_factor_matrix_info* info) {
  return guarded([&] {
    const shaftcull_factor_matrix& made = given(matrix, "matrix");
    const ViewFactors& all = made.all;
    given(info, "info") = {all.size(),          all.factor.size(),      made.first.data(), all.column.data(),
                           all.factor.data(),   all.area.data(),        all.sum.data(),    all.error.data(),
                           all.left_out.data(), from_sights(all.counts)};
  });
}

}  // extern "C"
