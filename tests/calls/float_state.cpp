// SPDX-License-Identifier: MIT
/// The caller's floating-point modes and flags: no answer depends on them, and every call leaves them as they were.
#include <gtest/gtest.h>

#include <cfenv>
#include <cstddef>
#include <vector>

#include "calls/every_call.hpp"
#include "float_modes.hpp"
#include "many/workload.hpp"
#include "parallel/parallel.hpp"
#include "sanitizers.hpp"

namespace shaftcull {
namespace {

#ifdef SHAFTCULL_HAS_FLOAT_MODES

TEST(FloatState, IsAfterEveryCallWhatItWasBeforeAndAnswersAreTheSame) {
  const EveryCall every(EveryCall::shafts(9), random_cases(2500));
  with_threads(2, [&] {
    for (const PublicCall& call : every.calls()) {
      AnswerWords right;
      call.call(right);
      for (const FloatRegisters flags : {flag_bits, FloatRegisters{0}}) {
        if (has_shadow_memory && flags == 0) continue;
        for (const Mode& mode : modes) {
          AnswerWords words;
          // What happened before stays, and nothing is added.
          const FloatRegisters before = (mode.bits & control_bits) | flags;
          FloatRegisters after = 0;
          {
            const InMode in(mode);
            set_float_registers(before);
            call.call(words);
            after = float_registers();
          }
          EXPECT_EQ(after, before) << call.name << " in mode " << mode.name;
          EXPECT_TRUE(words == right) << call.name << " in mode " << mode.name;
        }
      }
    }
  });
}

// What tasks make for others (boxes around spheres, numbers on a grid) is so well padded that answers would seldom show
// in which mode it was made.
TEST(FloatState, IsTheStandardOneInAllTasks) {
  constexpr std::size_t tasks = 40;
  for (const Mode& mode : modes) {
    std::vector<FloatRegisters> seen(5 * tasks, standard_mode);
    {
      const InMode in(mode);
      const auto see = [&](std::size_t i) { seen[i] = float_registers() & control_bits; };
      with_threads(3, [&] {
        kernel::parallel_for(1, 1, [&](std::size_t, std::size_t) { see(0); });
        kernel::parallel_for(tasks, 2, [&](std::size_t row, std::size_t column) {
          see(2 * row + column);
          if (row % 10 != 0) return;
          kernel::parallel_for_nested(4, 1, [&](std::size_t i, std::size_t) { see((2 + column) * tasks + row + i); });
        });
        kernel::ordered_pipeline(
            tasks, 4, [&](std::size_t i, std::size_t) { see(4 * tasks + i); }, [](std::size_t, std::size_t) {});
      });
    }
    EXPECT_EQ(seen, std::vector<FloatRegisters>(seen.size(), standard_mode)) << mode.name;
  }
}

#endif

TEST(FloatState, RoundingModeAndFlagsOfTheStandardLibraryStay) {
  const EveryCall every(EveryCall::shafts(9), has_shadow_memory ? 150 : 700);
  for (const PublicCall& call : every.calls()) {
    AnswerWords right;
    call.call(right);
    for (const int rounding : {FE_DOWNWARD, FE_UPWARD, FE_TOWARDZERO, FE_TONEAREST}) {
      AnswerWords words;
      std::feclearexcept(FE_ALL_EXCEPT);
      std::fesetround(rounding);
      call.call(words);
      const int raised = std::fetestexcept(FE_ALL_EXCEPT);
      const int left = std::fegetround();
      std::fesetround(FE_TONEAREST);
      EXPECT_EQ(raised, 0) << call.name;
      ASSERT_EQ(left, rounding) << call.name;
      ASSERT_TRUE(words == right) << call.name << ", rounding mode " << rounding;
    }
  }
}

}  // namespace
}  // namespace shaftcull
