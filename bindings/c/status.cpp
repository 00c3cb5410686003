// SPDX-License-Identifier: MIT
#include "status.hpp"

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "shaftcull/error.hpp"
#include "shaftcull/version.hpp"

namespace shaftcull::binding {

namespace {

/// The last error of one thread. Plain memory, so that a thread's first error allocates nothing, and its last may
/// come while the thread ends.
struct LastError {
  char message[1024];  ///< cut off if it is longer, as with a very long name in it
  std::uint64_t position;
};

constinit thread_local LastError last_error = {"", SHAFTCULL_NONE};

shaftcull_status record(shaftcull_status status, const char* message,
                        std::uint64_t position = SHAFTCULL_NONE) noexcept {
  std::snprintf(last_error.message, sizeof last_error.message, "%s", message);
  last_error.position = position;
  return status;
}

shaftcull_status record(const std::exception& error) noexcept {
  const char* what = error.what();
  if (const auto* bad = dynamic_cast<const BadBound*>(&error)) return record(SHAFTCULL_BAD_BOUND, what, bad->index());
  if (dynamic_cast<const InvalidArgument*>(&error) != nullptr) return record(SHAFTCULL_INVALID_ARGUMENT, what);
  if (dynamic_cast<const NeedsRefit*>(&error) != nullptr) return record(SHAFTCULL_NEEDS_REFIT, what);
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return record(SHAFTCULL_OUT_OF_MEMORY, "memory ran out");
  if (const auto* stopped = dynamic_cast<const Stopped*>(&error)) {
    char text[64];
    std::snprintf(text, sizeof text, "the callback returned %ld, so the call ended",
                  static_cast<long>(stopped->returned()));
    return record(SHAFTCULL_STOPPED, text);
  }
  return record(SHAFTCULL_INTERNAL_ERROR, what);
}

std::atomic<shaftcull_error_handler> error_handler{nullptr};

}  // namespace

#if defined(__cpp_exceptions)
shaftcull_status record_exception() noexcept {
  try {
    throw;
  } catch (const std::exception& error) {
    return record(error);
  } catch (...) {
    return record(SHAFTCULL_INTERNAL_ERROR, "something was thrown that is no std::exception");
  }
}
#endif

void tell_handler(const std::exception& error) {
  const shaftcull_status status = record(error);
  if (const shaftcull_error_handler handler = error_handler.load()) {
    handler(status, last_error.message, last_error.position);
  } else {
    static_cast<void>(std::fprintf(stderr, "shaftcull: %s\n", last_error.message));
  }
  std::abort();
}

}  // namespace shaftcull::binding

extern "C" {

const char* shaftcull_error_message() { return shaftcull::binding::last_error.message; }

uint64_t shaftcull_error_position() { return shaftcull::binding::last_error.position; }

shaftcull_error_handler shaftcull_set_error_handler(shaftcull_error_handler handler) {
  static_cast<void>(shaftcull::set_error_handler(shaftcull::binding::tell_handler));
  return shaftcull::binding::error_handler.exchange(handler);
}

uint32_t shaftcull_version() { return SHAFTCULL_VERSION; }

}  // extern "C"
