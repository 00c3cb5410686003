// SPDX-License-Identifier: MIT
/// The run as a table, for people.
#pragma once

#include "harness/results.hpp"
#include "harness/suite.hpp"

namespace shaftcull::bench {

/// Prints formation, tests by instruction set, limits, targets and notes to standard output.
void print_table(const Suite& suite, const Results& results);

}  // namespace shaftcull::bench
