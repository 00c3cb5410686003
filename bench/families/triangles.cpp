// SPDX-License-Identifier: MIT
/// triangles/…: triangles that shafts are asked about once the boxes around them are kept, on one thread; and meshes.
///
/// The triangles of triangles/vertices and triangles/exact span boxes of workload W that a shaft keeps, two corners and
/// a third vertex in the box. An item is one of them: they are few of those that test/boxes/cull/slab tests, which both
/// are compared with. Shafts of triangles/vertices have two planes added, as those of patches have.
///
/// triangles/mesh/… asks a mesh how many of its triangles each shaft keeps; an item is a shaft. `chunks` asks a tree of
/// triangles, exactly, `boxes` a tree of the boxes around single ones.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "harness/suite.hpp"
#include "scenes/random.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::bench {
namespace {

constexpr std::size_t shafts = Workload::test_shafts;
constexpr std::size_t most_kept = 1024;  // of each shaft
constexpr std::size_t mesh_side = 512;   // quads
constexpr std::size_t mesh_shafts = 1024;

/// Shafts, and triangles in boxes that each of them keeps.
struct Survivors {
  std::vector<CompiledShaft> plain;
  std::vector<CompiledShaft> with_planes;
  std::vector<TriangleStream> triangles;
  std::int64_t count = 0;
};

std::unique_ptr<const Survivors> survivors_of(const Workload& workload) {
  auto survivors = std::make_unique<Survivors>();
  Random random(4200);
  for (std::size_t s = 0; s != shafts; ++s) {
    const Box& a = workload.a[s];
    const Box& b = workload.b[s];
    survivors->plain.push_back(compile(a, b));
    std::array<Plane, 2> planes{};
    auto& [from_a, from_b] = planes;
    for (std::size_t k = 0; k != 3; ++k) {
      from_a.normal[k] = a.lo[k] + a.hi[k] - b.lo[k] - b.hi[k];
      from_b.normal[k] = -from_a.normal[k];
      from_a.offset += from_a.normal[k] * 0.5F * (a.lo[k] + a.hi[k]);
      from_b.offset += from_b.normal[k] * 0.5F * (b.lo[k] + b.hi[k]);
    }
    survivors->with_planes.push_back(compile(a, b, planes));
    std::vector<std::uint32_t> indices;
    list(survivors->plain[s], workload.boxes, indices, {.limit = most_kept});
    std::vector<Triangle> triangles;
    for (const std::uint32_t i : indices) {
      const Box box = workload.boxes[i];
      Triangle triangle{};
      for (std::size_t k = 0; k != 3; ++k) {
        const bool upwards = random.below(2) == 0;
        triangle.vertex[0][k] = upwards ? box.lo[k] : box.hi[k];
        triangle.vertex[1][k] = upwards ? box.hi[k] : box.lo[k];
        triangle.vertex[2][k] = random.uniform(box.lo[k], box.hi[k]);
      }
      triangles.push_back(triangle);
    }
    survivors->count += static_cast<std::int64_t>(triangles.size());
    survivors->triangles.emplace_back(std::span<const Triangle>(triangles));
  }
  return survivors;
}

/// A hilly surface, and thin shafts above it that now and then pass it.
struct Mesh {
  TriangleTree chunks;
  BoxTree boxes;
  std::vector<CompiledShaft> compiled;
  std::vector<std::uint64_t> counts = std::vector<std::uint64_t>(mesh_shafts);

  Mesh() {
    std::vector<Vec3> vertices;
    for (std::size_t i = 0; i <= mesh_side; ++i) {
      for (std::size_t j = 0; j <= mesh_side; ++j) {
        const float x = 10 * static_cast<float>(i) / mesh_side - 5;
        const float y = 10 * static_cast<float>(j) / mesh_side - 5;
        vertices.push_back({x, y, 0.5F * std::sin(2 * x) * std::cos(3 * y)});
      }
    }
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i != mesh_side; ++i) {
      for (std::uint32_t j = 0; j != mesh_side; ++j) {
        const auto corner = static_cast<std::uint32_t>(i * (mesh_side + 1) + j);
        const auto next = static_cast<std::uint32_t>(corner + mesh_side + 1);
        indices.insert(indices.end(), {corner, next, corner + 1, next, next + 1, corner + 1});
      }
    }
    const TriangleStream triangles(mesh_view(vertices, indices));
    chunks = TriangleTree(triangles.view());
    std::vector<Box> around;
    for (std::size_t i = 0; i != triangles.size(); ++i) {
      const Triangle triangle = triangles[i];
      Box box{triangle.vertex[0], triangle.vertex[0]};
      for (const Vec3& vertex : triangle.vertex) {
        for (std::size_t k = 0; k != 3; ++k) {
          box.lo[k] = std::min(box.lo[k], vertex[k]);
          box.hi[k] = std::max(box.hi[k], vertex[k]);
        }
      }
      around.push_back(box);
    }
    boxes = BoxTree(std::span<const Box>(around));
    Random random(4201);
    for (std::size_t s = 0; s != mesh_shafts; ++s) {
      const auto end = [&] {
        Box box = random.box(0.01F, 0.05F);
        const float rise = random.uniform(-0.4F, 0.8F) - box.lo[2];
        box.lo[2] += rise;
        box.hi[2] += rise;
        return box;
      };
      const Box a = end();
      compiled.push_back(compile(a, end()));
    }
  }
};

}  // namespace

void declare_triangles(Suite& suite, const Workload& workload) {
  const auto survivors = std::make_shared<std::unique_ptr<const Survivors>>();
  const auto mesh = std::make_shared<std::unique_ptr<Mesh>>();
  for (const Isa isa : available_isas()) {
    if (isa != Isa::avx2 && isa != Isa::avx512) continue;
    const std::string set(name(isa));
    const auto declare = [&](TriangleTest test, const std::string& row, double ratio) {
      suite.add(row + "/" + set, "", [=, &workload](benchmark::State& state) {
        select_isa(isa);
        if (!*survivors) *survivors = survivors_of(workload);
        const Survivors& all = **survivors;
        const auto& compiled = test == TriangleTest::vertices ? all.with_planes : all.plain;
        std::vector<std::uint64_t> kept(bit_words(most_kept));
        for (auto _ : state) {
          for (std::size_t s = 0; s != shafts; ++s) {
            cull(compiled[s], all.triangles[s], std::span(kept).first(bit_words(all.triangles[s].size())),
                 {.triangle_test = test});
          }
          benchmark::ClobberMemory();
        }
        state.SetItemsProcessed(state.iterations() * all.count);
      });
      suite.add_target(row + "/" + set, "test/boxes/cull/slab/" + set, ratio);
    };
    declare(TriangleTest::vertices, "triangles/vertices", 0.10);
    declare(TriangleTest::exact, "triangles/exact", 0.02);
    const auto ask_mesh = [=](const auto& ask) {
      return [=](benchmark::State& state) {
        select_isa(isa);
        if (!*mesh) *mesh = std::make_unique<Mesh>();
        for (auto _ : state) {
          ask(**mesh);
          benchmark::ClobberMemory();
        }
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh_shafts));
      };
    };
    suite.add("triangles/mesh/chunks/" + set, "",
              ask_mesh([](Mesh& asked) { count_many(asked.compiled, asked.chunks, asked.counts); }));
    suite.add("triangles/mesh/boxes/" + set, "",
              ask_mesh([](Mesh& asked) { count_many(asked.compiled, asked.boxes, asked.counts); }));
  }
}

}  // namespace shaftcull::bench
