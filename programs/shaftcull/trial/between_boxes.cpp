// SPDX-License-Identifier: MIT
/// Trials of shafts between two boxes.
#include <optional>

#include <fmt/format.h>

#include "oracle/cases/families.hpp"
#include "oracle/hull.hpp"
#include "oracle/open_contact.hpp"
#include "oracle/quick_hull.hpp"
#include "oracle/random.hpp"
#include "oracle/shaft_input.hpp"
#include "shaftcull/paper.hpp"
#include "trial/seed.hpp"
#include "trial/trial.hpp"

namespace shaftcull::cli {
namespace {

/// Of the answers that the quick oracle proves, one in this many is worked out in rationals all the same.
constexpr unsigned second_opinion = 64;

/// Of these trials, one in this many is about open contact: rationals work out all of its answers.
constexpr unsigned open_trials = 32;

CompiledShaft formed(Random& random, const ShaftInput& input) {
  ShaftOptions options;
  options.formation = static_cast<Formation>(random.below(3));
  options.order = static_cast<PlaneOrder>(random.below(3));
  Shaft shaft(input.a, input.b, options);
  for (const Plane& plane : input.added) shaft.add_plane(plane);
  CompiledShaft compiled = compile(shaft);
  set_contact(compiled, input.contact);
  return compiled;
}

}  // namespace

void Trial::make_between_boxes(Random& random, const Family& family, unsigned index) {
  ShaftInput input = family.shaft(random, index);
  if ((mixed(number_) >> 40U) % open_trials == 0) input.contact = Contact::open;
  input_ = input;
  shaft_ = formed(random, input);
  batched_ = input.added.empty() && random.one_in(2);

  const oracle::QuickHull quick(input);
  std::optional<oracle::Hull> exact;
  std::optional<oracle::OpenHull> open;
  if (input.contact == Contact::open) open.emplace(input);
  const auto answer_by_oracle = [&](std::size_t i, const auto& bound) {
    const std::optional<Answer> proved = quick.answer(bound);
    Answer right{};
    if (open) {
      right = open->answer(bound);
      ++counts_.by_rationals;
      if (proved && *proved == Answer::outside && right != Answer::outside)
        fail(i, "oracles disagree: open contact keeps what closed contact does not");
    } else if (proved && !random.one_in(second_opinion)) {
      right = *proved;
    } else {
      if (!exact) exact.emplace(input.a, input.b, input.added);
      right = exact->answer(bound);
      ++counts_.by_rationals;
      if (!proved && right != Answer::outside && exact->touches(bound)) ++counts_.touching;
      if (proved && *proved != right)
        fail(i, fmt::format("oracles disagree: rationals {}, intervals {}", text(right), text(*proved)));
    }
    note(i, right);
  };
  for (std::size_t i = 0; i != count_; ++i) {
    if (spheres_) {
      const Sphere sphere = family.sphere(random, input, quick);
      set(i, sphere);
      answer_by_oracle(i, sphere);
    } else {
      const Box box = random.one_in(8) ? blocking_box(random, input) : family.box(random, input);
      set(i, box);
      answer_by_oracle(i, box);
      note_blocking(i, input);
    }
  }
  sometimes_find_first_contact(random);
  sometimes_find_triangles(random);
}

}  // namespace shaftcull::cli
