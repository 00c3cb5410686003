// SPDX-License-Identifier: MIT
#include "visibility/box_clumps.hpp"

#include <algorithm>
#include <numeric>

#include "shaftcull/tree.hpp"

namespace shaftcull::kernel {

BoxClumps box_clumps(std::span<const BoxRow> boxes) {
  BoxClumps clumps;
  if (boxes.size() < BoxClumps::fewest_boxes) return clumps;
  const float* const face = boxes[0].face;
  const BoxTree tree(StridedBoxes{face, face + 3, sizeof(BoxRow), boxes.size()});
  clumps.members.assign(tree.order().begin(), tree.order().end());
  clumps.around.reserve((boxes.size() + BoxClumps::size - 1) / BoxClumps::size);
  for (std::size_t first = 0; first < boxes.size(); first += BoxClumps::size) {
    const std::size_t count = std::min(BoxClumps::size, boxes.size() - first);
    BoxRow around = boxes[clumps.members[first]];
    for (const std::uint32_t member : std::span(clumps.members).subspan(first + 1, count - 1)) {
      for (std::size_t k = 0; k != 3; ++k) {
        around.face[k] = std::min(around.face[k], boxes[member].face[k]);
        around.face[k + 3] = std::max(around.face[k + 3], boxes[member].face[k + 3]);
      }
    }
    clumps.around.push_back(around);
  }
  clumps.numbers.resize(clumps.around.size());
  std::iota(clumps.numbers.begin(), clumps.numbers.end(), std::uint32_t{0});
  return clumps;
}

}  // namespace shaftcull::kernel
