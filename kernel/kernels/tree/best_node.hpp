// SPDX-License-Identifier: MIT
/// Which node of a dynamic tree a bound suits best.
#pragma once

#include <cmath>

#include "kernels/shared/word.hpp"

namespace shaftcull::kernel {

/// The square of the sum of a box's widths: about the area of its surface, but not 0 for a line.
template <class L>
typename L::Vector node_measure_of(const typename L::Vector (&lo)[3], const typename L::Vector (&hi)[3]) noexcept {
  const auto sum = L::add(L::add(L::subtract(hi[0], lo[0]), L::subtract(hi[1], lo[1])), L::subtract(hi[2], lo[2]));
  return L::multiply(sum, sum);
}

/// As BestNode in kernels/kernel_table.hpp. Products and sums are rounded each, so that all sets choose the same node.
template <class L>
unsigned best_node(const float* const* node, const float* corner, const float* bias, float* least_cost) noexcept {
  const auto infinity = L::all(INFINITY);
  const auto now_counts = L::all(64.0F);
  const auto then_counts = L::all(65.0F);
  auto least = infinity;
  float cost[word_bits];
  for (unsigned i = 0; i < word_bits; i += L::width) {
    typename L::Vector lo[3];
    typename L::Vector hi[3];
    typename L::Vector low[3];
    typename L::Vector high[3];
    for (unsigned k = 0; k < 3; ++k) {
      lo[k] = L::load(node[k] + i);
      hi[k] = L::load(node[k + 3] + i);
      low[k] = L::minimum(L::all(corner[k]), lo[k]);
      high[k] = L::maximum(L::all(corner[k + 3]), hi[k]);
    }
    const auto now = L::multiply(now_counts, node_measure_of<L>(lo, hi));
    const auto then = L::multiply(then_counts, node_measure_of<L>(low, high));
    auto here = L::add(L::subtract(then, now), L::load(bias + i));
    here = L::choose(L::less(here, infinity), here, infinity);  // NaN too
    L::store(cost + i, here);
    least = L::minimum(here, least);
  }
  *least_cost = L::smallest(least);
  if (!(*least_cost < INFINITY)) return word_bits;
  const auto wanted = L::all(*least_cost);
  unsigned first = 0;
  while (L::bits(L::less_equal(L::load(cost + first), wanted)) == 0) first += L::width;
  return first + L::lowest_bit(L::bits(L::less_equal(L::load(cost + first), wanted)));
}

}  // namespace shaftcull::kernel
