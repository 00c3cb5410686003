// SPDX-License-Identifier: MIT
#include "shaftcull/solids.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hashes/cases.hpp"
#include "hashes/digest.hpp"
#include "hashes/hashes.hpp"

namespace shaftcull::hashes {

/// Boxes of a lattice that are joined where they can be, and large boxes inside hulls of 8 points.
std::uint64_t solids(std::uint64_t scenes, Way /*way*/) {
  constexpr std::size_t boxes_a_scene = 40;
  Numbers numbers;
  Digest digest;
  for (std::uint64_t s = 0; s != scenes; ++s) {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i != boxes_a_scene; ++i) {
      const Vec3 p = point(numbers, &Numbers::grid);
      Vec3 q = p;
      for (float& x : q) x += static_cast<float>(numbers.below(3));
      boxes.push_back({p, q});
    }
    for (const Box& joined : merged_boxes(boxes)) digest.add_box(joined);
    std::vector<Vec3> corners;
    for (int i = 0; i != 8; ++i) corners.push_back(point(numbers, s % 2 == 0 ? &Numbers::fine : &Numbers::grid));
    digest.add_box(inscribed_box(corners));
  }
  return digest.value();
}

}  // namespace shaftcull::hashes
