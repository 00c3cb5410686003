// SPDX-License-Identifier: MIT
/// Leaves calls that fail, in programs of WebAssembly without exceptions (cmake/toolchains/wasi/run.mjs).
#pragma once

#if !defined(__cpp_exceptions)

#include <exception>
#include <functional>

namespace shaftcull {

/// Calls `call`. If the library tells of an error, `is_expected` is asked of it: if it says yes, the call is left there
/// and then, and no destructor of it runs; else the program ends with the message.
void attempt(const std::function<void()>& call, const std::function<bool(const std::exception&)>& is_expected);

}  // namespace shaftcull

#endif
