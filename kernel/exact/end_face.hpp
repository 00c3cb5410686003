// SPDX-License-Identifier: MIT
/// Where a face of a moving box ends, which need not be a float.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "compiled/moving_faces.hpp"
#include "exact/expansion.hpp"

namespace shaftcull::kernel {

/// p + (end of t) · slope of a face, exactly. t must have an end.
inline Expansion<9> exact_end_face(const MovingFaces& faces, unsigned f) noexcept {
  const auto travel = Expansion<2>::difference(faces.end_minuend, faces.end_subtrahend) *
                      Expansion<2>::difference(faces.minuend[f], faces.subtrahend[f]);
  Expansion<9> end(faces.p[f]);
  for (std::size_t i = 0; i < travel.size(); ++i) end.grow(travel[i]);
  return end;
}

/// The sign of end − x.
inline int difference_sign(const Expansion<9>& end, double x) noexcept {
  Expansion<10> difference;
  for (std::size_t i = 0; i < end.size(); ++i) difference.append(end[i]);
  difference.grow(-x);
  return difference.sign();
}

/// A number as floats have it, none of them infinite.
struct EndFace {
  float nearest;  ///< to the face; but for the last bit, where that is a close decision
  float within;   ///< the last float that is not further out than the face; the largest one if the face is beyond that
};

inline EndFace end_face(const MovingFaces& faces, unsigned f) noexcept {
  constexpr float most = std::numeric_limits<float>::max();
  const Expansion<9> end = exact_end_face(faces, f);
  double sum = 0;  // smallest term first: off by a few units of itself
  for (std::size_t i = 0; i < end.size(); ++i) sum += end[i];
  const auto nearest = static_cast<float>(std::clamp(sum, -double{most}, double{most}));
  const auto is_within = [&](float x) {
    const int sign = difference_sign(end, x);
    return f < 3 ? sign <= 0 : sign >= 0;
  };
  const float inwards = f < 3 ? most : -most;
  float within = nearest;
  while (within != inwards && !is_within(within)) within = std::nextafter(within, inwards);
  const float outwards = f < 3 ? -std::numeric_limits<float>::infinity() : std::numeric_limits<float>::infinity();
  for (;;) {
    const float next = std::nextafter(within, outwards);
    if (!std::isfinite(next) || !is_within(next)) break;
    within = next;
  }
  return {nearest, within};
}

}  // namespace shaftcull::kernel
