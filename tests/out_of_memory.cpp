// SPDX-License-Identifier: MIT
/// Memory that runs out: after std::bad_alloc every object is as it was, lists are as they were or empty, and the same
/// call made again does its work.
///
/// Every call is made with its first allocation failing, then with its second, and so on (failing_memory.hpp says which
/// allocations these are), until it succeeds; and once more with all after the first failing one failing, too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "columns.hpp"
#include "dynamic/world.hpp"
#include "failing_memory.hpp"
#include "many/workload.hpp"
#include "shaftcull/shaftcull.hpp"
#include "tree/flat.hpp"
#include "tree/scenes.hpp"
#include "tree/volumes.hpp"

namespace shaftcull {
namespace {

/// Calls `call` with a new object of make() for every allocation of it that fails, and then `check` with that object.
/// Returns how many allocations the call makes.
template <class Make, class Call, class Check>
std::size_t fail_each_allocation(const Make& make, const Call& call, const Check& check) {
  std::size_t allocations = 0;
  for (const Failing failing : {Failing::only_one, Failing::from_then_on}) {
    for (std::size_t n = 1;; ++n) {
      auto object = make();
      const auto [was_thrown, has_failed] = call_with_failing(n, failing, [&] { call(object); });
      EXPECT_EQ(was_thrown, has_failed) << "allocation " << n;
      if (!has_failed) break;
      allocations = std::max(allocations, n);
      check(object);
      if (testing::Test::HasFailure()) {
        ADD_FAILURE() << "after allocation " << n << " had failed";
        return allocations;
      }
    }
  }
  return allocations;
}

TEST(OutOfMemory, FailsHereWhereItIsToldTo) {
  std::vector<std::size_t> failed;
  const std::size_t allocations =
      fail_each_allocation([] { return 0; },
                           [](int& done) {
                             for (; done != 3; ++done) ::operator delete(::operator new(1));
                           },
                           [&](int done) { failed.push_back(static_cast<std::size_t>(done)); });
  EXPECT_EQ(allocations, 3U);
  EXPECT_EQ(failed, (std::vector<std::size_t>{0, 1, 2, 0, 1, 2}));
}

template <class View>
auto bounds_of(const View& view) {
  std::vector<std::decay_t<decltype(view[0])>> bounds;
  for (std::size_t i = 0; i != view.count; ++i) bounds.push_back(view[i]);
  return bounds;
}

/// Streams: whatever `assign` does to one of 100 bounds, if it fails they are what they were.
template <class Stream, class Bound, class Assign>
void expect_kept_by(const std::vector<Bound>& before, const Assign& assign) {
  EXPECT_GT(fail_each_allocation([&] { return Stream(before); }, assign,
                                 [&](const Stream& stream) { EXPECT_EQ(bounds_of(stream.view()), before); }),
            0U);
}

TEST(OutOfMemory, StreamsKeepTheirBounds) {
  const std::vector<Box> boxes = random_boxes(1, 100);
  const std::vector<Box> more_boxes = random_boxes(2, 1000);
  const std::vector<Box> unit_boxes(1000, Box{{0, 0, 0}, {1, 1, 1}});
  const BoxStream other_boxes(more_boxes);
  expect_kept_by<BoxStream>(boxes, [&](BoxStream& stream) { stream = other_boxes; });
  expect_kept_by<BoxStream>(boxes, [&](BoxStream& stream) { stream = BoxStream(1000); });
  expect_kept_by<BoxStream>(boxes, [&](BoxStream& stream) { stream = BoxStream(more_boxes); });
  expect_kept_by<BoxStream>(boxes, [&](BoxStream& stream) {
    stream = BoxStream(StridedCentreExtents{&unit_boxes[0].lo, &unit_boxes[0].hi, sizeof(Box), unit_boxes.size()});
  });

  const std::vector<Sphere> spheres = random_spheres(3, 100);
  const std::vector<Sphere> more_spheres = random_spheres(4, 1000);
  const SphereStream other_spheres(more_spheres);
  expect_kept_by<SphereStream>(spheres, [&](SphereStream& stream) { stream = other_spheres; });
  expect_kept_by<SphereStream>(spheres, [&](SphereStream& stream) { stream = SphereStream(1000); });
  expect_kept_by<SphereStream>(spheres, [&](SphereStream& stream) { stream = SphereStream(more_spheres); });
}

TEST(OutOfMemory, ARefusalThatFindsNoMemoryForItsMessageChangesNothing) {
  std::vector<Box> bad = random_boxes(5, 100);
  bad[50].lo[0] = bad[50].hi[0] + 1;
  expect_kept_by<BoxStream>(random_boxes(6, 100), [&](BoxStream& stream) {
    try {
      stream.update(0, bad);
    } catch (const InvalidArgument&) {
    }
  });
}

template <class Tree>
class TreeOutOfMemory : public testing::Test {
 protected:
  static constexpr std::size_t count = 5000;

  TreeOutOfMemory() {
    Random random(61);
    before_ = scene<BoundOf<Tree>>(random, Shape::uniform, count);
    after_ = scene<BoundOf<Tree>>(random, Shape::wild_sizes, count);
    for (std::uint32_t i = 0; i < count; i += 1001) {  // few enough for single nodes to be fitted
      some_.push_back(i);
      some_values_.push_back(after_[i]);
    }
    tree_ = Tree{std::span<const BoundOf<Tree>>(before_)};
    shafts_ = shafts_for(random, 40);
  }

  /// What a tree is and answers.
  struct Snapshot {
    std::vector<BoundOf<Tree>> leaves;
    std::vector<std::uint32_t> order;
    std::vector<std::uint32_t> found;
    double sah_ratio;
    friend bool operator==(const Snapshot&, const Snapshot&) = default;
  };
  [[nodiscard]] Snapshot snapshot(const Tree& tree) const {
    Snapshot now{bounds_of(tree.leaves()), {tree.order().begin(), tree.order().end()}, {}, tree.sah_ratio()};
    for (const CompiledShaft& shaft : shafts_) {
      std::vector<std::uint32_t> kept(tree.size());
      kept.resize(list(shaft, tree, std::span(kept)));
      now.found.insert(now.found.end(), kept.begin(), kept.end());
    }
    return now;
  }
  void expect_flat_answers(const Tree& tree, const std::vector<BoundOf<Tree>>& bounds) const {
    for (const CompiledShaft& shaft : shafts_) {
      std::vector<std::uint32_t> kept(tree.size());
      kept.resize(list(shaft, tree, std::span(kept)));
      ASSERT_EQ(sorted(kept), FlatAnswers(shaft, bounds).kept());
    }
  }
  /// Makes `change` of a copy of the tree, which stays as it was if it fails. Returns the number of allocations.
  template <class Change>
  std::size_t expect_unchanged_by(const Change& change) const {
    const Snapshot as_it_was = snapshot(tree_);
    return fail_each_allocation([&] { return tree_; }, change,
                                [&](const Tree& tree) {
                                  EXPECT_FALSE(tree.needs_refit());
                                  EXPECT_EQ(snapshot(tree) == as_it_was, true);
                                });
  }

  std::vector<BoundOf<Tree>> before_;
  std::vector<BoundOf<Tree>> after_;
  std::vector<std::uint32_t> some_;
  std::vector<BoundOf<Tree>> some_values_;
  std::vector<CompiledShaft> shafts_;
  Tree tree_;
};
TYPED_TEST_SUITE(TreeOutOfMemory, TreeKinds);

TYPED_TEST(TreeOutOfMemory, ATreeThatIsBuiltOrCopiedAgainStaysWhatItWas) {
  using Bound = BoundOf<TypeParam>;
  const auto records = std::span<const Bound>(this->after_);
  EXPECT_GT(this->expect_unchanged_by([&](TypeParam& tree) { tree = TypeParam{records}; }), 3U);
  const auto memory = columns(this->after_);
  EXPECT_GT(this->expect_unchanged_by([&](TypeParam& tree) { tree = TypeParam{memory.view()}; }), 3U);
  const TypeParam other{records};
  EXPECT_GT(this->expect_unchanged_by([&](TypeParam& tree) { tree = other; }), 3U);
}

TYPED_TEST(TreeOutOfMemory, LayersThatFindNoMemoryLeaveThoseThatThereAre) {
  const std::vector<std::uint32_t> before(this->count, 2);
  const std::vector<std::uint32_t> after(this->count, 4);
  const auto make = [&] {
    TypeParam tree = this->tree_;
    tree.set_layers(before);
    return tree;
  };
  const auto expect_layers = [](const TypeParam& tree, const std::vector<std::uint32_t>& layers) {
    EXPECT_TRUE(std::equal(layers.begin(), layers.end(), tree.layers().begin(), tree.layers().end()));
  };
  const auto check = [&](TypeParam& tree) {
    expect_layers(tree, before);
    tree.set_layers(after);
    expect_layers(tree, after);
  };
  EXPECT_GT(fail_each_allocation(
                make, [&](TypeParam& tree) { tree.set_layers(after); }, check),
            1U);
  EXPECT_GT(fail_each_allocation(
                make, [](TypeParam& tree) { tree.rebuild(); }, check),
            4U);
}

TYPED_TEST(TreeOutOfMemory, MovingAllocatesNothing) {
  TypeParam tree = this->tree_;
  // NOLINTNEXTLINE(clang-analyzer-cplusplus.Move): what allocates nothing is called once
  const auto move = [&](TypeParam& other) { other = std::move(tree); };
  EXPECT_EQ(fail_each_allocation([] { return TypeParam(); }, move, [](const TypeParam&) {}), 0U);
}

TYPED_TEST(TreeOutOfMemory, ARebuildThatFailsLeavesTheTree) {
  EXPECT_GT(this->expect_unchanged_by([](TypeParam& tree) { tree.rebuild(); }), 3U);
}

TYPED_TEST(TreeOutOfMemory, UpdatingAllAllocatesNothing) {
  using Bound = BoundOf<TypeParam>;
  EXPECT_EQ(this->expect_unchanged_by([&](TypeParam& tree) { tree.update(std::span<const Bound>(this->after_)); }), 0U);
}

TYPED_TEST(TreeOutOfMemory, AnUpdateOfSomeThatFailsLeavesTheTreeAndWorksTheNextTime) {
  using Bound = BoundOf<TypeParam>;
  std::vector<Bound> updated = this->before_;
  for (std::size_t i = 0; i != this->some_.size(); ++i) updated[this->some_[i]] = this->some_values_[i];
  const auto update = [&](TypeParam& tree) { tree.update(this->some_, std::span<const Bound>(this->some_values_)); };
  const auto as_it_was = this->snapshot(this->tree_);
  const auto check = [&](TypeParam& tree) {
    EXPECT_FALSE(tree.needs_refit());
    EXPECT_EQ(this->snapshot(tree) == as_it_was, true);
    update(tree);
    EXPECT_TRUE(tree.needs_refit());
    tree.refit();
    this->expect_flat_answers(tree, updated);
  };
  EXPECT_EQ(fail_each_allocation([&] { return this->tree_; }, update, check), 3U);
}

TYPED_TEST(TreeOutOfMemory, TheFirstQueryAboutCandidatesThatFailsLeavesTheTreeAndWorksTheNextTime) {
  std::vector<std::uint32_t> expected(this->some_.size());
  expected.resize(list(this->shafts_[0], TypeParam(this->tree_), std::span(expected), {.only = this->some_}));
  const auto list_some = [&](const TypeParam& tree) {
    std::vector<std::uint32_t> kept = this->some_;
    return list(this->shafts_[0], tree, std::span(kept), {.only = kept});
  };
  const std::size_t its_own = 1;
  EXPECT_EQ(fail_each_allocation([&] { return this->tree_; },
                                 [&](const TypeParam& tree) { static_cast<void>(list_some(tree)); },
                                 [&](const TypeParam& tree) { EXPECT_EQ(list_some(tree), expected.size()); }),
            2U + its_own);
}

TYPED_TEST(TreeOutOfMemory, ARefitThatFailsIsStillNeeded) {
  using Bound = BoundOf<TypeParam>;
  for (const bool updates_most : {false, true}) {
    std::vector<std::uint32_t> indices = this->some_;
    std::vector<Bound> values = this->some_values_;
    if (updates_most) {
      indices.resize(this->count);
      std::iota(indices.begin(), indices.end(), std::uint32_t{0});
      values = this->after_;
    }
    std::vector<Bound> updated = this->before_;
    for (std::size_t i = 0; i != indices.size(); ++i) updated[indices[i]] = values[i];
    const auto make = [&] {
      TypeParam tree = this->tree_;
      tree.update(indices, std::span<const Bound>(values));
      return tree;
    };
    const auto check = [&](TypeParam& tree) {
      EXPECT_TRUE(tree.needs_refit());
      EXPECT_THROW(static_cast<void>(shaftcull::count(this->shafts_[0], tree)), NeedsRefit);
      tree.refit();
      this->expect_flat_answers(tree, updated);
    };
    EXPECT_EQ(fail_each_allocation(
                  make, [](TypeParam& tree) { tree.refit(); }, check),
              0U)
        << "refit() allocates";
    TypeParam tree = make();
    tree.refit();
    this->expect_flat_answers(tree, updated);
  }
}

TYPED_TEST(TreeOutOfMemory, AnEmptyTreeStaysOne) {
  using Bound = BoundOf<TypeParam>;
  const auto check = [](const TypeParam& tree) {
    EXPECT_EQ(tree.size(), 0U);
    EXPECT_FALSE(tree.needs_refit());
  };
  const auto make = [] { return TypeParam(); };
  EXPECT_GT(fail_each_allocation(
                make, [](TypeParam& tree) { tree.update(std::span<const Bound>()); }, check),
            0U);
  fail_each_allocation(
      make, [](TypeParam& tree) { tree.rebuild(); }, check);
}

TEST(LargeTreeOutOfMemory, NoThreadOfABuildLosesTheException) {
  Random random(62);
  const std::vector<Box> boxes = scene<Box>(random, Shape::uniform, 70000);  // halved by all threads together
  with_threads(4, [&] {
    EXPECT_GT(fail_each_allocation([] { return BoxTree(); },
                                   [&](BoxTree& tree) { tree = BoxTree{std::span<const Box>(boxes)}; },
                                   [](const BoxTree& tree) { EXPECT_EQ(tree.size(), 0U); }),
              3U);
  });
}

/// Whether lists that a failed call filled are as they were, or empty.
bool are_as_before_or_empty(const IndexLists& lists, const IndexLists& before) {
  return (lists.offsets == before.offsets && lists.indices == before.indices) ||
         (lists.size() == 0 && lists.indices.empty());
}

bool are_equal(const IndexLists& one, const IndexLists& other) {
  return one.offsets == other.offsets && one.indices == other.indices;
}

/// Makes call(lists) fail at every allocation, and again without: it lists what it lists of new memory.
template <class Call>
void expect_lists_or_none(const IndexLists& before, const Call& call) {
  IndexLists expected;
  call(expected);
  EXPECT_GT(expected.offsets.back(), 0U);
  EXPECT_GT(fail_each_allocation([&] { return before; }, call,
                                 [&](IndexLists& lists) {
                                   EXPECT_EQ(are_as_before_or_empty(lists, before), true);
                                   call(lists);
                                   EXPECT_EQ(are_equal(lists, expected), true);
                                 }),
            1U);
}

/// The same for call(overlap, inside), which fills two lists.
template <class Call>
void expect_both_lists_or_none(const IndexLists& before, const Call& call) {
  auto expected = std::pair(before, before);
  call(expected.first, expected.second);
  EXPECT_GT(expected.first.offsets.back(), 0U);
  EXPECT_GT(fail_each_allocation([&] { return std::pair(before, before); },
                                 [&](auto& lists) { call(lists.first, lists.second); },
                                 [&](auto& lists) {
                                   EXPECT_EQ(are_as_before_or_empty(lists.first, before), true);
                                   EXPECT_EQ(are_as_before_or_empty(lists.second, before), true);
                                   call(lists.first, lists.second);
                                   EXPECT_EQ(are_equal(lists.first, expected.first), true);
                                   EXPECT_EQ(are_equal(lists.second, expected.second), true);
                                 }),
            1U);
}

TYPED_TEST(TreeOutOfMemory, ListsOfATreeAreAsTheyWereOrEmpty) {
  const IndexLists indices{{0, 1}, {5}};
  const Bounds tree = this->tree_;
  const Bounds view = this->tree_.leaves();
  const Query of_candidates{.only = this->tree_.order()};
  expect_lists_or_none(indices, [&](auto& lists) { list_many(this->shafts_, tree, lists); });
  expect_lists_or_none(indices, [&](auto& lists) { list_many(this->shafts_, tree, lists, {.limit = 20}); });
  expect_lists_or_none(indices, [&](auto& lists) { list_many(this->shafts_, view, lists, of_candidates); });
  expect_lists_or_none(indices, [&](auto& lists) { list_many(this->shafts_, tree, lists, of_candidates); });
  expect_both_lists_or_none(
      indices, [&](auto& overlap, auto& inside) { list_classified_many(this->shafts_, tree, overlap, inside); });
  expect_both_lists_or_none(indices, [&](auto& overlap, auto& inside) {
    list_classified_many(this->shafts_, tree, overlap, inside, of_candidates);
  });
}

TEST(ListsOutOfMemory, ListsOfAViewAreAsTheyWereOrEmpty) {
  const std::vector<CompiledShaft> shafts = random_shafts(63, 70);  // two groups
  const BoxColumns boxes(random_boxes(64, 9000));
  const SphereColumns spheres(random_spheres(65, 9000));
  const IndexLists before{{0, 1}, {5}};
  expect_lists_or_none(before, [&](auto& lists) { list_many(shafts, boxes.view(), lists); });
  expect_lists_or_none(before, [&](auto& lists) { list_many(shafts, spheres.view(), lists); });
  expect_lists_or_none(before, [&](auto& lists) { list_many(shafts, boxes.view(), lists, {.limit = 20}); });
  expect_both_lists_or_none(
      before, [&](auto& overlap, auto& inside) { list_classified_many(shafts, boxes.view(), overlap, inside); });
}

TEST(ListsOutOfMemory, ListsOfWhatBlocksAreAsTheyWereOrEmpty) {
  const std::vector<CompiledShaft> shafts(70, compile(Box{{0, 0, 0}, {1, 1, 1}}, Box{{5, 0, 0}, {6, 1, 1}}));
  std::vector<Box> boxes = random_boxes(64, 9000);
  for (std::size_t i = 0; i < boxes.size(); i += 5) boxes[i] = {{2, -1, -1}, {3, 2, 2}};
  const BoxColumns memory(boxes);
  const BoundsTree<Box> tree{std::span<const Box>(boxes)};
  const IndexLists before{{0, 1}, {5}};
  expect_lists_or_none(before, [&](auto& lists) { list_occluders_many(shafts, memory.view(), lists); });
  expect_lists_or_none(before, [&](auto& lists) { list_occluders_many(shafts, tree, lists); });
}

/// Whether a snapshot has the bounds of the model, and lists those that a shaft keeps.
template <class Bound>
void expect_answers(const TreeSnapshot<Bound>& snapshot, const Model<Bound>& model) {
  expect_same_bounds(snapshot, model);
  const CompiledShaft shaft = compile({{-5, -5, -5}, {-5, 5, 1}}, {{5, -5, -5}, {5, 1, 5}});
  const auto memory = columns(model.bounds);
  Indices list_of[2];
  list(shaft, snapshot, list_of[0]);
  list(shaft, memory.view(), list_of[1]);
  EXPECT_EQ(sorted(list_of[0]), list_of[1]);
}

/// Changes of a dynamic tree: whichever allocation fails, the tree, its changes and its snapshots are as they were, and
/// the same call made again does its work. `holds_snapshot`: blocks are copied before they are changed.
template <class Bound>
void expect_dynamic_tree_kept(bool holds_snapshot, const Changes& first, const Changes& then) {
  struct Object {
    World<Bound> world{70};
    Model<Bound> committed;
    TreeSnapshot<Bound> held;
  };
  const auto make = [&] {
    Object object;
    object.world.change(first);
    object.world.tree.commit();
    object.committed = object.world.model;
    object.world.change(then);
    if (holds_snapshot) object.held = object.world.tree.snapshot();
    return object;
  };
  EXPECT_GT(fail_each_allocation(
                make, [](Object& object) { object.world.tree.commit(); },
                [&](Object& object) {
                  expect_answers(object.world.tree.committed(), object.committed);
                  EXPECT_EQ(object.world.tree.bound_count(), object.world.model.count());
                  object.world.tree.commit();
                  expect_answers(object.world.tree.committed(), object.world.model);
                  if (holds_snapshot) expect_answers(object.held, object.committed);
                }),
            3U);
}

template <class Bound>
class DynamicOutOfMemory : public testing::Test {};
TYPED_TEST_SUITE(DynamicOutOfMemory, DynamicKinds);

TYPED_TEST(DynamicOutOfMemory, CommitsAreMadeOrNot) {
  for (const bool holds_snapshot : {false, true}) {
    // Everything is sorted; some of two blocks is changed; bounds get layers; blocks are too full, and are split.
    expect_dynamic_tree_kept<TypeParam>(holds_snapshot, {.count = 0}, {.count = 300, .insertions = 10});
    expect_dynamic_tree_kept<TypeParam>(holds_snapshot, {.count = 5000, .insertions = 10}, {.count = 60});
    expect_dynamic_tree_kept<TypeParam>(holds_snapshot, {.count = 8190, .insertions = 10},  // then a new page of places
                                        {.count = 40, .insertions = 10});
    expect_dynamic_tree_kept<TypeParam>(holds_snapshot, {.count = 5000, .insertions = 10},
                                        {.count = 60, .layers = true});
    expect_dynamic_tree_kept<TypeParam>(holds_snapshot, {.count = 7400, .insertions = 10},
                                        {.count = 1500, .insertions = 10});
  }
}

TYPED_TEST(DynamicOutOfMemory, ImagesAreWrittenAndReadOrNot) {
  using Tree = DynamicTree<TypeParam>;
  struct Object {
    World<TypeParam> world{71};
    std::vector<std::byte> image;
    Tree read;
  };
  const auto make = [] {
    Object object;
    object.world.change({.count = 6000, .insertions = 8});
    object.world.tree.commit();
    object.image.resize(image_bytes(object.world.tree));
    return object;
  };
  const auto write_and_read = [](Object& object) {
    write_image(object.world.tree, object.image);
    object.read = dynamic_tree_from_image<Tree>(object.image);
  };
  EXPECT_GT(fail_each_allocation(make, write_and_read,
                                 [&](Object& object) {
                                   EXPECT_EQ(object.read.bound_count(), 0U);
                                   expect_answers(object.world.tree.committed(), object.world.model);
                                   write_and_read(object);
                                   expect_answers(object.read.committed(), object.world.model);
                                 }),
            20U);
}

TYPED_TEST(DynamicOutOfMemory, ChangesAreMadeOrNot) {
  const auto make = [] {
    World<TypeParam> world(72);
    world.change({.count = 2000, .insertions = 10});
    world.tree.commit();
    world.tree.commit();  // which keeps no memory for changes
    return world;
  };
  Random random(73);
  const std::vector<TypeParam> bounds = scene<TypeParam>(random, Shape::uniform, 3000);
  const auto unchanged = [&](World<TypeParam>& world) {
    EXPECT_EQ(world.tree.bound_count(), world.model.count());
    for (const BoundId id : world.model.ids) {
      EXPECT_EQ(world.tree.has(id), true);
      EXPECT_EQ(world.tree[id], world.model.bounds[id.index]);
    }
    world.tree.commit();
    expect_equal(world.tree.committed(), world.model, random);
  };
  const auto expect_kept_by_each = [&](const auto& change) {
    EXPECT_GT(fail_each_allocation(make, change, unchanged), 0U);
  };
  std::vector<BoundId> ids(bounds.size());
  expect_kept_by_each([&](World<TypeParam>& world) { world.tree.insert(bounds, ids); });
  expect_kept_by_each([&](World<TypeParam>& world) { world.tree.erase(world.model.ids); });
  expect_kept_by_each(
      [&](World<TypeParam>& world) { world.tree.move(world.model.ids, std::span(bounds).first(2000)); });
  const std::vector<Vec3> by(2000, Vec3{1, 0, 0});
  expect_kept_by_each([&](World<TypeParam>& world) { world.tree.move_by(world.model.ids, by); });
}

std::vector<Triangle> random_triangles(std::uint64_t seed, std::size_t count) {
  std::vector<Triangle> triangles;
  for (const Box& box : random_boxes(seed, count)) {
    triangles.push_back({{box.lo, Vec3{box.hi[0], box.lo[1], box.hi[2]}, box.hi}});
  }
  return triangles;
}

TEST(TrianglesOutOfMemory, StreamsAndTreesStayWhatTheyWere) {
  const std::vector<Triangle> triangles = random_triangles(67, 100);
  const std::vector<Triangle> more = random_triangles(68, 1000);
  const TriangleStream others(more);
  expect_kept_by<TriangleStream>(triangles, [&](TriangleStream& stream) { stream = others; });
  expect_kept_by<TriangleStream>(triangles, [&](TriangleStream& stream) { stream = TriangleStream(more); });

  const TriangleTree tree{std::span<const Triangle>(triangles)};
  const TriangleTree other_tree{std::span<const Triangle>(more)};
  const auto expect_unchanged_by = [&](const auto& change) {
    EXPECT_GT(fail_each_allocation([&] { return TriangleTree(tree); }, change,
                                   [&](const TriangleTree& now) {
                                     EXPECT_EQ(bounds_of(now.triangles()), bounds_of(tree.triangles()));
                                     EXPECT_TRUE(std::equal(now.order().begin(), now.order().end(),
                                                            tree.order().begin(), tree.order().end()));
                                   }),
              0U);
  };
  expect_unchanged_by([&](TriangleTree& now) { now = other_tree; });
  expect_unchanged_by([&](TriangleTree& now) { now = TriangleTree(std::span<const Triangle>(more)); });
  const std::span<const Triangle> others_now = std::span(more).first(triangles.size());
  const std::uint32_t some[] = {7, 99, 3};
  expect_unchanged_by([&](TriangleTree& now) { now.update(others_now); });
  expect_unchanged_by([&](TriangleTree& now) { now.update(some, others_now.first(3)); });
  expect_unchanged_by([&](TriangleTree& now) { now.rebuild(); });
}

TEST(TrianglesOutOfMemory, ListsAreAsTheyWereOrEmpty) {
  const std::vector<CompiledShaft> shafts = random_shafts(69, 70);
  const std::vector<Triangle> triangles = random_triangles(70, 9000);
  const TriangleColumns memory(triangles);
  const TriangleTree tree{std::span<const Triangle>(triangles)};
  const IndexLists before{{0, 1}, {5}};
  expect_lists_or_none(before, [&](auto& lists) { list_many(shafts, memory.view(), lists); });
  expect_lists_or_none(before, [&](auto& lists) { list_many(shafts, tree, lists); });
  expect_both_lists_or_none(
      before, [&](auto& overlap, auto& inside) { list_classified_many(shafts, memory.view(), overlap, inside); });
  expect_both_lists_or_none(before,
                            [&](auto& overlap, auto& inside) { list_classified_many(shafts, tree, overlap, inside); });
}

TYPED_TEST(TreeOutOfMemory, BitsAndNumbersOfCandidatesAreRightTheNextTime) {
  const Query query{.only = this->some_};
  const std::size_t words = this->shafts_.size() * bit_words(this->count);
  std::vector<std::uint64_t> right(words);
  cull_many(this->shafts_, TypeParam(this->tree_), right, query);
  std::vector<std::uint64_t> right_counts(this->shafts_.size());
  count_many(this->shafts_, TypeParam(this->tree_), right_counts, query);
  std::vector<std::uint64_t> kept(words);
  std::vector<std::uint64_t> counts(this->shafts_.size());
  const auto ask = [&](const TypeParam& tree) {
    cull_many(this->shafts_, tree, kept, query);
    count_many(this->shafts_, tree, counts, query);
  };
  EXPECT_GT(fail_each_allocation([&] { return this->tree_; }, ask,
                                 [&](const TypeParam& tree) {
                                   ask(tree);
                                   EXPECT_EQ(kept == right, true);
                                   EXPECT_EQ(counts, right_counts);
                                 }),
            0U);
}

TEST(ListsOutOfMemory, AVectorThatFindsNoMemoryIsListedIntoTheNextTime) {
  const CompiledShaft shaft = compile({{-5, -5, -5}, {0, 0, 0}}, {{0, 0, 0}, {5, 2, 2}});
  const BoxColumns boxes(random_boxes(64, 9000));
  std::vector<std::uint32_t> right;
  ASSERT_GT(list(shaft, boxes.view(), right), 300U) << "more than there is room for at first";
  const auto call = [&](std::vector<std::uint32_t>& kept) { list(shaft, boxes.view(), kept); };
  EXPECT_GT(fail_each_allocation([] { return std::vector<std::uint32_t>(); }, call,
                                 [&](std::vector<std::uint32_t>& kept) {
                                   call(kept);
                                   EXPECT_EQ(kept, right);
                                 }),
            1U);
}

}  // namespace
}  // namespace shaftcull
