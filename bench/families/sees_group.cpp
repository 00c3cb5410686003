// SPDX-License-Identifier: MIT
/// sees/group/TRIANGLES/EDGE: 16 rays for each of some pairs of patches, through one group of triangles, by
/// visible_fractions() against Embree. An item is a pair.
///
/// The triangles are a wavy sheet with holes between two planes. Patches are squares in these planes, wherever in them;
/// their edges are a tenth or a fiftieth as long as the planes are apart.
#ifdef SHAFTCULL_BENCH_WITH_EMBREE

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "families/sees_scene.hpp"
#include "scenes/random.hpp"
#include "scenes/shadow_rays.hpp"
#include "shaftcull/rays.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::bench {
namespace {

constexpr unsigned rays = 16;
constexpr std::uint32_t pairs = 4096;
constexpr float width = 10;  // of sheet and planes, and how far apart the planes are

/// A quarter of about `triangles` is left out.
std::vector<Triangle> sheet(std::uint32_t triangles) {
  const auto side = static_cast<unsigned>(std::sqrt(static_cast<double>(triangles) / 1.5));
  const float step = width / static_cast<float>(side);
  const auto at = [&](unsigned i, unsigned j) {
    const float x = static_cast<float>(i) * step;
    const float y = static_cast<float>(j) * step;
    const auto wave = [](float u) {  // 0 at each even number, 1 at each odd one
      const float v = u - 2 * std::floor(u / 2);
      return v * (2 - v);
    };
    return Vec3{x, y, width / 2 + 0.8F * wave(0.6F * x) * wave(0.5F * y)};
  };
  Random random(4311);
  std::vector<Triangle> mesh;
  for (unsigned i = 0; i != side; ++i) {
    for (unsigned j = 0; j != side; ++j) {
      if (random.below(4) == 0) continue;
      mesh.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
      mesh.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    }
  }
  return mesh;
}

/// Patch i of the lower plane is asked about patch i of the upper one, which is patch `pairs` + i of the scene.
PatchScene scene_of(std::uint32_t triangles, float edge) {
  PatchScene scene;
  scene.triangles = sheet(triangles);
  scene.objects.push_back(static_cast<std::uint32_t>(scene.triangles.size()));
  Random random(4312);
  for (const bool is_upper : {false, true}) {
    for (std::uint32_t i = 0; i != pairs; ++i) {
      const Vec3 corner{random.uniform(0, width - edge), random.uniform(0, width - edge), is_upper ? width : 0};
      scene.patches.push_back({corner, {edge, 0, 0}, {0, edge, 0}, false});
      scene.patch_boxes.push_back({corner, {corner[0] + edge, corner[1] + edge, corner[2]}});
      scene.patch_planes.push_back(is_upper ? Plane{{0, 0, -1}, -width} : Plane{{0, 0, 1}, 0});
      scene.zone.push_back(0);
    }
  }
  return scene;
}

struct GroupQuestion {
  PatchScene scene;
  PatchSet lower;
  PatchSet upper;
  Occluders occluders;
  std::vector<PatchPair> open;
  std::vector<std::size_t> first_candidate = std::vector<std::size_t>(pairs + 1);
  std::vector<std::uint32_t> candidates = std::vector<std::uint32_t>(pairs, 0);
  EmbreeScene embree;

  GroupQuestion(std::uint32_t triangles, float edge) : scene(scene_of(triangles, edge)), embree(scene) {
    std::vector<std::uint32_t> numbers(2 * std::size_t{pairs});
    std::iota(numbers.begin(), numbers.end(), 0U);
    lower = polygons_of(scene, std::span(numbers).first(pairs));
    upper = polygons_of(scene, std::span(numbers).last(pairs));
    const std::vector<std::size_t> group{0, scene.triangles.size()};
    occluders.add_triangles(TriangleStream(scene.triangles).view(), group);
    for (std::uint32_t i = 0; i != pairs; ++i) open.push_back({i, i});
    std::iota(first_candidate.begin(), first_candidate.end(), std::size_t{0});
    std::vector<float> fractions;
    answer(fractions);  // prepares the group, as Embree's tree is prepared
  }

  void answer(std::vector<float>& fractions) const {
    fractions.resize(pairs);
    visible_fractions(lower, upper, occluders, {open, first_candidate, candidates}, fractions, {.rays = rays});
  }
};

/// Less than chance has it, between sums over many pairs.
bool are_alike(double ours, double embree) { return std::abs(ours - embree) < 0.01 * pairs; }

}  // namespace

void declare_groups(Suite& suite) {
  for (const std::uint32_t triangles : {100U, 1'000U, 10'000U, 100'000U, 1'000'000U}) {
    if (suite.quick() && triangles > 100'000) continue;
    for (const auto& [edge, part] : {std::pair{width / 10, "tenth"}, {width / 50, "fiftieth"}}) {
      const std::string row = fmt::format("sees/group/{}/{}", triangles, part);
      const auto question = std::make_shared<Lazy<std::unique_ptr<GroupQuestion>>>();
      const auto asked = [=, edge = edge]() -> const GroupQuestion& {
        return *question->get([&] { return std::make_unique<GroupQuestion>(triangles, edge); });
      };
      const auto sum_by_embree = [=] {
        const GroupQuestion& all = asked();
        const ShadowRays shadow_rays(rays);
        double sum = 0;
        for (std::uint32_t i = 0; i != pairs; ++i) {
          const RayCounts counts = all.embree.trace({i, pairs + i}, shadow_rays);
          sum += counts.traced == 0 ? 0 : static_cast<double>(counts.clear) / counts.traced;
        }
        return sum;
      };
      suite.add(row, "", [=](benchmark::State& state) {
        select_isa(measured_isa());
        const GroupQuestion& all = asked();
        std::vector<float> fractions;
        all.answer(fractions);
        const double ours = std::accumulate(fractions.begin(), fractions.end(), 0.0);
        if (const double embree = sum_by_embree(); !are_alike(ours, embree)) {
          state.SkipWithError(
              fmt::format("the visible parts are {:.1f} in all, by Embree {:.1f}", ours, embree).c_str());
          return;
        }
        for (auto _ : state) {
          all.answer(fractions);
          benchmark::DoNotOptimize(fractions.data());
        }
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pairs));
      });
      suite.add(row + "/embree", "", [=](benchmark::State& state) {
        for (auto _ : state) benchmark::DoNotOptimize(sum_by_embree());
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(pairs));
      });
      suite.add_target(row, row + "/embree", 0.8);
    }
  }
}

}  // namespace shaftcull::bench

#endif
