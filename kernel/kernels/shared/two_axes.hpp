// SPDX-License-Identifier: MIT
/// Constraints on t in pairs: what leaves no t.
#pragma once

namespace shaftcull::kernel {

/// The largest sum of a constraint from below, since[k], and one from above, until[j], on different axes. None is
/// negative. If it is 1 or more, no t is left.
template <class L>
typename L::Vector largest_sum_of_two_axes(const typename L::Vector (&since)[3],
                                           const typename L::Vector (&until)[3]) noexcept {
  const auto x = L::add(since[0], L::maximum(until[1], until[2]));
  const auto y = L::add(since[1], L::maximum(until[2], until[0]));
  const auto z = L::add(since[2], L::maximum(until[0], until[1]));
  return L::maximum(x, L::maximum(y, z));
}

}  // namespace shaftcull::kernel
