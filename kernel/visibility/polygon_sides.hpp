// SPDX-License-Identifier: MIT
/// On which sides of a polygon's plane the ends of a shaft are: most polygons have both ends on one side.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "exact/orientation.hpp"
#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// The plane of a polygon's first three corners that are not on one line.
class PolygonSides {
 public:
  /// Which sides of the plane something reaches into for certain. Neither, if it is in the plane or close to it.
  struct Reach {
    bool front;
    bool back;
    bool is_in_plane;  ///< for certain, up to the tolerance if there is one
  };

  explicit PolygonSides(std::span<const Vec3> polygon) noexcept {
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      const Vec3& b = polygon[i - 1];
      const Vec3& c = polygon[i];
      for (unsigned k = 0; k != 3; ++k) point_[k] = polygon[0][k];
      const SpannedPlane plane(point_, {{b[0], point_[0]}, {b[1], point_[1]}, {b[2], point_[2]}},
                               {{c[0], point_[0]}, {c[1], point_[1]}, {c[2], point_[2]}});
      unsigned aslant = 0;
      for (unsigned k = 0; k != 3; ++k) {
        normal_[k] = plane.normal(k);
        aslant += normal_[k] != 0 ? 1 : 0;
      }
      if (aslant == 0) continue;
      // A normal along an axis takes one coordinate alone, whose sign is that of the difference. A component of
      // another normal is off by 2⁻³⁰ of itself at most, and what is added up rounds much less.
      margin_ = aslant == 1 ? 0 : 0x1p-28;
      return;
    }
  }

  [[nodiscard]] Reach of(const float (&box)[6]) const noexcept {
    double least = 0;
    double most = 0;
    double magnitude = 0;
    for (unsigned k = 0; k != 3; ++k) {
      const double low = normal_[k] * (double{box[k]} - point_[k]);
      const double high = normal_[k] * (double{box[k + 3]} - point_[k]);
      least += std::min(low, high);
      most += std::max(low, high);
      magnitude += std::max(std::fabs(low), std::fabs(high));
    }
    const double margin = margin_ * magnitude;
    return {most > margin, least < -margin, margin_ == 0 && most == 0 && least == 0};
  }

  /// Of the convex hull of points.
  [[nodiscard]] Reach of(std::span<const Vec3> points, float tolerance) const noexcept {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    double magnitude = 0;
    for (const Vec3& point : points) {
      double height = 0;
      double terms = 0;
      for (unsigned k = 0; k != 3; ++k) {
        const double along = normal_[k] * (double{point[k]} - point_[k]);
        height += along;
        terms += std::fabs(along);
      }
      least = std::min(least, height);
      most = std::max(most, height);
      magnitude = std::max(magnitude, terms);
    }
    const double margin = margin_ * magnitude;
    double thickness = 0;
    for (const double n : normal_) thickness += tolerance * std::fabs(n) * (1 - 0x1p-28);
    const bool is_in_plane =
        thickness > 0 ? std::max(most, -least) + margin <= thickness : margin_ == 0 && most == 0 && least == 0;
    return {most > margin, least < -margin, is_in_plane};
  }

  /// Whether no segment between two such ends goes from one side to the other, for certain.
  [[nodiscard]] static bool are_on_one_side(const Reach& a, const Reach& b) noexcept {
    return (a.front && b.front) || (a.back && b.back) || a.is_in_plane || b.is_in_plane;
  }

 private:
  double normal_[3] = {0, 0, 0};
  double point_[3] = {0, 0, 0};
  double margin_ = 1;
};

}  // namespace shaftcull::kernel
