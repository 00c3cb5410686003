#include "formation/join.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shaftcull::kernel {
namespace {

constexpr double largest_float = std::numeric_limits<float>::max();

// Normals of this size leave room for the offset, and for products with coordinates: none over- or underflows a float.
constexpr double smallest_plain_normal = 0x1p-20;
constexpr double largest_plain_normal = 0x1p20;

}  // namespace

JoiningPlane join(const Faces6& a, const Faces6& b, JoinedEdge edge, bool unit) noexcept {
  // In the plane of the two axes the boxes' edges are points. Going from a's to b's leads away from the red face, which
  // only a touches, and towards the blue one; the normal is that step turned by a right angle, outwards.
  // No product of two differences of floats over- or underflows a double.
  const double red_a = a[edge.red];
  const double blue_a = a[edge.blue];
  const double red_step = std::fabs(b[edge.red] - red_a);
  const double blue_step = std::fabs(b[edge.blue] - blue_a);
  double red_normal = is_hi(edge.red) ? blue_step : -blue_step;
  double blue_normal = is_hi(edge.blue) ? red_step : -red_step;
  double offset = red_normal * red_a + blue_normal * blue_a;

  const double size = std::max(red_step, blue_step);
  if (unit || size < smallest_plain_normal || size > largest_plain_normal) {
    double length = std::sqrt(red_step * red_step + blue_step * blue_step);
    if (std::fabs(offset) > largest_float * length) length *= 2;
    red_normal /= length;
    blue_normal /= length;
    offset /= length;
  }

  JoiningPlane joining{{{0.0F, 0.0F, 0.0F}, static_cast<float>(offset)}, edge.red, edge.blue};
  joining.plane.normal[axis_of(edge.red)] = static_cast<float>(red_normal);
  joining.plane.normal[axis_of(edge.blue)] = static_cast<float>(blue_normal);
  return joining;
}

}  // namespace shaftcull::kernel
