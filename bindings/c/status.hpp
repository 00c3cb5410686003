// SPDX-License-Identifier: MIT
/// Exceptions become statuses here, and nowhere else.
#pragma once

#include <cstdint>
#include <exception>
#include <utility>

#include "shaftcull.h"

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

/// Makes a call of the C++ interface. All functions of the C interface that return a status go through here.
template <class Call>
[[nodiscard]] shaftcull_status guarded(Call&& call) noexcept {
  try {
    std::forward<Call>(call)();
    return SHAFTCULL_OK;
  } catch (...) {
    return record_exception();
  }
}

}  // namespace shaftcull::binding
