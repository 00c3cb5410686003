// SPDX-License-Identifier: MIT
/// Answers do not depend on the floating-point mode that the caller runs in, and calls leave it as it was.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "columns.hpp"
#include "float_modes.hpp"
#include "forms.hpp"
#include "instruction_sets.hpp"
#include "oracle/cases/families.hpp"
#include "oracle/grid_answers.hpp"
#include "oracle/random.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"

#ifdef SHAFTCULL_HAS_FLOAT_MODES

namespace shaftcull {
namespace {

/// The answers of all calls, one word behind the other.
template <class View>
std::vector<std::uint64_t> all_words(const ShaftInput& input, const View& bounds, unsigned doublings) {
  const std::vector<Box> a(9, input.a);
  const std::vector<Box> b(9, input.b);
  const BoxColumns from(a);
  const BoxColumns to(b);
  std::vector<CompiledShaft> batch(9);
  compile_batch(from.view(), to.view(), batch);

  std::vector<std::uint64_t> words;
  std::vector<std::uint64_t> kept(bit_words(bounds.count));
  std::vector<std::uint64_t> inside(kept);
  const auto note = [&](const std::vector<std::uint64_t>& row) { words.insert(words.end(), row.begin(), row.end()); };
  for (const CompiledShaft& each : {shaft_of(input), compile(input.a, input.b, input.added), batch[0], batch[8]}) {
    for (const Form form : forms) {
      classify(in_form(each, form), bounds, kept, inside);
      note(kept);
      note(inside);
      cull(in_form(each, form), bounds, kept);
      note(kept);
    }
    classify(each, bounds, {}, inside);
    note(inside);
    const GridAnswers on_grid = grid_answers(each, bounds, doublings);
    note(on_grid.kept);
    note(on_grid.inside);
  }
  return words;
}

template <class Bound>
void expect_same_in_all_modes(const ShaftInput& input, const std::vector<Bound>& bounds, unsigned doublings) {
  const auto memory = columns(bounds);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    const std::vector<std::uint64_t> right = all_words(input, memory.view(), doublings);
    for (const Mode& mode : modes) {
      std::vector<std::uint64_t> words;
      FloatRegisters left = 0;
      {
        const InMode in(mode);
        words = all_words(input, memory.view(), doublings);
        left = float_registers() & control_bits;
      }
      ASSERT_EQ(left, mode.bits & control_bits) << mode.name << " on " << name(isa);
      ASSERT_EQ(words, right) << mode.name << " on " << name(isa) << "\n  " << source_text(input);
    }
  }
}

TEST(FloatEnvironment, AnswersAreTheSameInEveryMode) {
  constexpr std::uint64_t seed = 171;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  for (const Family& family : families) {
    SCOPED_TRACE(family.name);
    for (unsigned i = 0; i < 12 && !testing::Test::HasFailure(); i += 2) {
      const ShaftInput input = family.shaft(random, i);
      const oracle::QuickHull hull(input);
      std::vector<Box> boxes;
      std::vector<Sphere> spheres;
      for (unsigned k = 0; k != 64; ++k) {
        boxes.push_back(family.box(random, input));
        spheres.push_back(family.sphere(random, input, hull));
      }
      expect_same_in_all_modes(input, boxes, i);
      expect_same_in_all_modes(input, spheres, i);
    }
  }
}

}  // namespace
}  // namespace shaftcull

#endif
