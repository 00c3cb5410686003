// SPDX-License-Identifier: MIT
/// How many random cases a test tries, and what it cannot do under a sanitizer or on an emulated processor.
#pragma once

#include <cstdint>

namespace shaftcull {

/// Whether this is built with a sanitizer that keeps a record of every piece of memory.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // as GCC says it
inline constexpr bool has_shadow_memory = true;
#elif !defined(__has_feature)
inline constexpr bool has_shadow_memory = false;
#elif __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)  // as Clang says it
inline constexpr bool has_shadow_memory = true;
#else
inline constexpr bool has_shadow_memory = false;
#endif

/// Whether this is built for another processor and run by an emulator.
#if defined(SHAFTCULL_EMULATED)
inline constexpr bool is_emulated = true;
#else
inline constexpr bool is_emulated = false;
#endif

/// As many as asked for; under such a sanitizer or an emulator a sixth, since each takes several times as long there.
inline std::uint64_t random_cases(std::uint64_t cases) {
  return has_shadow_memory || is_emulated ? (cases + 5) / 6 : cases;
}

}  // namespace shaftcull
