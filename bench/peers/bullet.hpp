// SPDX-License-Identifier: MIT
/// Bullet's dynamic tree, which the library's is measured against.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shaftcull/bounds.hpp"

namespace shaftcull::bench {

/// btDbvt with one leaf for each box, as its broad phase builds it: by insertion.
class BulletTree {
 public:
  explicit BulletTree(std::span<const Box> boxes);
  BulletTree(const BulletTree&) = delete;
  BulletTree& operator=(const BulletTree&) = delete;
  ~BulletTree();

  /// Indices of the boxes that a box of the size of `from` meets on its way to `to`, by rayTestInternal() with the
  /// boxes grown by half its size, as btDbvtBroadphase::rayTest() does.
  void sweep(const Box& from, const Box& to, std::vector<std::uint32_t>& hits);

  /// Takes a box out and puts another in, as its broad phase does when a body is removed and one is added.
  void replace(std::uint32_t index, const Box& box);
  /// Moves a box.
  void move(std::uint32_t index, const Box& box);
  /// Improves the tree a little, as its broad phase does once a frame.
  void end_frame();

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace shaftcull::bench
