// SPDX-License-Identifier: MIT
/// The instruction sets that the kernels are compiled for, and the choice among them.
///
/// The first call that needs an instruction set chooses the best that the processor *and* the operating system support.
/// The environment variable SHAFTCULL_ISA, which holds a name such as avx2, or select_isa() forces another. If the
/// variable names no available set, the best set is used, and isa_choice() returns the reason. That is not an error,
/// since a user may have set the variable for another program or machine. The choice affects speed, never answers.
///
/// The choice applies to the tests, to formation, and to the loops that count and list bits. Packing streams and
/// checking records always use SSE2 on x86-64, since every such processor has it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// An instruction set. `scalar` and `portable128` (four floats per vector, no intrinsics) run on any processor. `neon`
/// is for 64-bit ARM, and the others are for x86-64. Numbers and names never change; a set that is added gets the next
/// number. available_isas() returns the sets in the order of their speed.
enum class Isa : std::uint8_t {
  scalar = 0,       ///< one float at a time
  portable128 = 1,  ///< four floats, by the compiler
  sse4_2 = 2,       ///< four floats; needs POPCNT as well
  avx2 = 3,         ///< eight floats; needs FMA, BMI and BMI2 as well
  avx512 = 4,       ///< sixteen floats; needs F, CD, DQ, BW and VL, and all that avx2 needs
  neon = 5,         ///< four floats
};

/// The name of an instruction set: "avx2" for Isa::avx2; "unknown" for a value that is not an enumerator.
[[nodiscard]] SHAFTCULL_EXPORT std::string_view name(Isa isa) noexcept;

/// The instruction set with this name, in upper or lower case; std::nullopt if no set has it.
[[nodiscard]] SHAFTCULL_EXPORT std::optional<Isa> isa_from_name(std::string_view text) noexcept;

/// The instruction sets that this build has kernels for and this machine can run, slowest first; never empty.
[[nodiscard]] SHAFTCULL_EXPORT std::vector<Isa> available_isas();

/// The instruction set that calls in every thread use from now on.
[[nodiscard]] SHAFTCULL_EXPORT Isa active_isa() noexcept;

/// The requested instruction set, and the set in use.
struct IsaChoice {
  std::string asked;  ///< the present value of SHAFTCULL_ISA; empty if it is not set
  /// Why SHAFTCULL_ISA cannot be followed, and a list of available sets; empty if it can, or is not set.
  std::string refusal;
  Isa running;  ///< active_isa()
};
/// The present choice. Reads the environment, so no other thread may change the environment during the call. This call
/// and available_isas() allocate, and throw std::bad_alloc if memory runs out.
[[nodiscard]] SHAFTCULL_EXPORT IsaChoice isa_choice();

/// Makes calls in every thread use `isa` from now on; overrides SHAFTCULL_ISA. Safe to call at any time: a call in
/// progress continues with the instruction set it began with. Throws InvalidArgument, with a list of the available
/// sets, if `isa` is not available.
SHAFTCULL_EXPORT void select_isa(Isa isa);

}  // namespace shaftcull
