// SPDX-License-Identifier: MIT
/// A tree answers what a flat scan answers.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "sanitizers.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/tree.hpp"
#include "tree/flat.hpp"
#include "tree/scenes.hpp"

namespace shaftcull {
namespace {

/// Every way of asking one shaft.
template <class Bound>
void expect_flat_answers(const BoundsTree<Bound>& tree, const std::vector<Bound>& bounds, const CompiledShaft& shaft) {
  const FlatAnswers flat(shaft, bounds);
  const Indices kept = flat.kept();
  EXPECT_EQ(count(shaft, tree), kept.size());
  EXPECT_EQ(any(shaft, tree), !kept.empty());

  // All words are written, whatever they were before.
  const std::vector<std::uint64_t> kept_bits = bits_of(kept, bounds.size());
  const std::vector<std::uint64_t> inside_bits = bits_of(flat.inside, bounds.size());
  std::vector<std::uint64_t> some(kept_bits.size(), 0x5555);
  std::vector<std::uint64_t> others(kept_bits.size(), 0x5555);
  cull(shaft, tree, some);
  EXPECT_EQ(some, kept_bits);
  classify(shaft, tree, {}, others);
  EXPECT_EQ(others, inside_bits);
  classify(shaft, tree, others, some);
  EXPECT_EQ(others, kept_bits);
  EXPECT_EQ(some, inside_bits);

  std::vector<std::uint32_t> indices(bounds.size());
  indices.resize(list(shaft, tree, std::span(indices)));
  EXPECT_EQ(sorted(indices), kept);

  std::vector<std::uint32_t> overlap(bounds.size());
  std::vector<std::uint32_t> inside(bounds.size());
  const KeptCounts counts = list_classified(shaft, tree, std::span(overlap), std::span(inside));
  overlap.resize(counts.overlap);
  inside.resize(counts.inside);
  EXPECT_EQ(count_classified(shaft, tree), counts);
  EXPECT_EQ(sorted(overlap), flat.overlap);
  EXPECT_EQ(sorted(inside), flat.inside);
}

template <class Bound>
void expect_flat_answers(std::uint64_t seed, Shape shape, std::size_t count, std::size_t shaft_count) {
  Random random(seed);
  const std::vector<Bound> bounds = scene<Bound>(random, shape, count);
  const BoundsTree<Bound> tree{std::span<const Bound>(bounds)};
  ASSERT_EQ(tree.size(), count);
  for (const CompiledShaft& shaft : shafts_for(random, shaft_count)) {
    expect_flat_answers(tree, bounds, shaft);
    if (!testing::Test::HasFailure()) continue;
    ADD_FAILURE() << "expect_flat_answers<" << (std::is_same_v<Bound, Box> ? "Box" : "Sphere") << ">(" << seed
                  << ", shape " << text(shape) << ", " << count << ", " << shaft_count << ')';
    return;
  }
}

/// Asked about inside alone, a tree answers what classify() of a view says of inside.
template <class Bound>
void expect_inside_as_flat(std::uint64_t seed, Shape shape) {
  Random random(seed);
  const std::vector<Bound> bounds = scene<Bound>(random, shape, 700);
  const BoundsTree<Bound> tree{std::span<const Bound>(bounds)};
  for (const int size : {1, 3, 6}) {
    const auto extent = static_cast<float>(size);
    const Box a = random.box(-4, 4, extent, extent);
    const Box b = random.box(-4, 4, extent, extent);
    std::vector<std::uint64_t> inside(bit_words(bounds.size()), 0x5555);
    classify(compile(a, b), tree, {}, inside);
    EXPECT_EQ(inside, bits_of(FlatAnswers(compile(a, b), bounds).inside, bounds.size())) << text(shape);
  }
}

TEST(TreeAgreement, HoldsForInsideAlone) {
  for (const Shape shape : shapes) {
    expect_inside_as_flat<Box>(600, shape);
    expect_inside_as_flat<Sphere>(601, shape);
  }
}

TEST(TreeAgreement, HoldsForEveryShapeAndCount) {
  std::uint64_t seed = 500;
  for (const Shape shape : shapes) {
    for (const std::size_t count : {0U, 1U, 63U, 64U, 65U, 128U, 129U, 4096U, 4097U, 8193U}) {
      expect_flat_answers<Box>(++seed, shape, count, random_cases(10));
      expect_flat_answers<Sphere>(++seed, shape, count, random_cases(10));
      if (HasFailure()) return;
    }
  }
}

TEST(TreeAgreement, HoldsForTenThousandRandomScenes) {
  for (std::uint64_t seed = 10000; seed != 10000 + random_cases(5000); ++seed) {
    Random random(seed * 7919);
    const Shape shape = shapes[random.below(std::size(shapes))];
    const std::size_t count = random.one_in(20) ? random.below(6000) : random.below(300);
    expect_flat_answers<Box>(seed, shape, count, 2);
    expect_flat_answers<Sphere>(seed, shape, count, 2);
    if (HasFailure()) return;
  }
}

TEST(TreeAgreement, HoldsOnFourLevels) {
  expect_flat_answers<Box>(31, Shape::uniform, 530000, 3);
  if (has_shadow_memory) return;
  expect_flat_answers<Box>(32, Shape::some_empty, 530000, 3);
  expect_flat_answers<Sphere>(33, Shape::uniform, 530000, 3);
  expect_flat_answers<Box>(34, Shape::one_giant, 530000, 3);
}

}  // namespace
}  // namespace shaftcull
