// SPDX-License-Identifier: MIT
/// What a call throws. WebAssembly has no exceptions: there JavaScript leaves a call that fails, and caught() finds the
/// error all the same.
#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <optional>

#include "attempt.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull {

/// Whether a call that fails undoes what it began: without exceptions its destructors do not run.
#if defined(__cpp_exceptions)
inline constexpr bool failed_calls_undo = true;
#else
inline constexpr bool failed_calls_undo = false;
#endif

/// The error of this kind that `call` throws; none if it throws none. Errors of other kinds fail the test.
template <class Error = InvalidArgument, class Call>
std::optional<Error> caught(const Call& call) {
#if defined(__cpp_exceptions)
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  return std::nullopt;
#else
  std::optional<Error> error;
  attempt(call, [&](const std::exception& thrown) {
    if (const auto* const of_this_kind = dynamic_cast<const Error*>(&thrown)) error = *of_this_kind;
    return error.has_value();
  });
  return error;
#endif
}

}  // namespace shaftcull

// GoogleTest's own ways to ask need exceptions. What fails in EXPECT_NO_THROW ends the program, unless an EXPECT_THROW
// around it expects that.
#if !defined(__cpp_exceptions)
#undef EXPECT_THROW
#undef EXPECT_NO_THROW
#define EXPECT_THROW(statement, Error) EXPECT_TRUE(::shaftcull::caught<Error>([&] { statement; }))
#define EXPECT_NO_THROW(statement) statement
#endif
