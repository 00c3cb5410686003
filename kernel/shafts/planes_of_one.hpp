// SPDX-License-Identifier: MIT
/// Planes that are added to one shaft.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "compiled/shaft_data.hpp"
#include "formation/usable_plane.hpp"
#include "kernels/kernel_table.hpp"
#include "shaftcull/error.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"

namespace shaftcull::kernel {

/// Throws InvalidArgument for planes that no shaft takes, by position, and for more than one has room for.
inline void require_planes(std::span<const Plane> planes) {
  require_memory("planes", planes, "planes");
  if (planes.size() > max_added_planes) {
    fail(InvalidArgument("a shaft has room for " + std::to_string(max_added_planes) + " added planes only, not for " +
                         std::to_string(planes.size())));
  }
  for (std::size_t i = 0; i != planes.size(); ++i) require_usable(planes[i], {"planes[", i, "]"});
}

/// Adds planes, which are checked, to a formed shaft that lies between its box a and faces `b`.
inline void add_planes(const Kernels& kernels, std::span<const Plane> planes, const float (&b)[6],
                       ShaftData& shaft) noexcept {
  if (planes.empty()) return;
  const float* a_rows[6];
  const float* b_rows[6];
  for (unsigned f = 0; f != 6; ++f) {
    a_rows[f] = &shaft.a[f];
    b_rows[f] = &b[f];
  }
  const Plane* const first = planes.data();
  kernels.add_planes(a_rows, b_rows, &first, planes.size(), 1, &shaft);
}

}  // namespace shaftcull::kernel
