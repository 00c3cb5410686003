#include "status.hpp"

#include <cstdint>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "shaftcull/error.hpp"
#include "shaftcull/version.hpp"

namespace shaftcull::binding {

namespace {

/// What went wrong last in one thread.
struct LastError {
  std::string message;
  const char* fixed = nullptr;  ///< instead of `message`, where there was no memory for it
  std::uint64_t position = SHAFTCULL_NONE;
};

LastError& last_error() noexcept {
  thread_local LastError error;
  return error;
}

shaftcull_status record(shaftcull_status status, const char* message,
                        std::uint64_t position = SHAFTCULL_NONE) noexcept {
  LastError& error = last_error();
  error.position = position;
  try {
    error.message = message;
    error.fixed = nullptr;
  } catch (...) {
    error.fixed = "the call failed, and there is no memory left for the message";
  }
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
    last_error() = {{}, "memory ran out", SHAFTCULL_NONE};  // no memory for the message either, maybe
    return SHAFTCULL_OUT_OF_MEMORY;
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

const char* shaftcull_error_message() {
  const shaftcull::binding::LastError& error = shaftcull::binding::last_error();
  return error.fixed != nullptr ? error.fixed : error.message.c_str();
}

uint64_t shaftcull_error_position() { return shaftcull::binding::last_error().position; }

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
