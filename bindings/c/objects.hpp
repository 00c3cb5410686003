// SPDX-License-Identifier: MIT
/// What the handles of the C interface are.
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "shaftcull.h"
#include "shaftcull/shaftcull.hpp"

struct shaftcull_shaft {
  shaftcull::Shaft formed;
};

/// Hulls are shared: arrays of shafts that one was put into own it, too.
struct shaftcull_hull {
  std::shared_ptr<const shaftcull::ConvexHull> hull;
};

struct shaftcull_shafts {
  std::vector<shaftcull::CompiledShaft> compiled;
  /// The hull that each of them refers to; none of them are there until the first hull is.
  std::vector<std::shared_ptr<const shaftcull::ConvexHull>> hulls;
};

struct shaftcull_bounds {
  std::variant<shaftcull::BoxView, shaftcull::SphereView, shaftcull::TriangleView, shaftcull::BoxStream,
               shaftcull::SphereStream, shaftcull::TriangleStream, shaftcull::BoxTree, shaftcull::SphereTree,
               shaftcull::TriangleTree>
      holder;
  /// Of a view or stream: none, or as many as there were bounds when they were set. Trees have their own.
  std::vector<std::uint32_t> layers{};
};

struct shaftcull_lists {
  shaftcull::IndexLists lists;
};
