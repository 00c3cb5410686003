// SPDX-License-Identifier: MIT
/// How a call ends with an error.
#pragma once

#include <exception>

#include "shaftcull/error.hpp"

namespace shaftcull::kernel {

/// Tells the handler of errors, and ends the program if it returns.
[[noreturn]] void tell_handler(const std::exception& error);

/// Throws an error; in a build without exceptions, tell_handler() of it.
template <class Error>
[[noreturn]] void fail(const Error& error) {
#if defined(__cpp_exceptions)
  throw error;
#else
  tell_handler(error);
#endif
}

}  // namespace shaftcull::kernel
