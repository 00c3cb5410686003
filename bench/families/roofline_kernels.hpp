// SPDX-License-Identifier: MIT
/// Small kernels that do one thing as fast as this machine can: what the tests are measured against in roofline/… and
/// memory/….
#pragma once

#include <cstddef>

#include "shaftcull/compiled.hpp"
#include "shaftcull/isa.hpp"

namespace shaftcull::bench {

/// Kernels of one instruction set. Those that return a value do so to keep the compiler from leaving their work out.
struct RooflineKernels {
  /// Lanes of a vector of floats.
  std::size_t width;
  /// The arithmetic of `vectors` slab tests and nothing else: five multiply-adds and six minima or maxima a vector, on
  /// registers, without loads, comparisons or results.
  float (*slab_arithmetic)(std::size_t vectors) noexcept;
  /// Likewise on a grid: five multiplications and six minima or maxima for as many boxes as two vectors of floats hold.
  float (*grid_arithmetic)(std::size_t vectors) noexcept;
  /// `vectors` divisions that do not depend on each other.
  float (*divide)(std::size_t vectors) noexcept;
  /// Reads `count` floats, a multiple of 64, of each of six streams in step, as a test does.
  float (*read)(const float* const* stream, std::size_t count) noexcept;
  /// Writes the two cache lines of each shaft that batch formation writes.
  void (*write_shafts)(CompiledShaft* shafts, std::size_t count) noexcept;
};

/// The kernels for `isa`, or null: there are some for avx2 and avx512, where this build and this machine have them.
[[nodiscard]] const RooflineKernels* roofline_kernels(Isa isa) noexcept;

}  // namespace shaftcull::bench
