// SPDX-License-Identifier: MIT
/// Trees in images: they answer what the tree did that was written, and what is no image is refused.
#include "shaftcull/tree_image.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB
#include <tbb/task_arena.h>
#endif

#include "caught.hpp"
#include "instruction_sets.hpp"
#include "message_of.hpp"
#include "oracle/cases/triangles.hpp"
#include "pages.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/first_contact.hpp"
#include "support/checksum.hpp"
#include "tree/image_of.hpp"
#include "tree/scenes.hpp"
#include "tree/volumes.hpp"

namespace shaftcull {
namespace {

using testing::AllOf;
using testing::HasSubstr;

template <class Tree>
Tree tree_of(const std::vector<BoundOf<Tree>>& bounds) {
  return Tree(std::span(bounds));
}

/// What is the same for a tree and for the one in its image, whatever they hold.
template <class Tree>
void expect_same(const Tree& one, const Tree& other, std::span<const CompiledShaft> shafts) {
  ASSERT_EQ(one.size(), other.size());
  EXPECT_TRUE(std::ranges::equal(one.order(), other.order()));
  EXPECT_EQ(one.box(), other.box());
  EXPECT_EQ(one.sah_ratio(), other.sah_ratio());
  EXPECT_TRUE(std::ranges::equal(one.layers(), other.layers()));
  std::vector<std::uint32_t> of_one(one.size());
  std::vector<std::uint32_t> of_other(one.size());
  std::vector<std::uint64_t> bits(bit_words(one.size()));
  std::vector<std::uint64_t> other_bits(bits.size());
  for (const CompiledShaft& shaft : shafts) {
    const std::size_t kept = list(shaft, one, std::span(of_one));
    ASSERT_EQ(list(shaft, other, std::span(of_other)), kept);
    EXPECT_TRUE(std::equal(of_one.begin(), of_one.begin() + static_cast<std::ptrdiff_t>(kept), of_other.begin()));
    cull(shaft, one, bits);
    cull(shaft, other, other_bits);
    EXPECT_EQ(bits, other_bits);
    EXPECT_EQ(count_classified(shaft, one), count_classified(shaft, other));
    const FirstContact first = first_contact(shaft, one);
    const FirstContact other_first = first_contact(shaft, other);
    EXPECT_EQ(first.index, other_first.index);
    EXPECT_EQ(first.time, other_first.time);
  }
}

/// The same for trees of triangles.
void expect_same(const TriangleTree& one, const TriangleTree& other, std::span<const CompiledShaft> shafts) {
  ASSERT_EQ(one.size(), other.size());
  EXPECT_TRUE(std::ranges::equal(one.order(), other.order()));
  EXPECT_EQ(one.box(), other.box());
  std::vector<std::uint32_t> of_one(one.size());
  std::vector<std::uint32_t> of_other(one.size());
  std::vector<std::uint64_t> bits(bit_words(one.size()));
  std::vector<std::uint64_t> other_bits(bits.size());
  for (const CompiledShaft& shaft : shafts) {
    const std::size_t kept = list(shaft, one, std::span(of_one));
    ASSERT_EQ(list(shaft, other, std::span(of_other)), kept);
    EXPECT_TRUE(std::equal(of_one.begin(), of_one.begin() + static_cast<std::ptrdiff_t>(kept), of_other.begin()));
    classify(shaft, one, {}, bits);
    classify(shaft, other, {}, other_bits);
    EXPECT_EQ(bits, other_bits);
    EXPECT_EQ(count_classified(shaft, one), count_classified(shaft, other));
  }
}

/// Of a bit in any byte.
template <class Tree>
void expect_changes_are_noticed(const Tree& tree) {
  Random random(35);
  const Pages pages(image_bytes(tree));
  write_image(tree, pages.bytes());
  const std::span<std::byte> bytes = pages.bytes();
  for (std::size_t i = 0; i != bytes.size(); ++i) {
    const auto flipped = static_cast<std::byte>(1U << random.below(8));
    bytes[i] ^= flipped;
    EXPECT_THROW(TreeInImage<Tree>{bytes}, InvalidArgument) << "byte " << i;
    bytes[i] ^= flipped;
  }
  EXPECT_EQ(TreeInImage<Tree>(bytes).tree().size(), tree.size());
}

/// Sizes around those at which a tree gets another level, or rows that are farther apart.
constexpr std::size_t sizes[] = {0, 1, 63, 64, 65, 127, 128, 129, 1000, 4096, 8191, 8192, 8193, 100000};

template <class Tree>
class TreeImages : public testing::Test {};
TYPED_TEST_SUITE(TreeImages, TreeKinds);

TYPED_TEST(TreeImages, AnswerAsTheTreesThatWereWritten) {
  Random random(31);
  for (const std::size_t size : sizes) {
    SCOPED_TRACE(size);
    const Shape shape = shapes[size % std::size(shapes)];
    auto tree = tree_of<TypeParam>(scene<BoundOf<TypeParam>>(random, shape, size));
    if (size % 2 == 1) {
      std::vector<std::uint32_t> layers(size);
      for (std::uint32_t& each : layers) each = random.below(16);
      tree.set_layers(layers);
    }
    const Pages pages(image_bytes(tree));
    write_image(tree, pages.bytes());
    ASSERT_TRUE(pages.forbid_writing());
    const std::vector<CompiledShaft> shafts = shafts_for(random, 20);
    for (const ImageCheck check : {ImageCheck::all, ImageCheck::header}) {
      TreeInImage<TypeParam> image(pages.bytes(), check);
      const TreeInImage<TypeParam> moved(std::move(image));
      on_each_instruction_set([&] { expect_same(tree, moved.tree(), shafts); });
    }
  }
}

TYPED_TEST(TreeImages, AnswerQuestionsAboutLayersAndCandidates) {
  Random random(32);
  auto tree = tree_of<TypeParam>(scene<BoundOf<TypeParam>>(random, Shape::uniform, 20000));
  std::vector<std::uint32_t> layers(tree.size());
  for (std::uint32_t& each : layers) each = 1U << random.below(3);
  layers[7] = 0;
  tree.set_layers(layers);
  const Pages pages(image_bytes(tree));
  write_image(tree, pages.bytes());
  ASSERT_TRUE(pages.forbid_writing());
  const TreeInImage<TypeParam> image(pages.bytes());
  const CompiledShaft everything = compile({{-99, -99, -99}, {99, 99, 99}}, {{-99, -99, -99}, {99, 99, 99}});
  EXPECT_EQ(count(everything, image.tree()), 20000U);
  EXPECT_EQ(count(everything, image.tree(), {.layer_mask = {7}}), 19999U);
  const Query of_two_layers{.layer_mask = {5}};
  std::vector<std::uint32_t> candidates(1000);
  for (std::uint32_t& each : candidates) each = random.below(20000);
  for (const CompiledShaft& shaft : shafts_for(random, 50)) {
    EXPECT_EQ(count(shaft, tree, of_two_layers), count(shaft, image.tree(), of_two_layers));
    std::vector<std::uint32_t> kept(candidates.size());
    std::vector<std::uint32_t> others(candidates.size());
    const std::size_t size = list(shaft, tree, std::span(kept), {.only = candidates});
    EXPECT_EQ(size, list(shaft, image.tree(), std::span(others), {.only = candidates}));
    EXPECT_EQ(kept, others);
  }
}

TYPED_TEST(TreeImages, CopiesOfTheTreeOwnTheirMemory) {
  Random random(33);
  const std::vector<BoundOf<TypeParam>> bounds = scene<BoundOf<TypeParam>>(random, Shape::uniform, 9000);
  const std::vector<BoundOf<TypeParam>> others = scene<BoundOf<TypeParam>>(random, Shape::clustered, 9000);
  auto tree = tree_of<TypeParam>(bounds);
  std::optional<Pages> pages(std::in_place, image_bytes(tree));
  write_image(tree, pages->bytes());
  ASSERT_TRUE(pages->forbid_writing());
  TypeParam copy = TreeInImage<TypeParam>(pages->bytes()).tree();
  pages.reset();
  const std::vector<CompiledShaft> shafts = shafts_for(random, 20);
  expect_same(tree, copy, shafts);
  for (TypeParam* const each : {&tree, &copy}) {
    const std::uint32_t moved[] = {3, 8000};
    each->update(std::span(moved), std::span(others).first(2));
    each->refit();
  }
  expect_same(tree, copy, shafts);
  for (TypeParam* const each : {&tree, &copy}) {
    each->update(std::span(others));
    each->rebuild();
    each->reorder();
  }
  expect_same(tree, copy, shafts);
  EXPECT_EQ(image_of(tree), image_of(copy));
}

TYPED_TEST(TreeImages, AreTheSameForTreesThatWereBuiltAlike) {
  Random random(34);
  const auto bounds = scene<BoundOf<TypeParam>>(random, Shape::wild_sizes, 30000);
  std::optional<std::vector<std::byte>> first;
  on_each_instruction_set([&] {
    const std::vector<std::byte> image = image_of(tree_of<TypeParam>(bounds));
    if (!first) first = image;
    EXPECT_EQ(image, *first);
  });
#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB
  for (const int threads : {1, 3, 8}) {
    tbb::task_arena arena(threads);
    EXPECT_EQ(arena.execute([&] { return image_of(tree_of<TypeParam>(bounds)); }), *first) << threads << " threads";
  }
#endif
}

TYPED_TEST(TreeImages, WhoseBytesWereChangedAreRefused) {
  Random random(35);
  const auto tree = tree_of<TypeParam>(scene<BoundOf<TypeParam>>(random, Shape::uniform, 200));
  expect_changes_are_noticed(tree);
}

TYPED_TEST(TreeImages, OfTreesThatNeedARefitAreNotWritten) {
  Random random(36);
  const auto bounds = scene<BoundOf<TypeParam>>(random, Shape::uniform, 200);
  auto tree = tree_of<TypeParam>(bounds);
  const std::vector<std::byte> before = image_of(tree);
  const std::uint32_t moved[] = {3};
  tree.update(std::span(moved), std::span(bounds).subspan(5, 1));
  EXPECT_THROW(static_cast<void>(image_bytes(tree)), NeedsRefit);
  std::vector<std::byte> image = before;
  EXPECT_THROW(write_image(tree, std::span(image)), NeedsRefit);
  EXPECT_EQ(image, before);
  tree.refit();
  EXPECT_NE(image_of(tree), before);
}

std::vector<Triangle> some_triangles(std::size_t size) {
  Random random(37);
  std::vector<Triangle> triangles;
  while (triangles.size() != size) triangles.push_back(grid_triangle(random, -9, 9));
  return triangles;
}

TEST(TriangleTreeImages, AnswerAsTheTreesThatWereWritten) {
  Random random(38);
  for (const std::size_t size : {0U, 1U, 31U, 32U, 33U, 64U, 65U, 2047U, 2048U, 2049U, 10000U}) {
    SCOPED_TRACE(size);
    const std::vector<Triangle> triangles = some_triangles(size);
    const TriangleTree tree{std::span(triangles)};
    std::optional<Pages> pages(std::in_place, image_bytes(tree));
    write_image(tree, pages->bytes());
    ASSERT_TRUE(pages->forbid_writing());
    const std::vector<CompiledShaft> shafts = shafts_for(random, 20);
    std::optional<TriangleTree> copy;
    {
      const TreeInImage<TriangleTree> image(pages->bytes());
      on_each_instruction_set([&] { expect_same(tree, image.tree(), shafts); });
      copy = image.tree();
    }
    pages.reset();
    expect_same(tree, *copy, shafts);
  }
}

TEST(TriangleTreeImages, WhoseBytesWereChangedAreRefused) {
  const std::vector<Triangle> triangles = some_triangles(70);
  expect_changes_are_noticed(TriangleTree{std::span(triangles)});
}

/// What is said of memory that is no image of a BoxTree.
std::string complaint(std::span<const std::byte> image, ImageCheck check = ImageCheck::header) {
  return message_of<InvalidArgument>([&] { TreeInImage<BoxTree>{image, check}; });
}

TEST(TreeImage, SaysWhyMemoryIsNone) {
  Random random(40);
  const std::vector<Box> boxes = scene<Box>(random, Shape::uniform, 500);
  const BoxTree tree{std::span(boxes)};
  const std::size_t size = image_bytes(tree);
  const Pages pages(size + 64);
  const std::span<std::byte> image = pages.bytes().first(size);
  write_image(tree, image);
  EXPECT_THAT(complaint({static_cast<const std::byte*>(nullptr), size}), HasSubstr("image"));
  EXPECT_THAT(complaint(pages.bytes().subspan(4, size)), HasSubstr("a multiple of 64 bytes"));
  EXPECT_THAT(complaint(image.first(0)), HasSubstr("0 bytes"));
  EXPECT_THAT(complaint(image.first(127)), AllOf(HasSubstr("127 bytes"), HasSubstr("128")));
  EXPECT_THAT(complaint(image.first(size - 64)),
              AllOf(HasSubstr(std::to_string(size)), HasSubstr(std::to_string(size - 64))));
  EXPECT_THAT(complaint(pages.bytes()), HasSubstr(std::to_string(size + 64)));
  EXPECT_THAT(message_of<InvalidArgument>([&] { TreeInImage<SphereTree>{image}; }),
              HasSubstr("is of boxes, not of spheres"));
  EXPECT_THAT(complaint(image, static_cast<ImageCheck>(7)), HasSubstr("ImageCheck 7"));

  const auto with = [&](std::size_t at, std::uint32_t value) {
    std::uint32_t before = 0;
    std::memcpy(&before, image.data() + at, sizeof before);
    std::memcpy(image.data() + at, &value, sizeof value);
    std::string what = complaint(image);
    std::memcpy(image.data() + at, &before, sizeof before);
    return what;
  };
  EXPECT_THAT(with(0, 0), HasSubstr("something else"));
  EXPECT_THAT(with(16, 7), HasSubstr("has format 7; this version reads 1"));
  EXPECT_THAT(with(20, 0x04030201), HasSubstr("orders bytes otherwise"));
  EXPECT_THAT(with(24, 5), HasSubstr("unknown bounds"));
  const std::size_t low_half = std::endian::native == std::endian::little ? 64 : 68;  // of the number of bounds
  EXPECT_THAT(with(low_half, 600), HasSubstr("600 bounds do not take"));
  EXPECT_THAT(with(low_half, 0), HasSubstr("0 bounds do not take"));
  EXPECT_THAT(with(64 + 68 - low_half, 1), HasSubstr("bounds do not take"));
  image[size - 1] ^= std::byte{1};
  EXPECT_THAT(complaint(image, ImageCheck::all), HasSubstr("checksum"));
  EXPECT_NO_THROW(TreeInImage<BoxTree>(image, ImageCheck::header));
  image[size - 1] ^= std::byte{1};

  std::vector<std::byte> small(size - 1);
  EXPECT_THAT(message_of<InvalidArgument>([&] { write_image(tree, std::span(small)); }),
              AllOf(HasSubstr(std::to_string(size)), HasSubstr(std::to_string(size - 1))));
}

TEST(TreeImage, IsNotWrittenOntoTheTreeThatLiesThere) {
  Random random(41);
  const std::vector<Box> boxes = scene<Box>(random, Shape::uniform, 500);
  const Pages pages(image_bytes(BoxTree{std::span(boxes)}));
  write_image(BoxTree{std::span(boxes)}, pages.bytes());
  const TreeInImage<BoxTree> image(pages.bytes());
  EXPECT_THAT(message_of<InvalidArgument>([&] { write_image(image.tree(), pages.bytes()); }), HasSubstr("the image"));
  EXPECT_NO_THROW(TreeInImage<BoxTree>{pages.bytes()});
}

/// Whoever changes what an image holds has to give it another format: images of before would be read wrongly.
TEST(TreeImage, IsTheOneOnRecord) {
  std::vector<Box> boxes;
  std::vector<std::uint32_t> layers;
  for (std::uint32_t i = 0; i != 1000; ++i) {
    const auto at = [&](std::uint32_t step) { return static_cast<float>(i * step % 101); };
    boxes.push_back({{at(7), at(31), at(57)}, {at(7) + 1, at(31) + 2, at(57) + 0.5F}});
    layers.push_back(1U << i % 5);
  }
  BoxTree tree{std::span(boxes)};
  tree.set_layers(layers);
  const std::vector<std::byte> image = image_of(tree);
  ASSERT_EQ(image.size(), 34752U);
  if constexpr (std::endian::native == std::endian::little) {
    EXPECT_EQ(kernel::checksum(image), 17498188322843655696U);
  }
}

TEST(Checksum, IsXxh64) {
  std::vector<std::byte> bytes(96);
  EXPECT_EQ(kernel::checksum(std::span(bytes).first(32)), 0xf6e9be5d70632cf5U);
  for (std::size_t i = 0; i != bytes.size(); ++i) bytes[i] = static_cast<std::byte>(7 * i + 1);
  if constexpr (std::endian::native == std::endian::big) {  // it reads words as they are in memory
    for (std::size_t word = 0; word != bytes.size(); word += 8) std::reverse(&bytes[word], &bytes[word] + 8);
  }
  EXPECT_EQ(kernel::checksum(bytes), 0x7df0a6c63db9338aU);
}

}  // namespace
}  // namespace shaftcull
