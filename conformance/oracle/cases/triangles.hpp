// SPDX-License-Identifier: MIT
/// Triangles around a shaft: random ones, and those that touch it or miss touching it by an ulp or two.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "oracle/cases/bounds.hpp"
#include "oracle/random.hpp"
#include "oracle/shaft_input.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull {

/// Makes a triangle flat, straight or a point in one case of some.
inline Triangle sometimes_degenerate(Random& random, Triangle triangle) {
  auto& [v0, v1, v2] = triangle.vertex;
  switch (random.below(16)) {
    case 0:
      v2 = v1;
      break;
    case 1:
      v1 = v2 = v0;
      break;
    case 2:  // in one line, but for rounding
      for (std::size_t k = 0; k != 3; ++k) v2[k] = 0.5F * v0[k] + 0.5F * v1[k];
      break;
    case 3:
    case 4:
    case 5: {  // a wall, a floor
      const std::size_t k = random.below(3);
      v1[k] = v2[k] = v0[k];
      break;
    }
    case 6: {  // an upright wall at any angle
      const std::size_t k = random.below(3);
      v2 = v1;
      v2[k] = v0[k];
      v0[k] = v1[k];
      break;
    }
    default:
      break;
  }
  return triangle;
}

/// With vertices around a point near the shaft, on all sides.
inline Triangle nearby_triangle(Random& random, const ShaftInput& input) {
  const float size = random.one_in(2) ? 0.3F : random.one_in(2) ? 1.5F : 20.0F;
  const Vec3 centre = random_centre(random, input, 1.5F);
  Triangle triangle{};
  for (Vec3& vertex : triangle.vertex) {
    for (std::size_t k = 0; k != 3; ++k) vertex[k] = centre[k] + random.uniform(-size, size);
  }
  return sometimes_degenerate(random, triangle);
}

/// A triangle that touches the shaft, but for an ulp or two: with a vertex on the path of a corner of the moving box,
/// or with an edge or its inside through it.
inline Triangle touching_triangle(Random& random, const ShaftInput& input) {
  const auto t = static_cast<double>(random.one_in(4) ? random.integer(0, 1) : random.uniform(0.0F, 1.0F));
  double at[3];
  double outwards[3];
  double scale = 0x1p-149;
  for (std::size_t k = 0; k != 3; ++k) {
    const bool hi = random.one_in(2);
    const auto from = static_cast<double>(hi ? input.a.hi[k] : input.a.lo[k]);
    const auto to = static_cast<double>(hi ? input.b.hi[k] : input.b.lo[k]);
    at[k] = from + t * (to - from);
    outwards[k] = hi ? 1 : -1;
    scale = std::max({scale, std::abs(from - static_cast<double>(input.b.lo[k])), std::abs(to - from)});
  }
  const auto as_float = [](double x) { return static_cast<float>(std::clamp(x, -3e38, 3e38)); };
  // Two ways from the point, each outwards as often as not.
  double way[2][3];
  const double size = scale * static_cast<double>(random.uniform(0.0F, random.one_in(3) ? 2.0F : 0.3F));
  for (auto& each : way) {
    const bool is_outwards = !random.one_in(4);
    for (std::size_t k = 0; k != 3; ++k) {
      const auto step = static_cast<double>(random.uniform(is_outwards ? 0.0F : -1.0F, 1.0F));
      each[k] = random.one_in(5) ? 0 : size * outwards[k] * step;
    }
  }
  Triangle triangle{};
  const unsigned where = random.below(3);
  for (std::size_t k = 0; k != 3; ++k) {
    auto& [v0, v1, v2] = triangle.vertex;
    if (where == 0) {  // a vertex
      v0[k] = as_float(at[k]);
      v1[k] = as_float(at[k] + way[0][k]);
      v2[k] = as_float(at[k] + way[1][k]);
    } else if (where == 1) {  // an edge
      v0[k] = as_float(at[k] - way[0][k]);
      v1[k] = as_float(at[k] + way[0][k]);
      v2[k] = as_float(at[k] + way[1][k]);
    } else {  // the inside
      v0[k] = as_float(at[k] - way[0][k] - way[1][k]);
      v1[k] = as_float(at[k] + way[0][k]);
      v2[k] = as_float(at[k] + way[1][k]);
    }
  }
  for (Vec3& vertex : triangle.vertex) {
    for (float& x : vertex) x = random.one_in(3) ? random.nudge(x) : x;
  }
  std::rotate(triangle.vertex.begin(), triangle.vertex.begin() + static_cast<std::ptrdiff_t>(random.below(3)),
              triangle.vertex.end());
  return sometimes_degenerate(random, triangle);
}

/// With integer coordinates.
inline Triangle grid_triangle(Random& random, int low, int high) {
  Triangle triangle{};
  for (Vec3& vertex : triangle.vertex) {
    vertex = {random.integer(low, high), random.integer(low, high), random.integer(low, high)};
  }
  return sometimes_degenerate(random, triangle);
}

/// With coordinates of some magnitudes.
inline Triangle wild_triangle(Random& random, int low = -149, int high = 127) {
  Triangle triangle{};
  for (Vec3& vertex : triangle.vertex)
    vertex = {random.wild(low, high), random.wild(low, high), random.wild(low, high)};
  return sometimes_degenerate(random, triangle);
}

}  // namespace shaftcull
