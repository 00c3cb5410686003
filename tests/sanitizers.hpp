// SPDX-License-Identifier: MIT
/// How many random cases a test tries, and what it cannot do under a sanitizer.
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

/// As many as asked for; under such a sanitizer a sixth, since each takes several times as long there.
constexpr std::uint64_t random_cases(std::uint64_t cases) { return has_shadow_memory ? (cases + 5) / 6 : cases; }

}  // namespace shaftcull
