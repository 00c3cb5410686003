// SPDX-License-Identifier: MIT
/// FCL's dynamic tree, which the library's is measured against.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "shaftcull/bounds.hpp"

namespace shaftcull::bench {

/// DynamicAABBTreeCollisionManager, with one object for each box.
class FclTree {
 public:
  explicit FclTree(std::span<const Box> boxes);
  FclTree(const FclTree&) = delete;
  FclTree& operator=(const FclTree&) = delete;
  ~FclTree();

  /// Takes a box out and puts another in.
  void replace(std::uint32_t index, const Box& box);
  /// Gives a box other coordinates; all at once at the end of the frame.
  void move(std::uint32_t index, const Box& box);
  void end_frame();

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace shaftcull::bench
