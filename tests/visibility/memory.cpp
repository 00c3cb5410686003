// SPDX-License-Identifier: MIT
/// What calls about visibility allocate: no more than they may, and nothing that is left where an allocation fails.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "failing_memory.hpp"
#include "many/workload.hpp"
#include "oracle/random.hpp"
#include "oracle/sight_scene.hpp"
#include "sanitizers.hpp"
#include "shaftcull/shaftcull.hpp"
#include "solids/meshes.hpp"
#include "view_factors/radiating_scene.hpp"

namespace shaftcull {
namespace {

/// Two sides of a gap full of occluders: all pairs are undecided, with most of the occluders as candidates. Many of
/// them are small and solid, and some hundreds are candidates of a pair.
struct Gap {
  PatchSet left;
  PatchSet right;
  Occluders occluders;

  Gap(std::size_t patches, std::size_t between, bool are_solid = false) {
    Random random(5);
    std::vector<Box> boxes[2];
    for (std::size_t i = 0; i != 2 * patches; ++i) {
      Box box = random.box(-1, 1, 0.5F, 0.6F);
      box.lo[0] = box.hi[0] = i % 2 == 0 ? -3.0F : 3.0F;
      boxes[i % 2].push_back(box);
    }
    left = PatchSet(std::span<const Box>(boxes[0]));
    right = PatchSet(std::span<const Box>(boxes[1]));
    std::vector<Box> all;
    for (std::size_t i = 0; i != between; ++i) {
      all.push_back(are_solid ? random.box(-1, 1, 0.01F, 0.05F) : random.box(-0.8F, 0.8F, 0.2F, 0.7F));
    }
    if (are_solid) {
      occluders.add_solids(std::span<const Box>(all));
    } else {
      occluders.add_boxes(std::span<const Box>(all));
    }
  }
};

/// Points on both sides of a gap, and posts in it: pairs are clear or occluded, and neighbours often are not alike.
struct Fence {
  PatchSet left;
  PatchSet right;
  Occluders occluders;

  Fence(std::size_t patches, std::size_t posts) {
    Random random(6);
    std::vector<Box> boxes[2];
    for (std::size_t i = 0; i != 2 * patches; ++i) {
      const Vec3 at{i % 2 == 0 ? -3.0F : 3.0F, random.uniform(-1, 1), random.uniform(-1, 1)};
      boxes[i % 2].push_back({at, at});
    }
    left = PatchSet(std::span<const Box>(boxes[0]));
    right = PatchSet(std::span<const Box>(boxes[1]));
    std::vector<Box> all;
    for (std::size_t i = 0; i != posts; ++i) {
      const Vec3 at{random.uniform(-1, 1), random.uniform(-1, 1), -1};
      all.push_back({at, {at[0] + 0.01F, at[1] + 0.01F, 1}});
    }
    occluders.add_solids(std::span<const Box>(all));
  }
};

/// What a call takes that delivers all answers, at most, and how much it delivers.
struct Taken {
  std::size_t peak = 0;
  std::size_t largest = 0;  ///< of a batch
  std::uint64_t bytes = 0;  ///< of all batches
};

Taken taken_by(int threads, const PatchSet& a, const PatchSet& b, const Occluders& occluders,
               const VisibilityOptions& options) {
  Taken taken;
  with_threads(threads, [&] {
    const auto note = [&](const SightBatch& batch) {
      const UndecidedPairs& undecided = batch.undecided;
      const std::size_t bytes = batch.blocks.size_bytes() + undecided.pairs.size_bytes() +
                                undecided.first_candidate.size_bytes() + undecided.candidates.size_bytes();
      taken.bytes += bytes;
      taken.largest = std::max(taken.largest, bytes);
    };
    const std::size_t before = live_bytes();
    forget_peak();
    visibility(a, b, occluders, note, options);
    taken.peak = peak_bytes() - before;
  });
  return taken;
}

/// What each thread walks with.
std::size_t walks(int threads, const Occluders& occluders) {
  return static_cast<std::size_t>(threads + 1) * 100 * occluders.size();
}

TEST(VisibilityMemory, StaysBelowItsBoundHoweverManyPairsAreUndecided) {
  const Gap gap(has_shadow_memory ? 300 : 1200, 60);
  for (const int threads : {1, 2}) {
    for (const std::size_t memory : {std::size_t{1} << 20, std::size_t{8} << 20}) {
      VisibilityOptions options;
      options.memory = memory;
      const Taken taken = taken_by(threads, gap.left, gap.right, gap.occluders, options);
      ASSERT_GT(taken.bytes, 80 * gap.left.size() * gap.right.size() / 2);  // far more than the bound
      EXPECT_LE(taken.peak, memory) << threads << " threads, " << memory << " bytes, batches of up to "
                                    << taken.largest;
      EXPECT_LE(taken.largest, memory);
    }
  }
}

TEST(VisibilityMemory, StaysBelowItsBoundHoweverManyPairsAreDecided) {
  const Fence fence(has_shadow_memory ? 600 : 2400, 60);
  for (const int threads : {1, 2}) {
    for (const bool has_resolve : {false, true}) {
      VisibilityOptions options;
      options.memory = std::size_t{1} << 20;
      if (has_resolve) {
        options.resolve = [](const UndecidedPairs&, std::span<Sight> verdict) {
          std::fill(verdict.begin(), verdict.end(), Sight::clear);
        };
      }
      const Taken taken = taken_by(threads, fence.left, fence.right, fence.occluders, options);
      ASSERT_GT(taken.bytes, (has_shadow_memory ? 2 : 4) * options.memory);
      EXPECT_LE(taken.peak, options.memory) << threads << " threads, batches of up to " << taken.largest;
    }
  }
}

// Lists of solids wait as those of candidates do, and a row of pairs may have more candidates than there is memory for.
TEST(VisibilityMemory, StaysBelowItsBoundHoweverManySolidsThereAre) {
  const Gap gap(has_shadow_memory ? 100 : 300, 4000, true);
  for (const int threads : {1, 2}) {
    VisibilityOptions options;
    options.memory = std::size_t{1} << 20;
    const Taken taken = taken_by(threads, gap.left, gap.right, gap.occluders, options);
    ASSERT_GT(taken.bytes, 4 * options.memory);
    EXPECT_LE(taken.peak, options.memory + walks(threads, gap.occluders)) << threads << " threads";
  }
}

TEST(VisibilityMemory, StaysBelowItsBoundWhereEveryPairIsResolved) {
  const Gap gap(has_shadow_memory ? 300 : 1200, 8);
  for (const int threads : {1, 2}) {
    for (const bool with_candidates : {false, true}) {
      VisibilityOptions options;
      options.memory = std::size_t{1} << 20;
      options.candidates = with_candidates;
      options.resolve = [](const UndecidedPairs&, std::span<Sight> verdict) {
        std::fill(verdict.begin(), verdict.end(), Sight::clear);
      };
      const Taken taken = taken_by(threads, gap.left, gap.right, gap.occluders, options);
      ASSERT_GT(taken.bytes, 20 * gap.left.size() * gap.right.size() / 2);
      EXPECT_LE(taken.peak, options.memory) << threads << " threads, batches of up to " << taken.largest;
    }
  }
}

/// Fails each allocation of a call in turn, and expects std::bad_alloc and nothing left behind.
template <class Call>
void expect_nothing_left(const Call& call) {
  call();  // what is made once only
  for (const Failing failing : {Failing::only_one, Failing::from_then_on}) {
    std::size_t thrown = 0;
    for (std::size_t n = 1;; ++n) {
      const std::size_t before = live_bytes();
      const auto [was_thrown, has_failed] = call_with_failing(n, failing, call);
      const std::size_t after = live_bytes();
      // A call may do without what it did not get: std::stable_partition() does.
      EXPECT_TRUE(has_failed || !was_thrown) << "allocation " << n;
      thrown += was_thrown ? 1 : 0;
      EXPECT_EQ(after, before) << "allocation " << n;
      if (!has_failed) {
        EXPECT_GT(thrown, (n - 1) / 2);
        break;
      }
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(VisibilityMemory, ThatRunsOutLeavesNothingBehind) {
  SightScene scene;
  for (std::uint64_t seed = 1;; ++seed) {
    scene = random_sight_scene(SightScenery::room, seed, 150);
    if (!scene.is_of_one_set && scene.a.size() > 70 && scene.b.size() > 70 && !scene.solids.empty() &&
        scene.triangles.size() > 3 && scene.first_hull.size() > 1) {
      break;
    }
  }
  const PatchSet a = first_set(scene);
  const PatchSet b = second_set(scene);
  const Occluders occluders = occluders_of(scene);
  Polygons polygons;
  polygons.add_box({{0, 0, 0}, {1, 1, 1}});
  polygons.add_l_block(3, 0, 0, 1);
  const TriangleStream mesh{std::span<const Triangle>(polygons.triangles)};
  VisibilityOptions options;
  with_threads(1, [&] {
    expect_nothing_left([&] { static_cast<void>(first_set(scene)); });
    expect_nothing_left([&] { static_cast<void>(occluders_of(scene)); });
    expect_nothing_left([&] { static_cast<void>(merged_boxes(scene.solids)); });
    expect_nothing_left([&] { static_cast<void>(find_solids(mesh)); });
    expect_nothing_left([&] { Occluders().add_mesh(mesh); });
    expect_nothing_left([&] { static_cast<void>(count_visibility(a, b, occluders, options)); });
    expect_nothing_left([&] { static_cast<void>(count_visibility(a, occluders, options)); });
    expect_nothing_left([&] { static_cast<void>(collect_visibility(a, b, occluders, options)); });
    expect_nothing_left([&] { static_cast<void>(count_visibility(a, b, occluders_of(scene), options)); });
    options.resolve = [](const UndecidedPairs&, std::span<Sight> verdict) {
      for (std::size_t i = 0; i < verdict.size(); i += 2) verdict[i] = Sight::occluded;
    };
    expect_nothing_left([&] { static_cast<void>(collect_visibility(a, b, occluders, options)); });
  });
}

TEST(VisibilityMemory, OfRaysAndViewFactorsThatRunsOutLeavesNothingBehind) {
  RadiatingScene scene;
  scene.add_box({{0, 0, 0}, {4, 4, 4}}, 1, true);
  scene.add_box({{1, 1, 1}, {2, 2, 2}}, 1, false);
  const PatchSet patches = scene.patches();
  const Occluders occluders = scene.occluders();
  const Visibility found = collect_visibility(patches, occluders);
  ASSERT_FALSE(found.undecided.empty());
  with_threads(1, [&] {
    expect_nothing_left([&] { static_cast<void>(view_factors(patches, occluders)); });
    expect_nothing_left([&] {
      // What is prepared for rays is of these alone.
      const PatchSet others(scene.corners, scene.first);
      Occluders between = occluders;
      between.add_boxes(std::span<const Box>());
      std::vector<float> fractions(found.undecided.size());
      visible_fractions(others, others, between, {found.undecided, found.first_candidate, found.candidates}, fractions);
    });
    expect_nothing_left([&] {
      const PatchSet others(scene.corners, scene.first);
      Occluders between = occluders;
      between.add_boxes(std::span<const Box>());
      const std::vector<Vec3> directions{{1, 2, 3}, {-1, 0, 1}};
      std::vector<float> fractions(others.size() * directions.size());
      lit_fractions(others, between, directions, fractions);
    });
  });
}

/// A way to add occluders: one of each kind.
struct Adding {
  const char* name;
  std::size_t (*add)(Occluders& to, float x);
};

/// An occluder of unit size at x. Those of x and x + 1 touch.
constexpr Adding addings[] = {
    {"boxes",
     [](Occluders& to, float x) {
       const Box box{{x, 0, 0}, {x + 1, 1, 1}};
       return to.add_boxes(std::span<const Box>(&box, 1));
     }},
    {"solids",
     [](Occluders& to, float x) {
       const Box box{{x, 0, 0}, {x + 1, 1, 1}};
       return to.add_solids(std::span<const Box>(&box, 1));
     }},
    {"hulls",
     [](Occluders& to, float x) {
       const Vec3 corners[] = {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}, {x, 0, 1}};
       const std::size_t first[] = {0, 4};
       return to.add_solid_hulls(corners, first);
     }},
    {"polygons",
     [](Occluders& to, float x) {
       const Vec3 corners[] = {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}};
       const std::size_t first[] = {0, 3};
       return to.add_polygons(corners, first);
     }},
    {"found solids",
     [](Occluders& to, float x) {
       FoundSolids found;
       found.hull_corners = {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}, {x, 0, 1}};
       found.first_hull_corner = {0, 4};
       found.polygon_corners = {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}};
       found.first_polygon_corner = {0, 3};
       found.inner_boxes = {{{x, 0, 0}, {x + 1, 1, 1}}};
       to.add_found(found);
       return to.size();
     }},
    {"groups",
     [](Occluders& to, float x) {
       const Triangle triangle{{{{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}}}};
       const std::size_t first[] = {0, 1};
       return to.add_triangles(TriangleStream{std::span<const Triangle>(&triangle, 1)}.view(), first);
     }},
    {"triangles",
     [](Occluders& to, float x) {
       const Triangle triangle{{{{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}}}};
       return to.add_triangles(TriangleStream{std::span<const Triangle>(&triangle, 1)}.view());
     }},
    {"a mesh",
     [](Occluders& to, float x) {
       Polygons mesh;
       mesh.add_box({{x, 0, 0}, {x + 1, 1, 1}});
       mesh.add({{x, 0, 2}, {x + 1, 0, 2}, {x, 1, 2}});
       return to.add_mesh(TriangleStream{std::span<const Triangle>(mesh.triangles)});
     }},
};

void expect_same(const Occluders& a, const Occluders& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i != a.size(); ++i) {
    EXPECT_EQ(a.box(i), b.box(i));
    EXPECT_TRUE(std::equal(a.triangles(i).begin(), a.triangles(i).end(), b.triangles(i).begin(), b.triangles(i).end()));
  }
  // Points, and small triangles, on both sides of them.
  std::vector<Box> points;
  std::vector<Vec3> corners;
  std::vector<std::size_t> first{0};
  for (unsigned i = 0; i != 40; ++i) {
    const Vec3 at{static_cast<float>(i % 20) / 2, 0.25F, i % 2 == 0 ? -1.0F : 2.0F};
    points.push_back({at, at});
    corners.insert(corners.end(), {at, {at[0] + 0.0625F, at[1], at[2] + 0.0625F}, {at[0], at[1] + 0.0625F, at[2]}});
    first.push_back(corners.size());
  }
  for (const PatchSet& patches : {PatchSet{std::span<const Box>(points)}, PatchSet(corners, first, PatchSides::both)}) {
    const Visibility of_a = collect_visibility(patches, a);
    const Visibility of_b = collect_visibility(patches, b);
    EXPECT_EQ(of_a.counts, of_b.counts);
    EXPECT_EQ(of_a.undecided, of_b.undecided);
    EXPECT_EQ(of_a.candidates, of_b.candidates);
  }
}

TEST(VisibilityMemory, FoundSolidsAreWhatTheyWereWhereMemoryRunsOut) {
  Polygons mesh;
  mesh.add_box({{0, 0, 0}, {1, 1, 1}});
  mesh.add_column(5, 5, 1, 6, 0, 1);
  const TriangleStream triangles{std::span<const Triangle>(mesh.triangles)};
  const FoundSolids right = find_solids(triangles);
  ASSERT_EQ(right.hulls(), 2U);
  for (std::size_t n = 1;; ++n) {
    FoundSolids found = right;
    const auto [was_thrown, has_failed] =
        call_with_failing(n, Failing::from_then_on, [&] { static_cast<void>(take_boxes(found, triangles)); });
    EXPECT_EQ(found == right, was_thrown);
    if (!has_failed) break;
  }
}

TEST(VisibilityMemory, OccludersAreWhatTheyWereWhereMemoryRunsOut) {
  Occluders right;
  for (unsigned i = 0; i != 2; ++i) {
    for (const Adding& adding : addings) adding.add(right, static_cast<float>(right.size()));
  }
  for (const Adding& adding : addings) {
    SCOPED_TRACE(adding.name);
    Occluders more = right;
    EXPECT_EQ(adding.add(more, 5), right.size());
    Occluders other = right;
    adding.add(other, 5.5F);
    for (const Failing failing : {Failing::only_one, Failing::from_then_on}) {
      for (std::size_t n = 1;; ++n) {
        SCOPED_TRACE(n);
        Occluders occluders = right;  // no vector has room for more
        const auto [was_thrown, has_failed] = call_with_failing(n, failing, [&] { adding.add(occluders, 5.5F); });
        if (was_thrown) {
          expect_same(occluders, right);
          adding.add(occluders, 5);  // elsewhere, so that nothing of the other one is at its place
          expect_same(occluders, more);
        } else {
          expect_same(occluders, other);
        }
        EXPECT_TRUE(has_failed || !was_thrown);
        if (!has_failed) {
          EXPECT_GT(n, 1U);
          break;
        }
        if (HasFailure()) return;
      }
    }
  }
}

TEST(VisibilityMemory, OccludersThatAreAddedOneByOneTakeNoMoreThanInProportion) {
  const auto bytes_of = [](const Adding& adding, std::size_t count) {
    Occluders occluders;
    const std::size_t before = allocated_bytes();
    for (std::size_t i = 0; i != count; ++i) adding.add(occluders, static_cast<float>(i));
    return allocated_bytes() - before;
  };
  for (const Adding& adding : addings) {
    const std::size_t few = bytes_of(adding, 300);
    EXPECT_GT(few, 300 * sizeof(Box)) << adding.name;
    EXPECT_LT(bytes_of(adding, 4800), 32 * few) << adding.name;  // 16 times as many; quadratic would be 256
  }
}

}  // namespace
}  // namespace shaftcull
