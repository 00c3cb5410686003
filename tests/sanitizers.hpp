// SPDX-License-Identifier: MIT
/// How many random cases a test tries, and what it cannot do under a sanitizer or on an emulated processor.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string_view>

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

/// Whether this is built without optimisation, as the preset `debug` is.
#if defined(__OPTIMIZE__)
inline constexpr bool is_optimised = true;
#else
inline constexpr bool is_optimised = false;
#endif

/// Whether only a layer of the tests is run, quick or ci: ./cmake/run sets SHAFTCULL_TEST_LAYER.
inline bool is_run_often() {
  const char* const layer = std::getenv("SHAFTCULL_TEST_LAYER");
  return layer != nullptr && (std::string_view(layer) == "quick" || std::string_view(layer) == "ci");
}

/// As many as asked for; half as many in the layers quick and ci; under such a sanitizer or without optimisation a
/// sixth, since each takes several times as long there; and in an emulator, where each takes fifty times as long, a
/// 24th.
inline std::uint64_t random_cases(std::uint64_t cases) {
  if (is_emulated) return (cases + 23) / 24;
  if (has_shadow_memory || !is_optimised) return (cases + 5) / 6;
  return is_run_often() ? (cases + 1) / 2 : cases;
}

}  // namespace shaftcull
