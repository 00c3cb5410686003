// SPDX-License-Identifier: MIT
/// Visibility: which pairs of patches see each other.
#include "shaftcull/visibility.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "shaftcull/geometry.hpp"
#include "sights.hpp"
#include "sources.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::Occluders;
using shaftcull::PairBlock;
using shaftcull::PatchPair;
using shaftcull::PatchSet;
using shaftcull::Sight;
using shaftcull::SightBatch;
using shaftcull::SightCounts;
using shaftcull::UndecidedPairs;
using shaftcull::VisibilityOptions;

struct shaftcull_visibility_result {
  std::vector<shaftcull_pair_block> blocks;
  std::vector<shaftcull_index_pair> pairs;
  std::vector<std::uint64_t> first_candidate;
  std::vector<std::uint32_t> candidates;
  bool has_candidates = false;
  shaftcull_sight_counts counts{};
};

namespace {

shaftcull_pair_block from_block(const PairBlock& block) noexcept {
  return {{block.a.first, block.a.count}, {block.b.first, block.b.count}, static_cast<shaftcull_sight>(block.sight)};
}

shaftcull_index_pair from_pair(const PatchPair& pair) noexcept { return {pair.a, pair.b}; }

/// Appends the same elements in C.
template <class Out, class In, class Convert>
void append(std::vector<Out>& out, std::span<const In> in, Convert&& convert) {
  out.resize(out.size() + in.size());
  std::transform(in.begin(), in.end(), out.end() - static_cast<std::ptrdiff_t>(in.size()), convert);
}

/// Undecided pairs in C's terms, in memory that is used again.
class UndecidedInC {
 public:
  [[nodiscard]] shaftcull_undecided_pairs of(const UndecidedPairs& undecided) {
    pairs_.clear();
    first_candidate_.clear();
    append(pairs_, undecided.pairs, from_pair);
    append(first_candidate_, undecided.first_candidate, [](std::size_t first) { return std::uint64_t{first}; });
    shaftcull_undecided_pairs out{};
    out.pairs = pairs_.data();
    out.count = pairs_.size();
    if (!first_candidate_.empty()) {
      out.first_candidate = first_candidate_.data();
      out.candidates = undecided.candidates.data();
    }
    return out;
  }

 private:
  std::vector<shaftcull_index_pair> pairs_;
  std::vector<std::uint64_t> first_candidate_;
};

constexpr const char* sight_enumerators =
    "SHAFTCULL_SIGHT_UNDECIDED, SHAFTCULL_SIGHT_CLEAR, SHAFTCULL_SIGHT_OCCLUDED and SHAFTCULL_SIGHT_FACING_AWAY";

[[noreturn]] void refuse_verdict(std::size_t i, unsigned verdict, const PatchPair& pair) {
  refuse("verdicts[" + std::to_string(i) + "] = " + std::to_string(verdict) + ", of patches " + std::to_string(pair.a) +
         " and " + std::to_string(pair.b) + ", is none of " + sight_enumerators);
}

/// Options as those of C++; callbacks that end the call fail with Stopped.
VisibilityOptions as_options(const shaftcull_visibility_options* options) {
  VisibilityOptions out;
  if (options == nullptr) return out;
  require_zero(options->reserved, "options");
  out.memory = as_size(options->memory, "options.memory");
  out.contact = as_contact(options->contact);
  out.solids_around_ends = as_bool(options->solids_around_ends, "options.solids_around_ends");
  out.candidates = as_bool(options->candidates, "options.candidates");
  out.tolerance = options->tolerance;
  out.part = options->part;
  out.parts = options->parts;
  if (options->resolve != nullptr) {
    out.resolve = [resolve = options->resolve, user = options->user](const UndecidedPairs& undecided,
                                                                     std::span<Sight> verdict) {
      UndecidedInC memory;  // many threads come here at once
      const shaftcull_undecided_pairs pairs = memory.of(undecided);
      std::vector<std::uint8_t> verdicts(verdict.size(), SHAFTCULL_SIGHT_UNDECIDED);
      go_on_if(resolve(&pairs, verdicts.data(), user));
      for (std::size_t i = 0; i != verdict.size(); ++i) {
        if (verdicts[i] > SHAFTCULL_SIGHT_FACING_AWAY) refuse_verdict(i, verdicts[i], undecided.pairs[i]);
        verdict[i] = static_cast<Sight>(verdicts[i]);
      }
    };
  }
  if (options->progress != nullptr) out.progress = as_progress(options->progress, options->user);
  return out;
}

/// Calls use(set) or use(set, set), as `b` is NULL or not.
template <class Use>
auto of_one_or_two(const shaftcull_patches* a, const shaftcull_patches* b, Use&& use) {
  const PatchSet& first = given(a, "a").set;
  return b == nullptr ? use(first) : use(first, b->set);
}

template <class Deliver>
SightCounts deliver_all(const shaftcull_patches* a, const shaftcull_patches* b, const Occluders& occluders,
                        const VisibilityOptions& options, const Deliver& deliver) {
  return of_one_or_two(
      a, b, [&](const auto&... sets) { return shaftcull::visibility(sets..., occluders, deliver, options); });
}

/// Adds the boxes of a source.
template <class Add>
void add_from(const shaftcull_source* source, std::uint64_t* first, Add&& add) {
  const BoxesInStreams boxes(source, "boxes");
  const std::size_t number = add(boxes.view());
  if (first != nullptr) *first = number;
}

/// Positions at which lists begin: one more than there are lists, or none.
std::vector<std::size_t> as_offsets(const std::uint64_t* offsets, std::uint64_t count, const char* name) {
  if (count == 0 && offsets == nullptr) return {};
  const std::span<const std::uint64_t> from =
      as_span(offsets, std::uint64_t{as_count(count, sizeof(*offsets), name)} + 1, name);
  std::vector<std::size_t> to(from.size());
  std::transform(from.begin(), from.end(), to.begin(), [name](std::uint64_t offset) { return as_size(offset, name); });
  return to;
}

template <class Add>
shaftcull_status add_corners(shaftcull_occluders* occluders, const float* corners, std::uint64_t corner_count,
                             const std::uint64_t* first_corner, std::uint64_t count, std::uint64_t* first,
                             Add&& add) noexcept {
  return guarded([&] {
    Occluders& all = given(occluders, "occluders").all;
    const auto points = as_vectors(corners, corner_count, "corners");
    const auto offsets = as_offsets(first_corner, count, "first_corner");
    if (offsets.empty() && !points.empty()) refuse("first_corner is NULL; it must say which corners belong together");
    const std::size_t number = offsets.empty() ? all.size() : add(all, points, offsets);
    if (first != nullptr) *first = number;
  });
}

/// Calls use(view) of the triangles that a source has.
template <class Use>
void use_triangles(const shaftcull_source* triangles, const Use& use) {
  const Source source = as_source(triangles, "triangles");
  const bool taken = use_source(
      source, [&]<class Records>(const Records& records) requires(
                  std::is_same_v<Records, shaftcull::TriangleView> ||
                  std::is_constructible_v<shaftcull::TriangleStream, const Records&>) {
        if constexpr (std::is_same_v<Records, shaftcull::TriangleView>) {
          use(records);
        } else {
          const shaftcull::TriangleStream packed(records);
          use(packed.view());
        }
      });
  if (!taken) refuse("triangles is a source of other bounds; this call takes triangles");
}

}  // namespace

extern "C" {

shaftcull_status shaftcull_patches_create(const shaftcull_source* boxes, const shaftcull_plane* planes,
                                          uint64_t plane_count, shaftcull_patches** patches) {
  return guarded([&] {
    shaftcull_patches*& out = given(patches, "patches");
    const BoxesInStreams all(boxes, "boxes");
    out = new shaftcull_patches{PatchSet(all.view(), as_planes(planes, plane_count, "planes"))};
  });
}

shaftcull_status shaftcull_patches_create_polygons(const float* corners, uint64_t corner_count,
                                                   const uint64_t* first_corner, uint64_t patch_count,
                                                   shaftcull_patch_sides sides, shaftcull_patches** patches) {
  return guarded([&] {
    shaftcull_patches*& out = given(patches, "patches");
    const auto points = as_vectors(corners, corner_count, "corners");
    const std::vector<std::size_t> offsets = as_offsets(first_corner, patch_count, "first_corner");
    if (offsets.empty() && !points.empty()) refuse("first_corner is NULL; it must say which corners belong together");
    out = new shaftcull_patches{PatchSet(points, offsets, as_patch_sides(sides))};
  });
}

void shaftcull_patches_free(shaftcull_patches* patches) { delete patches; }

shaftcull_status shaftcull_patches_describe(const shaftcull_patches* patches, shaftcull_patches_info* info) {
  return guarded([&] {
    const PatchSet& set = given(patches, "patches").set;
    given(info, "info") = {set.size(), first_of(set.order())};
  });
}

shaftcull_status shaftcull_occluders_create(shaftcull_occluders** occluders) {
  return guarded([&] {
    shaftcull_occluders*& out = given(occluders, "occluders");
    out = new shaftcull_occluders{};
  });
}

void shaftcull_occluders_free(shaftcull_occluders* occluders) { delete occluders; }

uint64_t shaftcull_occluders_count(const shaftcull_occluders* occluders) {
  return occluders == nullptr ? 0 : occluders->all.size();
}

shaftcull_status shaftcull_occluders_add_boxes(shaftcull_occluders* occluders, const shaftcull_source* boxes,
                                               uint64_t* first) {
  return guarded([&] {
    Occluders& all = given(occluders, "occluders").all;
    add_from(boxes, first, [&](const shaftcull::BoxView& view) { return all.add_boxes(view); });
  });
}

shaftcull_status shaftcull_occluders_add_solids(shaftcull_occluders* occluders, const shaftcull_source* boxes,
                                                uint64_t* first) {
  return guarded([&] {
    Occluders& all = given(occluders, "occluders").all;
    add_from(boxes, first, [&](const shaftcull::BoxView& view) { return all.add_solids(view); });
  });
}

shaftcull_status shaftcull_occluders_add_solid_hulls(shaftcull_occluders* occluders, const float* corners,
                                                     uint64_t corner_count, const uint64_t* first_corner,
                                                     uint64_t hull_count, uint64_t* first) {
  return add_corners(
      occluders, corners, corner_count, first_corner, hull_count, first,
      [](Occluders& all, const auto& points, const auto& offsets) { return all.add_solid_hulls(points, offsets); });
}

shaftcull_status shaftcull_occluders_add_polygons(shaftcull_occluders* occluders, const float* corners,
                                                  uint64_t corner_count, const uint64_t* first_corner,
                                                  uint64_t polygon_count, uint64_t* first) {
  return add_corners(
      occluders, corners, corner_count, first_corner, polygon_count, first,
      [](Occluders& all, const auto& points, const auto& offsets) { return all.add_polygons(points, offsets); });
}

shaftcull_status shaftcull_occluders_add_triangles(shaftcull_occluders* occluders, const shaftcull_source* triangles,
                                                   const uint64_t* first_triangle, uint64_t group_count,
                                                   uint64_t* first) {
  return guarded([&] {
    Occluders& all = given(occluders, "occluders").all;
    const std::vector<std::size_t> groups = as_offsets(first_triangle, group_count, "first_triangle");
    use_triangles(triangles, [&](const shaftcull::TriangleView& view) {
      const std::size_t number = all.add_triangles(view, groups);
      if (first != nullptr) *first = number;
    });
  });
}

shaftcull_status shaftcull_occluders_add_mesh(shaftcull_occluders* occluders, const shaftcull_source* triangles,
                                              float least_width, uint32_t bodies, const shaftcull_patches* a,
                                              const shaftcull_patches* b, shaftcull_found_solids* found,
                                              uint64_t* first) {
  return guarded([&] {
    Occluders& all = given(occluders, "occluders").all;
    shaftcull::SolidSearch search{.least_width = least_width, .bodies = as_bool(bodies, "bodies")};
    if (a != nullptr || b != nullptr) {
      search.region = shaftcull::joined(given(a, "a").set.box(), (b == nullptr ? a : b)->set.box());
    }
    use_triangles(triangles, [&](const shaftcull::TriangleView& view) {
      shaftcull::FoundSolids solids;
      const std::size_t number = all.add_mesh(view, search, &solids);
      if (first != nullptr) *first = number;
      if (found != nullptr) *found = {solids.hulls(), solids.polygons(), solids.inner_boxes.size()};
    });
  });
}

shaftcull_status shaftcull_occluders_describe(const shaftcull_occluders* occluders, uint64_t occluder,
                                              shaftcull_occluder_info* info) {
  return guarded([&] {
    const Occluders& all = given(occluders, "occluders").all;
    if (occluder >= all.size()) {
      refuse("occluder = " + std::to_string(occluder) + " is not below the number of occluders, " +
             std::to_string(all.size()));
    }
    const auto i = static_cast<std::size_t>(occluder);
    const std::span<const uint32_t> triangles = all.triangles(i);
    given(info, "info") = {first_of(triangles), triangles.size(), converted<shaftcull_box>(all.box(i))};
  });
}

shaftcull_status shaftcull_visibility(const shaftcull_patches* a, const shaftcull_patches* b,
                                      const shaftcull_occluders* occluders, const shaftcull_visibility_options* options,
                                      shaftcull_sight_callback callback, void* user, shaftcull_sight_counts* counts) {
  return guarded([&] {
    const Occluders& all = given(occluders, "occluders").all;
    const VisibilityOptions with = as_options(options);
    if (callback == nullptr) {
      shaftcull_sight_counts& out = given(counts, "counts");
      out = from_sights(
          of_one_or_two(a, b, [&](const auto&... sets) { return shaftcull::count_visibility(sets..., all, with); }));
      return;
    }
    std::vector<shaftcull_pair_block> blocks;
    UndecidedInC undecided;
    const SightCounts found = deliver_all(a, b, all, with, [&](const SightBatch& answers) {
      blocks.clear();
      append(blocks, answers.blocks, from_block);
      const shaftcull_sight_batch batch{blocks.data(), blocks.size(), undecided.of(answers.undecided)};
      go_on_if(callback(&batch, user));
    });
    if (counts != nullptr) *counts = from_sights(found);
  });
}

shaftcull_status shaftcull_collect_visibility(const shaftcull_patches* a, const shaftcull_patches* b,
                                              const shaftcull_occluders* occluders,
                                              const shaftcull_visibility_options* options,
                                              shaftcull_visibility_result** result) {
  return guarded([&] {
    const Occluders& all = given(occluders, "occluders").all;
    const VisibilityOptions with = as_options(options);
    shaftcull_visibility_result*& out = given(result, "result");
    auto collected = std::make_unique<shaftcull_visibility_result>();
    collected->has_candidates = with.candidates;
    collected->first_candidate.push_back(0);
    collected->counts = from_sights(deliver_all(a, b, all, with, [&](const SightBatch& answers) {
      const UndecidedPairs& undecided = answers.undecided;
      append(collected->blocks, answers.blocks, from_block);
      append(collected->pairs, undecided.pairs, from_pair);
      const std::size_t before = collected->candidates.size();
      collected->candidates.insert(collected->candidates.end(), undecided.candidates.begin(),
                                   undecided.candidates.end());
      if (undecided.pairs.empty() || undecided.first_candidate.empty()) return;
      append(collected->first_candidate, undecided.first_candidate.subspan(1),
             [before](std::size_t first) { return std::uint64_t{before + first}; });
    }));
    out = collected.release();
  });
}

void shaftcull_visibility_result_free(shaftcull_visibility_result* result) { delete result; }

shaftcull_status shaftcull_visibility_result_describe(const shaftcull_visibility_result* result,
                                                      shaftcull_sight_batch* batch, shaftcull_sight_counts* counts) {
  return guarded([&] {
    const shaftcull_visibility_result& all = given(result, "result");
    shaftcull_sight_batch& out = given(batch, "batch");
    out = {all.blocks.data(), all.blocks.size(), {all.pairs.data(), all.pairs.size(), nullptr, nullptr}};
    if (all.has_candidates) {
      out.undecided.first_candidate = all.first_candidate.data();
      out.undecided.candidates = all.candidates.data();
    }
    if (counts != nullptr) *counts = all.counts;
  });
}

shaftcull_status shaftcull_visibility_bits(const shaftcull_patches* a, const shaftcull_patches* b,
                                           const shaftcull_occluders* occluders,
                                           const shaftcull_visibility_options* options, shaftcull_sight sight,
                                           uint64_t* bits, uint64_t words, shaftcull_sight_counts* counts) {
  return guarded([&] {
    const Occluders& all = given(occluders, "occluders").all;
    const VisibilityOptions with = as_options(options);
    const Sight kind = as_enumerator(sight, Sight::facing_away, "sight", sight_enumerators);
    const std::span<uint64_t> out = as_span(bits, words, "bits");
    const SightCounts found = of_one_or_two(
        a, b, [&](const auto&... sets) { return shaftcull::visibility_bits(sets..., all, kind, out, with); });
    if (counts != nullptr) *counts = from_sights(found);
  });
}

}  // extern "C"
