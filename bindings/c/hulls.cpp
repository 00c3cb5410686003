// SPDX-License-Identifier: MIT
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::ConvexHull;
using shaftcull::Vec3;

namespace {

shaftcull_hull* new_hull(ConvexHull&& hull) {
  return new shaftcull_hull{std::make_shared<const ConvexHull>(std::move(hull))};
}

const float* floats_of(std::span<const Vec3> vectors) noexcept {
  return vectors.empty() ? nullptr : vectors.front().data();
}

}  // namespace

extern "C" {

shaftcull_status shaftcull_hull_create(const float* points, uint64_t point_count, uint64_t first_end,
                                       const float* directions, uint64_t direction_count, shaftcull_hull_test test,
                                       shaftcull_hull** hull) {
  return guarded([&] {
    shaftcull_hull*& out = given(hull, "hull");
    const std::vector<Vec3> all_points = as_vectors(points, point_count, "points");
    const std::vector<Vec3> all_directions = as_vectors(directions, direction_count, "directions");
    if (first_end == 0) {
      out = new_hull(ConvexHull(all_points, all_directions, as_hull_test(test)));
      return;
    }
    if (first_end >= point_count) {
      refuse("first_end = " + std::to_string(first_end) + " leaves no point of " + std::to_string(point_count) +
             " to the second end");
    }
    if (direction_count != 0) {
      refuse("direction_count = " + std::to_string(direction_count) +
             ", and first_end is not 0; a hull between two ends has no directions");
    }
    const std::span<const Vec3> both(all_points);
    const auto first = static_cast<std::size_t>(first_end);
    out = new_hull(shaftcull::between_polygons(both.first(first), both.subspan(first), as_hull_test(test)));
  });
}

shaftcull_status shaftcull_hull_of_frustum(const float matrix[16], shaftcull_clip_depth depth, shaftcull_hull_test test,
                                           shaftcull_hull** hull) {
  return guarded([&] {
    shaftcull_hull*& out = given(hull, "hull");
    (void)given(matrix, "matrix");
    out = new_hull(shaftcull::frustum(std::span<const float, 16>(matrix, 16), as_depth(depth), as_hull_test(test)));
  });
}

shaftcull_status shaftcull_hull_of_casters(const shaftcull_hull* view, const float light[4], shaftcull_hull** hull) {
  return guarded([&] {
    shaftcull_hull*& out = given(hull, "hull");
    const shaftcull::ConvexHull& of = *given(view, "view").hull;
    const shaftcull::Vec3 at = as_vector(light, "light");
    if (light[3] != 0 && light[3] != 1) {
      refuse("light[3] = " + std::to_string(light[3]) + " is neither 1, for a lamp at a point, nor 0, for a sun");
    }
    out = new_hull(light[3] == 0 ? casters_towards(of, at) : casters(of, at));
  });
}

void shaftcull_hull_free(shaftcull_hull* hull) { delete hull; }

shaftcull_status shaftcull_hull_describe(const shaftcull_hull* hull, shaftcull_hull_info* info) {
  return guarded([&] {
    const ConvexHull& convex = *given(hull, "hull").hull;
    given(info, "info") = {convex.points().size(), convex.directions().size(), floats_of(convex.points()),
                           floats_of(convex.directions()), converted<shaftcull_box>(convex.box())};
  });
}

}  // extern "C"
