// SPDX-License-Identifier: MIT
#include "calls/every_call.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "calls/forming_calls.hpp"
#include "calls/occluded_calls.hpp"
#include "calls/query_calls.hpp"
#include "calls/stream_calls.hpp"
#include "calls/tree_calls.hpp"
#include "calls/triangle_calls.hpp"
#include "calls/visibility_calls.hpp"
#include "oracle/random.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {
namespace {

/// Whether a shaft of EveryCall::shafts() is that of a moving box, which has no two ends.
bool is_moving(std::size_t shaft) { return shaft % 7 == 6; }

}  // namespace

EveryCall::EveryCall(std::vector<CompiledShaft> shafts, std::size_t bounds) {
  table_.shafts = std::move(shafts);
  Random random(4711);
  for (std::size_t i = 0; i != bounds; ++i) {
    table_.boxes.push_back(i % 3 == 0 ? random.grid_box(-5, 5) : random.box(-5, 5, 0.05F, 1.0F));
    if (i % 90 == 4) table_.boxes.back() = {{-1e-40F, 1e-39F, 1e-41F}, {1e-39F, 2, 3e-40F}};  // denormals
    table_.spheres.push_back({table_.boxes.back().lo, i % 5 == 0 ? random.integer(0, 3) : random.uniform(0.01F, 0.5F)});
    if (i % 7 == 0) table_.candidates.push_back(static_cast<std::uint32_t>(i));
  }
  table_.mask.resize(bit_words(bounds));
  for (std::size_t i = 0; i != bounds; ++i) {
    table_.layers.push_back(1U << i % 5);
    if (i % 11 == 0) table_.mask[i / 64] |= std::uint64_t{1} << i % 64;
  }
  const auto one_of_them = [bounds](std::size_t i) { return static_cast<std::uint32_t>(bounds == 0 ? 0 : i % bounds); };
  for (std::size_t s = 0; s != table_.shafts.size(); ++s) {
    table_.of_each.push_back(one_of_them(s));
    table_.of_each.push_back(one_of_them(7 * s));
    if (!is_moving(s)) table_.between.push_back(table_.shafts[s]);
  }
  static const ConvexHull polygons = between_polygons(std::vector<Vec3>{{-5, -1, 0}, {-5, 1, 0.5F}, {-5, 0, 1e-39F}},
                                                      std::vector<Vec3>{{5, -1, 0.1F}, {5.5F, 1, 0.5F}, {5, 0, 1}});
  table_.between.push_back(polygons);
  table_.box_stream = BoxStream(table_.boxes);
  table_.sphere_stream = SphereStream(table_.spheres);
  for (std::size_t i = 0; i != bounds; ++i) {
    const Box& box = table_.boxes[i];
    table_.triangles.push_back({{box.lo, Vec3{box.hi[0], box.lo[1], box.hi[2]}, i % 4 == 0 ? box.lo : box.hi}});
  }
  table_.triangle_stream = TriangleStream(table_.triangles);
  table_.triangle_tree = TriangleTree(table_.triangle_stream.view());
  table_.box_tree = BoxTree(table_.box_stream.view());
  table_.sphere_tree = SphereTree(table_.sphere_stream.view());
  table_.box_tree.set_layers(table_.layers);
  table_.sphere_tree.set_layers(table_.layers);
  add_forming_calls(table_);
  add_stream_calls(table_);
  add_tree_calls<Box>(table_, " of boxes", table_.box_stream, table_.boxes, table_.box_tree);
  add_tree_calls<Sphere>(table_, " of spheres", table_.sphere_stream, table_.spheres, table_.sphere_tree);
  add_triangle_calls(table_);
  add_visibility_calls(table_);
  add_view_calls(table_, " of boxes", table_.box_stream.view());
  add_view_calls(table_, " of spheres", table_.sphere_stream.view());
  add_query_calls(table_, {.bounds = table_.box_tree, .name = " of a tree of boxes"});
  add_query_calls(table_, {.bounds = table_.sphere_tree, .name = " of a tree of spheres"});
  add_triangle_query_calls(table_, " of triangles in a view", Bounds(table_.triangle_stream, table_.layers), true);
  add_triangle_query_calls(table_, " of triangles in a tree", table_.triangle_tree, false);
  add_calls_about_one(table_, " of boxes", table_.boxes);
  add_calls_about_one(table_, " of spheres", table_.spheres);
  add_occluded_calls(table_, table_.box_stream, table_.boxes, table_.box_tree);
}

std::vector<CompiledShaft> EveryCall::shafts(std::size_t count) {
  Random random(4712);
  std::vector<CompiledShaft> shafts(count);
  for (std::size_t s = 0; s != count; ++s) {
    const Box a = s % 2 == 0 ? random.grid_box(-5, 5) : random.box(-5, 5, 0.2F, 2.0F);
    const Box b = random.grid_box(-5, 5);
    if (is_moving(s)) {
      const Vec3 way{1, 0.25F, s % 2 == 0 ? 0.0F : -3.0F};
      const Vec3 light{a.hi[0] + 2, a.lo[1], a.lo[2]};
      shafts[s] = s % 3 == 0 ? swept(a, way) : s % 3 == 1 ? swept_infinite(a, way) : shadow({light, light}, a);
    } else if (s % 3 != 0 || s % 4 == 0) {
      const Plane plane{{1, 2, 3}, 4};
      shafts[s] = compile(a, b, std::span(&plane, s % 4 == 0 ? 1 : 0));
      complete(shafts[s]);
    } else {
      compile_batch(BoxStream(std::span(&a, 1)).view(), BoxStream(std::span(&b, 1)).view(), std::span(&shafts[s], 1));
    }
    if (s % 5 == 2) set_contact(shafts[s], Contact::open);
  }
  return shafts;
}

}  // namespace shaftcull
