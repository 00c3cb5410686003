// SPDX-License-Identifier: MIT
/// Errors become statuses here, and nowhere else. In a build without exceptions they go to the caller's handler.
#pragma once

#include <cstdint>
#include <exception>
#include <utility>

#include "shaftcull.h"
#include "shaftcull/error.hpp"

namespace shaftcull::binding {

/// Ends a call of the library because a callback returned something else than 0.
class Stopped : public std::exception {
 public:
  explicit Stopped(std::int32_t returned) noexcept : returned_(returned) {}
  [[nodiscard]] std::int32_t returned() const noexcept { return returned_; }
  [[nodiscard]] const char* what() const noexcept override { return "the callback ended the call"; }

 private:
  std::int32_t returned_;
};

/// Records the exception that is being handled as this thread's last error, and returns its status.
[[nodiscard]] shaftcull_status record_exception() noexcept;

/// Records an error as this thread's last one, calls the caller's handler, and ends the program if that returns.
[[noreturn]] void tell_handler(const std::exception& error);

/// Throws an error; calls tell_handler() in a build without exceptions. As kernel/support/fail.hpp.
template <class Error>
[[noreturn]] void fail(const Error& error) {
#if defined(__cpp_exceptions)
  throw error;
#else
  tell_handler(error);
#endif
}

/// Makes a call of the C++ interface. All functions of the C interface that return a status go through here.
template <class Call>
[[nodiscard]] shaftcull_status guarded(Call&& call) noexcept {
#if defined(__cpp_exceptions)
  try {
    std::forward<Call>(call)();
    return SHAFTCULL_OK;
  } catch (...) {
    return record_exception();
  }
#else
  std::forward<Call>(call)();
  return SHAFTCULL_OK;
#endif
}

}  // namespace shaftcull::binding
