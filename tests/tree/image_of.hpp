// SPDX-License-Identifier: MIT
/// Images of trees, for tests.
#pragma once

#include <cstddef>
#include <vector>

#include "shaftcull/tree_image.hpp"

namespace shaftcull {

template <class Tree>
std::vector<std::byte> image_of(const Tree& tree) {
  std::vector<std::byte> image(image_bytes(tree));
  write_image(tree, image);
  return image;
}

}  // namespace shaftcull
