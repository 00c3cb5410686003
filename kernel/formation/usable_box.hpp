// SPDX-License-Identifier: MIT
/// What a box that a shaft is formed from must be.
#pragma once

#include <cstddef>
#include <limits>

#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// Whether a box is finite with lo ≤ hi.
[[nodiscard]] inline bool is_usable(const Box& box) noexcept {
  bool usable = true;
  for (std::size_t k = 0; k < 3; ++k) {
    usable &= box.lo[k] >= -std::numeric_limits<float>::max() && box.lo[k] <= box.hi[k] &&
              box.hi[k] <= std::numeric_limits<float>::max();
  }
  return usable;
}

/// Throws the InvalidArgument of a box that is not usable.
[[noreturn]] void refuse_box(const Box& box, const char* name);

/// Throws InvalidArgument unless `box`, called `name` in messages, is finite with lo ≤ hi.
inline void require_finite(const Box& box, const char* name) {
  if (!is_usable(box)) [[unlikely]]
    refuse_box(box, name);
}

}  // namespace shaftcull::kernel
