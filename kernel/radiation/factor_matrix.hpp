// SPDX-License-Identifier: MIT
/// The matrix of view factors, from what pairs of patches exchange.
#pragma once

#include <vector>

#include "shaftcull/view_factors.hpp"

namespace shaftcull::kernel {

/// What two patches exchange.
struct Exchange {
  PatchPair pair;
  double area;  ///< A₁ F₁₂
  double error;
};

/// A list of lists, so that a long list is never copied to grow.
using ExchangeLists = std::vector<std::vector<Exchange>>;

/// Fills all but `area`, which has the areas of all patches, and `counts`. Pairs neither of whose factors reaches
/// `least` are left out. Columns ascend, so sums do not depend on the order of exchanges. Frees exchanges on the way.
void fill_rows(ViewFactors& factors, ExchangeLists exchanges, double least);

/// Multiplies what patches i and j exchange by a number of i and one of j, so that rows that are not empty sum to 1.
/// The sums of left-out factors are multiplied by the square of the number of their row. Throws InvalidArgument for a
/// row whose sum is far from 1.
void close_rows(ViewFactors& factors);

}  // namespace shaftcull::kernel
