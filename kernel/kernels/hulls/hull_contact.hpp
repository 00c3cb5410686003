// SPDX-License-Identifier: MIT
/// Boxes that touch a convex hull with open contact. The other stages have found those that miss it.
#pragma once

#include "exact/convex_hull.hpp"
#include "kernels/hulls/hull_boxes.hpp"
#include "kernels/hulls/hull_depths.hpp"
#include "kernels/shared/word.hpp"

namespace shaftcull::kernel {

/// Bits of the boxes of the vector at `at` that may touch a plane of the hull or a face of its box. All others reach
/// behind each of them.
template <class L, bool bounded>
[[nodiscard]] std::uint64_t hull_touching_vector(const HullData& hull, const float* const* stream,
                                                 std::size_t at) noexcept {
  HullDepths<L, 1, bounded> depths;
  depths.template add_boxes<3, HullCorner::near>(hull, 0, hull.faces, stream, at);
  depths.template add_boxes<2, HullCorner::near>(hull, hull.faces, hull.faces + hull.edges, stream, at);
  const auto touches =
      bounded ? L::less_equal(depths.most[0], L::all(2 * hull_margin)) : L::less_equal(depths.least[0], L::all(0.0F));
  return L::bits(touches) | touching_hull_box<L, 1>(hull, stream, at);
}

/// Clears the bits of boxes that are kept with closed contact and not with open contact.
template <class L>
void hull_contact_stage(const HullData& hull, const float* const* stream, std::size_t words,
                        std::uint64_t* kept) noexcept {
  for (std::size_t w = 0; w < words; ++w) {
    std::uint64_t touching = hull.suits_floats ? 0 : ~std::uint64_t{0};
    for (unsigned lane = 0; lane < word_bits && hull.suits_floats; lane += L::width) {
      if ((kept[w] & lanes_of<L>(lane)) == 0) continue;
      const std::size_t at = w * word_bits + lane;
      touching |= (hull.is_bounded ? hull_touching_vector<L, true>(hull, stream, at)
                                   : hull_touching_vector<L, false>(hull, stream, at))
                  << lane;
    }
    touching &= kept[w];
    if (touching == 0) continue;
    kept[w] &= ~decide_lanes<L>(touching, [&](unsigned lane) {
      return hull_box_outside_openly(hull, BoundAt<L, 6>(stream, w * word_bits + lane).value);
    });
  }
}

}  // namespace shaftcull::kernel
