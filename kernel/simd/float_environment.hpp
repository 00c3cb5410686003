/// The floating-point environment that error margins and exact predicates are proven for.
#pragma once

#include "exact_floats.hpp"

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace shaftcull::kernel {

/// Rounds to nearest and keeps denormals while in scope, whatever mode the caller runs in (engines and audio code like to
/// flush denormals to zero), and puts the caller's mode back. `Tag` keeps one instruction set's copy from another's.
template <class Tag>
class FloatEnvironment {
 public:
  FloatEnvironment() noexcept {
#ifdef __SSE__
    if ((saved_ & modes) != standard) _mm_setcsr((saved_ & ~modes) | standard);
#endif
  }
  ~FloatEnvironment() {
#ifdef __SSE__
    if ((saved_ & modes) != standard) _mm_setcsr(saved_);
#endif
  }
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

 private:
#ifdef __SSE__
  static constexpr unsigned modes = 0xffc0;     // flush to zero, rounding, exception masks, denormals are zero
  static constexpr unsigned standard = 0x1f80;  // round to nearest, all exceptions masked
  unsigned saved_ = _mm_getcsr();
#endif
};

}  // namespace shaftcull::kernel
