// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "columns.hpp"
#include "hashes/cases.hpp"
#include "hashes/digest.hpp"
#include "hashes/hashes.hpp"
#include "hashes/moving_shaft.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::hashes {
namespace {

std::uint64_t of_triangles(std::uint64_t scenes, TriangleTest test) {
  Numbers numbers;
  Digest digest;
  for (std::size_t s = 0; s != scenes; ++s) {
    const Number number = number_of(s);
    const Box a = box(numbers, number);
    const Box b = box(numbers, number);
    const Vec3 movement = point(numbers, number);  // first: compilers may draw arguments in any order
    CompiledShaft shaft = moving_shaft(numbers.below(4), a, b, movement);
    if (s % 3 == 0) {
      const Plane plane{{1, -2, 3}, numbers.grid()};
      shaft = compile(a, b, std::span(&plane, 1));
    }
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i != bounds_a_scene; ++i) {
      Triangle triangle{};
      for (Vec3& vertex : triangle.vertex) {
        const bool touches = !is_wild(s) && numbers.below(3) == 0;
        vertex = touches ? edge_point(numbers, shaft.a(), shaft.b()) : point(numbers, number);
      }
      if (numbers.below(8) == 0) triangle.vertex[2] = triangle.vertex[numbers.below(2) == 0 ? 0 : 1];
      triangles.push_back(triangle);
    }
    triangles[s % bounds_a_scene].vertex[s % 2][s % 3] = std::numeric_limits<float>::quiet_NaN();
    std::vector<std::uint64_t> kept(bit_words(bounds_a_scene));
    cull(shaft, TriangleColumns(triangles).view(), kept, {.triangle_test = test});
    digest.add_all(kept);
  }
  return digest.value();
}

}  // namespace

std::uint64_t triangles_by_vertices(std::uint64_t scenes, Way /*way*/) {
  return of_triangles(scenes, TriangleTest::vertices);
}
std::uint64_t triangles_exactly(std::uint64_t scenes, Way /*way*/) { return of_triangles(scenes, TriangleTest::exact); }

}  // namespace shaftcull::hashes
