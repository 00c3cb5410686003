// SPDX-License-Identifier: MIT
/// The instruction sets that the kernels are compiled for, and the choice among them.
///
/// The best one that the processor *and* the operating system support is taken at the first call that needs one. The
/// environment variable SHAFTCULL_ISA, which holds a name such as avx2, or select_isa() forces another. A variable that
/// cannot be followed is not an error, since a user may have set it for another program or another machine: the best
/// one is taken, and isa_choice() says why. Answers do not depend on the choice; only speed does.
///
/// The choice is about the tests and formation, and the loops that count and list their bits. Packing streams and
/// checking records use SSE2 on x86-64 whatever is chosen, since every such processor has it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// On one processor, the better ones later. `scalar` and `portable128`, four floats in a vector and no intrinsics, run
/// on any processor; `neon` is that of 64-bit ARM, and the others are those of x86-64. Numbers may change when a set is
/// added: what is to last is the name.
enum class Isa : std::uint8_t {
  scalar,       ///< one float at a time
  portable128,  ///< four floats, by the compiler
  sse4_2,       ///< four floats; needs POPCNT, too
  avx2,         ///< eight floats; needs FMA, BMI and BMI2, too
  avx512,       ///< sixteen floats: F, CD, DQ, BW and VL; needs those of avx2, too
  neon,         ///< four floats
};

/// "avx2" for Isa::avx2; "unknown" for a value that is no enumerator.
[[nodiscard]] SHAFTCULL_EXPORT std::string_view name(Isa isa) noexcept;

/// The instruction set of that name, in upper or lower case, or nothing.
[[nodiscard]] SHAFTCULL_EXPORT std::optional<Isa> isa_from_name(std::string_view text) noexcept;

/// What this build has kernels for and this machine can run, slowest first; never empty.
[[nodiscard]] SHAFTCULL_EXPORT std::vector<Isa> available_isas();

/// What calls use from now on, in every thread.
[[nodiscard]] SHAFTCULL_EXPORT Isa active_isa() noexcept;

/// What was asked for, and what runs.
struct IsaChoice {
  std::string asked;  ///< SHAFTCULL_ISA as it is now; empty if it is not set
  /// Why SHAFTCULL_ISA cannot be followed, with a list of what there is; empty if it can, or is not set.
  std::string refusal;
  Isa running;  ///< active_isa()
};
/// Reads the environment, so no other thread may change it meanwhile. This and available_isas() allocate, and throw
/// std::bad_alloc if memory runs out.
[[nodiscard]] SHAFTCULL_EXPORT IsaChoice isa_choice();

/// Uses `isa` from now on, in every thread; wins over SHAFTCULL_ISA. Safe to call at any time: a call that
/// is under way goes on with the instruction set it began with.
/// Throws InvalidArgument, listing what there is, if `isa` is not available.
SHAFTCULL_EXPORT void select_isa(Isa isa);

}  // namespace shaftcull
