// SPDX-License-Identifier: MIT
#include <cstdint>
#include <span>
#include <vector>

#include "ask.hpp"
#include "results.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::ClassifiedRanges;
using shaftcull::CompiledShaft;
using shaftcull::KeptRanges;
using shaftcull::LeafRange;
using shaftcull::TileAnswers;

namespace {

/// Calls back, and ends the call of the library if that is what it says.
template <class Callback, class Argument>
void call_back(Callback callback, const Argument& argument, void* user) {
  if (const std::int32_t returned = callback(&argument, user); returned != 0) fail(Stopped(returned));
}

template <class Callback>
void check_callback(Callback callback) {
  if (callback == nullptr) refuse("callback is NULL");
}

/// Hands over tiles.
auto tile_by_tile(shaftcull_tile_callback callback, void* user, std::uint64_t first) {
  return [callback, user, first](const TileAnswers& answers) {
    shaftcull_tile tile{};
    tile.shaft = first + answers.shaft;
    tile.first = answers.first;
    tile.size = answers.size;
    tile.kept = answers.kept.data();
    tile.inside = answers.inside.empty() ? nullptr : answers.inside.data();
    call_back(callback, tile, user);
  };
}

/// Ranges as those of C, in memory that is used again. Callbacks come one at a time.
void convert(std::span<const LeafRange> ranges, std::vector<shaftcull_leaf_range>& out) {
  out.clear();
  for (const LeafRange& range : ranges) out.push_back(from_range(range));
}

}  // namespace

extern "C" {

shaftcull_status shaftcull_for_each_tile(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                         const shaftcull_bounds* bounds, const shaftcull_query* query,
                                         shaftcull_tile_callback callback, void* user) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    check_callback(callback);
    ask_bounds(bounds, query, takes_views, [&](const FlatSet auto& set) {
      shaftcull::for_each_tile(asked, set, tile_by_tile(callback, user, first));
    });
  });
}

shaftcull_status shaftcull_for_each_classified_tile(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                                    const shaftcull_bounds* bounds, const shaftcull_query* query,
                                                    shaftcull_tile_callback callback, void* user) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    check_callback(callback);
    ask_bounds(bounds, query, takes_views, [&](const FlatSet auto& set) {
      shaftcull::for_each_classified_tile(asked, set, tile_by_tile(callback, user, first));
    });
  });
}

shaftcull_status shaftcull_for_each_kept(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                         const shaftcull_bounds* bounds, const shaftcull_query* query,
                                         shaftcull_ranges_callback callback, void* user) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    check_callback(callback);
    std::vector<shaftcull_leaf_range> kept;
    ask_bounds(bounds, query, takes_trees, [&](const TreeSet auto& set, const auto& excluding) {
      const auto hand_over = [&](const KeptRanges& answers) {
        convert(answers.kept, kept);
        shaftcull_ranges ranges{};
        ranges.shaft = first + answers.shaft;
        ranges.kept = kept.data();
        ranges.kept_count = kept.size();
        call_back(callback, ranges, user);
      };
      shaftcull::for_each_kept(asked, set, hand_over, excluding);
    });
  });
}

shaftcull_status shaftcull_for_each_classified(const shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                               const shaftcull_bounds* bounds, const shaftcull_query* query,
                                               shaftcull_ranges_callback callback, void* user) {
  return guarded([&] {
    const std::span<const CompiledShaft> asked = shafts_of(shafts, first, count);
    check_callback(callback);
    std::vector<shaftcull_leaf_range> overlap;
    std::vector<shaftcull_leaf_range> inside;
    ask_bounds(bounds, query, takes_trees, [&](const TreeSet auto& set, const auto& excluding) {
      const auto hand_over = [&](const ClassifiedRanges& answers) {
        convert(answers.overlap, overlap);
        convert(answers.inside, inside);
        shaftcull_ranges ranges{};
        ranges.shaft = first + answers.shaft;
        ranges.kept = overlap.data();
        ranges.kept_count = overlap.size();
        ranges.inside = inside.data();
        ranges.inside_count = inside.size();
        call_back(callback, ranges, user);
      };
      shaftcull::for_each_classified(asked, set, hand_over, excluding);
    });
  });
}

}  // extern "C"
