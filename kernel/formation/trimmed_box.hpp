/// The shaft box, trimmed by joining planes, as a polyhedron: how much does one more plane cut off?
#pragma once

#include <array>
#include <cstddef>

#include "formation/rule.hpp"

namespace shaftcull::kernel {

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
  using Point = std::array<double, 3>;

  // A rectangle has 4 corners and each of up to 8 planes adds one; the rest is room for what rounding may add.
  static constexpr std::size_t max_corners = 24;
  static constexpr std::size_t max_faces = face_count + max_joining_planes;

  struct Polygon {
    std::array<Point, max_corners> corner;  ///< counter-clockwise, seen from outside
    std::size_t count = 0;

    void add(const Point& point) noexcept {
      if (count < max_corners) corner[count++] = point;
    }
  };

  static double beyond(const CornerCut& cut, const Point& point) noexcept;
  static Polygon rectangle(const Point& corner, const Point& side, const Point& other_side,
                           const Point& outwards) noexcept;
  static Polygon face_of(const CornerCut& cut) noexcept;
  static Polygon clipped(const Polygon& polygon, const CornerCut& cut, double keep) noexcept;
  static double pyramid(const Polygon& base, const Point& apex) noexcept;

  std::array<Polygon, max_faces> face_;
  std::array<CornerCut, max_joining_planes> cut_;
  std::size_t faces_ = 0;
  std::size_t cuts_ = 0;
};

}  // namespace shaftcull::kernel
