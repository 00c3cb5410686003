// SPDX-License-Identifier: MIT
/// Two ends that face each other, and boxes between them that hide one from the other as often as not.
#pragma once

#include <utility>
#include <vector>

#include "oracle/random.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull {

struct Ends {
  std::vector<Vec3> p;
  std::vector<Vec3> q;
};

/// Up to four points each, at any angle or on a grid, one end to the left and the other to the right.
inline Ends random_ends(Random& random, bool on_grid) {
  Ends ends;
  for (std::vector<Vec3>* const end : {&ends.p, &ends.q}) {
    const float x = end == &ends.p ? -6.0F : 6.0F;
    const unsigned corners = 1 + random.below(4);
    for (unsigned c = 0; c != corners; ++c) {
      end->push_back(on_grid ? Vec3{x + random.integer(-1, 1), random.integer(-2, 2), random.integer(-2, 2)}
                             : Vec3{x + random.uniform(-1, 1), random.uniform(-2, 2), random.uniform(-2, 2)});
    }
    if (random.one_in(4)) {  // in a plane across x
      for (Vec3& corner : *end) corner[0] = x;
    }
  }
  if (random.one_in(4)) std::swap(ends.p, ends.q);
  return ends;
}

/// A wall between the ends, as a rule: many hide them from each other.
inline Box random_wall(Random& random, bool on_grid) {
  if (random.one_in(6)) return on_grid ? random.grid_box(-8, 8) : random.box(-8, 8, 0, 3);
  const auto size = [&] { return on_grid ? random.integer(1, 3) : random.uniform(0.5F, 4); };
  const float x = on_grid ? random.integer(-6, 6) : random.uniform(-6, 6);
  return {{x, -size(), -size()}, {x + (random.one_in(3) ? 0 : size()), size(), size()}};
}

}  // namespace shaftcull
