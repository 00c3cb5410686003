// SPDX-License-Identifier: MIT
/// Whether a shaft answers what it is asked.
#pragma once

#include <cstddef>

#include "compiled/shaft_data.hpp"

namespace shaftcull::kernel {

[[noreturn]] void refuse_unformed(std::size_t position);
[[noreturn]] void refuse_kind(std::size_t position);
[[noreturn]] void refuse_hull_without_ends(std::size_t position);

/// Throws InvalidArgument for a shaft that was never formed. `position` is the shaft's index among many, for the
/// message.
inline void require_formed(const ShaftData& shaft, std::size_t position) {
  if (!shaft.is_formed()) [[unlikely]]
    refuse_unformed(position);
}

/// Throws InvalidArgument unless the shaft was formed between two boxes or polygons: others have no two ends that a box
/// could hide from each other. `position` as above.
inline void require_two_ends(const ShaftData& shaft, std::size_t position) {
  require_formed(shaft, position);
  if (shaft.kind == ShaftData::Kind::between) [[likely]]
    return;
  if (!shaft.is_hull()) refuse_kind(position);
  if (shaft.hull->middle == nullptr) refuse_hull_without_ends(position);
}

[[noreturn]] void refuse_hull(std::size_t position);

/// Throws InvalidArgument for a convex hull: nothing moves there. `position` as above.
inline void require_motion(const ShaftData& shaft, std::size_t position) {
  if (shaft.is_hull()) [[unlikely]]
    refuse_hull(position);
}

}  // namespace shaftcull::kernel
