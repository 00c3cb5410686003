// SPDX-License-Identifier: MIT
#include "shaftcull/error.hpp"

#include <atomic>
#include <cstdio>
#include <cstdlib>

#include "support/exact_floats.hpp"
#include "support/fail.hpp"

namespace shaftcull {
namespace {

std::atomic<ErrorHandler> error_handler{nullptr};

}  // namespace

InvalidArgument::~InvalidArgument() = default;
BadBound::~BadBound() = default;
NeedsRefit::~NeedsRefit() = default;

ErrorHandler set_error_handler(ErrorHandler handler) noexcept { return error_handler.exchange(handler); }

namespace kernel {

void tell_handler(const std::exception& error) {
  if (const ErrorHandler handler = error_handler.load()) {
    handler(error);
  } else {
    static_cast<void>(std::fprintf(stderr, "shaftcull: %s\n", error.what()));
  }
  std::abort();
}

}  // namespace kernel
}  // namespace shaftcull
