// SPDX-License-Identifier: MIT
/// layers/… and tree/{any,at_most,first,first_of_spheres}/…: queries of a bounds tree that want a part of what it would
/// list.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "harness/suite.hpp"
#include "scenes/swept_boxes.hpp"
#include "scenes/tree_scene.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/isa.hpp"

namespace shaftcull::bench {
namespace {

constexpr std::size_t queries = 1024;

/// The scene of tree/…, with layers: all boxes are in one of the first sixteen, all but one in layer 20, and every
/// other one in layer 24.
struct LayeredScene : TreeScene {
  using TreeScene::TreeScene;
  const BoxTree& layered() {
    return layered_.get([&] {
      std::vector<std::uint32_t> layers(count);
      for (std::size_t i = 0; i != count; ++i) layers[i] = 1U << i % 16 | 1U << 20U | (i % 2 == 0 ? 1U << 24U : 0);
      layers[count / 2] = 1U << 3U;
      BoxTree with_layers(tree());
      with_layers.set_layers(layers);
      return with_layers;
    });
  }

 private:
  Lazy<BoxTree> layered_;
};

struct Swept {
  std::vector<CompiledShaft> shafts = std::vector<CompiledShaft>(queries);
  std::vector<std::uint32_t> hits;

  Swept(const SweptSetting& setting, std::size_t bounds) : hits(bounds) {
    const SweptBoxes boxes(queries, setting);
    compile_batch(boxes.from.view(), boxes.to.view(), shafts);
  }
};

/// Adds a row that calls ask(shaft, swept) for each of some shafts.
template <class Ask>
void add_row(Suite& suite, const std::string& row, Isa isa, const SweptSetting& setting, std::size_t bounds,
             const Ask& ask) {
  suite.add(fmt::format("{}/{}", row, name(isa)), "",
            [=](benchmark::State& state) {
              select_isa(isa);
              Swept swept(setting, bounds);
              for (auto _ : state) {
                for (const CompiledShaft& shaft : swept.shafts) ask(shaft, swept);
              }
              state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(queries));
            },
            {.brief = true});
}

void declare_setting(Suite& suite, const std::shared_ptr<LayeredScene>& scene, const SweptSetting& setting, Isa isa) {
  const auto add = [&](const std::string& row, const auto& ask) {
    add_row(suite, row, isa, setting, scene->count, ask);
  };
  const auto row = [&](const char* what) { return fmt::format("tree/{}/{}", what, setting.name); };
  const auto named = [&](const std::string& of) { return fmt::format("{}/{}", of, name(isa)); };
  const bool finds_thousands = setting.half > 0.1F;

  add(row("list"), [=](const CompiledShaft& shaft, Swept& swept) {
    benchmark::DoNotOptimize(list(shaft, scene->tree(), std::span(swept.hits)));
  });
  add(row("count"), [=](const CompiledShaft& shaft, Swept&) { benchmark::DoNotOptimize(count(shaft, scene->tree())); });
  add(row("any"), [=](const CompiledShaft& shaft, Swept&) { benchmark::DoNotOptimize(any(shaft, scene->tree())); });
  add(row("at_most_10"), [=](const CompiledShaft& shaft, Swept&) {
    benchmark::DoNotOptimize(count(shaft, scene->tree(), {.limit = 10}));
  });
  add(row("first"),
      [=](const CompiledShaft& shaft, Swept&) { benchmark::DoNotOptimize(first_contact(shaft, scene->tree()).index); });
  add(row("list_of_spheres"), [=](const CompiledShaft& shaft, Swept& swept) {
    benchmark::DoNotOptimize(list(shaft, scene->sphere_tree(), std::span(swept.hits)));
  });
  add(row("first_of_spheres"), [=](const CompiledShaft& shaft, Swept&) {
    benchmark::DoNotOptimize(first_contact(shaft, scene->sphere_tree()).index);
  });
  if (finds_thousands) suite.add_time_ratio_target(named(row("any")), named(row("count")), 0.5);
  suite.add_time_ratio_target(named(row("first")), named(row("list")), finds_thousands ? 0.3 : 1.2);

  const auto add_layers = [&](const char* what, std::uint32_t mask) {
    add(fmt::format("layers/{}/{}", setting.name, what), [=](const CompiledShaft& shaft, Swept& swept) {
      benchmark::DoNotOptimize(list(shaft, scene->layered(), std::span(swept.hits), {.layer_mask = {mask}}));
    });
  };
  add(fmt::format("layers/{}/none", setting.name), [=](const CompiledShaft& shaft, Swept& swept) {
    benchmark::DoNotOptimize(list(shaft, scene->layered(), std::span(swept.hits)));
  });
  add_layers("all", ~0U);
  add_layers("all_but_one", 1U << 20U);
  add_layers("half", 1U << 24U);
  const std::string none = named(fmt::format("layers/{}/none", setting.name));
  suite.add_target(named(fmt::format("layers/{}/all", setting.name)), none, 0.95);
}

}  // namespace

void declare_picking(Suite& suite, const Workload& /*workload*/) {
  const auto scene = std::make_shared<LayeredScene>(suite.quick() ? std::size_t{1} << 17U : 1000000);
  for (const SweptSetting& setting : swept_settings) {
    for (const Isa isa : available_isas()) {
      if (isa == Isa::avx2 || isa == Isa::avx512) declare_setting(suite, scene, setting, isa);
    }
  }
}

}  // namespace shaftcull::bench
