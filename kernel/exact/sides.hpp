// SPDX-License-Identifier: MIT
/// On which sides of a plane some points are.
#pragma once

namespace shaftcull::kernel {

/// Of a plane, or of the plane through an edge and each of some points.
struct Sides {
  bool in_front = false;
  bool behind = false;
  bool in_plane = false;

  /// Adds a point, by the sign of its height above the plane.
  void add(int side) noexcept {
    in_front |= side > 0;
    behind |= side < 0;
    in_plane |= side == 0;
  }
  [[nodiscard]] bool are_mixed() const noexcept { return in_front && behind; }
};

}  // namespace shaftcull::kernel
