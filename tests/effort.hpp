/// How many random cases a test tries.
#pragma once

#include <cstdint>

namespace shaftcull {

/// As many as asked for; under AddressSanitizer a third. What it looks for does not take many cases, and takes long.
constexpr std::uint64_t effort(std::uint64_t cases) {
#if defined(__SANITIZE_ADDRESS__)
  return (cases + 2) / 3;
#else
  return cases;
#endif
}

}  // namespace shaftcull
