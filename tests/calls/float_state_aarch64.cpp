// SPDX-License-Identifier: MIT
/// Modes and flags on 64-bit ARM: a program without any library, so that every x86 machine with clang, lld and
/// qemu-user can try it (CMakeLists.txt). Its exit code has a bit for each thing that is wrong.
#include "support/float_environment.hpp"

namespace {

using shaftcull::kernel::in_float_environment;
using Register = unsigned long;

Register fpcr() {
  Register value;
  asm volatile("mrs %0, fpcr" : "=r"(value));
  return value;
}
Register fpsr() {
  Register value;
  asm volatile("mrs %0, fpsr" : "=r"(value));
  return value;
}
void set(Register control, Register flags) {
  asm volatile("msr fpcr, %0" : : "r"(control));
  asm volatile("msr fpsr, %0" : : "r"(flags));
}

constexpr Register flush_to_zero = Register{1} << 24U;
constexpr Register default_nan = Register{1} << 25U;
constexpr Register towards_zero = Register{3} << 22U;
constexpr Register controls[] = {0, flush_to_zero, Register{1} << 22U, Register{2} << 22U,
                                 towards_zero | flush_to_zero | default_nan};
constexpr Register flag_sets[] = {0, 0x9f};

int faults() {
  volatile float tiny = 0x1p-120F;
  volatile float small = 0x1p-20F;
  volatile float one = 1;
  int wrong = 0;
  for (const Register control : controls) {
    for (const Register flags : flag_sets) {
      set(control, flags);
      float product = 0;
      float sum = 0;
      in_float_environment([&] {
        product = tiny * small;
        sum = one + small * small;
      });
      if (fpcr() != control) wrong |= 1;
      if (fpsr() != flags) wrong |= 2;
      set(0, 0);
      if (product != 0x1p-140F) wrong |= 4;
      if (sum != 1) wrong |= 8;
    }
  }
  set(flush_to_zero, 0);
  const volatile float flushed = tiny * small;
  set(0, 0);
  if (flushed != 0) wrong |= 16;  // the emulated processor does not flush, so all this shows nothing
  return wrong;
}

}  // namespace

extern "C" [[noreturn]] void _start() {
  register long code asm("x0") = faults();
  register long exit_call asm("x8") = 93;
  asm volatile("svc 0" : : "r"(code), "r"(exit_call));
  __builtin_unreachable();
}
