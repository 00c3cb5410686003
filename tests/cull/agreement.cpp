// SPDX-License-Identifier: MIT
#include "cull/agreement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "columns.hpp"
#include "flat/tiling.hpp"
#include "forms.hpp"
#include "instruction_sets.hpp"
#include "oracle/grid_answers.hpp"
#include "oracle/hull.hpp"
#include "oracle/open_contact.hpp"
#include "result_words.hpp"
#include "shaftcull/compiled.hpp"

namespace shaftcull {
namespace {

static_assert(bounds_on_grid == kernel::tile_bounds);

Answer answer(const std::vector<std::uint64_t>& kept, const std::vector<std::uint64_t>& inside, std::size_t i) {
  return !bit(kept, i) ? Answer::outside : bit(inside, i) ? Answer::inside : Answer::overlap;
}

template <class Bound>
std::vector<Answer> all_answers(const ShaftInput& input, const std::vector<Bound>& bounds, Form form) {
  const auto memory = columns(bounds);
  const CompiledShaft shaft = shaft_of(input);
  // Words that the calls must overwrite entirely.
  std::vector<std::uint64_t> culled(bit_words(bounds.size()), ~std::uint64_t{0});
  std::vector<std::uint64_t> kept = culled;
  std::vector<std::uint64_t> inside = culled;
  cull(in_form(shaft, form), memory.view(), culled);
  classify(in_form(shaft, form), memory.view(), kept, inside);
  EXPECT_EQ(culled, kept) << "cull() and classify() keep different bounds of " << source_text(input);
  std::vector<Answer> answers;
  for (std::size_t i = 0; i != bounds.size(); ++i) {
    EXPECT_TRUE(bit(kept, i) || !bit(inside, i)) << "inside but not kept: " << source_text(bounds[i]);
    answers.push_back(answer(kept, inside, i));
  }
  return answers;
}

/// The answers of tests on a grid. Its steps double `doublings` times, and bounds are `apart` places apart.
template <class Bound>
std::vector<Answer> all_on_grid(const ShaftInput& input, const std::vector<Bound>& bounds, unsigned doublings,
                                std::size_t apart) {
  const auto memory = columns(bounds);
  const GridAnswers on_grid = grid_answers(shaft_of(input), memory.view(), doublings, apart);
  std::vector<Answer> answers;
  for (std::size_t i = 0; i != bounds.size(); ++i) answers.push_back(answer(on_grid.kept, on_grid.inside, i));
  return answers;
}

template <class Bound>
void expect_right(const ShaftInput& input, const std::vector<Bound>& bounds, const std::vector<Answer>& right,
                  const std::vector<Answer>& answers, const char* form) {
  std::size_t wrong = 0;
  std::size_t first = 0;
  for (std::size_t i = bounds.size(); i-- != 0;) {
    if (answers[i] == right[i]) continue;
    ++wrong;
    first = i;
  }
  EXPECT_EQ(wrong, 0U) << "of " << bounds.size() << " on " << name(active_isa()) << ", form " << form
                       << "; the first is bound " << first << ":\n  " << source_text(input) << "\n  "
                       << source_text(bounds[first]) << "\n  is " << text(right[first]) << ", answered "
                       << text(answers[first]);
}

template <class Bound>
void expect_all(const ShaftInput& input, const std::vector<Bound>& bounds, const std::vector<Answer>& right) {
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    expect_right(input, bounds, right, all_answers(input, bounds, Form::slab), "slab");
    expect_right(input, bounds, right, all_answers(input, bounds, Form::planes), "planes");
    // Few undecided bounds in a word take another path than many.
    const std::size_t far_apart = bounds_on_grid / std::max<std::size_t>(bounds.size(), 1);
    for (const auto& [doublings, apart] :
         {std::pair(0U, std::size_t{1}), std::pair(0U, far_apart), std::pair(6U, std::size_t{1})}) {
      expect_right(input, bounds, right, all_on_grid(input, bounds, doublings, apart), "grid");
    }
  }
}

template <class Bound>
void expect_oracle(const ShaftInput& input, const std::vector<Bound>& bounds) {
  std::vector<Answer> right;
  const auto ask = [&](const auto& oracle) {
    for (const Bound& bound : bounds) right.push_back(oracle.answer(bound));
  };
  if (input.contact == Contact::open) {
    ask(oracle::OpenHull(input));
  } else {
    ask(oracle::Hull(input.a, input.b, input.added));
  }
  expect_all(input, bounds, right);
}

}  // namespace

std::vector<Answer> answers(const ShaftInput& input, const std::vector<Box>& bounds, Form form) {
  return all_answers(input, bounds, form);
}

std::vector<Answer> answers(const ShaftInput& input, const std::vector<Sphere>& bounds, Form form) {
  return all_answers(input, bounds, form);
}

void expect_answers(const ShaftInput& input, const std::vector<Box>& bounds, const std::vector<Answer>& right) {
  expect_all(input, bounds, right);
}

void expect_answers(const ShaftInput& input, const std::vector<Sphere>& bounds, const std::vector<Answer>& right) {
  expect_all(input, bounds, right);
}

void expect_exact(const ShaftInput& input, const std::vector<Box>& bounds) { expect_oracle(input, bounds); }

void expect_exact(const ShaftInput& input, const std::vector<Sphere>& bounds) { expect_oracle(input, bounds); }

}  // namespace shaftcull
