// SPDX-License-Identifier: MIT
#include "shaftcull/error.hpp"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "support/exact_floats.hpp"
#include "support/fail.hpp"
#include "support/telling_instead.hpp"

namespace shaftcull {
namespace {

std::atomic<ErrorHandler> error_handler{nullptr};

thread_local const kernel::TellingInstead::Other* told_instead = nullptr;

}  // namespace

InvalidArgument::~InvalidArgument() = default;
BadBound::~BadBound() = default;
NeedsRefit::~NeedsRefit() = default;

ErrorHandler set_error_handler(ErrorHandler handler) noexcept { return error_handler.exchange(handler); }

namespace kernel {

TellingInstead::TellingInstead(const Other& other) noexcept { told_instead = &other; }
TellingInstead::~TellingInstead() { told_instead = nullptr; }

void tell_handler(const std::exception& error) {
  // The handler may leave this call for good, so nothing is told instead of the next error.
  const TellingInstead::Other* const other = std::exchange(told_instead, nullptr);
  const auto* const replaced = dynamic_cast<const InvalidArgument*>(&error);
  if (other != nullptr && replaced != nullptr) tell_handler((*other)(*replaced));
  if (const ErrorHandler handler = error_handler.load()) {
    handler(error);
  } else {
    static_cast<void>(std::fprintf(stderr, "shaftcull: %s\n", error.what()));
  }
  std::abort();
}

}  // namespace kernel
}  // namespace shaftcull
