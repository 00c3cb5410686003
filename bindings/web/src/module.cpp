// SPDX-License-Identifier: MIT
// What the library needs of the module: errors are told to JavaScript, and there is one thread, which never ends.
#include <cstdint>

#include "shaftcull.h"

extern "C" {

// The module has no exceptions of its own; JavaScript throws one through it.
[[clang::import_module("shaftcull"), clang::import_name("fail")]] void fail(shaftcull_status status,
                                                                            const char* message,
                                                                            std::uint64_t position);

// libc++abi of this system lacks it: destructors of thread-local objects run when their thread ends.
int __cxa_thread_atexit(void (* /*destroy*/)(void*), void* /*object*/, void* /*library*/) { return 0; }

}  // extern "C"

namespace {

[[maybe_unused]] const shaftcull_error_handler before = shaftcull_set_error_handler(fail);

}  // namespace
