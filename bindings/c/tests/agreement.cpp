// SPDX-License-Identifier: MIT
/// Every query by the C interface, against the C++ one: over random scenes, of bounds of all kinds in all holders, of
/// all kinds of shafts, with each option and with all of them.
#include "agreement.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sanitizers.hpp"
#include "tree/scenes.hpp"

namespace shaftcull::agreement {
namespace {

/// Layers of so many bounds, four of them.
Indices some_layers(Random& random, std::size_t size) {
  Indices layers(size);
  for (std::uint32_t& layer : layers) layer = 1U << random.below(4);
  return layers;
}

/// No query, one that says nothing, and each option. Triangles are tested in one way, and other bounds refuse one.
std::vector<Options> each_option(Random& random, std::size_t shafts, std::size_t size, Kind kind, TriangleTest test) {
  const auto some_indices = [&](std::size_t count) {
    Indices indices(count);
    for (std::uint32_t& index : indices) index = random.below(static_cast<unsigned>(size));
    return indices;
  };
  std::vector<Options> all;
  const auto add = [&](const char* name) -> Options& {
    Options& options = all.emplace_back();
    options.name = name;
    options.test = test;
    return options;
  };
  if (test == TriangleTest::exact) add("no query").null = true;
  add("nothing");
  for (Options& options : all) options.everywhere = true;
  add("exclude").exclude = some_indices(60);
  add("exclude_each").exclude_each = some_indices(shafts * excluded_each);
  Words& mask = add("exclude_mask").exclude_mask;
  mask.resize(bit_words(size));
  for (std::size_t i = 0; i != size; ++i) {
    if (random.one_in(4)) mask[i / 64] |= std::uint64_t{1} << (i % 64);
  }
  add("a layer mask").layer_masks = {0b1011};
  Indices& masks = add("layer masks").layer_masks;
  for (std::size_t s = 0; s != shafts; ++s) masks.push_back(random.below(16));
  Indices& only = add("only").only.emplace();
  for (std::size_t i = size; i >= 3; i -= 3) only.push_back(static_cast<std::uint32_t>(i - 1));  // they descend
  add("only none").only.emplace();
  add("limit").limit = 4;
  if (test == TriangleTest::exact) add("skip_overlapping").skip_overlapping = true;
  if (kind != Kind::triangles) add("triangle_test").test = TriangleTest::vertices;
  return all;
}

/// All of these at once, with a limit and without, which some verbs refuse, and with candidates and without, which
/// others refuse. The bounds may have no layers.
std::vector<Options> all_at_once(const std::vector<Options>& each, bool have_layers) {
  Options all;
  all.everywhere = true;
  all.test = each.front().test;
  for (const Options& options : each) {
    if (!options.exclude.empty()) all.exclude = options.exclude;
    if (!options.exclude_each.empty()) all.exclude_each = options.exclude_each;
    if (!options.exclude_mask.empty()) all.exclude_mask = options.exclude_mask;
    if (have_layers && !options.layer_masks.empty()) all.layer_masks = options.layer_masks;
    if (options.only && !options.only->empty()) all.only = options.only;
  }
  std::vector<Options> several(4, all);
  several[0].name = "all but a limit";
  several[1].name = "all options";
  several[1].limit = 2;
  several[2].name = "all but a limit and candidates";
  several[2].only.reset();
  several[3].name = "all but candidates";
  several[3].only.reset();
  several[3].limit = 2;
  return several;
}

/// A view or stream: without layers, and then with each option and all of them.
template <class View>
void compare_flat(Random& random, const Shafts& shafts, shaftcull_bounds* c, const View& view, Kind kind,
                  TriangleTest test = TriangleTest::exact) {
  const std::vector<Options> each = each_option(random, shafts.cpp.size(), view.count, kind, test);
  const std::vector<Options> all = all_at_once(each, true);
  const Indices layers = some_layers(random, view.count);
  compare({shafts, c, view, kind, false}, {each[0], all[0]});
  compare({shafts, c, view, kind, false}, all_at_once(each, false));
  ok(shaftcull_bounds_set_layers(c, nullptr, layers.data(), layers.size()));
  compare({shafts, c, Bounds(view, layers), kind, true}, each);
  compare({shafts, c, Bounds(view, layers), kind, true}, all);

  Indices others = layers;
  const Indices some{3, 1, 3};
  const Indices changed{1, 2, 8};
  others[1] = 2;
  others[3] = 8;  // the last counts
  ok(shaftcull_bounds_set_layers(c, some.data(), changed.data(), 3));
  const std::uint32_t* const given = described(c).layers;
  EXPECT_EQ(Indices(given, given + view.count), others);
  const BoundsHandle copy = made<BoundsHandle>(shaftcull_bounds_copy, static_cast<const shaftcull_bounds*>(c));
  ok(shaftcull_bounds_set_layers(c, nullptr, nullptr, view.count));
  EXPECT_EQ(described(c).layers, nullptr);
  compare({shafts, copy.get(), Bounds(view, others), kind, true}, {all[0]});
}

/// A tree before and after it is updated in all ways.
template <class Bound>
void compare_trees(Random& random, const Shafts& shafts, const std::vector<Bound>& values, Kind kind) {
  const auto in_c = as_c(values);
  const shaftcull_source source = source_of(in_c);
  BoundsTree<Bound> tree{std::span<const Bound>(values)};
  const BoundsHandle bounds = made<BoundsHandle>(shaftcull_tree_create, &source);
  const std::vector<Options> each = each_option(random, shafts.cpp.size(), values.size(), kind, TriangleTest::exact);
  const std::vector<Options> all = all_at_once(each, true);
  const std::vector<Options> few{each[0], all[0], all[3]};
  const auto compare_now = [&](const std::vector<Options>& options) {
    compare({shafts, bounds.get(), tree, kind, tree.has_layers()}, options);
  };
  compare_now(few);
  compare_now(all_at_once(each, false));
  const Indices all_layers = some_layers(random, values.size());
  tree.set_layers(all_layers);
  ok(shaftcull_bounds_set_layers(bounds.get(), nullptr, all_layers.data(), all_layers.size()));
  compare_now(each);
  compare_now(all);

  std::vector<Bound> moved(values.rbegin(), values.rend());
  const auto moved_in_c = as_c(moved);
  const shaftcull_source moved_source = source_of(moved_in_c);
  tree.update(std::span<const Bound>(moved));
  ok(shaftcull_bounds_update(bounds.get(), 0, &moved_source));
  const Indices some{3, 1, 7};
  const auto three = std::vector(in_c.begin(), in_c.begin() + 3);
  const shaftcull_source three_source = source_of(three);
  tree.update(std::span<const std::uint32_t>(some), std::span(values).first(3));
  const std::uint32_t layers[] = {1, 2, 4};
  tree.set_layers(std::span<const std::uint32_t>(some), layers);
  ok(shaftcull_tree_update_some(bounds.get(), some.data(), 3, &three_source));
  ok(shaftcull_bounds_set_layers(bounds.get(), some.data(), layers, 3));
#if defined(__cpp_exceptions)  // without, errors are no statuses
  std::uint64_t number = 0;
  EXPECT_EQ(shaftcull_count(shafts.c.get(), 0, 1, bounds.get(), nullptr, &number), SHAFTCULL_NEEDS_REFIT);
#endif
  tree.refit();
  ok(shaftcull_tree_refit(bounds.get()));
  EXPECT_EQ(described(shaftcull_tree_describe, static_cast<const shaftcull_bounds*>(bounds.get())).sah_ratio,
            tree.sah_ratio());
  compare_now(few);
  tree.rebuild();
  ok(shaftcull_tree_rebuild(bounds.get()));
  tree.reorder();
  ok(shaftcull_tree_reorder(bounds.get()));
  const shaftcull_bounds_info info = described(bounds.get());
  EXPECT_TRUE(std::ranges::equal(std::span(info.layers, tree.size()), tree.layers()));
  EXPECT_TRUE(std::ranges::equal(std::span(info.order, tree.size()), tree.order()));
  EXPECT_EQ(std::bit_cast<Box>(info.box), tree.box());
  compare_now(few);
  tree.clear_layers();
  ok(shaftcull_bounds_set_layers(bounds.get(), nullptr, nullptr, tree.size()));
  EXPECT_EQ(described(bounds.get()).layers, nullptr);
  compare_now(few);
}

/// A dynamic tree, through the same changes in both languages.
template <class Bound>
void compare_dynamic_trees(Random& random, const Shafts& shafts, const std::vector<Bound>& values, Kind kind) {
  const std::uint32_t kind_in_c = kind == Kind::boxes ? SHAFTCULL_BOXES : SHAFTCULL_SPHERES;
  DynamicTree<Bound> tree;
  const BoundsHandle bounds = made<BoundsHandle>(shaftcull_dynamic_tree_create, kind_in_c, 2.0);
  const Indices layers = some_layers(random, values.size());
  const auto in_c = as_c(values);
  const shaftcull_source source = source_of(in_c);
  std::vector<BoundId> ids(values.size());
  std::vector<shaftcull_bound_id> ids_in_c(values.size());
  tree.insert(values, ids, layers);
  ok(shaftcull_dynamic_tree_insert(bounds.get(), &source, layers.data(), ids_in_c.data()));
  const std::vector<Options> each = each_option(random, shafts.cpp.size(), values.size(), kind, TriangleTest::exact);
  const auto compare_now = [&](const std::vector<Options>& options) {
    tree.commit();
    ok(shaftcull_dynamic_tree_commit(bounds.get()));
    EXPECT_EQ(described(bounds.get()).count, tree.committed().index_end());
    EXPECT_EQ(std::bit_cast<Box>(described(bounds.get()).box), tree.committed().box());
    compare({shafts, bounds.get(), tree, kind, true}, options);
  };
  compare_now(each);
  const std::vector<Options> all = all_at_once(each, true);
  const BoundsHandle snapshot =
      made<BoundsHandle>(shaftcull_bounds_copy, static_cast<const shaftcull_bounds*>(bounds.get()));
  const auto snapshot_in_cpp = tree.snapshot();
  tree.erase(std::span(ids).first(50));
  ok(shaftcull_dynamic_tree_erase(bounds.get(), ids_in_c.data(), 50));
  tree.move(std::span(ids).subspan(60, 40), std::span(values).first(40));
  const auto first = std::vector(in_c.begin(), in_c.begin() + 40);
  const shaftcull_source first_source = source_of(first);
  ok(shaftcull_dynamic_tree_move(bounds.get(), &ids_in_c[60], 40, &first_source, nullptr));
  const std::vector<Vec3> by(30, Vec3{0.5F, -1, 0});
  tree.move_by(std::span(ids).subspan(150, 30), by);
  ok(shaftcull_dynamic_tree_move(bounds.get(), &ids_in_c[150], 30, nullptr, by[0].data()));
  compare_now(all);
  compare({shafts, snapshot.get(), snapshot_in_cpp, kind, true}, all);
}

class CAgreesWithCpp : public testing::TestWithParam<Shape> {};

TEST_P(CAgreesWithCpp, OnBoxesAndSpheresInViewsStreamsAndTrees) {
  Random random(20 + static_cast<std::uint64_t>(GetParam()));
  Shafts shafts;
  make_shafts(random, shafts);
  std::vector<Box> boxes = scene<Box>(random, GetParam(), 333);
  boxes[5] = boxes[210] = {{-0.5F, -20, -20}, {0.5F, 20, 20}};  // walls, which block all shafts between two boxes
  const std::vector<Sphere> spheres = scene<Sphere>(random, GetParam(), 333);
  const BoxStream box_stream{std::span<const Box>(boxes)};
  const SphereStream sphere_stream{std::span<const Sphere>(spheres)};
  const BoundsHandle box_view = made<BoundsHandle>(shaftcull_view_create, std::uint32_t{SHAFTCULL_BOXES},
                                                   box_stream.view().stream.data(), std::uint64_t{boxes.size()});
  const BoundsHandle sphere_view =
      made<BoundsHandle>(shaftcull_view_create, std::uint32_t{SHAFTCULL_SPHERES}, sphere_stream.view().stream.data(),
                         std::uint64_t{spheres.size()});
  const std::vector<shaftcull_box> c_boxes = as_c(boxes);
  const std::vector<shaftcull_sphere> c_spheres = as_c(spheres);
  const shaftcull_source box_source = source_of(c_boxes);
  const shaftcull_source sphere_source = source_of(c_spheres);
  const BoundsHandle c_box_stream = made<BoundsHandle>(shaftcull_stream_create, &box_source);
  const BoundsHandle c_sphere_stream = made<BoundsHandle>(shaftcull_stream_create, &sphere_source);
  std::uint64_t wall = 0;
  ok(shaftcull_find_occluder(shafts.c.get(), 0, box_view.get(), nullptr, &wall));
  EXPECT_LE(wall, 5U);  // a scene may have one before it
  compare_flat(random, shafts, box_view.get(), box_stream.view(), Kind::boxes);
  compare_flat(random, shafts, c_box_stream.get(), box_stream.view(), Kind::boxes);
  compare_flat(random, shafts, sphere_view.get(), sphere_stream.view(), Kind::spheres);
  compare_flat(random, shafts, c_sphere_stream.get(), sphere_stream.view(), Kind::spheres);
  compare_trees(random, shafts, boxes, Kind::boxes);
  compare_trees(random, shafts, spheres, Kind::spheres);
  compare_dynamic_trees(random, shafts, boxes, Kind::boxes);
  compare_dynamic_trees(random, shafts, spheres, Kind::spheres);
}

TEST_P(CAgreesWithCpp, OnTriangles) {
  Random random(70 + static_cast<std::uint64_t>(GetParam()));
  Shafts shafts;
  make_shafts(random, shafts);
  std::vector<Triangle> triangles;
  for (const Box& box : scene<Box>(random, Shape::uniform, 333)) {
    triangles.push_back({{box.lo, Vec3{box.hi[0], box.lo[1], box.hi[2]}, box.hi}});
  }
  const std::vector<shaftcull_triangle> in_c = as_c(triangles);
  const shaftcull_source source = source_of(in_c);
  const TriangleStream stream{std::span<const Triangle>(triangles)};
  const TriangleTree tree{std::span<const Triangle>(triangles)};
  const BoundsHandle c_view = made<BoundsHandle>(shaftcull_view_create, std::uint32_t{SHAFTCULL_TRIANGLES},
                                                 stream.view().stream.data(), std::uint64_t{triangles.size()});
  const BoundsHandle c_stream = made<BoundsHandle>(shaftcull_stream_create, &source);
  const BoundsHandle c_tree = made<BoundsHandle>(shaftcull_tree_create, &source);
  for (const TriangleTest test : {TriangleTest::exact, TriangleTest::vertices}) {
    const bool exact = test == TriangleTest::exact;
    SCOPED_TRACE(exact ? "exact" : "by vertices");
    compare_flat(random, shafts, c_view.get(), stream.view(), Kind::triangles, test);
    compare_flat(random, shafts, c_stream.get(), stream.view(), Kind::triangles, test);
    const std::vector<Options> each = each_option(random, shafts.cpp.size(), triangles.size(), Kind::triangles, test);
    compare({shafts, c_tree.get(), tree, Kind::triangles, false}, each);  // it has no layers
    compare({shafts, c_tree.get(), tree, Kind::triangles, false}, all_at_once(each, false));
    Words inside(bit_words(triangles.size()));
    for (std::size_t s = 0; s != shafts.cpp.size(); ++s) {
      classify(shafts.cpp[s], stream, {}, inside, {.triangle_test = test});
      for (std::size_t i = 0; i < triangles.size(); i += 10) {
        shaftcull_answer answer = 99;
        ok(shaftcull_classify_one(shafts.c.get(), s, SHAFTCULL_TRIANGLES, &in_c[i],
                                  exact ? SHAFTCULL_TRIANGLES_EXACT : SHAFTCULL_TRIANGLES_BY_VERTICES, &answer));
        EXPECT_EQ(answer != SHAFTCULL_OUTSIDE, keeps(shafts.cpp[s], triangles[i], test));
        EXPECT_EQ(answer == SHAFTCULL_INSIDE, (inside[i / 64] >> (i % 64) & 1) != 0);
      }
    }
  }
}

TEST_P(CAgreesWithCpp, OnOneBoxSphereOrPolygon) {
  Random random(120 + static_cast<std::uint64_t>(GetParam()));
  Shafts shafts;
  make_shafts(random, shafts);
  const shaftcull_shafts* const c = shafts.c.get();
  for (std::size_t i = 0; i != 50; ++i) {
    const Box box = random.box(-4, 4, 0.1F, 3);
    const Sphere sphere{random.vec3(-4, 4), random.uniform(0, 2)};
    const std::vector<Vec3> polygon{box.lo, {box.hi[0], box.lo[1], box.lo[2]}, box.hi};
    const shaftcull_box c_box = as_c(box);
    const shaftcull_sphere c_sphere = as_c(sphere);
    std::vector<float> corners;
    for (const Vec3& corner : polygon) corners.insert(corners.end(), corner.begin(), corner.end());
    for (std::size_t s = 0; s != shafts.cpp.size(); ++s) {
      const CompiledShaft& shaft = shafts.cpp[s];
      shaftcull_answer answer = 99;
      ok(shaftcull_classify_one(c, s, SHAFTCULL_BOXES, &c_box, 0, &answer));
      EXPECT_EQ(static_cast<Answer>(answer), classify(shaft, box));
      ok(shaftcull_classify_one(c, s, SHAFTCULL_SPHERES, &c_sphere, 0, &answer));
      EXPECT_EQ(static_cast<Answer>(answer), classify(shaft, sphere));
      if (s >= shafts.between) continue;
      std::uint32_t hidden = 99;
      ok(shaftcull_occluded_by(c, s, reinterpret_cast<const float*>(&c_box), 2, &hidden));
      EXPECT_EQ(hidden != 0, occluded(shaft, box));
      ok(shaftcull_occluded_by(c, s, corners.data(), 3, &hidden));
      EXPECT_EQ(hidden != 0, occluded(shaft, polygon));
    }
  }
}

// With a sanitizer a few: it looks for wrong memory, which does not depend on where bounds are.
INSTANTIATE_TEST_SUITE_P(Scenes, CAgreesWithCpp,
                         testing::ValuesIn(shapes, shapes + (has_shadow_memory ? 2 : std::size(shapes))));

}  // namespace
}  // namespace shaftcull::agreement
