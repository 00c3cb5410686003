// SPDX-License-Identifier: MIT
/// Boost.Geometry's R-tree, which dynamic trees are measured against.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shaftcull/bounds.hpp"

namespace shaftcull::bench {

/// boost::geometry::index::rtree of boxes and their indices, by R* with 16 entries a node.
class BoostTree {
 public:
  explicit BoostTree(std::span<const Box> boxes);
  BoostTree(const BoostTree&) = delete;
  BoostTree& operator=(const BoostTree&) = delete;
  ~BoostTree();

  /// Takes a box out and puts another in.
  void replace(std::uint32_t index, const Box& before, const Box& after);

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace shaftcull::bench
