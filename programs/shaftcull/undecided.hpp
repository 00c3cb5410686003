// SPDX-License-Identifier: MIT
/// Which answers the float filter leaves to the exact predicates.
#pragma once

#include <cstdint>
#include <span>

#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"

namespace shaftcull::cli {

/// Sets bit i of `asked` iff classify() on the scalar path asks an exact predicate about bound i. Other instruction
/// sets round a little differently and ask about a few others. Answers into `kept` and `inside`, as classify(); all
/// three have bit_words(bounds.count) words. The shaft has its planes.
void undecided(const CompiledShaft& shaft, const BoxView& boxes, std::span<std::uint64_t> asked,
               std::span<std::uint64_t> kept, std::span<std::uint64_t> inside);
void undecided(const CompiledShaft& shaft, const SphereView& spheres, std::span<std::uint64_t> asked,
               std::span<std::uint64_t> kept, std::span<std::uint64_t> inside);

}  // namespace shaftcull::cli
