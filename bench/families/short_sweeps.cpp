// SPDX-License-Identifier: MIT
/// tree/equal_short/…: short sweeps among boxes of one size, which suit a uniform grid best: a tree against one.
///
/// 100,000 boxes of 0.5 m, uniform in a cube of 31 m, and boxes of their size that travel up to 3 m in any direction
/// and meet 14 of them. tree/equal_short/tree forms a shaft of both ends and asks the tree; /grid asks a grid whose
/// cells are as large as serves it best; /words forms the shaft too, and tests as many words of 64 boxes as a walk to
/// these hits must, in one call and always the same ones: no tree of such words can do better.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "harness/suite.hpp"
#include "peers/uniform_grid.hpp"
#include "scenes/random.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/tree.hpp"

namespace shaftcull::bench {
namespace {

constexpr std::size_t boxes = 100000;
constexpr std::size_t sweeps = 4096;
constexpr std::size_t most_found = 1024;  // by any sweep
constexpr float half_world = 15.5F;
constexpr float half_box = 0.25F;
constexpr float longest = 3.0F;

Box cube(const Vec3& centre) {
  Box box{};
  for (std::size_t k = 0; k < 3; ++k) {
    box.lo[k] = centre[k] - half_box;
    box.hi[k] = centre[k] + half_box;
  }
  return box;
}

Vec3 somewhere(Random& random, float half) {
  return {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
}

/// A point of the ball of radius `longest` around the origin.
Vec3 random_travel(Random& random) {
  for (;;) {
    const Vec3 by = somewhere(random, longest);
    if (by[0] * by[0] + by[1] * by[1] + by[2] * by[2] <= longest * longest) return by;
  }
}

struct Scene {
  std::vector<Box> bounds;
  std::vector<Box> from;
  std::vector<Box> to;
  BoxTree tree;
  std::vector<std::size_t> words;  ///< of 64 leaves or nodes that each sweep's walk must test

  Scene() {
    Random random(4100);
    for (std::size_t i = 0; i < boxes; ++i) bounds.push_back(cube(somewhere(random, half_world)));
    for (std::size_t s = 0; s < sweeps; ++s) {
      const Vec3 start = somewhere(random, half_world);
      const Vec3 by = random_travel(random);
      from.push_back(cube(start));
      to.push_back(cube({start[0] + by[0], start[1] + by[1], start[2] + by[2]}));
    }
    tree = BoxTree(std::span<const Box>(bounds));
    count_words();
  }

 private:
  /// As many as the tree has at its top, and one for each node that is not outside.
  void count_words() {
    constexpr std::size_t fanout = 64;
    std::vector<Box> level;
    for (const std::uint32_t i : tree.order()) level.push_back(bounds[i]);
    words.assign(sweeps, 0);
    while (level.size() > 2 * fanout) {
      std::vector<Box> nodes;
      for (std::size_t i = 0; i < level.size(); ++i) {
        if (i % fanout == 0) nodes.push_back(level[i]);
        for (std::size_t k = 0; k < 3; ++k) {
          nodes.back().lo[k] = std::min(nodes.back().lo[k], level[i].lo[k]);
          nodes.back().hi[k] = std::max(nodes.back().hi[k], level[i].hi[k]);
        }
      }
      level = std::move(nodes);
      const BoxStream stream(level);
      std::vector<std::uint64_t> kept(bit_words(level.size()));
      for (std::size_t s = 0; s < sweeps; ++s) {
        cull(compile(from[s], to[s]), stream, kept);
        words[s] += BitView(kept).count();
      }
    }
    for (std::size_t& of_sweep : words) of_sweep += bit_words(level.size());
  }
};

/// Runs `sweep(s, found)`, which returns how many indices it wrote, for all sweeps, and sums up.
template <class Sweep>
std::size_t run_all(const Sweep& sweep) {
  std::array<std::uint32_t, most_found + UniformGrid::most_written_more> found;
  std::size_t sum = 0;
  for (std::size_t s = 0; s < sweeps; ++s) {
    sum += sweep(s, found.data());
    benchmark::DoNotOptimize(found);
  }
  return sum;
}

std::size_t by_tree(const Scene& scene, std::size_t s, std::uint32_t* found) {
  return list(compile(scene.from[s], scene.to[s]), scene.tree, std::span(found, most_found));
}

/// The grid that takes the least time for these sweeps on `isa`.
UniformGrid best_grid(const Scene& scene, SweepGrid* sweep) {
  std::optional<UniformGrid> best;
  auto least = std::chrono::steady_clock::duration::max();
  for (const float cell : {0.5F, 0.6F, 0.75F, 1.0F, 1.25F, 1.5F, 2.0F, 2.5F}) {
    UniformGrid grid(scene.bounds, cell);
    auto taken = std::chrono::steady_clock::duration::max();
    for (int times = 0; times < 5; ++times) {
      const auto start = std::chrono::steady_clock::now();
      run_all([&](std::size_t s, std::uint32_t* found) { return sweep(grid, scene.from[s], scene.to[s], found); });
      taken = std::min(taken, std::chrono::steady_clock::now() - start);
    }
    if (taken >= least) continue;
    least = taken;
    best = std::move(grid);
  }
  return *best;
}

/// Throws unless the grid finds as many boxes as the tree, but for some that roundings decide about.
void require_same_hits(const Scene& scene, const UniformGrid& grid, SweepGrid* sweep) {
  const std::size_t by_trees = run_all([&](std::size_t s, std::uint32_t* found) { return by_tree(scene, s, found); });
  const std::size_t by_grids =
      run_all([&](std::size_t s, std::uint32_t* found) { return sweep(grid, scene.from[s], scene.to[s], found); });
  const std::size_t apart = by_trees < by_grids ? by_grids - by_trees : by_trees - by_grids;
  if (apart * 2000 > by_trees) {
    throw std::runtime_error(
        fmt::format("tree/equal_short: the grid finds {} boxes, the library {}", by_grids, by_trees));
  }
}

}  // namespace

void declare_short_sweeps(Suite& suite, const Workload& /*workload*/) {
  const auto shared = std::make_shared<std::unique_ptr<const Scene>>();
  const auto scene = [shared]() -> const Scene& {
    if (!*shared) *shared = std::make_unique<const Scene>();
    return **shared;
  };
  for (const Isa isa : {Isa::avx2, Isa::avx512}) {
    SweepGrid* const sweep = sweep_grid(isa);
    if (sweep == nullptr) continue;
    const auto add = [&](const char* what, auto body) {
      std::string row = fmt::format("tree/equal_short/{}/{}", what, name(isa));
      suite.add(row, "", [=](benchmark::State& state) {
        select_isa(isa);
        body(state);
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(sweeps));
      });
      return row;
    };
    const std::string tree = add("tree", [=](benchmark::State& state) {
      const Scene& of = scene();
      for (auto _ : state) {
        benchmark::DoNotOptimize(run_all([&](std::size_t s, std::uint32_t* found) { return by_tree(of, s, found); }));
      }
    });
    const std::string grid = add("grid", [=](benchmark::State& state) {
      const Scene& of = scene();
      const UniformGrid best = best_grid(of, sweep);
      require_same_hits(of, best, sweep);
      for (auto _ : state) {
        benchmark::DoNotOptimize(
            run_all([&](std::size_t s, std::uint32_t* found) { return sweep(best, of.from[s], of.to[s], found); }));
      }
      state.counters["cell"] = 1 / best.inverse_cell;
    });
    const std::string words = add("words", [=](benchmark::State& state) {
      const Scene& of = scene();
      const BoxView leaves = of.tree.leaves();
      std::array<std::uint64_t, most_found> kept;
      for (auto _ : state) {
        for (std::size_t s = 0; s < sweeps; ++s) {
          cull(compile(of.from[s], of.to[s]), leaves.slice(0, 64 * of.words[s]), std::span(kept).first(of.words[s]));
          benchmark::DoNotOptimize(kept);
        }
      }
    });
    suite.add_target(tree, grid, 1.2);
    suite.limit(tree, words, 1.0, "forming the shaft and testing the words of 64 that a walk must");
  }
}

}  // namespace shaftcull::bench
