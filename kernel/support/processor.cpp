// SPDX-License-Identifier: MIT
#include "support/processor.hpp"

#include "support/compiler.hpp"

namespace shaftcull::kernel {

#ifdef SHAFTCULL_TARGET_SSE2
namespace {

/// Registers of cpuid().
constexpr unsigned ebx = 1;
constexpr unsigned ecx = 2;

/// Bits of XCR0: registers that the operating system saves.
constexpr std::uint64_t no_registers = 0;
constexpr std::uint64_t avx_registers = 0x06;     // XMM, YMM
constexpr std::uint64_t avx512_registers = 0xe6;  // and masks, ZMM

/// Where the processor says that it has a feature, and what must be saved (Intel's manual, volume 2, CPUID).
struct Place {
  ProcessorFeature feature;
  std::uint32_t leaf;
  unsigned in;
  unsigned bit;
  std::uint64_t registers;
};
constexpr Place places[] = {{ProcessorFeature::sse4_2, 1, ecx, 20, no_registers},
                            {ProcessorFeature::popcnt, 1, ecx, 23, no_registers},
                            {ProcessorFeature::fma, 1, ecx, 12, avx_registers},
                            {ProcessorFeature::avx2, 7, ebx, 5, avx_registers},
                            {ProcessorFeature::bmi, 7, ebx, 3, no_registers},
                            {ProcessorFeature::bmi2, 7, ebx, 8, no_registers},
                            {ProcessorFeature::avx512f, 7, ebx, 16, avx512_registers},
                            {ProcessorFeature::avx512cd, 7, ebx, 28, avx512_registers},
                            {ProcessorFeature::avx512dq, 7, ebx, 17, avx512_registers},
                            {ProcessorFeature::avx512bw, 7, ebx, 30, avx512_registers},
                            {ProcessorFeature::avx512vl, 7, ebx, 31, avx512_registers},
                            {ProcessorFeature::avx512vbmi2, 7, ecx, 6, avx512_registers}};
constexpr unsigned osxsave = 27;  // of ECX in leaf 1

constexpr bool has(std::uint32_t bits, unsigned bit) noexcept { return (bits >> bit & 1U) != 0; }
constexpr std::uint32_t bit_of(ProcessorFeature feature) noexcept {
  return std::uint32_t{1} << static_cast<unsigned>(feature);
}

/// A bit for each feature.
std::uint32_t find_features() noexcept {
  std::uint32_t about[4];
  std::uint32_t leaf_1[4];
  std::uint32_t leaf_7[4] = {};
  cpuid(0, about);
  cpuid(1, leaf_1);
  if (about[0] >= 7) cpuid(7, leaf_7);
  const std::uint64_t saved = has(leaf_1[ecx], osxsave) ? read_xcr0() : 0;
  std::uint32_t features = 0;
  for (const Place& place : places) {
    const std::uint32_t word = (place.leaf == 1 ? leaf_1 : leaf_7)[place.in];
    if (has(word, place.bit) && (saved & place.registers) == place.registers) features |= bit_of(place.feature);
  }
  return features;
}

}  // namespace

bool processor_has(ProcessorFeature feature) noexcept {
  static const std::uint32_t features = find_features();
  return (features & bit_of(feature)) != 0;
}

#else

bool processor_has(ProcessorFeature /*feature*/) noexcept { return false; }

#endif

}  // namespace shaftcull::kernel
