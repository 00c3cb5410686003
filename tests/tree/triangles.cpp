// SPDX-License-Identifier: MIT
/// Trees of triangles: they answer what a scan of the same triangles answers.
#include "shaftcull/triangles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "columns.hpp"
#include "instruction_sets.hpp"
#include "message_of.hpp"
#include "oracle/cases/triangles.hpp"
#include "sanitizers.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/geometry.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/tree.hpp"
#include "shaftcull/tree_image.hpp"
#include "shaftcull/volumes.hpp"

namespace shaftcull {
namespace {

constexpr TriangleTest tests[] = {TriangleTest::vertices, TriangleTest::exact};

/// Triangles all over a scene, or those of a surface, next to each other.
std::vector<Triangle> triangles_of(Random& random, std::size_t count) {
  std::vector<Triangle> triangles;
  if (random.one_in(2)) {
    while (triangles.size() != count) triangles.push_back(grid_triangle(random, -9, 9));
    return triangles;
  }
  const auto side = static_cast<std::size_t>(std::max(1.0F, std::sqrt(static_cast<float>(count) / 2)));
  const auto at = [&](std::size_t i, std::size_t j) {
    const float x = 20 * static_cast<float>(i) / static_cast<float>(side) - 10;
    const float y = 20 * static_cast<float>(j) / static_cast<float>(side) - 10;
    return Vec3{x, y, 0.03F * x * y - 0.02F * x * x};
  };
  for (std::size_t i = 0; triangles.size() < count; ++i) {
    const std::size_t row = i / side;
    triangles.push_back({{{at(row, i % side), at(row + 1, i % side), at(row, i % side + 1)}}});
    if (triangles.size() == count) break;
    triangles.push_back({{{at(row + 1, i % side), at(row + 1, i % side + 1), at(row, i % side + 1)}}});
  }
  std::vector<Triangle> shuffled;
  for (std::size_t left = triangles.size(); left != 0; --left) {
    std::swap(triangles[random.below(static_cast<unsigned>(left))], triangles[left - 1]);
    shuffled.push_back(triangles[left - 1]);
  }
  return shuffled;
}

std::vector<CompiledShaft> shafts_for(Random& random) {
  std::vector<CompiledShaft> shafts;
  for (int s = 0; s != 10; ++s) {
    shafts.push_back(compile(random.box(-8, 8, 0, 0.6F), random.box(-8, 8, 0, 0.6F)));
    const Plane plane{{1, 2, 3}, 4};
    const Box a = random.grid_box(-9, 9);
    const Box b = random.grid_box(-9, 9);
    shafts.push_back(compile(a, b, std::span(&plane, random.one_in(2) ? 1 : 0)));
  }
  for (int s = 0; s != 10; ++s) {  // flat ones that triangles lie in, or touch
    Box a = random.grid_box(-9, 9);
    Box b = random.grid_box(-9, 9);
    const std::size_t k = random.below(3);
    if (s % 2 == 0) a.hi[k] = b.lo[k] = b.hi[k] = a.lo[k];
    shafts.push_back(compile(a, b, Contact::open));
  }
  shafts.push_back(swept_infinite(random.grid_box(-2, 2), {1, 0.25F, 0}));
  set_contact(shafts.back(), Contact::open);
  shafts.push_back(compile({{-99, -99, -99}, {99, 99, 99}}, {{-90, -99, -99}, {99, 99, 99}}));  // all is inside
  return shafts;
}

std::vector<std::uint32_t> sorted(std::vector<std::uint32_t> indices) {
  std::sort(indices.begin(), indices.end());
  return indices;
}

TEST(TriangleTree, AnswersWhatAScanAnswers) {
  Random random(840);
  std::size_t kept_in_all = 0;
  for (const std::size_t count :
       {0U, 1U, 31U, 32U, 33U, 64U, 65U, 2047U, 2048U, 2049U, 4095U, 6139U, 9000U,
        98299U}) {  // 48 words of chunks, one of which is short: a node of nodes that is inside
    const std::vector<Triangle> triangles = triangles_of(random, count);
    const TriangleColumns memory(triangles);
    const TriangleTree tree{std::span<const Triangle>(triangles)};
    ASSERT_EQ(tree.size(), count);
    std::vector<CompiledShaft> shafts = shafts_for(random);
    if (count > (has_shadow_memory ? 2000U : 10000U)) {  // a few of all sorts: sanitizers take a second a shaft
      const std::size_t few = has_shadow_memory ? 3 : 6;
      for (std::size_t s = 0; s != few; ++s) shafts[s] = shafts[shafts.size() - 1 - 5 * s];
      shafts.resize(few);
    }
    shafts.push_back(compile({{-99, -99, -99}, {99, 99, 99}}, {{-99, -99, -99}, {99, 99, 99}}));
    for (const Isa isa : isas_under_test()) {
      const UseIsa use(isa);
      for (const TriangleTest test : tests) {
        SCOPED_TRACE(std::string(name(isa)) + ", " + std::to_string(count) + " triangles");
        const Query query{.triangle_test = test};
        std::vector<std::uint64_t> rows(shafts.size() * bit_words(count), 0x5555);
        cull_many(shafts, tree, rows, query);
        std::vector<std::uint64_t> flat_rows(rows.size());
        cull_many(shafts, memory.view(), flat_rows, query);
        EXPECT_EQ(rows, flat_rows);
        std::vector<std::uint64_t> inside_rows(rows.size(), 0x5555);
        std::vector<std::uint64_t> flat_inside_rows(rows.size());
        classify_many(shafts, tree, flat_rows, inside_rows, query);
        EXPECT_EQ(rows, flat_rows) << "classify_many() keeps other triangles";
        classify_many(shafts, memory.view(), {}, flat_inside_rows, query);
        EXPECT_EQ(inside_rows, flat_inside_rows);
        std::vector<KeptCounts> classified(shafts.size());
        count_classified_many(shafts, tree, classified, query);
        std::vector<std::uint64_t> counts(shafts.size(), 5);
        count_many(shafts, tree, counts, query);
        std::vector<std::uint64_t> any_bits(bit_words(shafts.size()), 5);
        any_many(shafts, tree, any_bits, query);
        IndexLists lists;
        list_many(shafts, tree, lists, query);
        ASSERT_EQ(lists.size(), shafts.size());
        for (std::size_t s = 0; s != shafts.size(); ++s) {
          std::vector<std::uint32_t> expected(count);
          expected.resize(list(shafts[s], memory.view(), std::span(expected), query));
          kept_in_all += expected.size();
          std::vector<std::uint32_t> listed(count);
          listed.resize(list(shafts[s], tree, std::span(listed), query));
          EXPECT_TRUE(std::equal(listed.begin(), listed.end(), lists[s].begin(), lists[s].end()));
          EXPECT_EQ(sorted(listed), expected);
          EXPECT_EQ(shaftcull::count(shafts[s], tree, query), expected.size());
          EXPECT_EQ(counts[s], expected.size());
          EXPECT_EQ(any(shafts[s], tree, query), !expected.empty());
          EXPECT_EQ((any_bits[s / 64] >> s % 64 & 1) != 0, !expected.empty());
          std::vector<std::uint64_t> kept(bit_words(count), 0x5555);
          cull(shafts[s], tree, kept, query);
          EXPECT_TRUE(std::equal(kept.begin(), kept.end(), rows.begin() + static_cast<int>(s * kept.size())));
          classify(shafts[s], tree, {}, kept, query);
          EXPECT_TRUE(std::equal(kept.begin(), kept.end(), inside_rows.begin() + static_cast<int>(s * kept.size())));
          const std::size_t insides = BitView(kept).count();
          EXPECT_EQ(classified[s], (KeptCounts{expected.size() - insides, insides}));
          EXPECT_EQ(count_classified(shafts[s], tree, query), classified[s]);
        }
      }
    }
  }
  EXPECT_GT(kept_in_all, 100000U);
}

TEST(TriangleTree, ListsAreInTreeOrder) {
  Random random(841);
  const TriangleTree tree{std::span<const Triangle>(triangles_of(random, 5000))};
  std::vector<std::size_t> place(tree.size());
  for (std::size_t p = 0; p != tree.size(); ++p) place[tree.order()[p]] = p;
  for (const CompiledShaft& shaft : shafts_for(random)) {
    std::vector<std::uint32_t> listed(tree.size());
    listed.resize(list(shaft, tree, std::span(listed)));
    EXPECT_TRUE(std::is_sorted(listed.begin(), listed.end(), [&](auto i, auto j) { return place[i] < place[j]; }));
  }
}

TEST(TriangleTree, HoldsEachTriangleOnceByItsIndex) {
  Random random(842);
  for (const std::size_t count : {1U, 40U, 777U, 12345U}) {
    const std::vector<Triangle> triangles = triangles_of(random, count);
    const TriangleTree tree{std::span<const Triangle>(triangles)};
    std::vector<std::uint32_t> order(tree.order().begin(), tree.order().end());
    ASSERT_EQ(order.size(), count);
    for (std::size_t p = 0; p != count; ++p) EXPECT_EQ(tree.triangles()[p], triangles[order[p]]);
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0U);
    EXPECT_EQ(sorted(order), all);
    Box around{triangles[0].vertex[0], triangles[0].vertex[0]};
    for (const Triangle& triangle : triangles) {
      for (const Vec3& vertex : triangle.vertex) {
        for (std::size_t k = 0; k != 3; ++k) {
          around.lo[k] = std::min(around.lo[k], vertex[k]);
          around.hi[k] = std::max(around.hi[k], vertex[k]);
        }
      }
    }
    EXPECT_EQ(tree.box(), around);
    EXPECT_GE(tree.memory_bytes(), count * (sizeof(Triangle) + sizeof(std::uint32_t)));
  }
}

TEST(TriangleTree, AMeshIsTheTrianglesThatItsIndicesName) {
  Random random(843);
  struct Vertex {
    float weight;
    Vec3 at;
  };
  std::vector<Vertex> vertices;
  for (int v = 0; v != 50; ++v) vertices.push_back({1, random.vec3(-5, 5)});
  std::vector<std::uint32_t> indices;
  std::vector<Triangle> triangles;
  for (int i = 0; i != 300; ++i) {
    Triangle triangle{};
    for (Vec3& vertex : triangle.vertex) {
      indices.push_back(random.below(50));
      vertex = vertices[indices.back()].at;
    }
    triangles.push_back(triangle);
  }
  const MeshView mesh{&vertices[0].at, sizeof(Vertex), vertices.size(), indices};
  const TriangleTree of_mesh(mesh);
  const TriangleTree of_array{std::span<const Triangle>(triangles)};
  const TriangleTree of_view(TriangleColumns(triangles).view());
  for (const CompiledShaft& shaft : shafts_for(random)) {
    std::vector<std::uint32_t> expected(triangles.size());
    expected.resize(list(shaft, of_array, expected));
    for (const TriangleTree* tree : {&of_mesh, &of_view}) {
      std::vector<std::uint32_t> listed(triangles.size());
      listed.resize(list(shaft, *tree, listed));
      EXPECT_EQ(listed, expected);
    }
  }
}

TEST(TriangleTree, IsCopiedAndMovedAsAValue) {
  Random random(844);
  const TriangleTree tree{std::span<const Triangle>(triangles_of(random, 500))};
  TriangleTree copy(tree);
  TriangleTree moved(std::move(copy));
  EXPECT_EQ(moved.size(), 500U);
  copy = moved;
  moved = TriangleTree();
  EXPECT_EQ(moved.size(), 0U);
  EXPECT_EQ(moved.triangles().count, 0U);
  EXPECT_EQ(moved.memory_bytes(), 0U);
  EXPECT_EQ(moved.box(), BoxTree().box());
  for (const CompiledShaft& shaft : shafts_for(random)) {
    EXPECT_EQ(count(shaft, copy), count(shaft, tree));
    EXPECT_EQ(count(shaft, moved), 0U);
    EXPECT_FALSE(any(shaft, moved));
  }
}

/// Whether a tree answers as a view of the triangles, with both tests.
void expect_answers_of(const TriangleTree& tree, const std::vector<Triangle>& triangles, Random& random) {
  const TriangleColumns memory(triangles);
  Box around = TriangleTree().box();  // empty
  for (const Triangle& triangle : triangles) around = joined(around, box_around(triangle.vertex));
  EXPECT_EQ(tree.box(), around);
  for (const CompiledShaft& shaft : shafts_for(random)) {
    for (const TriangleTest test : tests) {
      const Query query{.triangle_test = test};
      std::vector<std::uint32_t> of_tree;
      std::vector<std::uint32_t> of_view;
      list(shaft, tree, of_tree, query);
      list(shaft, memory.view(), of_view, query);
      EXPECT_EQ(sorted(of_tree), of_view);
      EXPECT_EQ(count_classified(shaft, tree, query), count_classified(shaft, memory.view(), query));
    }
  }
}

TEST(TriangleTree, AnswersForTrianglesThatWereUpdated) {
  Random random(860);
  for (const std::size_t count : {0U, 1U, 31U, 32U, 33U, 100U, 2049U, 6139U}) {
    if (has_shadow_memory && count == 6139) continue;
    SCOPED_TRACE(std::to_string(count) + " triangles");
    TriangleTree tree{std::span<const Triangle>(triangles_of(random, count))};
    std::vector<Triangle> now;
    for (int way = 0; way != 3; ++way) {
      now = triangles_of(random, count);
      if (way == 0) tree.update(std::span<const Triangle>(now));
      if (way == 1) tree.update(TriangleColumns(now).view());
      if (way == 2) {
        std::vector<Vec3> vertices;
        for (const Triangle& triangle : now)
          vertices.insert(vertices.end(), triangle.vertex.begin(), triangle.vertex.end());
        std::vector<std::uint32_t> indices(vertices.size());
        std::iota(indices.begin(), indices.end(), 0U);
        tree.update(mesh_view(vertices, indices));
      }
      expect_answers_of(tree, now, random);
    }
    if (count == 0) continue;
    for (const std::size_t some : {std::size_t{1}, count / 2, 2 * count}) {
      std::vector<std::uint32_t> indices;
      const std::vector<Triangle> others = triangles_of(random, some);
      for (std::size_t i = 0; i != some; ++i) {
        indices.push_back(random.below(static_cast<unsigned>(count)));
        now[indices.back()] = others[i];  // the last one counts
      }
      tree.update(std::span<const std::uint32_t>(indices), std::span<const Triangle>(others));
      EXPECT_EQ(tree.needs_refit(), some != 0);
      tree.refit();
      EXPECT_FALSE(tree.needs_refit());
      expect_answers_of(tree, now, random);
    }
    const TriangleTree copy(tree);
    tree.rebuild();
    EXPECT_EQ(tree.sah_ratio(), 1);
    const TriangleTree fresh{std::span<const Triangle>(now)};
    EXPECT_TRUE(std::ranges::equal(tree.order(), fresh.order()));
    expect_answers_of(tree, now, random);
    expect_answers_of(copy, now, random);
    std::vector<Triangle> reordered;
    for (const std::uint32_t index : tree.order()) reordered.push_back(now[index]);
    tree.reorder();
    expect_answers_of(tree, reordered, random);
    const std::uint32_t last = static_cast<std::uint32_t>(count - 1);
    tree.update(std::span(&last, 1), std::span<const Triangle>(now).first(1));
    reordered[last] = now[0];
    tree.refit();
    expect_answers_of(tree, reordered, random);
  }
}

TEST(TriangleTree, GrowsWithWhatItsTrianglesDo) {
  std::vector<Triangle> triangles;
  for (int i = 0; i != 640; ++i) {
    const auto x = static_cast<float>(i);
    triangles.push_back({{{{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}}}});
  }
  TriangleTree tree{std::span<const Triangle>(triangles)};
  EXPECT_EQ(tree.sah_ratio(), 1);
  for (Triangle& triangle : triangles) {
    for (Vec3& vertex : triangle.vertex) vertex[1] *= 4;
  }
  tree.update(std::span<const Triangle>(triangles));
  EXPECT_EQ(tree.sah_ratio(), 4);
  tree.rebuild();
  EXPECT_EQ(tree.sah_ratio(), 1);
}

TEST(TriangleTree, RefusesUpdatesThatItCannotUseAndQueriesBeforeARefit) {
  const std::vector<Triangle> triangles(100, Triangle{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}});
  TriangleTree tree{std::span<const Triangle>(triangles)};
  const std::span<const Triangle> all(triangles);
  const CompiledShaft shaft = compile({{-1, -1, -1}, {0, 0, 0}}, {{1, 1, 0}, {2, 2, 1}});
  const std::uint32_t some[] = {5, 100};
  EXPECT_THAT(message_of([&] { tree.update(all.first(99)); }),
              testing::HasSubstr("update of a tree of 100 triangles got 99"));
  EXPECT_THAT(message_of([&] { tree.update(some, all.first(2)); }), testing::HasSubstr("indices[1] = 100"));
  EXPECT_THAT(message_of([&] { tree.update(std::span(some).first(1), all.first(2)); }),
              testing::HasSubstr("1 index and 2 triangles"));
  std::vector<Triangle> bad(triangles);
  bad[7].vertex[1][2] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(tree.update(std::span<const Triangle>(bad)), BadBound);
  EXPECT_THROW(tree.update(std::span(some).first(1), std::span<const Triangle>(bad).subspan(7, 1)), BadBound);
  EXPECT_FALSE(tree.needs_refit());
  EXPECT_EQ(count(shaft, tree), 100U);
  EXPECT_EQ(tree.sah_ratio(), 1);

  tree.update(std::span(some).first(1), all.first(1));
  EXPECT_THROW((void)count(shaft, tree), NeedsRefit);
  EXPECT_THROW((void)tree.box(), NeedsRefit);
  EXPECT_THROW((void)tree.sah_ratio(), NeedsRefit);
  EXPECT_THROW((void)image_bytes(tree), NeedsRefit);
  tree.refit();
  EXPECT_EQ(count(shaft, tree), 100U);
  tree.update(tree.triangles());  // its own memory is copied first
  EXPECT_EQ(count(shaft, tree), 100U);
  TriangleTree nothing;
  nothing.update(all.first(0));
  nothing.rebuild();
  nothing.reorder();
  nothing.refit();
  EXPECT_EQ(nothing.sah_ratio(), 1);
  EXPECT_THROW(nothing.update(all), InvalidArgument);
}

TEST(TriangleTree, RefusesWhatItCannotUse) {
  std::vector<Triangle> triangles(40, Triangle{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}});
  const TriangleTree tree{std::span<const Triangle>(triangles)};
  triangles[33].vertex[2][1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(message_of<BadBound>([&] { (void)TriangleTree(std::span<const Triangle>(triangles)); }),
              testing::HasSubstr("triangle 33: vertex 2 has y = nan; vertices must be finite"));
  const ConvexHull hull(std::vector<Vec3>{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}});
  EXPECT_EQ(count(hull, tree, {.triangle_test = TriangleTest::vertices}), 40U);
  EXPECT_EQ(count(hull, tree), 40U);
  std::vector<std::uint64_t> kept(2, 7);
  const CompiledShaft shaft = compile(Box{{0, 0, 0}, {1, 1, 1}}, Box{{5, 0, 0}, {6, 1, 1}});
  EXPECT_THAT(message_of([&] { cull(shaft, tree, kept); }), testing::HasSubstr("kept has 2 words"));
  EXPECT_THAT(message_of([&] { (void)any(CompiledShaft(), tree); }), testing::HasSubstr("never formed"));
  EXPECT_THAT(message_of([&] { (void)any(shaft, tree, {.triangle_test = static_cast<TriangleTest>(2)}); }),
              testing::HasSubstr("test = 2 is neither"));
  EXPECT_EQ(kept, std::vector<std::uint64_t>(2, 7));
}

}  // namespace
}  // namespace shaftcull
