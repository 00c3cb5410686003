// SPDX-License-Identifier: MIT
#include "formation/join.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace shaftcull::kernel {
namespace {

constexpr double largest_float = std::numeric_limits<float>::max();

// Normals of this size leave enough exponents for the offset, and for products with coordinates: none over- or
// underflows a float.
constexpr double smallest_plain_normal = 0x1p-20;
constexpr double largest_plain_normal = 0x1p20;

constexpr std::array<double, face_count> outwards = {-1, -1, -1, 1, 1, 1};

}  // namespace

JoinedPlanes join(const Faces6& a, const Faces6& b, const JoinedEdges& edges, bool unit) noexcept {
  std::array<double, face_count> step;
  for (Face f = 0; f < face_count; ++f) step[f] = std::fabs(double{b[f]} - double{a[f]});
  return join(a, step, edges, unit);
}

JoinedPlanes join(const Faces6& a, const std::array<double, face_count>& step, const JoinedEdges& edges,
                  bool unit) noexcept {
  // In the plane of the two axes the boxes' edges are points. Going from a's to b's leads away from the red face, which
  // only a touches, and towards the blue one; the normal is that step turned by a right angle, outwards.
  // No product of two differences of floats over- or underflows a double.
  //
  // All columns are worked out, without branches: how many there are, and which way they face, is random.
  double red_step[max_joining_planes];
  double blue_step[max_joining_planes];
  double red_normal[max_joining_planes];
  double blue_normal[max_joining_planes];
  double offset[max_joining_planes];
  for (std::size_t i = 0; i < max_joining_planes; ++i) {
    const auto [red, blue] = edges.edge[i];
    red_step[i] = step[red];
    blue_step[i] = step[blue];
    red_normal[i] = outwards[red] * step[blue];
    blue_normal[i] = outwards[blue] * step[red];
    offset[i] = red_normal[i] * double{a[red]} + blue_normal[i] * double{a[blue]};
  }

  JoinedPlanes planes;
  for (std::size_t i = 0; i < max_joining_planes; ++i) {
    const double size = std::max(red_step[i], blue_step[i]);
    const bool is_plain = !unit & (size >= smallest_plain_normal) & (size <= largest_plain_normal);
    const double length = std::sqrt(red_step[i] * red_step[i] + blue_step[i] * blue_step[i]);
    const double finite_length = std::fabs(offset[i]) > largest_float * length ? 2 * length : length;
    const double divisor = is_plain ? 1 : finite_length;
    planes.red_normal[i] = static_cast<float>(red_normal[i] / divisor);
    planes.blue_normal[i] = static_cast<float>(blue_normal[i] / divisor);
    planes.offset[i] = static_cast<float>(offset[i] / divisor);
  }
  return planes;
}

}  // namespace shaftcull::kernel
