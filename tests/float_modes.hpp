// SPDX-License-Identifier: MIT
/// Floating-point modes that callers may run in, on processors that have them.
#pragma once

#ifdef __SSE__
#include <xmmintrin.h>

namespace shaftcull {

struct Mode {
  const char* name;
  unsigned bits;
};
inline constexpr Mode modes[] = {
    {"denormals are zero", 0x9fc0}, {"down", 0x3f80}, {"up", 0x5f80}, {"towards zero, flushing", 0xffc0}};

/// The bits that say the mode; the others say what has happened.
inline constexpr unsigned control_bits = 0xffc0;
inline constexpr unsigned flag_bits = 0x3f;

/// Runs in a mode until the end of the scope.
class InMode {
 public:
  explicit InMode(const Mode& mode) : saved_(_mm_getcsr()) { _mm_setcsr(mode.bits); }
  ~InMode() { _mm_setcsr(saved_); }
  InMode(const InMode&) = delete;
  InMode& operator=(const InMode&) = delete;

 private:
  unsigned saved_;
};

}  // namespace shaftcull

#endif
