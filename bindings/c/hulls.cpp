// SPDX-License-Identifier: MIT
#include <memory>
#include <span>
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

shaftcull_status shaftcull_hull_create(const float* points, uint64_t point_count, const float* directions,
                                       uint64_t direction_count, shaftcull_hull_test test, shaftcull_hull** hull) {
  return guarded([&] {
    shaftcull_hull*& out = given(hull, "hull");
    const std::vector<Vec3> all_points = as_vectors(points, point_count, "points");
    out = new_hull(ConvexHull(all_points, as_vectors(directions, direction_count, "directions"), as_hull_test(test)));
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

shaftcull_status shaftcull_hull_of_casters(const shaftcull_hull* view, const float light[3], shaftcull_hull** hull) {
  return guarded([&] {
    shaftcull_hull*& out = given(hull, "hull");
    out = new_hull(shaftcull::casters(*given(view, "view").hull, as_vector(light, "light")));
  });
}

shaftcull_status shaftcull_hull_of_casters_towards(const shaftcull_hull* view, const float towards_sun[3],
                                                   shaftcull_hull** hull) {
  return guarded([&] {
    shaftcull_hull*& out = given(hull, "hull");
    out = new_hull(shaftcull::casters_towards(*given(view, "view").hull, as_vector(towards_sun, "towards_sun")));
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
