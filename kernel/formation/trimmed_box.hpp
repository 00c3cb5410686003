// SPDX-License-Identifier: MIT
/// The shaft box, trimmed by joining planes, as a polyhedron: how much does one more plane cut off?
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "formation/rule.hpp"
#include "support/double3.hpp"

namespace shaftcull::kernel {

/// Position of a face of the cube on its axis, and the point at depth `depth` below it.
inline double position(Face f) noexcept { return is_hi(f) ? 1 : 0; }
inline double below(Face f, double depth) noexcept { return is_hi(f) ? 1 - depth : depth; }
inline double depth_below(Face f, const Double3& point) noexcept { return std::fabs(point[axis_of(f)] - position(f)); }

/// A plane that cuts the edge between two neighbouring faces off the unit cube.
struct CornerCut {
  Face first;
  Face second;
  double first_leg;   ///< how far from the edge it meets the second face: along the first one's axis, in (0, 1]
  double second_leg;  ///< likewise along the second one's axis

  /// Volume of the prism that it cuts off the cube.
  [[nodiscard]] double volume() const noexcept { return first_leg * second_leg / 2; }
};

/// The unit cube without the prisms cut off so far. Affine maps keep ratios of volumes, so that the cube stands
/// for every shaft box, even a flat one.
///
/// Its faces are kept as convex polygons: the cube's six, and that of each plane, which is a rectangle until other
/// planes trim it. So no plane's face is ever pieced together from intersections with others.
class TrimmedBox {
 public:
  TrimmedBox() noexcept;

  /// Volume of what `cut` would take away from what is left, by summing pyramids over the faces beyond it.
  [[nodiscard]] double volume_beyond(const CornerCut& cut) const noexcept;

  /// Takes it away.
  void trim(const CornerCut& cut) noexcept;

 private:
  // A rectangle has 4 corners and each of up to 8 planes adds one; the others are spare, for corners that rounding may
  // add.
  static constexpr std::size_t max_corners = 24;
  static constexpr std::size_t max_faces = face_count + max_joining_planes;

  struct Polygon {
    std::array<Double3, max_corners> corner;  ///< counter-clockwise, seen from outside
    std::size_t count = 0;

    void add(const Double3& point) noexcept {
      if (count < max_corners) corner[count++] = point;
    }
  };

  static double beyond(const CornerCut& cut, const Double3& point) noexcept;
  static Polygon rectangle(const Double3& corner, const Double3& side, const Double3& other_side,
                           const Double3& outwards) noexcept;
  static Polygon face_of(const CornerCut& cut) noexcept;
  static Polygon clipped(const Polygon& polygon, const CornerCut& cut, double keep) noexcept;
  static double pyramid(const Polygon& base, const Double3& apex) noexcept;

  std::array<Polygon, max_faces> face_;
  std::array<CornerCut, max_joining_planes> cut_;
  std::size_t faces_ = 0;
  std::size_t cuts_ = 0;
};

inline TrimmedBox::TrimmedBox() noexcept {
  for (Face f = 0; f < face_count; ++f) {
    Double3 corner{};
    Double3 side{};
    Double3 other_side{};
    Double3 outwards{};
    corner[axis_of(f)] = position(f);
    side[(axis_of(f) + 1) % 3] = 1;
    other_side[(axis_of(f) + 2) % 3] = 1;
    outwards[axis_of(f)] = is_hi(f) ? 1 : -1;
    face_[faces_++] = rectangle(corner, side, other_side, outwards);
  }
}

inline double TrimmedBox::volume_beyond(const CornerCut& cut) const noexcept {
  // With the apex on the cutting plane, the face that the plane itself adds to the piece has no volume to add.
  Double3 apex{};
  apex[axis_of(cut.first)] = below(cut.first, cut.first_leg);
  apex[axis_of(cut.second)] = position(cut.second);
  double volume = 0;
  for (std::size_t i = 0; i < faces_; ++i) volume += pyramid(clipped(face_[i], cut, 1), apex);
  return volume;
}

inline void TrimmedBox::trim(const CornerCut& cut) noexcept {
  Polygon face = face_of(cut);
  for (std::size_t i = 0; i < cuts_; ++i) face = clipped(face, cut_[i], -1);
  for (std::size_t i = 0; i < faces_; ++i) face_[i] = clipped(face_[i], cut, -1);
  face_[faces_++] = face;
  cut_[cuts_++] = cut;
}

/// Positive for points that `cut` cuts off, 0 on its plane.
inline double TrimmedBox::beyond(const CornerCut& cut, const Double3& point) noexcept {
  return cut.first_leg * cut.second_leg - depth_below(cut.first, point) * cut.second_leg -
         depth_below(cut.second, point) * cut.first_leg;
}

inline TrimmedBox::Polygon TrimmedBox::rectangle(const Double3& corner, const Double3& side, const Double3& other_side,
                                                 const Double3& outwards) noexcept {
  const bool counter_clockwise = dot(cross(side, other_side), outwards) > 0;
  const Double3& u = counter_clockwise ? side : other_side;
  const Double3& v = counter_clockwise ? other_side : side;
  Polygon polygon;
  polygon.add(corner);
  polygon.add({corner[0] + u[0], corner[1] + u[1], corner[2] + u[2]});
  polygon.add({corner[0] + u[0] + v[0], corner[1] + u[1] + v[1], corner[2] + u[2] + v[2]});
  polygon.add({corner[0] + v[0], corner[1] + v[1], corner[2] + v[2]});
  return polygon;
}

inline TrimmedBox::Polygon TrimmedBox::face_of(const CornerCut& cut) noexcept {
  const unsigned i = axis_of(cut.first);
  const unsigned j = axis_of(cut.second);
  Double3 corner{};
  Double3 side{};
  Double3 other_side{};
  Double3 outwards{};
  corner[i] = below(cut.first, cut.first_leg);
  corner[j] = position(cut.second);
  side[i] = position(cut.first) - corner[i];
  side[j] = below(cut.second, cut.second_leg) - corner[j];
  other_side[3 - i - j] = 1;
  outwards[i] = is_hi(cut.first) ? cut.second_leg : -cut.second_leg;
  outwards[j] = is_hi(cut.second) ? cut.first_leg : -cut.first_leg;
  return rectangle(corner, side, other_side, outwards);
}

/// The part of `polygon` beyond the cut if `keep` is 1, before it if −1 (Sutherland and Hodgman, 1974).
inline TrimmedBox::Polygon TrimmedBox::clipped(const Polygon& polygon, const CornerCut& cut, double keep) noexcept {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Double3& from = polygon.corner[i];
    const Double3& to = polygon.corner[i + 1 == polygon.count ? 0 : i + 1];
    const double from_side = keep * beyond(cut, from);
    const double to_side = keep * beyond(cut, to);
    if (from_side >= 0) kept.add(from);
    if ((from_side > 0 && to_side < 0) || (from_side < 0 && to_side > 0)) {
      const double t = from_side / (from_side - to_side);
      const Double3 step = to - from;
      kept.add({from[0] + t * step[0], from[1] + t * step[1], from[2] + t * step[2]});
    }
  }
  return kept;
}

/// Volume of the pyramid over `base`, positive if the apex is on the inner side of it.
inline double TrimmedBox::pyramid(const Polygon& base, const Double3& apex) noexcept {
  double volume = 0;
  for (std::size_t i = 2; i < base.count; ++i) {
    const Double3 u = base.corner[0] - apex;
    const Double3 v = base.corner[i - 1] - apex;
    const Double3 w = base.corner[i] - apex;
    volume += dot(u, cross(v, w)) / 6;
  }
  return volume;
}

}  // namespace shaftcull::kernel
