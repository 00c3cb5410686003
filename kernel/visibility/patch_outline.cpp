// SPDX-License-Identifier: MIT
#include "visibility/patch_outline.hpp"

#include <string>

#include "shaftcull/error.hpp"
#include "support/fail.hpp"

namespace shaftcull::kernel {
namespace {

/// An axis across which a box is flat; 3 if there is none.
std::size_t flat_axis(const Box& box) noexcept {
  std::size_t axis = 0;
  while (axis != 3 && box.lo[axis] != box.hi[axis]) ++axis;
  return axis;
}

}  // namespace

PatchCorners outline_of_flat_box(const Box& box, float towards) noexcept {
  const std::size_t axis = flat_axis(box);
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  PatchCorners corners;
  constexpr bool is_hi[4][2] = {{false, false}, {true, false}, {true, true}, {false, true}};
  for (std::size_t c = 0; c != 4; ++c) {
    Vec3 corner = box.lo;
    const bool(&of)[2] = is_hi[towards < 0 ? (4 - c) % 4 : c];
    corner[u] = of[0] ? box.hi[u] : box.lo[u];
    corner[v] = of[1] ? box.hi[v] : box.lo[v];
    corners.add(corner);
  }
  return corners;
}

PatchCorners outline_of(const PatchTree& tree, std::size_t position) {
  if (tree.has_corners()) return tree.corners_of(position);
  const PatchStreams& patches = tree.patch_streams();
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    box.lo[k] = patches.stream(k)[position];
    box.hi[k] = patches.stream(k + 3)[position];
  }
  const std::size_t axis = flat_axis(box);
  if (axis == 3) {
    fail(InvalidArgument("patch " + std::to_string(tree.order()[position]) +
                         " is a box that is not flat; rays and view factors are of polygons"));
  }
  return outline_of_flat_box(box, patches.has_planes() ? patches.stream(6 + axis)[position] : 1);
}

}  // namespace shaftcull::kernel
