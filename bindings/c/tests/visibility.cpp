// SPDX-License-Identifier: MIT
/// Visibility by the C interface, against the C++ one: all answers, pair by pair.
#include "shaftcull/visibility.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "handles.hpp"
#include "oracle/random.hpp"
#include "shaftcull.h"
#include "shaftcull/geometry.hpp"
#include "shaftcull/rays.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/view_factors.hpp"

namespace shaftcull {
namespace {

/// A scene with occluders of all sorts, the same in both languages.
struct Scene {
  std::vector<Box> boxes;
  std::vector<Plane> planes;
  PatchSet cpp;
  PatchSet others_cpp;
  Occluders occluders_cpp;
  PatchesHandle c;
  PatchesHandle others_c;
  OccludersHandle occluders_c;
};

void make_scene(Random& random, Scene& scene) {
  std::vector<Box> others;
  for (std::size_t i = 0; i != 40; ++i) {
    scene.boxes.push_back(random.box(-9, 9, 0.0F, 1.0F));
    const Vec3 normal = random.vec3(-1, 1);
    scene.planes.push_back({normal, random.uniform(-9, 1)});
    others.push_back(random.box(-9, 9, 0.0F, 2.0F));
  }
  const std::vector<shaftcull_box> c_boxes = as_c(scene.boxes);
  const std::vector<shaftcull_box> c_others = as_c(others);
  const std::vector<shaftcull_plane> c_planes = as_c(scene.planes);
  const shaftcull_source source = source_of(c_boxes);
  const shaftcull_source other_source = source_of(c_others);
  scene.cpp = PatchSet(std::span<const Box>(scene.boxes), scene.planes);
  scene.others_cpp = PatchSet(std::span<const Box>(others));
  scene.c = made<PatchesHandle>(shaftcull_patches_create, &source, c_planes.data(), std::uint64_t{c_planes.size()});
  scene.others_c = made<PatchesHandle>(shaftcull_patches_create, &other_source,
                                       static_cast<const shaftcull_plane*>(nullptr), std::uint64_t{0});
  scene.occluders_c = made<OccludersHandle>(shaftcull_occluders_create);
  shaftcull_occluders* const c = scene.occluders_c.get();
  Occluders& cpp = scene.occluders_cpp;

  std::vector<Box> some;
  std::vector<Box> solids;
  std::vector<Triangle> triangles;
  std::vector<Vec3> corners;
  std::vector<std::size_t> first_corner{0};
  std::vector<std::uint64_t> c_first_corner{0};
  std::vector<Vec3> squares;
  for (std::size_t i = 0; i != 5; ++i) {
    some.push_back(random.box(-9, 9, 0.5F, 2.0F));
    solids.push_back(random.box(-9, 9, 1.0F, 9.0F));
    const Vec3 at = random.vec3(-9, 9);
    triangles.push_back({at, {at[0] + 1, at[1], at[2]}, {at[0], at[1] + 2, at[2] + 1}});
    for (std::size_t corner = 0; corner != 8; ++corner) {
      corners.push_back(
          {at[0] + (corner & 1 ? 3.0F : 0), at[1] + (corner & 2 ? 4.0F : 0), at[2] + (corner & 4 ? 5.0F : 0)});
    }
    first_corner.push_back(corners.size());
    c_first_corner.push_back(corners.size());
  }
  for (const Vec3& corner : {Vec3{-9, -9, 1}, Vec3{9, -9, 1}, Vec3{9, 9, 1}, Vec3{-9, 9, 1}}) squares.push_back(corner);
  const std::vector<std::size_t> first_of_square{0, 4};
  const std::vector<std::uint64_t> c_first_of_square{0, 4};
  const std::vector<std::size_t> groups{0, 2, 5};
  const std::vector<std::uint64_t> c_groups{0, 2, 5};
  const auto floats_of = [](const std::vector<Vec3>& points) {
    std::vector<float> floats;
    for (const Vec3& point : points) floats.insert(floats.end(), point.begin(), point.end());
    return floats;
  };
  const std::vector<shaftcull_box> c_some = as_c(some);
  const std::vector<shaftcull_box> c_solids = as_c(solids);
  const std::vector<shaftcull_triangle> c_triangles = as_c(triangles);
  const shaftcull_source some_source = source_of(c_some);
  const shaftcull_source solid_source = source_of(c_solids);
  const shaftcull_source triangle_source = source_of(c_triangles);
  const TriangleStream stream{std::span<const Triangle>(triangles)};
  std::uint64_t first = 0;
  ok(shaftcull_occluders_add_boxes(c, &some_source, &first));
  EXPECT_EQ(first, cpp.add_boxes(some));
  ok(shaftcull_occluders_add_solids(c, &solid_source, &first));
  EXPECT_EQ(first, cpp.add_solids(solids));
  ok(shaftcull_occluders_add_solid_hulls(c, floats_of(corners).data(), corners.size(), c_first_corner.data(), 5,
                                         &first));
  EXPECT_EQ(first, cpp.add_solid_hulls(corners, first_corner));
  ok(shaftcull_occluders_add_polygons(c, floats_of(squares).data(), 4, c_first_of_square.data(), 1, &first));
  EXPECT_EQ(first, cpp.add_polygons(squares, first_of_square));
  ok(shaftcull_occluders_add_triangles(c, &triangle_source, c_groups.data(), 2, &first));
  EXPECT_EQ(first, cpp.add_triangles(stream.view(), groups));
  ok(shaftcull_occluders_add_triangles(c, &triangle_source, nullptr, 0, &first));
  EXPECT_EQ(first, cpp.add_triangles(stream.view()));
  shaftcull_found_solids found;
  ok(shaftcull_occluders_add_mesh(c, &triangle_source, 0.25F, 1, scene.c.get(), scene.others_c.get(), &found, &first));
  const Box region = joined(scene.cpp.box(), scene.others_cpp.box());
  FoundSolids of_mesh;
  EXPECT_EQ(first, cpp.add_mesh(stream.view(), {.least_width = 0.25F, .region = region}, &of_mesh));
  EXPECT_EQ(found.hulls, of_mesh.hulls());
  EXPECT_EQ(found.polygons, of_mesh.polygons());
  EXPECT_EQ(found.inner_boxes, of_mesh.inner_boxes.size());
  EXPECT_EQ(shaftcull_occluders_count(c), cpp.size());
  for (std::size_t i = 0; i != cpp.size(); ++i) {
    shaftcull_occluder_info info;
    ok(shaftcull_occluders_describe(c, i, &info));
    EXPECT_EQ(std::bit_cast<Box>(info.box), cpp.box(i));
    EXPECT_TRUE(std::ranges::equal(std::span(info.triangles, info.triangle_count), cpp.triangles(i)));
  }
}

void expect_equal(const shaftcull_sight_batch& c, const Visibility& cpp) {
  ASSERT_EQ(c.block_count, cpp.blocks.size());
  for (std::size_t i = 0; i != cpp.blocks.size(); ++i) {
    const shaftcull_pair_block& block = c.blocks[i];
    EXPECT_EQ(
        (PairBlock{{block.a.first, block.a.count}, {block.b.first, block.b.count}, static_cast<Sight>(block.sight)}),
        cpp.blocks[i]);
  }
  ASSERT_EQ(c.undecided.count, cpp.undecided.size());
  for (std::size_t i = 0; i != cpp.undecided.size(); ++i) {
    EXPECT_EQ((PatchPair{c.undecided.pairs[i].a, c.undecided.pairs[i].b}), cpp.undecided[i]);
  }
  if (cpp.first_candidate.empty()) {
    EXPECT_EQ(c.undecided.first_candidate, nullptr);
    EXPECT_EQ(c.undecided.candidates, nullptr);
    return;
  }
  EXPECT_TRUE(std::ranges::equal(std::span(c.undecided.first_candidate, c.undecided.count + 1), cpp.first_candidate));
  EXPECT_TRUE(std::ranges::equal(std::span(c.undecided.candidates, cpp.candidates.size()), cpp.candidates));
}

TEST(CVisibility, IsThatOfCpp) {
  Random random(1801);
  SightCounts seen;
  for (int round = 0; round != 6; ++round) {
    Scene scene;
    make_scene(random, scene);
    for (const bool is_of_one_set : {false, true}) {
      const shaftcull_patches* const other = is_of_one_set ? nullptr : scene.others_c.get();
      const PatchSet& second = is_of_one_set ? scene.cpp : scene.others_cpp;
      shaftcull_visibility_options options = shaftcull_default_visibility_options();
      options.contact = round % 2 == 0 ? SHAFTCULL_CONTACT_OPEN : SHAFTCULL_CONTACT_CLOSED;
      options.candidates = round % 3 != 2;
      options.solids_around_ends = round < 3;
      VisibilityOptions with;
      with.contact = round % 2 == 0 ? Contact::open : Contact::closed;
      with.candidates = round % 3 != 2;
      with.solids_around_ends = round < 3;
      const Visibility wanted = is_of_one_set ? collect_visibility(scene.cpp, scene.occluders_cpp, with)
                                              : collect_visibility(scene.cpp, second, scene.occluders_cpp, with);
      const auto result =
          made<VisibilityHandle>(shaftcull_collect_visibility, static_cast<const shaftcull_patches*>(scene.c.get()),
                                 other, static_cast<const shaftcull_occluders*>(scene.occluders_c.get()),
                                 static_cast<const shaftcull_visibility_options*>(&options));
      shaftcull_sight_batch all;
      shaftcull_sight_counts counts;
      ok(shaftcull_visibility_result_describe(result.get(), &all, &counts));
      expect_equal(all, wanted);
      EXPECT_EQ(as_cpp(counts), wanted.counts);
      ok(shaftcull_visibility(scene.c.get(), other, scene.occluders_c.get(), &options, nullptr, nullptr, &counts));
      EXPECT_EQ(as_cpp(counts), wanted.counts);

      const shaftcull_patches* const patches = scene.c.get();
      const shaftcull_patches_info info = described(shaftcull_patches_describe, patches);
      EXPECT_TRUE(std::ranges::equal(std::span(info.order, info.count), scene.cpp.order()));
      const std::size_t words = scene.cpp.size() * bit_words(second.size());
      std::vector<std::uint64_t> bits(words);
      std::vector<std::uint64_t> wanted_bits(words);
      for (const Sight sight : {Sight::undecided, Sight::clear, Sight::occluded, Sight::facing_away}) {
        if (is_of_one_set) {
          visibility_bits(scene.cpp, scene.occluders_cpp, sight, wanted_bits, with);
        } else {
          visibility_bits(scene.cpp, second, scene.occluders_cpp, sight, wanted_bits, with);
        }
        ok(shaftcull_visibility_bits(scene.c.get(), other, scene.occluders_c.get(), &options,
                                     static_cast<shaftcull_sight>(sight), bits.data(), words, &counts));
        EXPECT_EQ(bits, wanted_bits);
        EXPECT_EQ(as_cpp(counts), wanted.counts);
      }
      seen.undecided += wanted.counts.undecided;
      seen.clear += wanted.counts.clear;
      seen.occluded += wanted.counts.occluded;
      seen.facing_away += wanted.counts.facing_away;
    }
  }
  // The scenes have enough of all.
  EXPECT_GT(seen.undecided, 100U);
  EXPECT_GT(seen.clear, 20U);
  EXPECT_GT(seen.occluded, 20U);
  EXPECT_GT(seen.facing_away, 100U);
}

TEST(CVisibility, IsResolvedAndDeliveredAsInCpp) {
  Random random(1802);
  Scene scene;
  make_scene(random, scene);
  // Pairs with one candidate are clear, and those with two occluded.
  const auto verdict_for = [](std::uint64_t candidates) {
    return candidates == 1 ? Sight::clear : candidates == 2 ? Sight::occluded : Sight::undecided;
  };
  VisibilityOptions with;
  with.resolve = [&](const UndecidedPairs& undecided, std::span<Sight> verdict) {
    for (std::size_t i = 0; i != verdict.size(); ++i) {
      verdict[i] = verdict_for(undecided.first_candidate[i + 1] - undecided.first_candidate[i]);
    }
  };
  const Visibility wanted = collect_visibility(scene.cpp, scene.occluders_cpp, with);
  const Visibility unresolved = collect_visibility(scene.cpp, scene.occluders_cpp);
  EXPECT_LT(wanted.counts.undecided, unresolved.counts.undecided);

  shaftcull_visibility_options options = shaftcull_default_visibility_options();
  options.user = const_cast<void*>(static_cast<const void*>(&verdict_for));
  options.resolve = [](const shaftcull_undecided_pairs* undecided, std::uint8_t* verdicts, void* user) -> std::int32_t {
    for (std::size_t i = 0; i != undecided->count; ++i) {
      const auto candidates = undecided->first_candidate[i + 1] - undecided->first_candidate[i];
      verdicts[i] = static_cast<std::uint8_t>((*static_cast<decltype(verdict_for)*>(user))(candidates));
    }
    return 0;
  };
  const auto result = made<VisibilityHandle>(
      shaftcull_collect_visibility, static_cast<const shaftcull_patches*>(scene.c.get()),
      static_cast<const shaftcull_patches*>(nullptr), static_cast<const shaftcull_occluders*>(scene.occluders_c.get()),
      static_cast<const shaftcull_visibility_options*>(&options));
  shaftcull_sight_batch all;
  shaftcull_sight_counts counts;
  ok(shaftcull_visibility_result_describe(result.get(), &all, &counts));
  expect_equal(all, wanted);

  SightCounts told;
  ok(shaftcull_visibility(
      scene.c.get(), nullptr, scene.occluders_c.get(), &options,
      [](const shaftcull_sight_batch* batch, void* user) -> std::int32_t {
        auto& sum = *static_cast<SightCounts*>(user);
        sum.undecided += batch->undecided.count;
        for (std::size_t i = 0; i != batch->block_count; ++i) {
          const shaftcull_pair_block& block = batch->blocks[i];
          const std::uint64_t pairs = std::uint64_t{block.a.count} * block.b.count;
          (block.sight == SHAFTCULL_SIGHT_CLEAR      ? sum.clear
           : block.sight == SHAFTCULL_SIGHT_OCCLUDED ? sum.occluded
                                                     : sum.facing_away) += pairs;
        }
        return 0;
      },
      &told, &counts));
  EXPECT_EQ(told, wanted.counts);
  EXPECT_EQ(as_cpp(counts), wanted.counts);
}

TEST(CVisibility, RefusalsSpeakOfWhatTheCallerWrote) {
  Random random(1804);
  Scene scene;
  make_scene(random, scene);
  shaftcull_visibility_options options = shaftcull_default_visibility_options();
  options.resolve = [](const shaftcull_undecided_pairs*, std::uint8_t* verdicts, void*) -> std::int32_t {
    verdicts[0] = 4;
    return 0;
  };
  shaftcull_sight_counts counts;
  EXPECT_EQ(shaftcull_visibility(scene.c.get(), nullptr, scene.occluders_c.get(), &options, nullptr, nullptr, &counts),
            SHAFTCULL_INVALID_ARGUMENT);
  EXPECT_THAT(shaftcull_error_message(), testing::AllOf(testing::StartsWith("verdicts[0] = 4, of patches "),
                                                        testing::HasSubstr(", is none of SHAFTCULL_SIGHT_UNDECIDED, "),
                                                        testing::EndsWith(" and SHAFTCULL_SIGHT_FACING_AWAY")));
  std::uint64_t bits = 0;
  EXPECT_EQ(shaftcull_visibility_bits(scene.c.get(), nullptr, scene.occluders_c.get(), nullptr, SHAFTCULL_SIGHT_CLEAR,
                                      &bits, 1, nullptr),
            SHAFTCULL_INVALID_ARGUMENT);
  EXPECT_THAT(shaftcull_error_message(), testing::StartsWith("bits has 1 word; 40 rows, one for each patch of a"));

  const std::vector<shaftcull_box> upside_down = as_c(std::vector<Box>{{{0, 2, 0}, {1, 1, 1}}});
  const shaftcull_source boxes = source_of(upside_down);
  shaftcull_patches* patches = nullptr;
  EXPECT_EQ(shaftcull_patches_create(&boxes, nullptr, 0, &patches), SHAFTCULL_BAD_BOUND);
  EXPECT_STREQ(shaftcull_error_message(), "patch 0 has lo > hi: lo.y = 2 is above hi.y = 1");
  const std::vector<shaftcull_sphere> spheres(1);
  const shaftcull_source others = source_of(spheres);
  EXPECT_EQ(shaftcull_patches_create(&others, nullptr, 0, &patches), SHAFTCULL_INVALID_ARGUMENT);
  EXPECT_STREQ(shaftcull_error_message(), "boxes is a source of other bounds; this call takes boxes");
}

TEST(CVisibility, PolygonsAndATolerance) {
  // Two triangles in one plane, and one 0.25 in front of it.
  const std::vector<float> corners{0, 0, 0, 1, 0, 1, 1,     1, 1, 3,     0, 3, 4,    0,
                                   4, 4, 1, 4, 6, 0, 6.25F, 7, 0, 7.25F, 7, 1, 7.25F};
  const std::vector<std::uint64_t> first{0, 3, 6, 9};
  const auto patches =
      made<PatchesHandle>(shaftcull_patches_create_polygons, corners.data(), std::uint64_t{9}, first.data(),
                          std::uint64_t{3}, shaftcull_patch_sides{SHAFTCULL_PATCH_FRONT});
  const auto occluders = made<OccludersHandle>(shaftcull_occluders_create);
  shaftcull_visibility_options options = shaftcull_default_visibility_options();
  EXPECT_EQ(options.tolerance, 0.0F);
  shaftcull_sight_counts counts{};
  // The third is in front of the others, and these are behind it.
  ASSERT_EQ(shaftcull_visibility(patches.get(), nullptr, occluders.get(), &options, nullptr, nullptr, &counts),
            SHAFTCULL_OK);
  EXPECT_EQ(counts.facing_away, 3U);
  const auto seen_from_both =
      made<PatchesHandle>(shaftcull_patches_create_polygons, corners.data(), std::uint64_t{9}, first.data(),
                          std::uint64_t{3}, shaftcull_patch_sides{SHAFTCULL_PATCH_BOTH});
  ASSERT_EQ(shaftcull_visibility(seen_from_both.get(), nullptr, occluders.get(), &options, nullptr, nullptr, &counts),
            SHAFTCULL_OK);
  EXPECT_EQ(counts.clear, 2U);
  EXPECT_EQ(counts.facing_away, 1U);  // the two in one plane
  const auto lower = made<PatchesHandle>(shaftcull_patches_create_polygons, corners.data(), std::uint64_t{3},
                                         first.data(), std::uint64_t{1}, shaftcull_patch_sides{SHAFTCULL_PATCH_FRONT});
  const shaftcull_box point{{6, 0, 6.25F}, {6, 0, 6.25F}};
  const shaftcull_source source = shaftcull_boxes(&point, 1);
  const auto receiver = made<PatchesHandle>(shaftcull_patches_create, &source,
                                            static_cast<const shaftcull_plane*>(nullptr), std::uint64_t{0});
  for (const float tolerance : {0.0F, 0.0625F, 0.125F}) {
    options.tolerance = tolerance;
    ASSERT_EQ(shaftcull_visibility(lower.get(), receiver.get(), occluders.get(), &options, nullptr, nullptr, &counts),
              SHAFTCULL_OK);
    EXPECT_EQ(counts.facing_away, tolerance == 0.125F ? 1U : 0U);
    EXPECT_EQ(counts.clear, tolerance == 0.125F ? 0U : 1U);
  }
}

TEST(CVisibility, OpenBodiesAreFoundBetweenPatchesThatAreGiven) {
  // A box without its bottom, which stands on the ground of these patches.
  std::vector<Triangle> triangles;
  const auto add = [&](const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
    triangles.push_back({p, q, r});
    triangles.push_back({p, r, s});
  };
  const Vec3 low[]{{4, 4, 0}, {6, 4, 0}, {6, 6, 0}, {4, 6, 0}};
  const Vec3 high[]{{4, 4, 3}, {6, 4, 3}, {6, 6, 3}, {4, 6, 3}};
  for (std::size_t i = 0; i != 4; ++i) add(low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]);
  add(high[0], high[1], high[2], high[3]);
  const std::vector<shaftcull_triangle> c_triangles = as_c(triangles);
  const shaftcull_source source = source_of(c_triangles);
  const std::vector<shaftcull_box> ground{{{0, 0, 0}, {9, 9, 0}}};
  const std::vector<shaftcull_box> deeper{{{0, 0, -1}, {9, 9, 5}}};
  const auto patches_of = [](const std::vector<shaftcull_box>& boxes) {
    const shaftcull_source boxes_source = source_of(boxes);
    return made<PatchesHandle>(shaftcull_patches_create, &boxes_source, static_cast<const shaftcull_plane*>(nullptr),
                               std::uint64_t{0});
  };
  const PatchesHandle a = patches_of(ground);
  const PatchesHandle b = patches_of(deeper);
  const PatchesHandle none = patches_of({});
  const OccludersHandle occluders = made<OccludersHandle>(shaftcull_occluders_create);
  const auto hulls = [&](const shaftcull_patches* one, const shaftcull_patches* other) {
    shaftcull_found_solids found;
    std::uint64_t first = 0;
    ok(shaftcull_occluders_add_mesh(occluders.get(), &source, 0, 1, one, other, &found, &first));
    // A body that is an upright box stands for its triangles.
    const std::uint64_t added = shaftcull_occluders_count(occluders.get()) - first;
    shaftcull_occluder_info last;
    ok(shaftcull_occluders_describe(occluders.get(), first + added - 1, &last));
    EXPECT_EQ(last.triangle_count == 0, found.hulls == 1);
    return found.hulls;
  };
  EXPECT_EQ(hulls(nullptr, nullptr), 0U);
  EXPECT_EQ(hulls(a.get(), nullptr), 1U);
  EXPECT_EQ(hulls(a.get(), a.get()), 1U);
  EXPECT_EQ(hulls(a.get(), none.get()), 1U);
  EXPECT_EQ(hulls(a.get(), b.get()), 0U);
}

TEST(CVisibility, DefaultOptionsAreThoseOfCpp) {
  const shaftcull_visibility_options sight = shaftcull_default_visibility_options();
  const VisibilityOptions of_sight;
  EXPECT_EQ(sight.memory, of_sight.memory);
  EXPECT_EQ(sight.contact, static_cast<shaftcull_contact>(of_sight.contact));
  EXPECT_EQ(sight.solids_around_ends, std::uint32_t{of_sight.solids_around_ends});
  EXPECT_EQ(sight.candidates, std::uint32_t{of_sight.candidates});
  EXPECT_EQ(sight.tolerance, of_sight.tolerance);
  EXPECT_EQ(sight.part, of_sight.part);
  EXPECT_EQ(sight.parts, of_sight.parts);
  const shaftcull_ray_options rays = shaftcull_default_ray_options();
  const RayOptions of_rays;
  EXPECT_EQ(rays.rays, of_rays.rays);
  EXPECT_EQ(rays.error, of_rays.error);
  EXPECT_EQ(rays.seed, of_rays.seed);
  EXPECT_EQ(rays.tolerance, of_rays.tolerance);
  const shaftcull_view_factor_options factors = shaftcull_default_view_factor_options();
  const ViewFactorOptions of_factors;
  EXPECT_EQ(factors.memory, of_factors.memory);
  EXPECT_EQ(factors.seed, of_factors.seed);
  EXPECT_EQ(factors.error, of_factors.error);
  EXPECT_EQ(factors.least, of_factors.least);
  EXPECT_EQ(factors.rays, of_factors.rays);
  EXPECT_EQ(factors.close_rows, std::uint32_t{of_factors.close_rows});
  EXPECT_EQ(factors.tolerance, of_factors.tolerance);
  EXPECT_EQ(factors.part, of_factors.part);
  EXPECT_EQ(factors.parts, of_factors.parts);
  for (std::uint32_t sight_of_c = 0; sight_of_c != 4; ++sight_of_c) {
    EXPECT_EQ(shaftcull_sight_name(sight_of_c), name(static_cast<Sight>(sight_of_c)));
  }
}

TEST(CVisibility, SolidsAreMergedAndInscribedAsInCpp) {
  Random random(1803);
  std::vector<Box> boxes;
  for (std::size_t i = 0; i != 30; ++i) {
    const std::size_t row = i / 5 * (i % 7 == 0 ? 2 : 1);
    const float x = static_cast<float>(i % 5);
    const float y = static_cast<float>(row);
    boxes.push_back({{x, y, 0}, {x + 1, y + 1, 3}});
  }
  const std::vector<Box> wanted = merged_boxes(boxes);
  const std::vector<shaftcull_box> c_boxes = as_c(boxes);
  std::vector<shaftcull_box> merged(wanted.size() + 1);
  std::uint64_t count = 0;
  ok(shaftcull_merged_boxes(c_boxes.data(), c_boxes.size(), merged.data(), merged.size(), &count));
  ASSERT_EQ(count, wanted.size());
  for (std::size_t i = 0; i != wanted.size(); ++i) EXPECT_EQ(std::bit_cast<Box>(merged[i]), wanted[i]);
  std::vector<Vec3> corners;
  for (int i = 0; i != 12; ++i) corners.push_back(random.vec3(-5, 5));
  shaftcull_box box;
  ok(shaftcull_inscribed_box(corners[0].data(), 12, &box));
  EXPECT_EQ(std::bit_cast<Box>(box), inscribed_box(corners));
}

}  // namespace
}  // namespace shaftcull
