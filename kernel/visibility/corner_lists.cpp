// SPDX-License-Identifier: MIT
#include "visibility/corner_lists.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "support/arguments.hpp"
#include "support/exact_floats.hpp"
#include "support/fail.hpp"
#include "support/padding.hpp"
#include "support/text.hpp"

namespace shaftcull::kernel {

bool is_finite(const Vec3& point) noexcept {
  return std::all_of(point.begin(), point.end(), [](float x) { return std::isfinite(x); });
}

Box box_around_corners(std::span<const Vec3> corners) noexcept {
  Box box = empty_box;
  for (const Vec3& corner : corners) {
    for (std::size_t k = 0; k != 3; ++k) {
      box.lo[k] = std::min(box.lo[k], corner[k]);
      box.hi[k] = std::max(box.hi[k], corner[k]);
    }
  }
  return box;
}

void require_parts(std::span<const std::size_t> first, std::size_t size, const char* name, const char* noun) {
  if (first.empty() && size == 0) return;
  if (first.empty() || first.front() != 0 || first.back() != size) {
    fail(InvalidArgument(std::string(name) + " must begin with 0 and end with the number of " + noun + ", " +
                         std::to_string(size)));
  }
  for (std::size_t i = 1; i < first.size(); ++i) {
    if (first[i] >= first[i - 1]) continue;
    fail(InvalidArgument(std::string(name) + "[" + std::to_string(i) + "] = " + std::to_string(first[i]) +
                         " is less than the one before it"));
  }
}

void require_corner_lists(std::span<const Vec3> corners, std::span<const std::size_t> first, const char* noun,
                          std::size_t fewest, std::size_t most) {
  require_memory("corners", corners, "corners");
  require_memory("first_corner", first, "positions");
  require_parts(first, corners.size(), "first_corner", "corners");
  for (std::size_t i = 0; i + 1 < first.size(); ++i) {
    const std::span<const Vec3> part = corners.subspan(first[i], first[i + 1] - first[i]);
    if (part.size() < fewest || part.size() > most) {
      fail(InvalidArgument(std::string(noun) + " " + std::to_string(i) + " has " + counted(part.size(), "corner") +
                           "; it takes " + std::to_string(fewest) +
                           (most < any_number ? " to " + std::to_string(most) : " or more")));
    }
    if (!std::all_of(part.begin(), part.end(), is_finite)) refuse_bound(noun, i, "has a corner that is not finite");
  }
}

}  // namespace shaftcull::kernel
