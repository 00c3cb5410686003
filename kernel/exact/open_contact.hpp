// SPDX-License-Identifier: MIT
/// Open contact: which bounds that touch a shaft are outside of it.
///
/// A bound is outside iff its relative interior has no point in common with the shaft's: iff no t between its ends,
/// which do not count, satisfies all constraints strictly. Only where, on an axis, the bound and all boxes on the way
/// are flat must they be equal instead (docs/exactness.md).
#pragma once

#include "compiled/moving_faces.hpp"
#include "compiled/shaft_data.hpp"
#include "exact/end_face.hpp"

namespace shaftcull::kernel {

/// Axes, bit k for axis k, on which all boxes on the way are flat.
inline unsigned flat_axes(const MovingFaces& faces) noexcept {
  unsigned axes = 0;
  for (unsigned k = 0; k < 3; ++k) {
    const bool is_flat = faces.p[k] == faces.p[k + 3] && faces.minuend[k] == faces.minuend[k + 3] &&
                         faces.subtrahend[k] == faces.subtrahend[k + 3];
    axes |= static_cast<unsigned>(is_flat) << k;
  }
  return axes;
}

/// Likewise, on which a bound is flat.
inline unsigned flat_axes(const float (&bound)[6]) noexcept {
  unsigned axes = 0;
  for (unsigned k = 0; k < 3; ++k) axes |= static_cast<unsigned>(bound[k] == bound[k + 3]) << k;
  return axes;
}

/// Whether coordinate x of a bound is at face f of the shaft box, which shaft_face() has as `face`, or beyond it.
inline bool reaches_face(const ShaftData& shaft, const MovingFaces& faces, unsigned f, float face, float x) noexcept {
  if (f < 3 ? x < face : x > face) return true;
  if (x != face) return false;
  if (shaft.kind == ShaftData::Kind::between || !faces.is_blue(f)) return true;
  // The face may be farther out, between two floats or infinitely far.
  return !faces.is_endless() && difference_sign(exact_end_face(faces, f), x) == 0;
}

/// Whether a bound is beyond the shaft box, with faces `face`, or touches it where that is outside. `both_flat` are the
/// axes on which the bound and the shaft are flat.
inline bool is_beyond_open_box(const ShaftData& shaft, const MovingFaces& faces, const float (&face)[6],
                               unsigned both_flat, const float (&bound)[6]) noexcept {
  for (unsigned k = 0; k < 3; ++k) {
    if ((both_flat >> k & 1U) != 0 && faces.is_purple(k)) {  // in the same plane, or not
      if (bound[k + 3] < face[k] || bound[k] > face[k + 3]) return true;
    } else if (reaches_face(shaft, faces, k, face[k], bound[k + 3]) ||
               reaches_face(shaft, faces, k + 3, face[k + 3], bound[k])) {
      return true;
    }
  }
  return false;
}

/// Whether a bound is beyond the edge between a red and a blue face, or touches it where that is outside, by the sign
/// of Edge::side().
inline bool is_beyond_open_edge(int side, unsigned both_flat, unsigned red, unsigned blue) noexcept {
  return side > 0 || (side == 0 && (both_flat >> red % 3 & both_flat >> blue % 3 & 1U) == 0);
}

}  // namespace shaftcull::kernel
