// SPDX-License-Identifier: MIT
/// What a case's boxes see of each other.
#pragma once

#include "fuzz/case.hpp"

namespace shaftcull::fuzz {

/// Throws Fault unless sets of patches and blockers refuse exactly those boxes and planes of a case that the headers
/// say, and every pair of the others is, on every instruction set, what exact arithmetic says. Slow.
void check_sights(const Case& it);

}  // namespace shaftcull::fuzz
