// SPDX-License-Identifier: MIT
#include "status.hpp"

#include <cstdint>
#include <cstdio>
#include <exception>
#include <new>

#include "shaftcull/error.hpp"
#include "shaftcull/version.hpp"

namespace shaftcull::binding {

namespace {

/// What went wrong last in one thread. Plain memory, so that a thread's first error allocates nothing, and its last may
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

}  // namespace

shaftcull_status record_exception() noexcept {
  try {
    throw;
  } catch (const BadBound& bad) {
    return record(SHAFTCULL_BAD_BOUND, bad.what(), bad.index());
  } catch (const InvalidArgument& bad) {
    return record(SHAFTCULL_INVALID_ARGUMENT, bad.what());
  } catch (const NeedsRefit& bad) {
    return record(SHAFTCULL_NEEDS_REFIT, bad.what());
  } catch (const std::bad_alloc&) {
    return record(SHAFTCULL_OUT_OF_MEMORY, "memory ran out");
  } catch (const Stopped& stopped) {
    char text[64];
    std::snprintf(text, sizeof text, "the callback returned %ld, so the call ended",
                  static_cast<long>(stopped.returned()));
    return record(SHAFTCULL_STOPPED, text);
  } catch (const std::exception& other) {
    return record(SHAFTCULL_INTERNAL_ERROR, other.what());
  } catch (...) {
    return record(SHAFTCULL_INTERNAL_ERROR, "something was thrown that is no std::exception");
  }
}

}  // namespace shaftcull::binding

extern "C" {

const char* shaftcull_error_message() { return shaftcull::binding::last_error.message; }

uint64_t shaftcull_error_position() { return shaftcull::binding::last_error.position; }

const char* shaftcull_status_name(shaftcull_status status) {
  switch (status) {
    case SHAFTCULL_OK:
      return "ok";
    case SHAFTCULL_INVALID_ARGUMENT:
      return "invalid argument";
    case SHAFTCULL_BAD_BOUND:
      return "bad bound";
    case SHAFTCULL_NEEDS_REFIT:
      return "needs refit";
    case SHAFTCULL_OUT_OF_MEMORY:
      return "out of memory";
    case SHAFTCULL_STOPPED:
      return "stopped";
    case SHAFTCULL_INTERNAL_ERROR:
      return "internal error";
    default:
      return "unknown status";
  }
}

uint32_t shaftcull_version() { return SHAFTCULL_VERSION; }

const char* shaftcull_version_string() { return SHAFTCULL_VERSION_STRING; }

}  // extern "C"
