// SPDX-License-Identifier: MIT
/// Images of dynamic trees: what is read from them goes on as the tree that was written, and what is no image is
/// refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dynamic/world.hpp"
#include "message_of.hpp"
#include "sanitizers.hpp"
#include "shaftcull/tree_image.hpp"
#include "tree/image_header.hpp"
#include "tree/image_of.hpp"

namespace shaftcull {
namespace {

using testing::HasSubstr;

template <class Bound>
class DynamicImages : public testing::Test {};
TYPED_TEST_SUITE(DynamicImages, DynamicKinds);

// Two worlds get the same changes. One of them goes through an image now and then.
TYPED_TEST(DynamicImages, GoOnAsTheTreeThatWasWritten) {
  for (std::uint64_t seed = 1; seed <= random_cases(8); ++seed) {
    SCOPED_TRACE(seed);
    World<TypeParam> one(seed);
    World<TypeParam> other(seed);
    for (unsigned commit = 0; commit != 14; ++commit) {
      const bool grows = commit < 8;
      const Changes changes{shapes[(seed + commit) % std::size(shapes)], 1U << (commit + 1), grows ? 8U : 2U,
                            seed % 2 == 0 && commit > 4};
      for (World<TypeParam>* const world : {&one, &other}) {
        world->change(changes);
        world->tree.commit();
      }
      if (commit == 11) {
        one.tree.set_sorted_per_change(0.5);
        other.tree.set_sorted_per_change(0.5);
      }
      const std::vector<std::byte> image = image_of(one.tree);
      ASSERT_EQ(image, image_of(other.tree));
      if ((seed + commit) % 3 == 0) continue;
      other.tree = dynamic_tree_from_image<DynamicTree<TypeParam>>(image);
      ASSERT_EQ(image, image_of(other.tree));
      EXPECT_EQ(other.tree.bound_count(), other.model.count());
      for (const BoundId& id : other.model.ids) EXPECT_EQ(other.tree.has(id), one.tree.has(id));
      Random asked(commit);
      expect_equal(other.tree.committed(), other.model, asked);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TYPED_TEST(DynamicImages, DoNotDependOnSnapshots) {
  World<TypeParam> one(7);
  World<TypeParam> other(7);
  TreeSnapshot<TypeParam> kept;
  for (unsigned commit = 0; commit != 10; ++commit) {
    for (World<TypeParam>* const world : {&one, &other}) {
      world->change({.count = 900, .insertions = commit < 6 ? 8U : 3U, .layers = commit > 3});
      world->tree.commit();
    }
    kept = other.tree.snapshot();
    ASSERT_EQ(image_of(one.tree), image_of(other.tree)) << commit;
  }
}

TYPED_TEST(DynamicImages, AreThoseOfEmptyTreesToo) {
  using Tree = DynamicTree<TypeParam>;
  Tree never_changed;
  EXPECT_EQ(image_bytes(never_changed) % 64, 0U);
  Tree read = dynamic_tree_from_image<Tree>(image_of(never_changed));
  EXPECT_EQ(read.bound_count(), 0U);
  World<TypeParam> world(3);
  const TypeParam bound = scene<TypeParam>(world.random(), Shape::uniform, 1).front();
  EXPECT_EQ(read.insert(bound), never_changed.insert(bound));
  read.commit();
  never_changed.commit();
  EXPECT_EQ(image_of(read), image_of(never_changed));

  const BoundId id = read.id_of(0);
  read.erase(id);
  read.commit();
  Tree emptied = dynamic_tree_from_image<Tree>(image_of(read));
  EXPECT_EQ(emptied.bound_count(), 0U);
  EXPECT_FALSE(emptied.has(id));
  EXPECT_EQ(emptied.insert(bound), (BoundId{0, 1}));
}

/// A tree whose blocks are full in part, with free indices.
DynamicBoxTree some_tree() {
  World<Box> world(11);
  world.change({.count = 3000, .insertions = 7, .layers = true});
  world.tree.commit();
  return std::move(world.tree);
}

TEST(DynamicImageErrors, ChangesThatWaitAreNotForgotten) {
  DynamicBoxTree tree = some_tree();
  std::vector<std::byte> image = image_of(tree);
  const std::vector<std::byte> before = image;
  tree.insert({{0, 0, 0}, {1, 1, 1}});
  EXPECT_THAT(message_of([&] { static_cast<void>(image_bytes(tree)); }),
              HasSubstr("changes wait; call commit() first"));
  EXPECT_THAT(message_of([&] { write_image(tree, image); }), HasSubstr("changes wait"));
  EXPECT_EQ(image, before);
}

TEST(DynamicImageErrors, NamesWhatIsNoImage) {
  const DynamicBoxTree tree = some_tree();
  std::vector<std::byte> image = image_of(tree);
  const auto refusal = [](std::span<const std::byte> bytes) {
    return message_of([&] { static_cast<void>(dynamic_tree_from_image<DynamicBoxTree>(bytes)); });
  };
  EXPECT_THAT(refusal({}), HasSubstr("has 0 bytes, fewer than any image has: 128"));
  EXPECT_THAT(refusal({static_cast<const std::byte*>(nullptr), 1}), HasSubstr("image is null"));
  EXPECT_THAT(refusal(std::span(image).first(image.size() - 64)), HasSubstr("bytes; here are"));
  EXPECT_THAT(message_of([&] { static_cast<void>(dynamic_tree_from_image<DynamicSphereTree>(image)); }),
              HasSubstr("is of boxes that come and go, not of spheres that come and go"));
  const std::vector<Box> boxes(3, Box{{0, 0, 0}, {1, 1, 1}});
  const BoxTree still{std::span<const Box>(boxes)};
  EXPECT_THAT(refusal(image_of(still)), HasSubstr("is of boxes, not of boxes that come and go"));
  EXPECT_THAT(message_of([&] { write_image(tree, std::span(image).first(64)); }),
              HasSubstr("image has 64 bytes; that of this tree takes " + std::to_string(image.size())));
}

TEST(DynamicImageErrors, FindsDamageAnywhere) {
  const DynamicBoxTree tree = some_tree();
  std::vector<std::byte> image = image_of(tree);
  Random random(5);
  for (std::size_t i = 0; i != random_cases(400); ++i) {
    const std::size_t at = i < 192 ? i : random.below(static_cast<unsigned>(image.size()));
    const std::byte before = image[at];
    image[at] ^= std::byte{static_cast<unsigned char>(1U << random.below(8))};
    EXPECT_THAT(message_of([&] { static_cast<void>(dynamic_tree_from_image<DynamicBoxTree>(image)); }),
                HasSubstr("the image of a tree"))
        << at;
    image[at] = before;
  }
  EXPECT_EQ(dynamic_tree_from_image<DynamicBoxTree>(image).bound_count(), tree.bound_count());
}

// Whatever an image with the right checksum says, indices stay in range.
TEST(DynamicImageErrors, RefusesContradictions) {
  const DynamicBoxTree tree = some_tree();
  const std::vector<std::byte> image = image_of(tree);
  constexpr std::size_t header = 192;
  const auto indices = static_cast<std::size_t>(tree.committed().index_end());
  const std::size_t free = header + kernel::in_lines(4 * indices);
  const std::size_t blocks = free + kernel::in_lines(4 * (indices - tree.bound_count()));
  constexpr std::size_t record = 2432;
  const auto refusal = [&](std::size_t at, std::uint32_t value) {
    std::vector<std::byte> changed = image;
    std::memcpy(changed.data() + at, &value, sizeof value);
    kernel::seal_image(changed);
    return message_of([&] { static_cast<void>(dynamic_tree_from_image<DynamicBoxTree>(changed)); });
  };
  EXPECT_THAT(refusal(64, 1), HasSubstr("do not take"));           // bounds
  EXPECT_THAT(refusal(72, 0xFFFFFFFF), HasSubstr("do not take"));  // indices
  EXPECT_THAT(refusal(88, 0xFFFFFFFF), HasSubstr("do not take"));  // blocks
  EXPECT_THAT(refusal(96, 0), HasSubstr("do not take"));           // numbers of blocks
  EXPECT_THAT(refusal(free, 0xFFFFFFFF), HasSubstr("is not free"));
  EXPECT_THAT(refusal(free, static_cast<std::uint32_t>(indices)), HasSubstr("is not free"));
  EXPECT_THAT(refusal(blocks, 0), HasSubstr("a block has the number 0"));
  EXPECT_THAT(refusal(blocks, 0xFFFFFFFF), HasSubstr("a block has the number 4294967295"));
  EXPECT_THAT(refusal(blocks + 64, 0), HasSubstr("its blocks hold"));  // leaves that are taken
  const std::size_t order = blocks + record + 6 * sizeof(float) * 4096;
  EXPECT_THAT(refusal(order, 0xFFFFFFFF), HasSubstr("no bound can have index 4294967295"));
}

}  // namespace
}  // namespace shaftcull
