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

/// The next float inwards of face f.
inline float next_inwards(float x, unsigned f) noexcept {
  constexpr float most = std::numeric_limits<float>::max();
  return std::nextafter(x, f < 3 ? most : -most);
}

/// A number as floats have it, none of them infinite.
struct EndFace {
  float nearest;  ///< to the face; but for the last bit, where that is a close decision
  float within;   ///< the last float that is not further out than the face; the largest one if the face is beyond that
};

/// Where face f ends, by exact numbers.
inline EndFace end_face(const MovingFaces& faces, unsigned f) noexcept {
  constexpr float most = std::numeric_limits<float>::max();
  const Expansion<9> end = exact_end_face(faces, f);
  double sum = 0;  // smallest term first: off by a few units of itself
  for (std::size_t i = 0; i < end.size(); ++i) sum += end[i];
  const auto nearest = static_cast<float>(std::clamp(sum, -double{most}, double{most}));
  const int beyond = difference_sign(end, nearest);
  // The face is half a step away at most, so no other float comes into question than the next one inwards.
  return {nearest, (f < 3 ? beyond <= 0 : beyond >= 0) ? nearest : next_inwards(nearest, f)};
}

/// Where the faces of a box end. Loops are over eight lanes, for vectors: the last two are of no face.
struct EndFaces {
  float nearest[8];  ///< as in EndFace
  float within[8];   ///< likewise, of faces that move outwards

  explicit EndFaces(const MovingFaces& faces) noexcept {
    constexpr double most = std::numeric_limits<float>::max();
    const double time = faces.end();
    double minuend[8] = {};
    double subtrahend[8] = {};
    double start[8] = {};
    for (unsigned f = 0; f < 6; ++f) {
      start[f] = faces.p[f];
      minuend[f] = faces.minuend[f];
      subtrahend[f] = faces.subtrahend[f];
    }
    double beyond[8];  // the end − the nearest float
    double error[8];   // of the end
    for (unsigned f = 0; f < 8; ++f) {
      // Four roundings: of the slope and the time, by 2⁻⁵³ of the travel each, of their product, and of the sum.
      const double travel = time * (minuend[f] - subtrahend[f]);
      const double end = start[f] + travel;
      const double finite = end < -most ? -most : end > most ? most : end;
      nearest[f] = static_cast<float>(finite);
      beyond[f] = end - nearest[f];
      error[f] = 0x1p-50 * std::fabs(travel) + 0x1p-52 * std::fabs(end);
    }
    for (unsigned f = 0; f < 6; ++f) {
      // Where the travel takes back most of the start, the error may be as large as the end.
      const bool is_near = error[f] <= 0x1p-40 * std::fabs(nearest[f]);
      if (is_near && (std::fabs(beyond[f]) > error[f] || !faces.is_blue(f))) [[likely]] {
        within[f] = (f < 3 ? beyond[f] < 0 : beyond[f] > 0) ? nearest[f] : next_inwards(nearest[f], f);
      } else {
        const EndFace exact = end_face(faces, f);
        nearest[f] = exact.nearest;
        within[f] = exact.within;
      }
    }
  }
};

}  // namespace shaftcull::kernel
