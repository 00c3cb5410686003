// SPDX-License-Identifier: MIT
/// What a refused call says.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "caught.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull {

/// The message of the error that `call` throws; fails the test if it throws none.
template <class Error = InvalidArgument, class Call>
std::string message_of(const Call& call) {
  if (const std::optional<Error> error = caught<Error>(call)) return error->what();
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

}  // namespace shaftcull
