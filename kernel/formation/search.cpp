// SPDX-License-Identifier: MIT
#include "formation/search.hpp"

namespace shaftcull::kernel {

JoinedEdges search_edges(const Faces6& a, const Faces6& b) noexcept {
  const Colouring colouring = colours(a, b);
  JoinedEdges joined;
  for (Face first = 0; first < face_count - 1; ++first) {
    if (colouring[first] == Colour::purple) continue;  // the boxes are flush here: nothing to join
    for (Face second = first + 1; second < face_count; ++second) {
      if (colouring[second] == Colour::purple || first + 3 == second) continue;  // opposite faces share no edge
      if (colouring[first] == colouring[second]) continue;
      const bool first_is_red = colouring[first] == Colour::red;
      joined.add(first_is_red ? JoinedEdge{first, second} : JoinedEdge{second, first});
    }
  }
  return joined;
}

}  // namespace shaftcull::kernel
