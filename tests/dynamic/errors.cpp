// SPDX-License-Identifier: MIT
/// What dynamic trees refuse, and what they say. Nothing is changed by it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "caught.hpp"
#include "dynamic/world.hpp"
#include "float_modes.hpp"
#include "message_of.hpp"

namespace shaftcull {
namespace {

using testing::HasSubstr;

template <class Bound>
class DynamicErrors : public testing::Test {
 protected:
  DynamicErrors() : world_(20) {
    world_.change({.count = 300, .insertions = 7});
    world_.tree.commit();
    world_.change({.count = 50});
    const std::uint32_t erased = some(true);
    world_.tree.erase(world_.model.ids[erased]);
    world_.model.erase(erased);
  }
  ~DynamicErrors() override {
    EXPECT_EQ(world_.tree.bound_count(), world_.model.count());
    world_.tree.commit();
    expect_equal(world_.tree.committed(), world_.model, world_.random());
  }
  [[nodiscard]] std::uint32_t some(bool with_bound) const {
    std::uint32_t index = 0;
    while ((world_.model.has_bound[index] != 0) != with_bound) ++index;
    return index;
  }
  World<Bound> world_;
};
TYPED_TEST_SUITE(DynamicErrors, DynamicKinds);

TYPED_TEST(DynamicErrors, AnIdOfAnErasedBoundIsNoneOfAnother) {
  auto& tree = this->world_.tree;
  const TypeParam bound = scene<TypeParam>(this->world_.random(), Shape::uniform, 1).front();
  const BoundId stale = this->world_.model.ids[this->some(false)];
  const BoundId unknown{100000, 0};
  const std::string erased =
      "index " + std::to_string(stale.index) + " of generation " + std::to_string(stale.generation) + ", was erased";
  EXPECT_THAT(message_of<InvalidArgument>([&] { tree.erase(stale); }), HasSubstr(erased));
  EXPECT_THAT(message_of<InvalidArgument>([&] { tree.move(stale, bound); }), HasSubstr(erased));
  EXPECT_THAT(message_of<InvalidArgument>([&] { tree.move_by(stale, {1, 0, 0}); }), HasSubstr(erased));
  EXPECT_THAT(message_of<InvalidArgument>([&] { tree.set_layers(stale, 1); }), HasSubstr(erased));
  EXPECT_THAT(message_of<InvalidArgument>([&] { (void)tree[stale]; }), HasSubstr(erased));
  EXPECT_THAT(message_of<InvalidArgument>([&] { tree.erase(unknown); }), HasSubstr("is no id of this tree"));
  EXPECT_THAT(message_of<InvalidArgument>([&] { tree.erase(BoundId{}); }), HasSubstr("is no id of this tree"));
  const BoundId future{stale.index, stale.generation + 9};
  EXPECT_THAT(message_of<InvalidArgument>([&] { tree.erase(future); }), HasSubstr("is no id of this tree"));
  EXPECT_FALSE(tree.has(stale));
  EXPECT_EQ(tree.id_of(100000), BoundId{});
  // The index is used again, and the id is another one.
  const BoundId next = tree.insert(bound);
  this->world_.model.insert(next, bound, all_layers);
  EXPECT_FALSE(tree.has(stale));
  EXPECT_TRUE(tree.has(next));
}

TYPED_TEST(DynamicErrors, OneBadIdAmongManyLeavesAllAsTheyAre) {
  auto& tree = this->world_.tree;
  std::vector<BoundId> ids;
  for (std::uint32_t i = 0; i != this->world_.model.bounds.size(); ++i) {
    if (this->world_.model.has_bound[i] != 0) ids.push_back(this->world_.model.ids[i]);
  }
  std::vector<BoundId> twice = ids;
  twice.push_back(ids.front());
  EXPECT_THAT(
      message_of<InvalidArgument>([&] { tree.erase(twice); }),
      HasSubstr("ids[" + std::to_string(ids.size()) + "], index " + std::to_string(ids[0].index) + ", occurs twice"));
  EXPECT_THAT(message_of<InvalidArgument>([&] { tree.move_by(twice, std::vector<Vec3>(twice.size())); }),
              HasSubstr("occurs twice"));
  std::vector<BoundId> stale = ids;
  stale.push_back(this->world_.model.ids[this->some(false)]);
  const std::vector<TypeParam> bounds = scene<TypeParam>(this->world_.random(), Shape::uniform, stale.size());
  const std::string name = "ids[" + std::to_string(ids.size()) + "]";
  EXPECT_THAT(message_of<InvalidArgument>([&] { tree.erase(stale); }), HasSubstr(name));
  EXPECT_THAT(message_of<InvalidArgument>([&] { tree.move(stale, bounds); }), HasSubstr(name));
  EXPECT_THAT(message_of<InvalidArgument>([&] { tree.move_by(stale, std::vector<Vec3>(stale.size())); }),
              HasSubstr(name));
}

TYPED_TEST(DynamicErrors, BadBoundsAreNamed) {
  auto& tree = this->world_.tree;
  std::vector<TypeParam> bounds = scene<TypeParam>(this->world_.random(), Shape::uniform, 3);
  if constexpr (std::is_same_v<TypeParam, Box>) {
    bounds[1].lo[0] = NAN;
  } else {
    bounds[1].radius = -1;
  }
  std::vector<BoundId> ids(3);
  const auto inserting = caught<BadBound>([&] { tree.insert(bounds, ids); });
  ASSERT_TRUE(inserting) << "a bad bound was inserted";
  EXPECT_EQ(inserting->index(), 1U);
  EXPECT_THROW(tree.insert(bounds[1]), BadBound);
  const BoundId id = this->world_.model.ids[this->some(true)];
  EXPECT_THROW(tree.move(id, bounds[1]), BadBound);
  EXPECT_THROW(tree.move_by(id, {NAN, 0, 0}), BadBound);
  const BoundId far = tree.insert(bounds[0]);
  this->world_.model.insert(far, bounds[0], all_layers);
  EXPECT_THAT(message_of<BadBound>([&] {
                tree.move_by(far, {0, INFINITY, 0});
              }),
              HasSubstr("move_by(): displacement 0 moves the bound of index " + std::to_string(far.index) + " beyond"));
  const BoundId one = tree.insert(bounds[0]);
  this->world_.model.insert(one, bounds[0], all_layers);
  const std::vector<BoundId> both = {far, one};
  tree.move_by(both, std::vector<Vec3>(2, Vec3{2e38F, 0, 0}));
  const std::vector<Vec3> too_far{{0, 0, 0}, {2e38F, 0, 0}};
  const auto moving = caught<BadBound>([&] { tree.move_by(both, too_far); });
  ASSERT_TRUE(moving) << "a bound was moved to infinity";
  EXPECT_EQ(moving->index(), 1U);
  for (const BoundId& each : both) this->world_.model.bounds[each.index] = tree[each];
}

TYPED_TEST(DynamicErrors, SpansOfOtherSizesAreRefused) {
  auto& tree = this->world_.tree;
  const std::vector<TypeParam> bounds = scene<TypeParam>(this->world_.random(), Shape::uniform, 3);
  std::vector<BoundId> ids(2);
  EXPECT_THAT(message_of<InvalidArgument>([&] { tree.insert(bounds, ids); }),
              HasSubstr("insert() got 3 bounds and 2 ids; give one for each"));
  ids.resize(3);
  EXPECT_THAT(message_of<InvalidArgument>([&] { tree.insert(bounds, ids, std::vector<std::uint32_t>(2)); }),
              HasSubstr("insert() got 3 bounds and 2 layers"));
  const std::vector<BoundId> one = {this->world_.model.ids[this->some(true)]};
  EXPECT_THAT(message_of<InvalidArgument>([&] { tree.move(one, bounds); }), HasSubstr("move() got 1 ids and 3 bounds"));
  EXPECT_THAT(message_of<InvalidArgument>([&] { tree.move_by(one, std::vector<Vec3>(2)); }),
              HasSubstr("move_by() got 1 ids and 2 displacements"));
  EXPECT_THAT(message_of<InvalidArgument>(
                  [&] { tree.insert(std::span<const TypeParam>(static_cast<const TypeParam*>(nullptr), 3), ids); }),
              HasSubstr("null"));
}

TYPED_TEST(DynamicErrors, QueriesRefuseWhatTheyRefuseOfOtherTrees) {
  const auto& tree = this->world_.tree;
  const CompiledShaft shaft = compile({{0, 0, 0}, {1, 1, 1}}, {{3, 3, 3}, {4, 4, 4}});
  const auto end = static_cast<std::uint32_t>(tree.committed().index_end());
  EXPECT_THAT(message_of<InvalidArgument>([&] { (void)count(shaft, tree, {.exclude = {end}}); }), HasSubstr("exclude"));
  const Indices beyond = {end};
  EXPECT_THAT(message_of<InvalidArgument>([&] { (void)count(shaft, tree, {.only = beyond}); }), HasSubstr("only"));
  EXPECT_THAT(message_of<InvalidArgument>([&] { (void)tree.committed()[end]; }), HasSubstr("no bound has index"));
  EXPECT_FALSE(tree.committed().has(end));
  std::vector<std::uint64_t> words(bit_words(end) + 1);
  EXPECT_THROW(cull(shaft, tree, words), InvalidArgument);
}

#ifdef SHAFTCULL_HAS_FLOAT_MODES
TYPED_TEST(DynamicErrors, BadBoundsAreBadInEveryMode) {
  auto& tree = this->world_.tree;
  const TypeParam bad = [] {  // unless denormals are zero
    if constexpr (std::is_same_v<TypeParam, Box>) {
      return Box{{1e-40F, 0, 0}, {0, 1, 1}};
    } else {
      return Sphere{{0, 0, 0}, -1e-40F};
    }
  }();
  for (const Mode& mode : modes) {
    const InMode in(mode);
    EXPECT_THROW(tree.insert(bad), BadBound) << mode.name;
    EXPECT_THROW(tree.move(this->world_.model.ids[this->some(true)], bad), BadBound) << mode.name;
  }
}
#endif

TYPED_TEST(DynamicErrors, UpkeepIsANumber) {
  EXPECT_THROW(this->world_.tree.set_sorted_per_change(-1), InvalidArgument);
  EXPECT_THROW(this->world_.tree.set_sorted_per_change(INFINITY), InvalidArgument);
  EXPECT_THROW(this->world_.tree.set_sorted_per_change(NAN), InvalidArgument);
  this->world_.tree.set_sorted_per_change(0);
}

}  // namespace
}  // namespace shaftcull
