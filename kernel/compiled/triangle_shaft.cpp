// SPDX-License-Identifier: MIT
#include "compiled/triangle_shaft.hpp"

#include <algorithm>
#include <cmath>

#include "compiled/moving_faces.hpp"
#include "support/exact_floats.hpp"

namespace shaftcull::kernel {
namespace {

/// Products of three lengths, each of at most this, do not overflow.
constexpr double most_extent = 0x1p35;

/// A shaft without end passes so many of its own extents in a unit of time: that puts what is near it and what is far
/// away both well within the interval of t.
constexpr double extents_a_unit = 16;

/// How long a unit of time is.
double unit_of(const MovingFaces& faces) noexcept {
  if (!faces.is_endless()) return faces.end();
  double extent = 0;
  double fastest = 0;
  for (unsigned f = 0; f < 6; ++f) {
    extent = std::max(extent, std::fabs(double{faces.p[f]} - double{faces.p[f % 3]}));
    fastest = std::max(fastest, std::fabs(faces.slope(f)));
  }
  return extent == 0 ? 1 : extents_a_unit * extent / fastest;
}

}  // namespace

TriangleShaft triangle_shaft(const ShaftData& shaft) noexcept {
  const MovingFaces faces(shaft);
  const double unit = unit_of(faces);
  TriangleShaft result;
  result.is_endless = faces.is_endless();
  double extent = 0;
  for (unsigned k = 0; k < 3; ++k) {
    const double lo_slope = unit * faces.slope(k);
    const double hi_slope = unit * faces.slope(k + 3);
    const double half = (double{faces.p[k + 3]} - double{faces.p[k]}) / 2;
    const double centre_slope = (hi_slope + lo_slope) / 2;
    const double half_slope = (hi_slope - lo_slope) / 2;
    result.start[k] = faces.p[k];
    result.half[k] = static_cast<float>(half);
    result.centre_slope[k] = static_cast<float>(centre_slope);
    result.half_slope[k] = static_cast<float>(half_slope);
    result.outward_slope[k] = static_cast<float>(-lo_slope);
    result.outward_slope[k + 3] = static_cast<float>(hi_slope);
    extent += 2 * half + std::fabs(centre_slope) + std::fabs(half_slope);
  }
  const bool suits_floats = extent < most_extent;
  result.extent = suits_floats ? static_cast<float>(extent * (1 + 0x1p-20)) : 0;
  result.most = suits_floats ? static_cast<float>(most_extent) : -1;
  return result;
}

}  // namespace shaftcull::kernel
