// SPDX-License-Identifier: MIT
/// How much is measured.
#pragma once

#include <cstddef>

namespace shaftcull::bench {

/// Medians of many short repetitions in random order withstand noise better than few long ones.
struct RunSize {
  std::size_t bounds;
  int repetitions;
  double seconds;  ///< least time of a repetition
};

inline constexpr RunSize full_run{std::size_t{1} << 22, 7, 0.3};
/// Less than a minute. So few bounds stay in an L3 cache, where memory/… and the ends of sweep/… are not what they are
/// in full.
inline constexpr RunSize quick_run{std::size_t{1} << 18, 7, 0.04};

}  // namespace shaftcull::bench
