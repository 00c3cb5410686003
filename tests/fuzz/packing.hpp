// SPDX-License-Identifier: MIT
/// What packing must refuse, and what it must make of the rest.
#pragma once

#include "fuzz/case.hpp"

namespace shaftcull::fuzz {

/// Whether packing takes it: no NaN and lo ≤ hi, or the empty box.
[[nodiscard]] bool is_legal(const Box& box);
/// Whether packing takes it: a finite centre and a radius of 0 or more.
[[nodiscard]] bool is_legal(const Sphere& sphere);

/// Packs all bounds, from records at odd addresses too, and takes the boxes for centres and half extents as well.
/// Throws Fault unless what is refused, which index is named, and what is packed are as the headers say.
void check_packing(const Case& it);

}  // namespace shaftcull::fuzz
