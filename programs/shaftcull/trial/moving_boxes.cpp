// SPDX-License-Identifier: MIT
/// Trials of shafts of moving boxes: swept bodies and shadows.
#include <cstddef>
#include <iterator>
#include <optional>

#include "oracle/cases/moving.hpp"
#include "oracle/moving_hull.hpp"
#include "oracle/open_contact.hpp"
#include "oracle/random.hpp"
#include "shaftcull/compiled.hpp"
#include "trial/trial.hpp"

namespace shaftcull::cli {
namespace {

/// Of these trials, one in this many is about open contact.
constexpr unsigned open_moving_trials = 4;

}  // namespace

void Trial::make_moving(Random& random, MovingKind kind) {
  const MovingFamily& family = moving_families[random.below(std::size(moving_families))];
  MovingInput input = family.input(random, kind);
  if (random.one_in(open_moving_trials)) input.contact = Contact::open;
  input_ = input;
  shaft_ = shaft_of(input);
  if (random.one_in(2)) complete(shaft_);
  batched_ = random.one_in(2);

  const oracle::MovingHull closed(input);
  std::optional<oracle::OpenHull> open;
  if (input.contact == Contact::open) open.emplace(input);
  const auto answer_by_oracle = [&](std::size_t i, const auto& bound) {
    set(i, bound);
    note(i, open ? open->answer(bound) : closed.answer(bound));
    ++counts_.by_rationals;
  };
  for (std::size_t i = 0; i != count_; ++i) {
    if (spheres_) {
      answer_by_oracle(i, family.sphere(random, input, closed));
    } else {
      answer_by_oracle(i, family.box(random, input));
    }
  }
  sometimes_find_first_contact(random);
  sometimes_find_triangles(random);
}

}  // namespace shaftcull::cli
