// SPDX-License-Identifier: MIT
/// Bounds trees of a case's bounds.
#pragma once

#include "fuzz/case.hpp"

namespace shaftcull::fuzz {

/// Throws Fault unless trees of all bounds that may be packed answer the shaft, if it may be formed, as a flat scan
/// does, as they were built and after an update, on every instruction set. Slower than check_answers().
void check_trees(const Case& it);

}  // namespace shaftcull::fuzz
