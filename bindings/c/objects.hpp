// SPDX-License-Identifier: MIT
/// The objects behind the handles of the C interface.
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "shaftcull.h"
#include "shaftcull/shaftcull.hpp"

/// Hulls are shared: arrays of shafts that hold one own it, too.
struct shaftcull_hull {
  std::shared_ptr<const shaftcull::ConvexHull> hull;
};

struct shaftcull_shafts {
  std::vector<shaftcull::CompiledShaft> compiled;
  /// The hull to which each of them refers. Empty until the array gets its first hull.
  std::vector<std::shared_ptr<const shaftcull::ConvexHull>> hulls;
};

struct shaftcull_bounds {
  std::variant<shaftcull::BoxView, shaftcull::SphereView, shaftcull::TriangleView, shaftcull::BoxStream,
               shaftcull::SphereStream, shaftcull::TriangleStream, shaftcull::BoxTree, shaftcull::SphereTree,
               shaftcull::TriangleTree, shaftcull::DynamicBoxTree, shaftcull::DynamicSphereTree,
               shaftcull::BoxTreeSnapshot, shaftcull::SphereTreeSnapshot>
      holder;
  /// The layers of a view or stream: none, or one set for each bound that there was when they were set. Trees have
  /// their own.
  std::vector<std::uint32_t> layers{};
};

struct shaftcull_lists {
  shaftcull::IndexLists lists;
};

struct shaftcull_patches {
  shaftcull::PatchSet set;
};

struct shaftcull_occluders {
  shaftcull::Occluders all;
};

namespace shaftcull::binding {

template <class Holder>
concept View = std::same_as<Holder, BoxView> || std::same_as<Holder, SphereView> || std::same_as<Holder, TriangleView>;
template <class Holder>
concept Stream = requires(const Holder& holder) {
  holder.view();
};
/// A tree of bounds that may move, but neither come nor go.
template <class Holder>
concept ChangingTree = requires(const Holder& holder) {
  holder.needs_refit();
};

/// A tree of bounds that come and go, and a state of it.
template <class Holder>
concept Dynamic = std::same_as<Holder, DynamicBoxTree> || std::same_as<Holder, DynamicSphereTree>;
template <class Holder>
concept Snapshot = std::same_as<Holder, BoxTreeSnapshot> || std::same_as<Holder, SphereTreeSnapshot>;

/// What queries of one of these see.
template <Dynamic Holder>
const auto& state_of(const Holder& tree) {
  return tree.committed();
}
template <Snapshot Holder>
const Holder& state_of(const Holder& snapshot) {
  return snapshot;
}

/// The floats of any other holder.
template <class Holder>
auto streams_of(const Holder& holder) {
  if constexpr (View<Holder>) {
    return holder;
  } else if constexpr (Stream<Holder>) {
    return holder.view();
  } else if constexpr (requires { holder.leaves(); }) {
    return holder.leaves();
  } else {
    return holder.triangles();
  }
}

/// "a tree of boxes", for example.
[[nodiscard]] std::string name_of(const shaftcull_bounds& bounds);

}  // namespace shaftcull::binding
