// SPDX-License-Identifier: MIT
/// A dynamic tree and a plain array, which are given the same random changes.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "columns.hpp"
#include "oracle/random.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/occluded.hpp"
#include "tree/flat.hpp"
#include "tree/scenes.hpp"

namespace shaftcull {

using DynamicKinds = testing::Types<Box, Sphere>;

/// What stands for an index without a bound: outside of everything.
template <class Bound>
Bound nothing() {
  if constexpr (std::is_same_v<Bound, Box>) {
    return empty_box;
  } else {
    return {{0, 0, 0}, -1};
  }
}

/// By index: bounds, their layers, and their ids.
template <class Bound>
struct Model {
  std::vector<Bound> bounds;
  std::vector<std::uint32_t> layers;  ///< 0 without a bound
  std::vector<BoundId> ids;           ///< the last one of each index
  std::vector<std::uint8_t> has_bound;

  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(std::count(has_bound.begin(), has_bound.end(), 1));
  }
  void insert(BoundId id, const Bound& bound, std::uint32_t layers_of_bound) {
    if (id.index == bounds.size()) {
      bounds.emplace_back();
      layers.emplace_back();
      ids.emplace_back();
      has_bound.emplace_back();
    }
    ASSERT_LT(id.index, bounds.size());
    EXPECT_EQ(has_bound[id.index], 0);
    EXPECT_NE(ids[id.index], id);
    bounds[id.index] = bound;
    layers[id.index] = layers_of_bound;
    ids[id.index] = id;
    has_bound[id.index] = 1;
  }
  void erase(std::uint32_t index) {
    bounds[index] = nothing<Bound>();
    layers[index] = 0;
    has_bound[index] = 0;
  }
};

/// How changes are made.
struct Changes {
  Shape shape = Shape::uniform;
  std::size_t count = 100;
  unsigned insertions = 4;  ///< of ten changes, about so many; others erase, move, and change layers
  bool layers = false;
};

template <class Bound>
class World {
 public:
  explicit World(std::uint64_t seed) : random_(seed) {}

  DynamicTree<Bound> tree;
  Model<Bound> model;

  void change(const Changes& how) {
    for (std::size_t i = 0; i != how.count; ++i) {
      if (model.bounds.empty() || random_.below(10) < how.insertions) {
        insert(how);
        continue;
      }
      const auto index = static_cast<std::uint32_t>(random_.below(static_cast<unsigned>(model.bounds.size())));
      if (model.has_bound[index] == 0) {
        EXPECT_FALSE(tree.has(model.ids[index]));
        continue;
      }
      change(index, how);
    }
    EXPECT_EQ(tree.bound_count(), model.count());
  }
  [[nodiscard]] Random& random() { return random_; }

 private:
  [[nodiscard]] Bound some(Shape shape) { return scene<Bound>(random_, shape, 1).front(); }
  void insert(const Changes& how) {
    const Bound bound = some(how.shape);
    const std::uint32_t layers = how.layers ? random_.below(8) : all_layers;
    model.insert(tree.insert(bound, layers), bound, layers);
  }
  void change(std::uint32_t index, const Changes& how) {
    const BoundId id = model.ids[index];
    EXPECT_TRUE(tree.has(id));
    EXPECT_EQ(tree[id], model.bounds[index]);
    EXPECT_EQ(tree.id_of(index), id);
    switch (random_.below(how.layers ? 5 : 4)) {
      case 0:
      case 1:
        tree.erase(id);
        model.erase(index);
        break;
      case 2:
        model.bounds[index] = some(how.shape);
        tree.move(id, model.bounds[index]);
        break;
      case 3:
        tree.move_by(id, {random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1)});
        model.bounds[index] = tree[id];
        break;
      default:
        model.layers[index] = random_.below(8);
        tree.set_layers(id, model.layers[index]);
        break;
    }
  }

  Random random_;
};

/// All outputs of a shaft, of a dynamic tree and of a view of the model.
template <class Bound>
void expect_same_answers(const CompiledShaft& shaft, const Bounds& tree, const Bounds& view, const Query& query) {
  const std::size_t words = bit_words(view.size());
  ASSERT_EQ(tree.size(), view.size());
  std::vector<std::uint64_t> kept[2];
  std::vector<std::uint64_t> inside[2];
  Indices list_of[2];
  for (const unsigned i : {0U, 1U}) {
    const Bounds& bounds = i == 0 ? tree : view;
    kept[i].resize(words);
    inside[i].resize(words);
    classify(shaft, bounds, kept[i], inside[i], query);
    list(shaft, bounds, list_of[i], query);
  }
  EXPECT_EQ(kept[0], kept[1]);
  EXPECT_EQ(inside[0], inside[1]);
  EXPECT_EQ(sorted(list_of[0]), list_of[1]);
  std::vector<std::uint64_t> culled(words);
  cull(shaft, tree, culled, query);
  EXPECT_EQ(culled, kept[1]);
  EXPECT_EQ(count(shaft, tree, query), list_of[1].size());
  EXPECT_EQ(count_classified(shaft, tree, query), count_classified(shaft, view, query));
  EXPECT_EQ(any(shaft, tree, query), !list_of[1].empty());
  Query first = query;
  first.limit = 3;
  Indices some;
  list(shaft, tree, some, first);
  ASSERT_EQ(some.size(), std::min<std::size_t>(3, list_of[0].size()));
  EXPECT_TRUE(std::equal(some.begin(), some.end(), list_of[0].begin()));
}

/// What takes candidates, of which some have no bound.
inline void expect_same_of_candidates(const CompiledShaft& shaft, const Bounds& tree, const Bounds& view,
                                      const Indices& candidates, const Query& query) {
  Query of_candidates = query;
  of_candidates.only = candidates;
  Indices list_of[2];
  list(shaft, tree, list_of[0], of_candidates);
  list(shaft, view, list_of[1], of_candidates);
  EXPECT_EQ(list_of[0], list_of[1]);
}

inline void expect_same_contacts(const CompiledShaft& sweep, const Bounds& tree, const Bounds& view,
                                 const Indices& indices, const Query& query) {
  EXPECT_EQ(first_contact(sweep, tree, query), first_contact(sweep, view, query));
  Query skipping = query;
  skipping.skip_overlapping = true;
  EXPECT_EQ(first_contact(sweep, tree, skipping), first_contact(sweep, view, skipping));
  std::vector<float> times[2] = {std::vector<float>(indices.size()), std::vector<float>(indices.size())};
  entry_times(sweep, tree, indices, times[0]);
  entry_times(sweep, view, indices, times[1]);
  EXPECT_EQ(times[0], times[1]);
}

/// Whether a snapshot has the bounds of the model.
template <class Bound>
void expect_same_bounds(const TreeSnapshot<Bound>& snapshot, const Model<Bound>& model) {
  ASSERT_EQ(snapshot.index_end(), model.bounds.size());
  EXPECT_EQ(snapshot.bound_count(), model.count());
  for (std::uint32_t i = 0; i != model.bounds.size(); ++i) {
    ASSERT_EQ(snapshot.has(i), model.has_bound[i] != 0) << i;
    if (model.has_bound[i] == 0) continue;
    ASSERT_EQ(snapshot[i], model.bounds[i]) << i;
  }
}

/// Whether a snapshot shows the model, by all verbs and options.
template <class Bound>
void expect_equal(const TreeSnapshot<Bound>& snapshot, const Model<Bound>& model, Random& random) {
  expect_same_bounds(snapshot, model);
  if (testing::Test::HasFatalFailure()) return;
  const auto memory = columns(model.bounds);
  const Bounds view(memory.view(), model.layers);
  const Bounds tree(snapshot);
  const auto bounds = static_cast<unsigned>(model.bounds.size());
  Indices some;
  for (unsigned i = 0; bounds != 0 && i != 50; ++i) some.push_back(random.below(bounds));
  const std::vector<CompiledShaft> shafts = shafts_for(random, 4);
  for (const CompiledShaft& shaft : shafts) {
    for (const Query& query :
         {Query{}, Query{.exclude = some}, Query{.layer_mask = {1}}, Query{.exclude = some, .layer_mask = {6}}}) {
      expect_same_answers<Bound>(shaft, tree, view, query);
      expect_same_of_candidates(shaft, tree, view, some, query);
    }
  }
  const CompiledShaft sweep = swept(random.box(-5, 5, 0.1F, 0.5F), random.vec3(-5, 5));
  expect_same_contacts(sweep, tree, view, some, {});
  expect_same_contacts(sweep, tree, view, some, {.layer_mask = {3}});
  if constexpr (std::is_same_v<Bound, Box>) {
    const CompiledShaft pair = compile(random.box(-5, 5, 0, 0.1F), random.box(-5, 5, 0, 0.1F));
    Indices blocking[2];
    list_occluders(pair, tree, blocking[0]);
    list_occluders(pair, view, blocking[1]);
    EXPECT_EQ(sorted(blocking[0]), blocking[1]);
    EXPECT_EQ(occluded(pair, tree), !blocking[1].empty());
  }
  IndexLists lists[2];
  list_many(shafts, tree, lists[0]);
  list_many(shafts, view, lists[1]);
  for (std::size_t s = 0; s != shafts.size(); ++s) EXPECT_EQ(sorted(lists[0][s]), sorted(lists[1][s]));
}

}  // namespace shaftcull
