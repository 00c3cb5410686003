// SPDX-License-Identifier: MIT
/// Errors become statuses here, and nowhere else. In a build without exceptions the caller's handler is told of them.
#pragma once

#include <cstdint>
#include <exception>
#include <utility>

#include "shaftcull.h"
#include "shaftcull/error.hpp"
#include "shaftcull/function_ref.hpp"

namespace shaftcull::binding {

/// What a callback that returns something else than 0 is carried out of the library by.
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

/// Records an error as this thread's last one, tells the caller's handler, and ends the program if that returns.
[[noreturn]] void tell_handler(const std::exception& error);

/// In a build without exceptions: has tell_handler() tell another error of a BadBound of this thread, until the end of
/// the scope or the first error. There is one at a time.
class TellingInstead {
 public:
  using Other = FunctionRef<BadBound(const BadBound&)>;

  /// `other` must live as long as this.
  explicit TellingInstead(const Other& other) noexcept;
  ~TellingInstead();
  TellingInstead(const TellingInstead&) = delete;
  TellingInstead& operator=(const TellingInstead&) = delete;
};

/// Throws an error; in a build without exceptions, tell_handler() of it. kernel/support/fail.hpp does alike.
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
