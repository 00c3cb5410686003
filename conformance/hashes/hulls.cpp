// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "columns.hpp"
#include "hashes/cases.hpp"
#include "hashes/digest.hpp"
#include "hashes/hashes.hpp"
#include "shaftcull/hull.hpp"

namespace shaftcull::hashes {

/// Hulls of one to eight points and up to two directions, in one plane or on one line now and then; boxes and spheres
/// of which many touch a point, or a line or a plane through some of them.
std::uint64_t convex_hulls(std::uint64_t scenes, Way way) {
  Numbers numbers;
  Digest digest;
  for (std::size_t h = 0; h != scenes; ++h) {
    const Number number = number_of(h);
    std::vector<Vec3> points;
    for (int left = 1 + numbers.below(8); left != 0; --left) points.push_back(point(numbers, number));
    if (numbers.below(6) == 0) {
      for (Vec3& p : points) p[h % 3] = points[0][h % 3];
    }
    std::vector<Vec3> directions;
    for (int left = numbers.below(6) - 3; left > 0; --left) {
      const Vec3 direction = point(numbers, number);
      if (direction != Vec3{}) directions.push_back(direction);
    }
    const ConvexHull hull(points, directions);
    const auto any_point = [&] {
      return points[static_cast<std::size_t>(numbers.below(static_cast<int>(points.size())))];
    };
    std::vector<Box> boxes;
    std::vector<Sphere> spheres;
    for (std::size_t i = 0; i != bounds_a_scene; ++i) {
      const bool touches = !is_wild(h) && numbers.below(2) == 0;
      const Vec3 p = any_point();
      const Vec3 on = touches ? edge_point(numbers, {p, p}, {any_point(), p}) : point(numbers, number);
      boxes.push_back(numbers.below(4) == 0 ? Box{on, on} : sorted(on, point(numbers, number)));
      spheres.push_back({on, numbers.below(4) == 0 ? 0.0F : std::abs((numbers.*number)())});
    }
    add_answers(hull, BoxColumns(boxes).view(), way, digest);
    add_answers(hull, SphereColumns(spheres).view(), way, digest);
  }
  return digest.value();
}

}  // namespace shaftcull::hashes
