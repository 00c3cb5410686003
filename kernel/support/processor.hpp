// SPDX-License-Identifier: MIT
/// Which instructions of x86 this processor has.
#pragma once

#include <cstdint>

namespace shaftcull::kernel {

/// Parts of the instruction set, as a compiler's flags name them: sse4_2 is that of -msse4.2.
enum class ProcessorFeature : std::uint8_t {
  sse4_2,
  popcnt,
  fma,
  avx2,
  bmi,
  bmi2,
  avx512f,
  avx512cd,
  avx512dq,
  avx512bw,
  avx512vl,
  avx512vbmi2
};

/// Whether programs can use it: the processor has it, and the operating system saves its registers. False on processors
/// other than x86. The processor is asked once.
[[nodiscard]] bool processor_has(ProcessorFeature feature) noexcept;

}  // namespace shaftcull::kernel
