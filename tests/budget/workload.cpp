// SPDX-License-Identifier: MIT
/// A fixed workload, whose instructions `valgrind --tool=callgrind` counts: what check.cmake compares with the budget.
///
/// Prints a line "path items" for each path in the order in which it runs them, and makes callgrind dump the cost of
/// each. Without valgrind it does the same work, and nothing is counted.
#include <valgrind/callgrind.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <vector>

#include "many/workload.hpp"
#include "oracle/random.hpp"
#include "shaftcull/paper.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {
namespace {

constexpr std::size_t shafts = 64;
constexpr std::size_t bounds = 4096;
constexpr std::size_t small_bounds = 64;
constexpr std::size_t between_tiles = 2100;
constexpr std::size_t pairs = 4096;
constexpr std::size_t leaves = 100000;  // so many that walks fetch

/// Counts the instructions of work(), which handles `items` of something.
template <class Work>
void count(const char* path, std::size_t items, const Work& work) {
  work();  // dynamic linking and first pages of memory are not ours
  std::printf("%s %zu\n", path, items);
  CALLGRIND_ZERO_STATS;
  CALLGRIND_TOGGLE_COLLECT;
  work();
  CALLGRIND_TOGGLE_COLLECT;
  CALLGRIND_DUMP_STATS_AT(path);
}

/// As the benchmarks' workload W: about one bound in fifty is kept.
std::vector<Box> drawn_boxes(std::uint64_t seed, std::size_t size, float small, float large) {
  Random random(seed);
  std::vector<Box> boxes;
  for (std::size_t i = 0; i != size; ++i) boxes.push_back(random.box(-5, 5, small, large));
  return boxes;
}

void run() {
  const BoxStream boxes{std::span<const Box>(drawn_boxes(1, bounds, 0.01F, 0.11F))};
  const SphereStream spheres{std::span<const Sphere>(random_spheres(2, bounds))};
  const std::vector<Box> a = drawn_boxes(3, pairs, 0.2F, 1.0F);
  const std::vector<Box> b = drawn_boxes(4, pairs, 0.2F, 1.0F);
  const BoxStream a_stream{std::span<const Box>(a)};
  const BoxStream b_stream{std::span<const Box>(b)};
  std::vector<CompiledShaft> compiled;
  for (std::size_t s = 0; s != shafts; ++s) {
    compiled.push_back(compile(a[s], b[s]));
    complete(compiled.back());
  }
  std::vector<std::uint64_t> kept(bit_words(bounds));
  std::vector<std::uint64_t> inside(bit_words(bounds));
  std::vector<std::uint64_t> counts(shafts);
  IndexLists lists;

  const auto each_shaft = [&](const auto& test) {
    for (const CompiledShaft& shaft : compiled) test(shaft);
  };
  constexpr std::size_t tests = shafts * bounds;
  count("boxes_cull_slab", tests,
        [&] { each_shaft([&](const CompiledShaft& shaft) { cull(shaft, boxes.view(), kept); }); });
  set_form(compiled, Form::planes);
  count("boxes_cull_planes", tests,
        [&] { each_shaft([&](const CompiledShaft& shaft) { cull(shaft, boxes.view(), kept); }); });
  set_form(compiled, Form::slab);
  count("boxes_classify_slab", tests,
        [&] { each_shaft([&](const CompiledShaft& shaft) { classify(shaft, boxes.view(), kept, inside); }); });
  count("spheres_cull_slab", tests,
        [&] { each_shaft([&](const CompiledShaft& shaft) { cull(shaft, spheres.view(), kept); }); });
  count("spheres_classify_slab", tests,
        [&] { each_shaft([&](const CompiledShaft& shaft) { classify(shaft, spheres.view(), kept, inside); }); });
  count("boxes_cull_64", shafts * small_bounds, [&] {
    each_shaft([&](const CompiledShaft& shaft) {
      cull(shaft, boxes.view().slice(0, small_bounds), std::span(kept).first(bit_words(small_bounds)));
    });
  });
  count("boxes_cull_63", shafts, [&] {
    each_shaft([&](const CompiledShaft& shaft) { cull(shaft, boxes.view().slice(0, 63), std::span(kept).first(1)); });
  });
  count("boxes_classify_1", shafts, [&] {
    each_shaft([&](const CompiledShaft& shaft) {
      classify(shaft, boxes.view().slice(0, 1), std::span(kept).first(1), std::span(inside).first(1));
    });
  });
  const Box world{{-6, -6, -6}, {6, 6, 6}};
  std::vector<Plane> view;
  for (const float side : {-1.0F, 1.0F}) {
    for (std::size_t k = 0; k != 3; ++k) {
      Plane plane{{0.5F, 0.5F, 0.5F}, 3};
      plane.normal[k] = 2 * side;
      view.push_back(plane);
    }
  }
  const CompiledShaft camera = compile(world, world, view);
  count("boxes_cull_added", bounds, [&] { cull(camera, boxes.view(), kept); });
  with_threads(1, [&] {
    count("boxes_count_between_tiles", shafts * between_tiles,
          [&] { count_many(compiled, boxes.view().slice(0, between_tiles), counts); });
    count("spheres_count_between_tiles", shafts * between_tiles,
          [&] { count_many(compiled, spheres.view().slice(0, between_tiles), counts); });
    count("boxes_count", tests, [&] { count_many(compiled, boxes.view(), counts); });
    count("spheres_count", tests, [&] { count_many(compiled, spheres.view(), counts); });
    count("boxes_list", tests, [&] { list_many(compiled, boxes.view(), lists); });
  });
  const std::vector<Box> records = drawn_boxes(5, leaves, 0.01F, 0.04F);
  with_threads(1, [&] {
    BoxTree tree;
    count("tree_build", leaves, [&] { tree = BoxTree(std::span<const Box>(records)); });
    count("tree_update", leaves, [&] { tree.update(std::span<const Box>(records)); });
    count("tree_count", shafts, [&] { count_many(compiled, tree, counts); });
    count("tree_list", shafts, [&] { list_many(compiled, tree, lists); });
  });

  std::vector<Triangle> corners;
  for (std::size_t i = 0; i != bounds; ++i) {
    const Box box = boxes[i];
    corners.push_back({{box.lo, Vec3{box.hi[0], box.hi[1], box.lo[2]}, Vec3{box.lo[0], box.hi[1], box.hi[2]}}});
  }
  const TriangleStream triangles(corners);
  for (const TriangleTest test : {TriangleTest::vertices, TriangleTest::exact}) {
    count(test == TriangleTest::exact ? "triangles_exact" : "triangles_vertices", tests, [&] {
      each_shaft([&](const CompiledShaft& shaft) { cull(shaft, triangles.view(), kept, {.triangle_test = test}); });
    });
  }

  BoxStream packed(leaves);
  SphereStream packed_spheres(leaves);
  std::vector<Sphere> sphere_records;
  std::vector<std::array<float, 6>> extents;
  for (const Box& box : records) {
    sphere_records.push_back({box.lo, 0.02F});
    extents.push_back({box.lo[0], box.lo[1], box.lo[2], 0.01F, 0.02F, 0.03F});
  }
  count("pack_boxes", leaves, [&] { packed.update(0, std::span<const Box>(records)); });
  count("pack_spheres", leaves, [&] { packed_spheres.update(0, std::span<const Sphere>(sphere_records)); });
  count("pack_centre_extents", leaves, [&] {
    packed.update(0, StridedCentreExtents{extents[0].data(), extents[0].data() + 3, sizeof extents[0], leaves});
  });
  std::vector<CompiledShaft> formed(pairs);
  count("form_batch", pairs, [&] { compile_batch(a_stream.view(), b_stream.view(), formed); });
  count("form_each", shafts, [&] {
    for (std::size_t s = 0; s != shafts; ++s) compiled[s] = compile(Shaft(a[s], b[s]));
  });
}

}  // namespace
}  // namespace shaftcull

int main() {
  const char* const wanted = std::getenv("SHAFTCULL_ISA");
  const auto isa = shaftcull::isa_from_name(wanted == nullptr ? "" : wanted);
  if (isa) {
    const std::vector<shaftcull::Isa> available = shaftcull::available_isas();
    if (std::find(available.begin(), available.end(), *isa) == available.end()) {
      std::printf("Skipped: there is no %s here.\n", wanted);
      return 0;
    }
  }
  shaftcull::run();
  return 0;
}
