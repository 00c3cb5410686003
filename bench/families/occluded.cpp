// SPDX-License-Identifier: MIT
/// occluded/…: which solid boxes block shafts, on one thread.
///
/// occluded/boxes lists those of the boxes of workload W that a shaft keeps, occluded/walls those of larger ones, of
/// which some block; an item is one of these boxes. They are few of those that test/boxes/cull/slab tests, which it is
/// compared with. occluded/tree asks a tree of walls about pairs of small patches, and occluded/any asks it whether the
/// shaft keeps any; an item is a shaft. occluded/polygon/boxes and /polygons ask shafts between two boxes and between
/// two triangles about a quadrilateral at any angle: an item is a call.
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "harness/suite.hpp"
#include "scenes/random.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/occluded.hpp"

namespace shaftcull::bench {
namespace {

constexpr std::size_t shafts = Workload::test_shafts;
constexpr std::size_t most_kept = 1024;  // of each shaft
constexpr std::size_t walls = 20000;
constexpr std::size_t pairs = 4096;
constexpr std::size_t polygons = 256;  // and as many shafts

/// Shafts, and boxes that each of them keeps.
struct Kept {
  std::vector<CompiledShaft> compiled;
  std::vector<BoxStream> boxes;
  std::int64_t count = 0;
};

/// Of `all` boxes, those that the first shafts of the workload keep.
std::unique_ptr<const Kept> kept_of(const Workload& workload, const BoxView& all) {
  auto kept = std::make_unique<Kept>();
  for (std::size_t s = 0; s != shafts; ++s) {
    kept->compiled.push_back(compile(workload.a[s], workload.b[s]));
    std::vector<std::uint32_t> indices;
    list(kept->compiled[s], all, indices, {.limit = most_kept});
    std::vector<Box> boxes;
    for (const std::uint32_t i : indices) boxes.push_back(all[i]);
    kept->count += static_cast<std::int64_t>(boxes.size());
    kept->boxes.emplace_back(std::span<const Box>(boxes));
  }
  return kept;
}

BoxStream large_boxes(std::size_t count, float smallest, float largest) {
  Random random(4100);
  std::vector<Box> boxes(count);
  for (Box& box : boxes) box = random.box(smallest, largest);
  return BoxStream(std::span<const Box>(boxes));
}

/// Pairs of small patches among walls: plates of any direction.
struct City {
  BoxTree tree;
  std::vector<CompiledShaft> compiled;
  std::vector<std::uint64_t> bits = std::vector<std::uint64_t>(bit_words(pairs));

  City() {
    Random random(4101);
    std::vector<Box> plates(walls);
    for (std::size_t i = 0; i != walls; ++i) {
      plates[i] = random.box(0.05F, 0.6F);
      const std::size_t axis = i % 3;
      plates[i].hi[axis] = plates[i].lo[axis] + 0.02F;
    }
    tree = BoxTree(std::span<const Box>(plates));
    for (std::size_t s = 0; s != pairs; ++s) {
      const Box from = random.box(0.01F, 0.05F);
      compiled.push_back(compile(from, random.box(0.01F, 0.05F)));
    }
  }
};

/// Walls at any angle, anywhere in the world, and shafts between two small ends.
struct Polygons {
  std::vector<CompiledShaft> between_boxes;
  std::vector<ConvexHull> between_triangles;
  std::vector<std::array<Vec3, 4>> walls;

  Polygons() {
    Random random(4102);
    const auto moved = [](const Vec3& from, const Vec3& by) {
      return Vec3{from[0] + by[0], from[1] + by[1], from[2] + by[2]};
    };
    const auto edge = [&](float longest) {
      return Vec3{random.uniform(-longest, longest), random.uniform(-longest, longest),
                  random.uniform(-longest, longest)};
    };
    for (std::size_t i = 0; i != polygons; ++i) {
      const Box a = random.box(0.3F, 0.5F);
      const Box b = random.box(0.3F, 0.5F);
      between_boxes.push_back(compile(a, b));
      const std::array<Vec3, 3> p{a.lo, moved(a.lo, edge(0.5F)), moved(a.lo, edge(0.5F))};
      const std::array<Vec3, 3> q{b.lo, moved(b.lo, edge(0.5F)), moved(b.lo, edge(0.5F))};
      between_triangles.push_back(between_polygons(p, q));
      const Vec3 corner = random.box(0.1F, 0.2F).lo;
      const Vec3 u = edge(3);
      const Vec3 v = edge(3);
      walls.push_back({corner, moved(corner, u), moved(moved(corner, u), v), moved(corner, v)});
    }
  }
};

template <class Shafts>
void ask_about_polygons(benchmark::State& state, const Shafts& of, const std::vector<std::array<Vec3, 4>>& all) {
  for (auto _ : state) {
    for (const CompiledShaft& shaft : of) {
      for (const std::array<Vec3, 4>& wall : all) benchmark::DoNotOptimize(occluded(shaft, std::span(wall)));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(polygons * polygons));
}

void declare_lists(Suite& suite, const std::string& name, Isa isa,
                   const std::shared_ptr<std::unique_ptr<const Kept>>& lazily,
                   const std::function<std::unique_ptr<const Kept>()>& make) {
  const std::string set(shaftcull::name(isa));
  suite.add(name + "/" + set, "", [=](benchmark::State& state) {
    select_isa(isa);
    if (!*lazily) *lazily = make();
    const Kept& kept = **lazily;
    std::vector<std::uint32_t> listed(most_kept);
    for (auto _ : state) {
      for (std::size_t s = 0; s != shafts; ++s) {
        benchmark::DoNotOptimize(list_occluders(kept.compiled[s], kept.boxes[s], listed));
      }
    }
    state.SetItemsProcessed(state.iterations() * kept.count);
  });
  suite.add_target(name + "/" + set, "test/boxes/cull/slab/" + set, 0.04);
}

}  // namespace

void declare_occluded(Suite& suite, const Workload& workload) {
  const auto of_workload = std::make_shared<std::unique_ptr<const Kept>>();
  const auto of_walls = std::make_shared<std::unique_ptr<const Kept>>();
  const auto city = std::make_shared<std::unique_ptr<City>>();
  const auto polygon_scene = std::make_shared<std::unique_ptr<const Polygons>>();
  for (const Isa isa : available_isas()) {
    if (isa != Isa::avx2 && isa != Isa::avx512) continue;
    declare_lists(suite, "occluded/boxes", isa, of_workload,
                  [&workload] { return kept_of(workload, workload.boxes.view()); });
    declare_lists(suite, "occluded/walls", isa, of_walls, [&workload] {
      const BoxStream large = large_boxes(4 * most_kept, 0.3F, 3.0F);
      return kept_of(workload, large.view());
    });
    const std::string set(name(isa));
    const auto ask_city = [=](const auto& ask) {
      return [=](benchmark::State& state) {
        select_isa(isa);
        if (!*city) *city = std::make_unique<City>();
        for (auto _ : state) {
          ask(**city);
          benchmark::ClobberMemory();
        }
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pairs));
      };
    };
    suite.add("occluded/tree/" + set, "",
              ask_city([](City& asked) { occluded_many(asked.compiled, asked.tree, asked.bits); }));
    suite.add("occluded/any/" + set, "",
              ask_city([](City& asked) { any_many(asked.compiled, asked.tree, asked.bits); }));
  }
  // Alike on all instruction sets.
  for (const bool are_boxes : {true, false}) {
    suite.add(are_boxes ? "occluded/polygon/boxes" : "occluded/polygon/polygons", "", [=](benchmark::State& state) {
      if (!*polygon_scene) *polygon_scene = std::make_unique<const Polygons>();
      const Polygons& scene = **polygon_scene;
      if (are_boxes) return ask_about_polygons(state, scene.between_boxes, scene.walls);
      ask_about_polygons(state, scene.between_triangles, scene.walls);
    });
  }
}

}  // namespace shaftcull::bench
