// SPDX-License-Identifier: MIT
/// What a case's boxes see of each other.
#pragma once

#include "fuzz/case.hpp"

namespace shaftcull::fuzz {

/// Patches are the boxes, in one set or two; occluders are boxes, solids, hulls, polygons and triangles of the same
/// coordinates. Throws Fault unless
/// * sets and occluders refuse exactly what the headers say;
/// * every pair is what exact arithmetic says, with its candidates, on every instruction set;
/// * resolve() has the last word on undecided pairs and on no others;
/// * of one case in sixteen, with many copies of the patches, answers are the same in the least memory.
/// Slow.
void check_sights(const Case& it);

}  // namespace shaftcull::fuzz
