// SPDX-License-Identifier: MIT
/// The floating-point environment that error margins and exact predicates are proven for, and the caller's own.
#pragma once

#include <cstdint>

#include "support/compiler.hpp"
#include "support/exact_floats.hpp"

#if defined(SHAFTCULL_TARGET_SSE2)
#include <xmmintrin.h>
#elif !defined(SHAFTCULL_TARGET_ARM64)
#include <cfenv>
#endif

namespace shaftcull::kernel {

/// What a thread's floating-point registers say: modes (rounding, flushing of denormals, traps) and flags of what
/// happened.
class FloatState {
 public:
#if defined(SHAFTCULL_TARGET_SSE2)
  static FloatState now() noexcept { return FloatState(_mm_getcsr()); }
  void set() const noexcept { _mm_setcsr(mxcsr_); }
  /// The same with the standard modes: round to nearest, keep denormals, no traps.
  [[nodiscard]] FloatState standard() const noexcept { return FloatState((mxcsr_ & ~0xffc0U) | 0x1f80U); }
  friend bool operator==(const FloatState&, const FloatState&) noexcept = default;

 private:
  explicit FloatState(unsigned mxcsr) noexcept : mxcsr_(mxcsr) {}
  unsigned mxcsr_;
#elif defined(SHAFTCULL_TARGET_ARM64)
  static FloatState now() noexcept {
    FloatState state;
    state.control_ = read_fpcr();
    state.flags_ = read_fpsr();
    return state;
  }
  void set() const noexcept {
    write_fpcr(control_);
    write_fpsr(flags_);
  }
  [[nodiscard]] FloatState standard() const noexcept {
    // Of FPCR: AHP, DN, FZ, RMode, FZ16, traps, NEP, AH and FIZ.
    constexpr std::uint64_t modes = 0x07c8'9f07;
    FloatState state = *this;
    state.control_ &= ~modes;
    return state;
  }
  friend bool operator==(const FloatState&, const FloatState&) noexcept = default;

 private:
  FloatState() noexcept = default;
  std::uint64_t control_ = 0;
  std::uint64_t flags_ = 0;
#else
  // What the standard library knows: it has no word for the flushing of denormals.
  static FloatState now() noexcept {
    FloatState state;
    std::fegetenv(&state.environment_);
    state.rounding_ = std::fegetround();
    state.flags_ = std::fetestexcept(FE_ALL_EXCEPT);
    return state;
  }
  void set() const noexcept {
    std::fesetenv(&environment_);
    std::fesetround(rounding_);
  }
  [[nodiscard]] FloatState standard() const noexcept {
    FloatState state = *this;
    state.rounding_ = FE_TONEAREST;
    return state;
  }
  friend bool operator==(const FloatState& a, const FloatState& b) noexcept {
    return a.rounding_ == b.rounding_ && a.flags_ == b.flags_;
  }

 private:
  FloatState() noexcept = default;
  std::fenv_t environment_;
  int rounding_ = FE_TONEAREST;
  int flags_ = 0;
#endif
};

/// Standard modes while in scope, whatever the caller runs in (engines and audio code like to flush denormals to zero).
/// At the end the caller's modes and flags are back.
///
/// Compilers do not know that arithmetic depends on these registers, and move it across what sets them. So what is in
/// scope must be behind a call that they cannot look into: one through a pointer, as all kernels are, or
/// in_float_environment().
class FloatEnvironment {
 public:
  FloatEnvironment() noexcept {
    if (const FloatState standard = saved_.standard(); standard != saved_) standard.set();
    keep_order_of_memory();
  }
  ~FloatEnvironment() {
    keep_order_of_memory();
    saved_.set();  // without reading the flags, which would wait for all arithmetic to end
  }
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

 private:
  FloatState saved_ = FloatState::now();
};

template <class Compute>
SHAFTCULL_NOINLINE decltype(auto) behind_a_call(const Compute& compute) {
  return compute();
}

/// What compute() returns in the standard modes. Modes and flags of the caller are as they were afterwards.
template <class Compute>
decltype(auto) in_float_environment(const Compute& compute) {
  const FloatEnvironment environment;
  return behind_a_call(compute);
}

}  // namespace shaftcull::kernel
