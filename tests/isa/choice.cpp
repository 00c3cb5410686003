// SPDX-License-Identifier: MIT
/// Which instruction set is chosen, and what is said if there is no such.
///
/// The choice is made once in a process, so every case is a process of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "caught.hpp"
#include "environment.hpp"
#include "instruction_sets.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/isa.hpp"

namespace shaftcull {
namespace {

using testing::AllOf;
using testing::HasSubstr;

bool is_available(Isa isa) {
  const std::vector<Isa> available = available_isas();
  return std::find(available.begin(), available.end(), isa) != available.end();
}

/// Says on standard error what is chosen with SHAFTCULL_ISA set to `wanted`, or left alone if that is null.
[[noreturn]] void say_choice(const char* wanted) {
  set_environment("SHAFTCULL_ISA", wanted);
  std::cerr << "chosen: " << name(active_isa()) << '.';
  const IsaChoice choice = isa_choice();
  std::cerr << " asked: " << choice.asked << ". running: " << name(choice.running) << ". refused: " << choice.refusal
            << '.' << std::endl;
  std::_Exit(0);
}

std::string chosen(Isa isa) { return "chosen: " + std::string(name(isa)) + "."; }

/// What a machine is known to have (emulated.cmake tells), else what it claims to have.
Isa best_expected() {
  const char* const expected = std::getenv("SHAFTCULL_EXPECTED_ISA");
  return expected == nullptr ? available_isas().back() : isa_from_name(expected).value();
}

std::string listed() {
  std::string list;
  for (const Isa isa : available_isas()) list += (list.empty() ? "" : ", ") + std::string(name(isa));
  return "this machine has " + list;
}

TEST(IsaChoice, TheBestOneIsPickedIfNothingIsSaid) {
  EXPECT_EXIT(say_choice(nullptr), testing::ExitedWithCode(0), HasSubstr(chosen(best_expected())));
  EXPECT_EXIT(say_choice(""), testing::ExitedWithCode(0), HasSubstr(chosen(best_expected())));
}

bool is_built(Isa isa) {
  constexpr Isa built[] = {
#define SHAFTCULL_BUILT(set, features) Isa::set,
#define SHAFTCULL_NOT_BUILT(set)
#include "dispatch/instruction_sets.inc"
#undef SHAFTCULL_BUILT
#undef SHAFTCULL_NOT_BUILT
  };
  return std::find(std::begin(built), std::end(built), isa) != std::end(built);
}

TEST(IsaChoice, NothingBeyondTheBestOneIsAvailableAndAllBelowThatAreBuiltAre) {
  for (const Isa isa : all_isas()) EXPECT_EQ(is_available(isa), is_built(isa) && isa <= best_expected()) << name(isa);
}

TEST(IsaChoice, TheEnvironmentForcesAnyThatThereIs) {
  for (const Isa isa : available_isas()) {
    EXPECT_EXIT(say_choice(name(isa).data()), testing::ExitedWithCode(0), HasSubstr(chosen(isa)));
  }
}

TEST(IsaChoice, TheEnvironmentIsReadInAnyCase) {
  EXPECT_EXIT(say_choice("Scalar"), testing::ExitedWithCode(0),
              AllOf(HasSubstr(chosen(Isa::scalar)), HasSubstr("asked: Scalar."), HasSubstr("refused: .")));
  EXPECT_EXIT(say_choice("SCALAR"), testing::ExitedWithCode(0), HasSubstr(chosen(Isa::scalar)));
}

TEST(IsaChoice, AnUnavailableOneLeavesTheBestThereIsAndIsSaid) {
  for (const Isa isa : all_isas()) {
    if (is_available(isa)) continue;
    EXPECT_EXIT(say_choice(name(isa).data()), testing::ExitedWithCode(0),
                AllOf(HasSubstr(chosen(best_expected())), HasSubstr("asked: " + std::string(name(isa))),
                      HasSubstr("refused: SHAFTCULL_ISA=" + std::string(name(isa)) + " is not available here"),
                      HasSubstr(listed())));
  }
}

TEST(IsaChoice, AnUnknownOneLeavesTheBestThereIsAndIsSaid) {
  EXPECT_EXIT(say_choice("avx3"), testing::ExitedWithCode(0),
              AllOf(HasSubstr(chosen(best_expected())), HasSubstr("asked: avx3."),
                    HasSubstr("refused: SHAFTCULL_ISA=avx3 is not an instruction set"), HasSubstr(listed())));
}

TEST(IsaChoice, ACallForAnUnavailableOneThrowsAndListsWhatThereIs) {
  for (const Isa isa : all_isas()) {
    if (is_available(isa)) continue;
    const auto error = caught([&] { select_isa(isa); });
    ASSERT_TRUE(error) << name(isa) << " was accepted";
    EXPECT_THAT(error->what(), AllOf(HasSubstr(std::string(name(isa))), HasSubstr(listed())));
  }
}

TEST(IsaChoice, AValueThatIsNoEnumeratorHasAName) {
  static_assert(Isa{0} == Isa::scalar && Isa{1} == Isa::portable128 && Isa{2} == Isa::sse4_2);  // numbers never change
  static_assert(Isa{3} == Isa::avx2 && Isa{4} == Isa::avx512 && Isa{5} == Isa::neon);
  EXPECT_EQ(name(static_cast<Isa>(6)), "unknown");
  EXPECT_EQ(name(static_cast<Isa>(255)), "unknown");
  EXPECT_THROW(select_isa(static_cast<Isa>(255)), InvalidArgument);
}

TEST(IsaChoice, ACallWinsOverTheEnvironment) {
  EXPECT_EXIT(
      {
        select_isa(Isa::scalar);
        say_choice(name(best_expected()).data());
      },
      testing::ExitedWithCode(0), HasSubstr(chosen(Isa::scalar)));
}

}  // namespace
}  // namespace shaftcull
