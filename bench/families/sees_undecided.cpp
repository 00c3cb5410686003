// SPDX-License-Identifier: MIT
/// sees/SCENE/undecided/TARGETS: 16 rays for each undecided pair, by visible_fractions() alone, against Embree. An item
/// is a pair.
#ifdef SHAFTCULL_BENCH_WITH_EMBREE

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "families/sees_scene.hpp"
#include "scenes/shadow_rays.hpp"
#include "shaftcull/rays.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::bench {
namespace {

constexpr unsigned rays = 16;

/// The undecided pairs of a product.
struct OpenPairs {
  PatchSet a;
  PatchSet b;
  Visibility found;
  std::vector<FacingPair> facing;  ///< the same pairs
};

struct Question {
  Occluders occluders;
  std::vector<OpenPairs> products;
  std::size_t pairs = 0;
};

Occluders triangles_of(const PatchScene& scene) {
  const TriangleStream stream(scene.triangles);
  const std::vector<std::size_t> first(scene.objects.begin(), scene.objects.end());
  Occluders occluders;
  occluders.add_triangles(stream.view(), first);
  return occluders;
}

void answer(const Question& question, std::vector<float>& fractions) {
  for (const OpenPairs& open : question.products) {
    fractions.resize(open.facing.size());
    visible_fractions(open.a, open.b, question.occluders,
                      {open.found.undecided, open.found.first_candidate, open.found.candidates}, fractions,
                      {.rays = rays});
    benchmark::DoNotOptimize(fractions.data());
  }
}

/// Ready for use: the first call prepares the occluders, as Embree's tree is prepared.
std::shared_ptr<Question> question_of(SeesScene& sees, RayTargets targets) {
  const PatchScene& scene = sees.scene();
  auto question = std::make_shared<Question>();
  question->occluders = targets == RayTargets::triangles ? triangles_of(scene) : sees.occluders();
  for (const Product& product : sees.products(false)) {
    OpenPairs open{polygons_of(scene, product.patches.a), polygons_of(scene, product.patches.b), {}, {}};
    open.found = collect_visibility(open.a, open.b, question->occluders);
    for (const PatchPair& pair : open.found.undecided) {
      open.facing.push_back({product.patches.a[pair.a], product.patches.b[pair.b]});
    }
    question->pairs += open.facing.size();
    if (!open.facing.empty()) question->products.push_back(std::move(open));
  }
  std::vector<float> fractions;
  answer(*question, fractions);
  return question;
}

}  // namespace

void declare_undecided(Suite& suite, const std::shared_ptr<SeesScene>& sees, RayTargets targets, double target) {
  const RunOptions options{.brief = !suite.quick(), .once = suite.quick()};
  const std::string row =
      fmt::format("sees/{}/undecided/{}", sees->name, targets == RayTargets::triangles ? "triangles" : "solids");
  const auto question = std::make_shared<Lazy<std::shared_ptr<Question>>>();
  const auto asked = [=]() -> const Question& { return *question->get([&] { return question_of(*sees, targets); }); };
  suite.add(
      row, "",
      [=](benchmark::State& state) {
        select_isa(measured_isa());
        const Question& all = asked();
        std::vector<float> fractions;
        for (auto _ : state) answer(all, fractions);
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.pairs));
      },
      options);
  suite.add(
      row + "/embree", "",
      [=](benchmark::State& state) {
        const Question& all = asked();
        const EmbreeScene& embree = sees->embree();
        const ShadowRays shadow_rays(rays);
        std::vector<RayCounts> counts;
        for (auto _ : state) {
          for (const OpenPairs& open : all.products) {
            counts.resize(open.facing.size());
            for (std::size_t i = 0; i != counts.size(); ++i) counts[i] = embree.trace(open.facing[i], shadow_rays);
            benchmark::DoNotOptimize(counts.data());
          }
        }
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.pairs));
      },
      options);
  suite.add_target(row, row + "/embree", target);
}

}  // namespace shaftcull::bench

#endif
