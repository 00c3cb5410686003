// SPDX-License-Identifier: MIT
/// Trials of convex hulls: of points and directions, and between two ends.
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>

#include "oracle/cases/ends.hpp"
#include "oracle/cases/hulls.hpp"
#include "oracle/convex_hull.hpp"
#include "oracle/open_contact.hpp"
#include "oracle/random.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/hull.hpp"
#include "trial/trial.hpp"

namespace shaftcull::cli {
namespace {

/// Of these trials, one in this many is about open contact.
constexpr unsigned open_hull_trials = 3;

/// Right answers, with either contact.
class RightAnswers {
 public:
  explicit RightAnswers(const HullInput& input) : closed(input) {
    if (input.contact == Contact::open) open_.emplace(input);
  }

  [[nodiscard]] Answer of(const Box& box) const { return open_ ? open_->answer(box) : closed.answer(box); }
  /// The library's answer about a sphere if it is one of those that are right. Some may be kept that miss the hull: all
  /// instruction sets must answer as the first one does.
  [[nodiscard]] Answer of(const CompiledShaft& shaft, const Sphere& sphere) const {
    const Answer found = classify(shaft, sphere);
    return open_ ? open_->corrected(sphere, found) : closed.corrected(sphere, found);
  }

  const oracle::ConvexHull closed;

 private:
  std::optional<oracle::OpenConvexHull> open_;
};

}  // namespace

void Trial::make_hull(Random& random) {
  const HullFamily& family = hull_families[random.below(std::size(hull_families))];
  HullInput input = family.input(random);
  if (random.one_in(open_hull_trials)) input.contact = Contact::open;
  input_ = input;
  hull_.emplace(input.points, input.directions);
  shaft_ = hull_->compiled();
  set_contact(shaft_, input.contact);
  const RightAnswers right(input);
  for (std::size_t i = 0; i != count_; ++i) {
    if (spheres_) {
      const Sphere sphere = family.sphere(random, input, right.closed);
      set(i, sphere);
      note(i, right.of(shaft_, sphere));
    } else {
      const Box box = family.box(random, input);
      set(i, box);
      note(i, right.of(box));
    }
    ++counts_.by_rationals;
  }
  sometimes_find_triangles(random);
}

void Trial::make_hull_between_ends(Random& random) {
  const bool on_grid = random.one_in(2);
  const Ends ends = random_ends(random, on_grid);
  HullInput input{ends.p, {}, random.one_in(open_hull_trials) ? Contact::open : Contact::closed, ends.p.size()};
  input.points.insert(input.points.end(), ends.q.begin(), ends.q.end());
  input_ = input;
  hull_.emplace(between_polygons(ends.p, ends.q));
  shaft_ = hull_->compiled();
  set_contact(shaft_, input.contact);
  const RightAnswers right(input);
  for (std::size_t i = 0; i != count_; ++i) {
    if (spheres_) {
      const Vec3 centre = random_wall(random, on_grid).lo;
      const Sphere sphere = sphere_around(random, right.closed, centre, 3);
      set(i, sphere);
      note(i, right.of(shaft_, sphere));
    } else {
      const Box box = random_wall(random, on_grid);
      set(i, box);
      note(i, right.of(box));
      note_blocking(i, input);
    }
    ++counts_.by_rationals;
  }
  sometimes_find_triangles(random);
}

}  // namespace shaftcull::cli
