// SPDX-License-Identifier: MIT
/// flat_against_tree/…: flat scans and trees over scenes of several sizes, with shafts that find next to nothing to
/// all; and what it takes when bounds move. The README's answer to "flat or tree?" is of these.
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "harness/suite.hpp"
#include "scenes/swept_boxes.hpp"
#include "scenes/tree_scene.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull::bench {
namespace {

constexpr std::size_t shafts_at_once = 64;

/// What a shaft of each finds of a million, the last one always all.
constexpr std::array finds{SweptSetting{"0.01%", 0.05F, 5.0F}, SweptSetting{"0.6%", 0.5F, 5.0F},
                           SweptSetting{"2.4%", 1.0F, 5.0F}, SweptSetting{"10%", 2.0F, 5.0F},
                           SweptSetting{"all", 10.0F, 0.0F}};

/// Lists what 64 shafts find of bounds, a view or a tree.
void list(benchmark::State& state, const Bounds& bounds, const SweptBoxes& swept) {
  select_isa(available_isas().back());
  std::vector<CompiledShaft> shafts(shafts_at_once);
  compile_batch(swept.from.view(), swept.to.view(), shafts);
  IndexLists lists;
  list_many(shafts, bounds, lists);  // the first pages of memory are not what is compared
  for (auto _ : state) {
    list_many(shafts, bounds, lists);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(shafts_at_once));
  state.counters["found"] =
      static_cast<double>(lists.indices.size()) / static_cast<double>(shafts_at_once * bounds.size());
}

void declare_finds(Suite& suite, std::size_t count) {
  const auto scene = std::make_shared<TreeScene>(count);
  for (const SweptSetting& setting : finds) {
    const std::string name = fmt::format("flat_against_tree/{}/{}/", count, setting.name);
    const auto swept = std::make_shared<const SweptBoxes>(shafts_at_once, setting);
    suite.add(name + "flat", "", [=](benchmark::State& state) { list(state, scene->stream(), *swept); },
              {.brief = true});
    suite.add(name + "tree", "", [=](benchmark::State& state) { list(state, scene->tree(), *swept); }, {.brief = true});
  }
}

/// What it takes to tell a stream or a tree where all bounds are now, or one in a hundred.
void declare_updates(Suite& suite, std::size_t count) {
  const auto scene = std::make_shared<TreeScene>(count);
  // prepare() returns what is timed, which tells of `bounds` bounds.
  const auto add = [&](const char* what, std::size_t bounds, const auto& prepare) {
    suite.add(fmt::format("flat_against_tree/{}/update/{}", count, what), "",
              [=](benchmark::State& state) {
                select_isa(available_isas().back());
                auto update = prepare();
                for (auto _ : state) update();
                state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bounds));
              },
              {.brief = true});
  };
  add("stream", count, [=] {
    return
        [=, stream = BoxStream(scene->stream())]() mutable { stream.update(0, std::span<const Box>(scene->boxes())); };
  });
  add("tree_shuffled", count, [=] { return [=] { scene->tree().update(std::span<const Box>(scene->boxes())); }; });
  add("tree_in_order", count, [=] {
    std::vector<Box> in_order;
    for (const std::uint32_t i : scene->tree().order()) in_order.push_back(scene->boxes()[i]);
    BoxTree tree{std::span<const Box>(in_order)};
    return [in_order = std::move(in_order), tree = std::move(tree)]() mutable {
      tree.update(std::span<const Box>(in_order));
    };
  });
  add("tree_one_in_100", count / 100, [=] {
    std::vector<std::uint32_t> some;
    std::vector<Box> same;
    Random random(4200);
    for (std::size_t i = 0; i != count / 100; ++i) {
      some.push_back(random.below(static_cast<unsigned>(count)));
      same.push_back(scene->boxes()[some.back()]);
    }
    return [scene, some = std::move(some), same = std::move(same)] {
      scene->tree().update(some, std::span<const Box>(same));
      scene->tree().refit();
    };
  });
}

}  // namespace

void declare_flat_against_tree(Suite& suite, const Workload& /*workload*/) {
  const std::size_t most = suite.quick() ? std::size_t{1} << 17 : 1000000;
  for (const std::size_t count : {std::size_t{1024}, std::size_t{65536}, most}) declare_finds(suite, count);
  declare_updates(suite, most);
}

}  // namespace shaftcull::bench
