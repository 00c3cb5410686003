// SPDX-License-Identifier: MIT
/// How the faces of a shaft's box move, for all kinds of shafts.
///
/// Face f of box(t) is at p[f] + t (minuend[f] − subtrahend[f]), t from 0 to the end. The floats are those that the
/// user gave: no slope is rounded.
#pragma once

#include <cmath>

#include "compiled/shaft_data.hpp"

namespace shaftcull::kernel {

struct MovingFaces {
  static constexpr float zeros[6] = {};

  const float* p;
  const float* minuend;
  const float* subtrahend;
  double end_minuend;  ///< t ends at end_minuend − end_subtrahend; +∞ if it does not
  double end_subtrahend;

  /// Faces that move from box a to box b, six faces each.
  MovingFaces(const float* a, const float* b) noexcept
      : p(a), minuend(b), subtrahend(a), end_minuend(1), end_subtrahend(0) {}

  explicit MovingFaces(const ShaftData& shaft) noexcept : MovingFaces(shaft.a, shaft.b) {
    using enum ShaftData::Kind;
    if (shaft.kind == between) [[likely]]
      return;
    const bool is_shadow = shaft.kind == shadow || shaft.kind == shadow_without_end;
    minuend = is_shadow ? shaft.a : shaft.motion;
    subtrahend = is_shadow ? shaft.motion : zeros;
    if (shaft.is_endless()) {
      end_minuend = HUGE_VAL;
    } else if (is_shadow) {
      end_minuend = shaft.reach;
      end_subtrahend = 1;
      if (shaft.reach == 1) subtrahend = minuend;  // the occluder itself: nothing moves
    }
  }

  [[nodiscard]] double slope(unsigned f) const noexcept { return double{minuend[f]} - double{subtrahend[f]}; }
  [[nodiscard]] double end() const noexcept { return end_minuend - end_subtrahend; }
  [[nodiscard]] bool is_endless() const noexcept { return end_minuend == HUGE_VAL; }
  [[nodiscard]] bool is_purple(unsigned f) const noexcept { return minuend[f] == subtrahend[f]; }
  /// Whether the face moves outwards: then the shaft box has it where t ends.
  [[nodiscard]] bool is_blue(unsigned f) const noexcept {
    return f < 3 ? minuend[f] < subtrahend[f] : minuend[f] > subtrahend[f];
  }
};

}  // namespace shaftcull::kernel
