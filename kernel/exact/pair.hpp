// SPDX-License-Identifier: MIT
/// Exact answers for the shaft between two boxes that was never compiled, and for planes of patches.
#pragma once

#include "compiled/shaft_data.hpp"

namespace shaftcull::kernel {

/// Whether the box with the faces of `bound` is outside of the shaft between boxes a and b: six finite faces each.
[[nodiscard]] bool is_outside_between(const float (&a)[6], const float (&b)[6], Contact contact,
                                      const float (&bound)[6]) noexcept;

/// Whether normal·p ≤ offset for a point, all finite.
[[nodiscard]] bool is_point_behind(const float (&normal)[3], float offset, const float (&point)[3]) noexcept;

/// Likewise for all points of a finite box.
[[nodiscard]] bool is_box_behind(const float (&normal)[3], float offset, const float (&box)[6]) noexcept;

}  // namespace shaftcull::kernel
