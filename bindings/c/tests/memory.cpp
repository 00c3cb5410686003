// SPDX-License-Identifier: MIT
/// Which calls of the C interface allocate, and that memory that runs out becomes a status. A program of its own, since
/// it replaces operator new.
#include <gmock/gmock.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "failing_memory.hpp"
#include "handles.hpp"
#include "shaftcull.h"

namespace shaftcull {
namespace {

constexpr shaftcull_box lamp{{0, 9, 0}, {1, 10, 1}};
constexpr shaftcull_box table{{4, 0, 4}, {6, 1, 6}};
constexpr float down[3] = {0, -1, 0};
constexpr float points[12] = {0, 0, 0, 9, 0, 0, 0, 9, 0, 0, 0, 9};

/// Boxes one behind the other.
std::vector<shaftcull_box> row(std::size_t count) {
  std::vector<shaftcull_box> boxes;
  for (std::size_t i = 0; i != count; ++i) {
    const float x = static_cast<float>(i);
    boxes.push_back({{x, 4, 2}, {x + 0.5F, 5, 3}});
  }
  return boxes;
}

TEST(CMemory, QueriesAboutOneShaftAllocateNothing) {
  const std::vector<shaftcull_box> boxes = row(100);
  const shaftcull_source source = source_of(boxes);
  const ShaftsHandle array = made<ShaftsHandle>(shaftcull_shafts_create, std::uint64_t{2});
  shaftcull_shafts* const shafts = array.get();
  const BoundsHandle stream = made<BoundsHandle>(shaftcull_stream_create, &source);
  const BoundsHandle tree = made<BoundsHandle>(shaftcull_tree_create, &source);
  ok(set_between(shafts, 0, lamp, table));
  std::vector<std::uint32_t> indices(100);
  std::vector<std::uint32_t> others(100);
  std::vector<float> times(3);
  const std::uint32_t candidates[3] = {3, 2, 1};
  const std::uint64_t mask[2] = {12, 0};
  const std::uint32_t layer_mask = 6;
  const std::vector<std::uint32_t> layers(100, 2);
  ok(shaftcull_bounds_set_layers(stream.get(), nullptr, layers.data(), layers.size()));
  ok(shaftcull_bounds_set_layers(tree.get(), nullptr, layers.data(), layers.size()));
  shaftcull_query out{};  // leaves bounds out
  out.exclude = candidates;
  out.exclude_count = 2;
  out.exclude_each = candidates;
  out.exclude_each_count = 3;
  out.exclude_mask = mask;
  out.exclude_mask_words = 2;
  out.layer_masks = &layer_mask;
  out.layer_mask_count = 1;
  shaftcull_query limited = out;
  limited.limit = 3;
  shaftcull_query only = out;
  only.only = candidates;
  only.only_count = 3;
  const shaftcull_query* const each[] = {nullptr, &out, &only};
  const shaftcull_query* const listing[] = {nullptr, &out, &limited, &only};
  const shaftcull_query* const occluding[] = {nullptr, &out};
  std::uint64_t number = 0;
  ok(shaftcull_count(shafts, 0, 1, tree.get(), &only, &number));  // the first one with candidates may

  const std::size_t before = allocations();
  const shaftcull_sphere ball{{2, 4, 2}, 1};
  const shaftcull_triangle face{{{2, 4, 2}, {3, 5, 3}, {3, 4, 2}}};
  std::uint64_t kept[2];
  std::uint64_t inside[2];
  std::uint32_t yes = 0;
  shaftcull_kept_counts counts;
  shaftcull_contact_found contact;
  shaftcull_bounds_info info;
  shaftcull_shafts_info about;
  ok(set_between(shafts, 1, lamp, table, SHAFTCULL_CONTACT_OPEN));
  ok(shaftcull_shafts_set_contact(shafts, 1, 1, SHAFTCULL_CONTACT_OPEN));
  ok(shaftcull_shafts_complete(shafts, 0, 2));
  ok(shaftcull_shafts_describe(shafts, 0, &about));
  ok(shaftcull_bounds_update(stream.get(), 0, &source));
  for (const shaftcull_bounds* const bounds : {stream.get(), tree.get()}) {
    ok(shaftcull_bounds_describe(bounds, &info));
    for (const shaftcull_query* const query : each) {
      ok(shaftcull_cull(shafts, 0, 1, bounds, query, kept, 2));
      ok(shaftcull_classify(shafts, 0, 1, bounds, query, kept, inside, 2));
      ok(shaftcull_classify(shafts, 0, 1, bounds, query, nullptr, inside, 2));
      ok(shaftcull_count_classified(shafts, 0, 1, bounds, query, &counts));
      ok(shaftcull_any(shafts, 0, 1, bounds, query, &number));
      ok(shaftcull_list_classified(shafts, 0, bounds, query, indices.data(), 100, others.data(), 100, &counts));
      ok(shaftcull_first_contact(shafts, 0, 1, bounds, query, &contact));
    }
    for (const shaftcull_query* const query : listing) {
      ok(shaftcull_count(shafts, 0, 1, bounds, query, &number));
      ok(shaftcull_list(shafts, 0, bounds, query, indices.data(), 100, &number));
    }
    for (const shaftcull_query* const query : occluding) {
      ok(shaftcull_occluded(shafts, 0, 1, bounds, query, &number));
      ok(shaftcull_find_occluder(shafts, 0, bounds, query, &number));
    }
    ok(shaftcull_entry_times(shafts, 0, bounds, candidates, times.data(), 3));
  }
  ok(shaftcull_bounds_set_layers(stream.get(), candidates, layers.data(), 3));
  ok(shaftcull_classify_one(shafts, 0, SHAFTCULL_BOXES, &lamp, 0, &yes));
  ok(shaftcull_classify_one(shafts, 0, SHAFTCULL_SPHERES, &ball, 0, &yes));
  ok(shaftcull_classify_one(shafts, 0, SHAFTCULL_TRIANGLES, &face, SHAFTCULL_TRIANGLES_EXACT, &yes));
  ok(shaftcull_occluded_by(shafts, 0, reinterpret_cast<const float*>(&lamp), 2, &yes));
  EXPECT_EQ(allocations(), before);
}

TEST(CMemory, ThatRunsOutIsAStatusAndChangesNothing) {
  const std::vector<shaftcull_box> boxes = row(300);
  const shaftcull_source source = source_of(boxes);
  const BoundsHandle tree = made<BoundsHandle>(shaftcull_tree_create, &source);
  const BoundsHandle stream = made<BoundsHandle>(shaftcull_stream_create, &source);
  const std::vector<std::uint32_t> layers(300, 2);
  const ShaftsHandle shafts = made<ShaftsHandle>(shaftcull_shafts_create, std::uint64_t{300});
  const ListsHandle lists = made<ListsHandle>(shaftcull_lists_create);
  const HullHandle hull =
      made<HullHandle>(shaftcull_hull_create, &points[0], std::uint64_t{4}, std::uint64_t{0},
                       static_cast<const float*>(nullptr), std::uint64_t{0}, std::uint32_t{SHAFTCULL_HULL_EXACT});
  for (std::uint64_t s = 0; s != 300; ++s) ok(set_between(shafts.get(), s, lamp, table));
  const PatchesHandle patches = made<PatchesHandle>(shaftcull_patches_create, &source,
                                                    static_cast<const shaftcull_plane*>(nullptr), std::uint64_t{0});
  const OccludersHandle occluders = made<OccludersHandle>(shaftcull_occluders_create);
  ok(shaftcull_occluders_add_boxes(occluders.get(), &source, nullptr));
  const float corners[] = {-1, 0, 0, -1, 1, 0, -1, 1, 1, -1, 0, 1, 9, 0, 0, 9, 0, 1, 9, 1, 1, 9, 1, 0};
  const std::uint64_t first_corner[] = {0, 4, 8};
  const PatchesHandle squares =
      made<PatchesHandle>(shaftcull_patches_create_polygons, &corners[0], std::uint64_t{8}, &first_corner[0],
                          std::uint64_t{2}, shaftcull_patch_sides{SHAFTCULL_PATCH_FRONT});
  const shaftcull_index_pair pair{0, 1};
  const std::uint64_t first_candidate[] = {0, 1};
  const std::uint32_t candidate = 1;
  const shaftcull_undecided_pairs undecided{&pair, 1, &first_candidate[0], &candidate};
  float fraction = 0;
  const BoundsHandle dynamic = made<BoundsHandle>(shaftcull_dynamic_tree_create, std::uint32_t{SHAFTCULL_BOXES}, 2.0);
  std::vector<shaftcull_bound_id> ids(300);
  std::vector<shaftcull_kept_counts> counts(300);
  shaftcull_sight_counts sights{};
  std::vector<std::uint64_t> bits(300 * shaftcull_bit_words(300));
  using Call = std::pair<std::function<shaftcull_status()>, std::function<void()>>;  // and what cleans up behind it
  bool created = false;  // whether a call that failed set its handle
  const auto creates = [&created]<class Handle>(void (*free)(Handle*), auto* make, auto... arguments) -> Call {
    auto handle = std::make_shared<Handle*>(nullptr);
    return {[=, &created] {
              const shaftcull_status status = make(arguments..., handle.get());
              created = *handle != nullptr;
              return status;
            },
            [=] { free(std::exchange(*handle, nullptr)); }};
  };
  const auto nothing = [] {};
  const Call calls[] = {
      creates(shaftcull_bounds_free, shaftcull_stream_create, &source),
      creates(shaftcull_bounds_free, shaftcull_tree_create, &source),
      creates(shaftcull_bounds_free, shaftcull_bounds_copy, static_cast<const shaftcull_bounds*>(tree.get())),
      creates(shaftcull_shafts_free, shaftcull_shafts_create, std::uint64_t{10}),
      creates(shaftcull_lists_free, shaftcull_lists_create),
      creates(shaftcull_hull_free, shaftcull_hull_create, &points[0], std::uint64_t{4}, std::uint64_t{0}, &down[0],
              std::uint64_t{1}, std::uint32_t{SHAFTCULL_HULL_EXACT}),
      creates(shaftcull_patches_free, shaftcull_patches_create, &source, static_cast<const shaftcull_plane*>(nullptr),
              std::uint64_t{0}),
      creates(shaftcull_occluders_free, shaftcull_occluders_create),
      creates(shaftcull_visibility_result_free, shaftcull_collect_visibility,
              static_cast<const shaftcull_patches*>(patches.get()), static_cast<const shaftcull_patches*>(nullptr),
              static_cast<const shaftcull_occluders*>(occluders.get()),
              static_cast<const shaftcull_visibility_options*>(nullptr)),
      creates(shaftcull_factor_matrix_free, shaftcull_view_factors,
              static_cast<const shaftcull_patches*>(squares.get()),
              static_cast<const shaftcull_occluders*>(occluders.get()),
              static_cast<const shaftcull_view_factor_options*>(nullptr)),
      {[&] {
         return shaftcull_visible_fractions(squares.get(), nullptr, occluders.get(), &undecided, nullptr, &fraction);
       },
       nothing},
      {[&] {
         return shaftcull_visibility(patches.get(), nullptr, occluders.get(), nullptr, nullptr, nullptr, &sights);
       },
       nothing},
      {[&] {
         return shaftcull_visibility_bits(patches.get(), nullptr, occluders.get(), nullptr, SHAFTCULL_SIGHT_CLEAR,
                                          bits.data(), bits.size(), nullptr);
       },
       nothing},
      {[&] { return shaftcull_bounds_set_layers(stream.get(), nullptr, layers.data(), layers.size()); },
       [&] { ok(shaftcull_bounds_set_layers(stream.get(), nullptr, nullptr, layers.size())); }},
      {[&] { return shaftcull_list_many(shafts.get(), 0, 300, tree.get(), nullptr, lists.get()); }, nothing},
      {[&] { return shaftcull_count_classified(shafts.get(), 0, 300, tree.get(), nullptr, counts.data()); }, nothing},
      {[&] { return shaftcull_dynamic_tree_insert(dynamic.get(), &source, nullptr, ids.data()); },
       [&] { ok(shaftcull_dynamic_tree_commit(dynamic.get())); }},
      {[&] {
         const shaftcull_status status = shaftcull_dynamic_tree_move(dynamic.get(), ids.data(), 300, &source, nullptr);
         return status == SHAFTCULL_OK ? shaftcull_dynamic_tree_commit(dynamic.get()) : status;
       },
       nothing},
      {[&] { return shaftcull_dynamic_tree_erase(dynamic.get(), ids.data(), 300); }, nothing},
      {[&] { return shaftcull_shafts_set_hull(shafts.get(), 7, hull.get()); }, nothing},
      {[&] { return shaftcull_shafts_set_between(shafts.get(), 0, 300, &source, &source, nullptr, nullptr, 0); },
       nothing}};
  for (std::size_t i = 0; i != std::size(calls); ++i) {
    SCOPED_TRACE("call " + std::to_string(i));
    created = false;
    const auto& [call, clean] = calls[i];
    std::size_t failures = 0;
    for (std::size_t n = 1;; ++n) {
      shaftcull_status status = SHAFTCULL_OK;
      bool failed = false;
      {
        const FailingMemory failing(n, Failing::only_one);
        status = call();
        failed = failing.has_failed();
      }
      if (!failed) {
        EXPECT_EQ(status, SHAFTCULL_OK) << shaftcull_error_message();
        clean();
        break;
      }
      ++failures;
      if (status == SHAFTCULL_OK) {  // patches are sorted without a buffer if there is no memory for one
        clean();
        created = false;
        continue;
      }
      ASSERT_EQ(status, SHAFTCULL_OUT_OF_MEMORY) << shaftcull_error_message();
      EXPECT_STREQ(shaftcull_error_message(), "memory ran out");
      EXPECT_FALSE(created);
    }
    EXPECT_GT(failures, 0U);
  }
}

TEST(CMemory, MessagesThatFindNoMemoryAreReplaced) {
  const FailingMemory failing(1, Failing::from_then_on);
  const shaftcull_status status = shaftcull_select_isa("mmx");  // its message takes memory
  const std::string_view message = shaftcull_error_message();
  EXPECT_EQ(status, SHAFTCULL_OUT_OF_MEMORY);
  EXPECT_TRUE(message.find("memory") != message.npos);
}

}  // namespace
}  // namespace shaftcull
