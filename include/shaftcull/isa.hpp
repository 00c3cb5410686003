/// The instruction sets that the kernels are compiled for, and the choice among them.
///
/// The best one that the processor *and* the operating system support is taken at the first call that
/// needs one. The environment variable SHAFTCULL_ISA (scalar, sse4_2, avx2 or avx512) or select_isa()
/// forces another. Answers do not depend on the choice; only speed does.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

enum class Isa : std::uint8_t { scalar, sse4_2, avx2, avx512 };

/// "scalar", "sse4_2", "avx2" (which includes FMA, BMI and BMI2) or "avx512" (those and F, CD, DQ, BW and VL).
[[nodiscard]] std::string_view name(Isa isa) noexcept;

/// The instruction set of that name, or nothing.
[[nodiscard]] std::optional<Isa> isa_from_name(std::string_view text) noexcept;

/// What this build has kernels for and this machine can run, slowest first; never empty.
[[nodiscard]] std::vector<Isa> available_isas();

/// What calls use from now on, in every thread.
/// Throws InvalidArgument if SHAFTCULL_ISA names an unknown or unavailable instruction set.
[[nodiscard]] Isa active_isa();

/// Uses `isa` from now on, in every thread; wins over SHAFTCULL_ISA. Safe to call at any time: a call that
/// is under way goes on with the instruction set it began with.
/// Throws InvalidArgument, listing what there is, if `isa` is not available.
void select_isa(Isa isa);

}  // namespace shaftcull
