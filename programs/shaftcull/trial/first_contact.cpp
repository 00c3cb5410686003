// SPDX-License-Identifier: MIT
/// What trials ask about first contact.
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <variant>

#include <fmt/format.h>

#include "oracle/entry_time.hpp"
#include "oracle/random.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/tree.hpp"
#include "trial/trial.hpp"

namespace shaftcull::cli {
namespace {

/// Of the trials that are not of convex hulls, one in this many is asked for first contact: rationals work it out.
constexpr unsigned contact_trials = 8;

}  // namespace

void Trial::sometimes_find_first_contact(Random& random) {
  if (!random.one_in(contact_trials)) return;
  with_view([&](const auto& bounds) {
    if (const auto* const between = std::get_if<ShaftInput>(&input_)) {
      find_first_contact(
          bounds, [&](const auto& bound) { return oracle::entry_time(between->a, between->b, bound); },
          [&](const auto& bound) { return oracle::contact_normal(between->a, between->b, bound); });
    } else if (const auto* const moving = std::get_if<MovingInput>(&input_)) {
      find_first_contact(
          bounds, [&](const auto& bound) { return oracle::entry_time(*moving, bound); },
          [&](const auto& bound) { return oracle::contact_normal(*moving, bound); });
    }
  });
}

template <class View, class TimeOf, class NormalOf>
void Trial::find_first_contact(const View& bounds, const TimeOf& time_of, const NormalOf& normal_of) {
  FirstContact first;
  decltype(time_of(bounds[0])) least;
  for (std::size_t i = 0; i != count_; ++i) {
    if (!BitView(kept_)[i]) continue;
    const auto time = time_of(bounds[i]);
    if (!time) {
      fail(i, "oracles disagree: a bound that is kept is never reached");
      continue;
    }
    if (least && *least <= *time) continue;
    least = time;
    first = {static_cast<std::uint32_t>(i), oracle::rounded_down(*time)};
  }
  if (first) first.normal = normal_of(bounds[first.index]);
  first_ = first;
}

void Trial::ask_first_contact(const CompiledShaft& shaft, const char* how) {
  if (!first_ || count_ == 0) return;
  const auto compare_contact = [&](const FirstContact& got, const char* of) {
    if (got == *first_) return;
    fail(got ? got.index : first_->index,
         fmt::format("first_contact of a {}, {}, {}: bound {} at {}, normal {} {} {}, instead of {} at {}, {} {} {}",
                     of, how, name(active_isa()), got.index, got.time, got.normal[0], got.normal[1], got.normal[2],
                     first_->index, first_->time, first_->normal[0], first_->normal[1], first_->normal[2]));
  };
  with_view([&]<class View>(const View& bounds) {
    using Bound = std::conditional_t<std::is_same_v<View, BoxView>, Box, Sphere>;
    CompiledShaft by_planes = shaft;
    set_form(by_planes, Form::planes);
    compare_contact(first_contact(shaft, bounds), "view, slab");
    compare_contact(first_contact(by_planes, bounds), "view, planes");
    compare_contact(first_contact(shaft, BoundsTree<Bound>(bounds)), "tree");
  });
}

}  // namespace shaftcull::cli
