// SPDX-License-Identifier: MIT
/// How many planes a test with early out looks at, for every order of planes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "shaftcull/paper.hpp"

namespace shaftcull::cli {

inline constexpr std::array plane_orders{PlaneOrder::unsorted, PlaneOrder::by_volume, PlaneOrder::by_added_volume};

/// Sums over shafts and bounds, of the paper's two tests done one plane at a time.
struct PlaneCount {
  std::uint64_t bounds = 0;
  std::uint64_t outside_tests = 0;     ///< bounds that meet the shaft box
  std::uint64_t culled_by_planes = 0;  ///< those of them that are outside a joining plane
  std::uint64_t inside_tests = 0;      ///< bounds that are not outside and lie in the shaft box
  std::uint64_t inside = 0;            ///< those of them that are inside
  std::array<std::uint64_t, plane_orders.size()> outside_plane_tests{};
  std::array<std::uint64_t, plane_orders.size()> inside_plane_tests{};

  /// Adds the shaft between `a` and `b` against all `boxes`. Returns its number of joining planes.
  std::size_t add(const Box& a, const Box& b, std::span<const Box> boxes);
};

}  // namespace shaftcull::cli
