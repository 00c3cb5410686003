// SPDX-License-Identifier: MIT
/// Floating-point modes that callers may run in, on processors that have them: x86 by MXCSR, 64-bit ARM by FPCR, whose
/// flags are in FPSR.
#pragma once

#include <cstdint>

#if defined(__SSE__)
#include <xmmintrin.h>
#define SHAFTCULL_HAS_FLOAT_MODES
#elif defined(__aarch64__)
#define SHAFTCULL_HAS_FLOAT_MODES
#endif

#ifdef SHAFTCULL_HAS_FLOAT_MODES

namespace shaftcull {

/// Modes and flags, as one number.
using FloatRegisters = std::uint64_t;

struct Mode {
  const char* name;
  FloatRegisters bits;
};

#if defined(__SSE__)

inline FloatRegisters float_registers() { return _mm_getcsr(); }
inline void set_float_registers(FloatRegisters bits) { _mm_setcsr(static_cast<unsigned>(bits)); }

inline constexpr Mode modes[] = {
    {"denormals are zero", 0x9fc0}, {"down", 0x3f80}, {"up", 0x5f80}, {"towards zero, flushing", 0xffc0}};
inline constexpr FloatRegisters standard_mode = 0x1f80;

/// The bits that say the mode; the others say what has happened.
inline constexpr FloatRegisters control_bits = 0xffc0;
inline constexpr FloatRegisters flag_bits = 0x3f;

#else

/// FPCR, and FPSR above it.
inline FloatRegisters float_registers() {
  std::uint64_t control;
  std::uint64_t flags;
  asm volatile("mrs %0, fpcr" : "=r"(control) : : "memory");
  asm volatile("mrs %0, fpsr" : "=r"(flags) : : "memory");
  return control | flags << 32U;
}
inline void set_float_registers(FloatRegisters bits) {
  asm volatile("msr fpcr, %0" : : "r"(bits & 0xffffffffU) : "memory");
  asm volatile("msr fpsr, %0" : : "r"(bits >> 32U) : "memory");
}

inline constexpr Mode modes[] = {{"denormals are zero", 0x0100'0000},
                                 {"down", 0x0080'0000},
                                 {"up", 0x0040'0000},
                                 {"towards zero, flushing, NaN is the default one", 0x03c0'0000}};
inline constexpr FloatRegisters standard_mode = 0;

/// DN, FZ and RMode; IDC, IXC, UFC, OFC, DZC and IOC.
inline constexpr FloatRegisters control_bits = 0x03c0'0000;
inline constexpr FloatRegisters flag_bits = FloatRegisters{0x9f} << 32U;

#endif

/// Runs in a mode until the end of the scope.
class InMode {
 public:
  explicit InMode(const Mode& mode) : saved_(float_registers()) { set_float_registers(mode.bits); }
  ~InMode() { set_float_registers(saved_); }
  InMode(const InMode&) = delete;
  InMode& operator=(const InMode&) = delete;

 private:
  FloatRegisters saved_;
};

}  // namespace shaftcull

#endif
