// SPDX-License-Identifier: MIT
/// Layers: a query answers what a flat scan answers of the bounds in the layers that it asks for, and of no others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "dispatch/active_kernels.hpp"
#include "instruction_sets.hpp"
#include "message_of.hpp"
#include "sanitizers.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/tree.hpp"
#include "tree/counted_words.hpp"
#include "tree/flat.hpp"
#include "tree/scenes.hpp"
#include "tree/tree_access.hpp"
#include "tree/volumes.hpp"
#include "tree/walked.hpp"

namespace shaftcull {
namespace {

using Layers = std::vector<std::uint32_t>;
using testing::AllOf;
using testing::HasSubstr;

/// Layers of which a bound has none, one or many.
Layers random_layers(Random& random, std::size_t count) {
  Layers layers(count);
  for (std::uint32_t& each : layers) {
    each = random.one_in(5) ? 0 : random.one_in(3) ? random.below(0xffffffff) : 1U << random.below(32);
  }
  return layers;
}

/// What a flat scan says of the bounds in some layers.
template <class Bound>
FlatAnswers flat_answers(const CompiledShaft& shaft, const std::vector<Bound>& bounds, const Layers& layers,
                         std::uint32_t mask) {
  FlatAnswers flat(shaft, bounds);
  const auto is_out = [&](std::uint32_t i) { return (layers[i] & mask) == 0; };
  std::erase_if(flat.overlap, is_out);
  std::erase_if(flat.inside, is_out);
  return flat;
}

/// Every verb of one shaft.
template <class Bound>
void expect_answers(const BoundsTree<Bound>& tree, const FlatAnswers& flat, const CompiledShaft& shaft,
                    const Query& query) {
  const Indices kept = flat.kept();
  EXPECT_EQ(count(shaft, tree, query), kept.size());
  EXPECT_EQ(any(shaft, tree, query), !kept.empty());
  EXPECT_EQ(count_classified(shaft, tree, query), (KeptCounts{flat.overlap.size(), flat.inside.size()}));
  Query few = query;
  few.limit = 3;
  EXPECT_EQ(count(shaft, tree, few), std::min<std::size_t>(3, kept.size()));

  std::vector<std::uint64_t> some(bit_words(tree.size()));
  std::vector<std::uint64_t> others(some.size());
  cull(shaft, tree, some, query);
  EXPECT_EQ(some, bits_of(kept, tree.size()));
  classify(shaft, tree, {}, some, query);
  EXPECT_EQ(some, bits_of(flat.inside, tree.size()));
  classify(shaft, tree, some, others, query);
  EXPECT_EQ(some, bits_of(kept, tree.size()));
  EXPECT_EQ(others, bits_of(flat.inside, tree.size()));

  std::vector<std::uint32_t> indices(tree.size());
  indices.resize(list(shaft, tree, std::span(indices), query));
  EXPECT_EQ(sorted(indices), kept);
  std::vector<std::uint32_t> first(indices.size() / 2);
  few.limit = first.size();
  EXPECT_EQ(list(shaft, tree, std::span(first), few), first.size());
  EXPECT_TRUE(std::equal(first.begin(), first.end(), indices.begin()));

  std::vector<std::uint32_t> overlap(tree.size());
  std::vector<std::uint32_t> inside(tree.size());
  const KeptCounts counts = list_classified(shaft, tree, std::span(overlap), std::span(inside), query);
  overlap.resize(counts.overlap);
  inside.resize(counts.inside);
  EXPECT_EQ(sorted(overlap), flat.overlap);
  EXPECT_EQ(sorted(inside), flat.inside);
}

template <class Tree>
class TreeLayers : public testing::Test {
 protected:
  static void expect_answers_with(const Tree& tree, const std::vector<BoundOf<Tree>>& bounds, const Layers& layers,
                                  std::vector<CompiledShaft> shafts) {
    shafts.push_back(compile({{-99, -99, 0}, {99, 99, 0}}, {{-99, -99, 99}, {99, 99, 99}}));  // many of them
    for (const CompiledShaft& shaft : shafts) {
      for (const std::uint32_t mask : {0U, ~0U, 1U, 0x80000000U, 0x00ff00ffU}) {
        SCOPED_TRACE("layers " + std::to_string(mask) + " of " + std::to_string(tree.size()) + " bounds");
        expect_answers<BoundOf<Tree>>(tree, flat_answers(shaft, bounds, layers, mask), shaft, {.layer_mask = {mask}});
        if (testing::Test::HasFailure()) return;
      }
    }
  }
};
TYPED_TEST_SUITE(TreeLayers, TreeKinds);

TYPED_TEST(TreeLayers, PickTheBoundsOfEveryVerb) {
  Random random(700);
  for (const Shape shape : shapes) {
    for (const std::size_t count : {0U, 1U, 63U, 64U, 65U, 129U, 4097U, 9000U}) {
      const auto bounds = scene<BoundOf<TypeParam>>(random, shape, count);
      const Layers layers = random_layers(random, count);
      TypeParam tree{std::span<const BoundOf<TypeParam>>(bounds)};
      tree.set_layers(layers);
      EXPECT_EQ(tree.has_layers(), count != 0);
      this->expect_answers_with(tree, bounds, layers, shafts_for(random, random_cases(count < 1000 ? 4 : 1)));
      if (this->HasFailure()) return;
    }
  }
}

TYPED_TEST(TreeLayers, ThatAllBoundsAreInLeaveOutNothing) {
  Random random(701);
  const auto bounds = scene<BoundOf<TypeParam>>(random, Shape::uniform, 5000);
  TypeParam tree{std::span<const BoundOf<TypeParam>>(bounds)};
  Layers layers = random_layers(random, bounds.size());
  const std::vector<CompiledShaft> shafts = shafts_for(random, 4);
  for (std::uint32_t& each : layers) each |= 1;  // one layer that all are in
  tree.set_layers(layers);
  this->expect_answers_with(tree, bounds, layers, shafts);
  for (std::uint32_t& each : layers) each = 1U << random.below(8);  // none that all are in, but none in none
  tree.set_layers(layers);
  this->expect_answers_with(tree, bounds, layers, shafts);
  layers[4999] = 0;
  tree.set_layers(layers);
  this->expect_answers_with(tree, bounds, layers, shafts);
}

TYPED_TEST(TreeLayers, GoWithIndicesAndAMaskOfBits) {
  Random random(702);
  const auto bounds = scene<BoundOf<TypeParam>>(random, Shape::uniform, 5000);
  const Layers layers = random_layers(random, bounds.size());
  TypeParam tree{std::span<const BoundOf<TypeParam>>(bounds)};
  tree.set_layers(layers);
  std::vector<std::uint64_t> mask(bit_words(bounds.size()), 0x1248);
  for (const CompiledShaft& shaft : shafts_for(random, 8)) {
    FlatAnswers flat = flat_answers(shaft, bounds, layers, 0xffff);
    const Indices kept = flat.kept();
    const std::vector<std::uint32_t> own = {kept.empty() ? std::uint32_t{9} : std::uint32_t{kept[kept.size() / 2]}};
    const auto is_out = [&](std::uint32_t i) { return i == own[0] || (mask[i / 64] >> i % 64 & 1) != 0; };
    std::erase_if(flat.overlap, is_out);
    std::erase_if(flat.inside, is_out);
    expect_answers<BoundOf<TypeParam>>(tree, flat, shaft,
                                       {.exclude = own, .exclude_mask = mask, .layer_mask = {0xffff}});
  }
}

TYPED_TEST(TreeLayers, AreEachShaftsOwnInCallsOfMany) {
  Random random(703);
  const auto bounds = scene<BoundOf<TypeParam>>(random, Shape::uniform, 6000);
  const Layers layers = random_layers(random, bounds.size());
  TypeParam tree{std::span<const BoundOf<TypeParam>>(bounds)};
  tree.set_layers(layers);
  const std::vector<CompiledShaft> shafts = shafts_for(random, 40);
  Layers masks;
  for (std::size_t s = 0; s != shafts.size(); ++s) masks.push_back(s % 7 == 0 ? ~0U : 0x11U << s % 28);
  for (const bool has_one_for_all : {false, true}) {
    const Layers asked = has_one_for_all ? Layers{0xf0f0} : masks;
    const Query query{.layer_mask = asked};
    IndexLists kept;
    IndexLists overlap;
    IndexLists inside;
    std::vector<std::uint64_t> counts(shafts.size());
    std::vector<std::uint64_t> few(shafts.size());
    std::vector<KeptCounts> classified(shafts.size());
    const std::size_t row = bit_words(bounds.size());
    std::vector<std::uint64_t> kept_bits(shafts.size() * row);
    std::vector<std::uint64_t> inside_bits(kept_bits.size());
    std::vector<std::uint64_t> found(1);
    Query limited = query;
    limited.limit = 5;
    list_many(shafts, tree, kept, query);
    list_classified_many(shafts, tree, overlap, inside, query);
    count_many(shafts, tree, counts, query);
    count_many(shafts, tree, few, limited);
    count_classified_many(shafts, tree, classified, query);
    any_many(shafts, tree, found, query);
    cull_many(shafts, tree, kept_bits, query);
    classify_many(shafts, tree, {}, inside_bits, query);
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      SCOPED_TRACE("shaft " + std::to_string(s));
      const FlatAnswers flat = flat_answers(shafts[s], bounds, layers, asked[has_one_for_all ? 0 : s]);
      EXPECT_EQ(sorted(kept[s]), flat.kept());
      EXPECT_EQ(sorted(overlap[s]), flat.overlap);
      EXPECT_EQ(sorted(inside[s]), flat.inside);
      EXPECT_EQ(counts[s], flat.kept().size());
      EXPECT_EQ(few[s], std::min<std::size_t>(5, flat.kept().size()));
      EXPECT_EQ(classified[s], (KeptCounts{flat.overlap.size(), flat.inside.size()}));
      EXPECT_EQ((found[0] >> s & 1) != 0, !flat.kept().empty());
      const auto row_of = [&](const std::vector<std::uint64_t>& rows) {
        const auto first = rows.begin() + static_cast<std::ptrdiff_t>(s * row);
        return std::vector<std::uint64_t>(first, first + static_cast<std::ptrdiff_t>(row));
      };
      EXPECT_EQ(row_of(kept_bits), bits_of(flat.kept(), bounds.size()));
      EXPECT_EQ(row_of(inside_bits), bits_of(flat.inside, bounds.size()));
    }
  }
}

TYPED_TEST(TreeLayers, StayThroughUpdatesRebuildsAndCopies) {
  using Bound = BoundOf<TypeParam>;
  Random random(704);
  auto bounds = scene<Bound>(random, Shape::uniform, 5000);
  const Layers layers = random_layers(random, bounds.size());
  const std::vector<CompiledShaft> shafts = shafts_for(random, 3);
  TypeParam tree{std::span<const Bound>(bounds)};
  tree.set_layers(layers);
  const TypeParam copy(tree);
  const auto before = bounds;

  bounds = scene<Bound>(random, Shape::clustered, bounds.size());
  tree.update(std::span<const Bound>(bounds));
  this->expect_answers_with(tree, bounds, layers, shafts);
  const std::vector<std::uint32_t> some = {7, 4998, 64};
  for (const std::uint32_t i : some) bounds[i] = before[i];
  tree.update(some, std::span<const Bound>(std::vector<Bound>{before[7], before[4998], before[64]}));
  tree.refit();
  this->expect_answers_with(tree, bounds, layers, shafts);
  const std::vector<std::uint32_t> order(tree.order().begin(), tree.order().end());
  tree.rebuild();
  EXPECT_FALSE(std::equal(order.begin(), order.end(), tree.order().begin())) << "nothing moved";
  this->expect_answers_with(tree, bounds, layers, shafts);
  this->expect_answers_with(copy, before, layers, shafts);
  TypeParam moved(std::move(tree));
  this->expect_answers_with(moved, bounds, layers, shafts);
  moved = copy;
  this->expect_answers_with(moved, before, layers, shafts);
}

TYPED_TEST(TreeLayers, MoveWithTheirBoundsWhenTheseGetOtherIndices) {
  using Bound = BoundOf<TypeParam>;
  Random random(705);
  const auto bounds = scene<Bound>(random, Shape::uniform, 1000);
  const Layers layers = random_layers(random, bounds.size());
  TypeParam tree{std::span<const Bound>(bounds)};
  tree.set_layers(layers);
  std::vector<Bound> reordered;
  Layers their_layers;
  for (const auto i : tree.order()) {
    reordered.push_back(bounds[i]);
    their_layers.push_back(layers[i]);
  }
  EXPECT_EQ(Layers(tree.layers().begin(), tree.layers().end()), their_layers);
  tree.reorder();
  EXPECT_EQ(Layers(tree.layers().begin(), tree.layers().end()), their_layers);
  this->expect_answers_with(tree, reordered, their_layers, shafts_for(random, 3));
}

TYPED_TEST(TreeLayers, AreReplacedAndForgottenWithTheirMemory) {
  using Bound = BoundOf<TypeParam>;
  Random random(706);
  const auto bounds = scene<Bound>(random, Shape::uniform, 5000);
  TypeParam tree{std::span<const Bound>(bounds)};
  const std::size_t without = tree.memory_bytes();
  EXPECT_FALSE(tree.has_layers());
  EXPECT_TRUE(tree.layers().empty());
  tree.set_layers(random_layers(random, bounds.size()));
  EXPECT_GE(tree.memory_bytes(), without + 4 * bounds.size());
  EXPECT_LE(tree.memory_bytes(), without + 5 * bounds.size());
  const Layers layers = random_layers(random, bounds.size());
  tree.set_layers(layers);
  this->expect_answers_with(tree, bounds, layers, shafts_for(random, 2));
  tree.clear_layers();
  EXPECT_FALSE(tree.has_layers());
  EXPECT_EQ(tree.memory_bytes(), without);
}

TYPED_TEST(TreeLayers, OfSingleBoundsAreChangedWithThoseOfTheNodesAbove) {
  using Bound = BoundOf<TypeParam>;
  Random random(711);
  for (const std::size_t count : {100U, 9000U}) {
    const auto bounds = scene<Bound>(random, Shape::uniform, count);
    TypeParam tree{std::span<const Bound>(bounds)};
    Layers layers(count, 1);
    tree.set_layers(layers);
    const std::vector<CompiledShaft> shafts = shafts_for(random, 2);
    for (int again = 0; again != 4; ++again) {
      std::vector<std::uint32_t> some;
      Layers their_layers;
      for (int i = 0; i != 30; ++i) {
        some.push_back(random.below(static_cast<std::uint32_t>(count)));
        their_layers.push_back(again == 3 ? 0 : 1U << random.below(32));
      }
      some.push_back(some[0]);  // the last one counts
      their_layers.push_back(0x00ff0000);
      for (std::size_t i = 0; i != some.size(); ++i) layers[some[i]] = their_layers[i];
      tree.set_layers(some, their_layers);
      this->expect_answers_with(tree, bounds, layers, shafts);
    }
    // Where no bound is in a layer any longer, no node says that there is one.
    tree.set_layers(layers);
    const auto nodes = TreeAccess::parts(tree)->layers.nodes;
    std::vector<std::uint32_t> all(count);
    for (std::uint32_t i = 0; i != count; ++i) all[i] = i;
    tree.set_layers(all, Layers(count, 0x80));
    tree.set_layers(all, layers);
    EXPECT_EQ(TreeAccess::parts(tree)->layers.nodes, nodes);
  }
}

TYPED_TEST(TreeLayers, AreRefusedWhereTheyDoNotFit) {
  using Bound = BoundOf<TypeParam>;
  Random random(707);
  const auto bounds = scene<Bound>(random, Shape::uniform, 100);
  TypeParam tree{std::span<const Bound>(bounds)};
  const std::vector<CompiledShaft> shafts = shafts_for(random, 3);
  EXPECT_THAT(message_of([&] { static_cast<void>(count(shafts[0], tree, {.layer_mask = {1}})); }),
              AllOf(HasSubstr("query.layer_mask"), HasSubstr("call set_layers()")));
  for (const std::size_t wrong : {0U, 99U, 101U}) {
    EXPECT_THAT(message_of([&] { tree.set_layers(Layers(wrong)); }),
                HasSubstr("set_layers() of a tree of 100 bounds got those of " + std::to_string(wrong)));
  }
  EXPECT_THAT(message_of([&] {
                tree.set_layers({static_cast<const std::uint32_t*>(nullptr), 100});
              }),
              HasSubstr("layers is null"));
  const std::vector<std::uint32_t> some = {3, 100};
  EXPECT_THAT(message_of([&] { tree.set_layers(std::span(some).first(1), Layers(1)); }),
              HasSubstr("a tree without layers; give those of all bounds first"));
  EXPECT_FALSE(tree.has_layers());
  tree.set_layers(Layers(100, 1));
  EXPECT_THAT(message_of([&] { tree.set_layers(some, Layers(2, 8)); }),
              HasSubstr("indices[1] = 100 is not below the number of bounds, 100"));
  EXPECT_THAT(message_of([&] { tree.set_layers(some, Layers(3, 8)); }), HasSubstr("2 indices and the layers of 3"));
  EXPECT_EQ(Layers(tree.layers().begin(), tree.layers().end()), Layers(100, 1));
  std::vector<std::uint64_t> counts(shafts.size(), 77);
  EXPECT_THAT(message_of([&] {
                count_many(shafts, tree, counts, {.layer_mask = {1, 2}});
              }),
              HasSubstr("query.layer_mask has 2 sets of layers for 3 shafts; give one for each, or one for all"));
  EXPECT_THAT(message_of([&] {
                count_many(shafts, tree, counts,
                           {.layer_mask = std::span(static_cast<const std::uint32_t*>(nullptr), 3)});
              }),
              HasSubstr("query.layer_mask is null"));
  EXPECT_EQ(counts, std::vector<std::uint64_t>(shafts.size(), 77));
  EXPECT_EQ(count(shafts[0], TypeParam(), {.layer_mask = {1}}), 0U) << "an empty tree needs no layers";
}

TEST(TreeLayerWalk, PassesOverNodesOfOtherLayers) {
  Random random(708);
  const std::vector<Box> boxes = scene<Box>(random, Shape::uniform, 100000);
  BoxTree tree{std::span<const Box>(boxes)};
  Layers layers;  // a tenth of the space is layer 0
  for (const Box& box : boxes) layers.push_back(box.lo[0] < -4 ? 1 : 2);
  tree.set_layers(layers);
  const CompiledShaft shaft = compile({{-6, -6, 0}, {6, 6, 0.01F}}, {{-6, -6, 0}, {6, 6, 0.01F}});
  const kernel::TreeParts<Box>& parts = *TreeAccess::parts(tree);
  const kernel::Kernels kernels = counting_kernels();
  const auto words_for_layers = [&](std::uint32_t mask) {
    words_tested = 0;
    kernel::Counter counter(kernels);
    walk(parts, kernels, shaft, kernel::Question::kept, counter, {parts.layers, parts.level.data(), mask, kernels});
    EXPECT_EQ(counter.result(), flat_answers(shaft, boxes, layers, mask).kept().size());
    return words_tested;
  };
  const std::size_t all = words_for_layers(3);
  EXPECT_GT(all, 50U);
  EXPECT_LT(words_for_layers(1), all / 3);
  EXPECT_LT(words_for_layers(4), all / 10) << "a layer that nothing is in";
}

TEST(KeepLayers, TellsTheSameOnEveryInstructionSet) {
  Random random(709);
  for (int i = 0; i != 200; ++i) {
    const Layers layers = random_layers(random, 64);
    const std::uint32_t mask = random.one_in(2) ? random.below(0xffffffff) : 1U << random.below(32);
    std::uint64_t expected = 0;
    for (std::size_t k = 0; k != 64; ++k) expected |= std::uint64_t{(layers[k] & mask) != 0} << k;
    for (const Isa isa : isas_under_test()) {
      const UseIsa use(isa);
      ASSERT_EQ(kernel::active_kernels().keep_layers(layers.data(), mask), expected) << name(isa) << ", " << mask;
    }
  }
}

}  // namespace
}  // namespace shaftcull
