// SPDX-License-Identifier: MIT
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "attempt.hpp"
#include "shaftcull/error.hpp"

extern "C" {

[[clang::import_module("attempts"), clang::import_name("attempt")]] int host_attempt(void (*call)(const void*),
                                                                                     const void* argument);
[[noreturn]] [[clang::import_module("attempts"), clang::import_name("leave")]] void host_leave();

// The compiler's own library was compiled with a stack protector, which needs these; nothing checks them here.
std::uintptr_t __stack_chk_guard = 0x5eed5eed;
[[noreturn]] void __stack_chk_fail() { std::abort(); }

}  // extern "C"

namespace shaftcull {
namespace {

/// Of the attempt that runs; null outside of any.
const std::function<bool(const std::exception&)>* expects = nullptr;

void leave_what_failed(const std::exception& error) {
  if (expects != nullptr && (*expects)(error)) host_leave();
  std::fprintf(stderr, "shaftcull: %s\n", error.what());  // and the library ends the program
}

}  // namespace

void attempt(const std::function<void()>& call, const std::function<bool(const std::exception&)>& is_expected) {
  const ErrorHandler handler_before = set_error_handler(leave_what_failed);
  const auto* const expected_before = std::exchange(expects, &is_expected);
  host_attempt([](const void* argument) { (*static_cast<const std::function<void()>*>(argument))(); }, &call);
  expects = expected_before;
  set_error_handler(handler_before);
}

}  // namespace shaftcull
