// SPDX-License-Identifier: MIT
/// Trials of convex hulls.
#include <cstddef>
#include <iterator>

#include "oracle/cases/hulls.hpp"
#include "oracle/convex_hull.hpp"
#include "oracle/random.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/hull.hpp"
#include "trial/trial.hpp"

namespace shaftcull::cli {
void Trial::make_hull(Random& random) {
  const HullFamily& family = hull_families[random.below(std::size(hull_families))];
  const HullInput input = family.input(random);
  input_ = input;
  hull_.emplace(input.points, input.directions);
  shaft_ = hull_->compiled();
  const oracle::ConvexHull exact(input);
  for (std::size_t i = 0; i != count_; ++i) {
    if (spheres_) {
      // Some may be kept that miss the hull: all instruction sets must answer as this one does, and that must be one of
      // the answers that are right.
      const Sphere sphere = family.sphere(random, input, exact);
      set(i, sphere);
      note(i, exact.corrected(sphere, classify(shaft_, sphere)));
    } else {
      const Box box = family.box(random, input);
      set(i, box);
      note(i, exact.answer(box));
    }
    ++counts_.by_rationals;
  }
}

}  // namespace shaftcull::cli
