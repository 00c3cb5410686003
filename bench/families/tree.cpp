// SPDX-License-Identifier: MIT
/// tree/…: swept boxes against a bounds tree, a flat scan and Bullet's tree; what building and refitting one costs.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "families/roofline_kernels.hpp"
#include "harness/memory.hpp"
#include "harness/suite.hpp"
#include "harness/threads.hpp"
#include "scenes/random.hpp"
#include "scenes/swept_boxes.hpp"
#include "scenes/tree_scene.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull::bench {
namespace {

constexpr std::size_t queries = 1024;
constexpr std::size_t full_bounds = 1000000;
constexpr std::size_t quick_bounds = std::size_t{1} << 17;

/// Compiles the swept boxes and lists the boxes that each meets, one after the other.
void query_tree(benchmark::State& state, const BoxTree& tree, const SweptBoxes& swept,
                Isa isa = available_isas().back()) {
  select_isa(isa);
  std::vector<CompiledShaft> shafts(swept.from.size());
  std::vector<std::uint32_t> hits(tree.size());
  for (auto _ : state) {
    compile_batch(swept.from.view(), swept.to.view(), shafts);
    for (const CompiledShaft& shaft : shafts) benchmark::DoNotOptimize(list(shaft, tree, std::span(hits)));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(shafts.size()));
}

/// The same by list_many() of all boxes, for as many shafts as the other flat benchmarks have.
void query_flat(benchmark::State& state, const BoxView& boxes, const SweptBoxes& swept) {
  select_isa(available_isas().back());
  std::vector<CompiledShaft> shafts(Workload::test_shafts);
  IndexLists lists;
  for (auto _ : state) {
    compile_batch(swept.from.view().slice(0, shafts.size()), swept.to.view().slice(0, shafts.size()), shafts);
    list_many(shafts, boxes, lists);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(shafts.size()));
}

#ifdef SHAFTCULL_BENCH_WITH_BULLET

/// Throws unless Bullet finds what the tree finds, but for boxes that a change of the swept box's size by a few
/// roundings decides about.
void require_same_hits(TreeScene& scene, const SweptBoxes& swept, const SweptSetting& setting) {
  std::vector<std::uint32_t> bullet;
  const auto grown = [](Box box, float by) {
    for (std::size_t k = 0; k != 3; ++k) {
      box.lo[k] -= by;
      box.hi[k] += by;
    }
    return box;
  };
  const auto hits_of = [&](std::size_t i, float by) {
    const CompiledShaft shaft = compile(grown(swept.from[i], by), grown(swept.to[i], by));
    std::vector<std::uint32_t> hits;
    list(shaft, scene.tree(), hits);
    std::sort(hits.begin(), hits.end());
    return hits;
  };
  for (std::size_t i = 0; i != Workload::test_shafts; ++i) {
    scene.bullet().sweep(swept.from[i], swept.to[i], bullet);
    std::sort(bullet.begin(), bullet.end());
    if (bullet == hits_of(i, 0)) continue;
    const float roundings = 4e-6F;  // some ulps of coordinates of 5 to 10
    const auto fewer = hits_of(i, -roundings);
    const auto more = hits_of(i, roundings);
    if (std::includes(bullet.begin(), bullet.end(), fewer.begin(), fewer.end()) &&
        std::includes(more.begin(), more.end(), bullet.begin(), bullet.end())) {
      continue;
    }
    throw std::runtime_error(fmt::format("tree/{}: Bullet finds {} boxes on swept box {}, the library {}", setting.name,
                                         bullet.size(), i, hits_of(i, 0).size()));
  }
}

void query_bullet(benchmark::State& state, TreeScene& scene, const SweptBoxes& swept, const SweptSetting& setting) {
  require_same_hits(scene, swept, setting);
  std::vector<Box> from;
  std::vector<Box> to;
  for (std::size_t i = 0; i != swept.from.size(); ++i) {
    from.push_back(swept.from[i]);
    to.push_back(swept.to[i]);
  }
  std::vector<std::uint32_t> hits;
  std::size_t next = 0;
  for (auto _ : state) {
    scene.bullet().sweep(from[next], to[next], hits);
    benchmark::DoNotOptimize(hits.data());
    next = (next + 1) % from.size();
  }
  state.SetItemsProcessed(state.iterations());
}

#endif

void declare_queries(Suite& suite, const std::shared_ptr<TreeScene>& scene) {
  for (const SweptSetting& setting : swept_settings) {
    const std::string name = fmt::format("tree/{}/", setting.name);
    const auto swept = std::make_shared<const SweptBoxes>(queries, setting);
    suite.add(name + "tree", "", [=](benchmark::State& state) { query_tree(state, scene->tree(), *swept); });
    suite.add(name + "flat", "", [=](benchmark::State& state) { query_flat(state, scene->stream().view(), *swept); },
              {.brief = true});
    suite.add_target(name + "tree", name + "flat", &setting == &swept_settings.back() ? 8.0 : 25.0);
#ifdef SHAFTCULL_BENCH_WITH_BULLET
    suite.add(name + "bullet", "", [=](benchmark::State& state) { query_bullet(state, *scene, *swept, setting); },
              {.brief = true});
    suite.add_target(name + "tree", name + "bullet", 25.0);
#endif
  }
}

/// Sweeps that end just behind the scene, and very far away: the same boxes are met.
void declare_reach(Suite& suite, const std::shared_ptr<TreeScene>& scene) {
  const auto behind_scene = std::make_shared<const SweptBoxes>(queries, 100.0F);
  const auto far_away = std::make_shared<const SweptBoxes>(queries, 1e30F);
  for (const Isa isa : available_isas()) {
    const auto add = [&](const std::string& row, const std::shared_ptr<const SweptBoxes>& swept) {
      suite.add(fmt::format("{}/{}", row, name(isa)), "",
                [=](benchmark::State& state) { query_tree(state, scene->tree(), *swept, isa); }, {.brief = true});
    };
    add("tree/reach_100", behind_scene);
    add("tree/reach_1e30", far_away);
    if (isa < Isa::avx2) continue;
    suite.add_time_ratio_target(fmt::format("tree/reach_1e30/{}", name(isa)),
                                fmt::format("tree/reach_100/{}", name(isa)), 1.3);
  }
}

/// As many hits among more and more boxes, the swept boxes shrinking with them.
void declare_sizes(Suite& suite) {
  constexpr std::size_t least = std::size_t{1} << 16;
  const std::size_t most = least << (suite.quick() ? 3U : 6U);
  for (std::size_t count = least; count <= most; count *= suite.quick() ? 8 : 4) {
    const auto scene = std::make_shared<TreeScene>(count);
    const float scale = std::cbrt(1e6F / static_cast<float>(count));
    const auto swept = std::make_shared<const SweptBoxes>(queries, swept_settings[0], scale);
    suite.add(fmt::format("tree/size/{}", count), "",
              [=](benchmark::State& state) { query_tree(state, scene->tree(), *swept); }, {.brief = true});
  }
  suite.add_time_ratio_target(fmt::format("tree/size/{}", most), fmt::format("tree/size/{}", least), 4);
}

void declare_build(Suite& suite, const std::shared_ptr<TreeScene>& scene) {
  const auto items = static_cast<std::int64_t>(scene->count);
  for (const unsigned threads : thread_counts()) {
    suite.add(fmt::format("tree/build/{}", threads), "",
              [=](benchmark::State& state) {
                const BoxView view = scene->stream().view();
                for (auto _ : state) benchmark::DoNotOptimize(BoxTree(view).size());
                state.SetItemsProcessed(state.iterations() * items);
              },
              {.threads = threads, .wall_clock = true});
    suite.add(fmt::format("tree/rebuild/{}", threads), "",
              [=](benchmark::State& state) {
                BoxTree tree(scene->stream().view());
                for (auto _ : state) tree.rebuild();
                state.SetItemsProcessed(state.iterations() * items);
              },
              {.threads = threads, .wall_clock = true, .brief = true});
  }
#ifdef SHAFTCULL_BENCH_WITH_BULLET
  suite.add("tree/build/bullet", "",
            [=](benchmark::State& state) {
              const std::vector<Box>& boxes = scene->boxes();
              for (auto _ : state) const BulletTree built(boxes);
              state.SetItemsProcessed(state.iterations() * items);
            },
            {.wall_clock = true, .once = true});
  suite.add_target(fmt::format("tree/build/{}", std::min(2U, all_threads())), "tree/build/bullet", 80.0);
#endif
}

/// Streams of as many boxes as small_boxes() gives, without its records.
BoxStream stream_of_small_boxes(std::size_t count) {
  constexpr std::size_t most = 65536;
  const float scale = std::cbrt(1e6F / static_cast<float>(count));
  Random random(4000);
  BoxStream stream(count);
  std::vector<Box> some;
  for (std::size_t first = 0; first < count; first += most) {
    some.resize(std::min(most, count - first));
    for (Box& box : some) box = random.box(0.005F * scale, 0.035F * scale);
    stream.update(first, some);
  }
  return stream;
}

/// A tree of many more boxes than caches hold takes at most twice the time a box, if it finds its memory at hand as a
/// tree of a million does. Trees of fewer than 2²¹ are built at once, and larger ones by regions, so one box less and
/// that many are measured, too.
void declare_large_builds(Suite& suite) {
  if (suite.quick()) return;
  constexpr std::size_t least_by_regions = std::size_t{1} << 21U;
  constexpr std::size_t most = std::size_t{1} << 26U;
  constexpr int builds_before = 2;
  const unsigned threads = std::min(2U, all_threads());
  const auto name_of = [](std::size_t count) { return fmt::format("tree/build/{}", count); };
  for (const std::size_t count : {least_by_regions - 1, least_by_regions, most}) {
    const std::uint64_t needed = std::uint64_t{count} * (sizeof(Box) + 40);
    if (available_memory() < needed) {
      suite.note(fmt::format("{} is not measured: it takes {:.1f} GB of memory, and {:.1f} GB are available",
                             name_of(count), static_cast<double>(needed) * 1e-9,
                             static_cast<double>(available_memory()) * 1e-9));
      continue;
    }
    const auto stream = std::make_shared<Lazy<BoxStream>>();
    suite.add(name_of(count), "",
              [=](benchmark::State& state) {
                const BoxView view = stream->get([=] { return stream_of_small_boxes(count); }).view();
                const FreedMemoryKept kept;
                for (int i = 0; i != builds_before; ++i) benchmark::DoNotOptimize(BoxTree(view).size());
                for (auto _ : state) benchmark::DoNotOptimize(BoxTree(view).size());
                state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
              },
              {.threads = threads, .wall_clock = true, .brief = true});
    if (count != most) continue;
    const std::string of_a_million = fmt::format("tree/build/{}", threads);
    suite.note(
        fmt::format("{} finds its memory at hand, as {} does; new memory takes what the system and its host take",
                    name_of(most), of_a_million));
    suite.add_time_ratio_target(name_of(most), of_a_million, 2.0);
  }
}

void declare_refit(Suite& suite, std::size_t bounds) {
  const auto scene = std::make_shared<TreeScene>(bounds);
  const auto items = static_cast<std::int64_t>(bounds);
  suite.add("tree/refit", "", [=](benchmark::State& state) {
    select_isa(available_isas().back());
    BoxTree& tree = scene->tree();
    std::vector<std::uint32_t> some;  // in so many nodes that all are refitted
    for (std::size_t p = 0; p < tree.size(); p += 256) some.push_back(tree.order()[p]);
    std::vector<Box> same;
    for (const std::uint32_t i : some) same.push_back(scene->boxes()[i]);
    for (auto _ : state) {
      state.PauseTiming();
      tree.update(some, std::span<const Box>(same));
      state.ResumeTiming();
      tree.refit();
    }
    state.SetItemsProcessed(state.iterations() * items);
  });
  const RooflineKernels* const kernels = roofline_kernels(available_isas().back());
  if (kernels == nullptr) return;
  suite.add("tree/read", "", [=](benchmark::State& state) {
    const BoxView leaves = scene->tree().leaves();
    for (auto _ : state) benchmark::DoNotOptimize(kernels->read(leaves.stream.data(), leaves.count));
    state.SetItemsProcessed(state.iterations() * items);
  });
  suite.add_target("tree/refit", "tree/read", 0.6);
  suite.limit("tree/refit", "tree/read", 1.0, "reading the leaves");
}

void declare_threads(Suite& suite, const std::shared_ptr<TreeScene>& scene) {
  constexpr std::size_t many = 100000;
  const auto swept = std::make_shared<const SweptBoxes>(many, swept_settings[1]);
  for (const unsigned threads : thread_counts()) {
    suite.add(fmt::format("tree/threads/{}", threads), "",
              [=](benchmark::State& state) {
                select_isa(available_isas().back());
                const BoxTree& tree = scene->tree();
                std::vector<CompiledShaft> shafts(many);
                compile_batch(swept->from.view(), swept->to.view(), shafts);
                IndexLists lists;
                for (auto _ : state) {
                  list_many(shafts, tree, lists);
                  benchmark::ClobberMemory();
                }
                state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(many));
              },
              {.threads = threads, .wall_clock = true, .brief = true});
  }
  if (all_threads() > 1) suite.add_target("tree/threads/2", "tree/threads/1", 1.8);
}

/// tree/list_many/N, and the same lists one after the other; and large ones of few shafts, on threads.
void declare_list_many(Suite& suite, const std::shared_ptr<TreeScene>& scene) {
  constexpr std::size_t several = 4096;
  constexpr std::size_t few = 16;
  const auto add = [&](const std::string& row, std::size_t count, const SweptSetting& setting, unsigned threads,
                       bool is_one_by_one) {
    const auto swept = std::make_shared<const SweptBoxes>(count, setting);
    suite.add(row, "",
              [=](benchmark::State& state) {
                select_isa(available_isas().back());
                const BoxTree& tree = scene->tree();
                std::vector<CompiledShaft> shafts(count);
                compile_batch(swept->from.view(), swept->to.view(), shafts);
                IndexLists lists;
                std::vector<std::uint32_t> hits;
                for (auto _ : state) {
                  if (is_one_by_one) {
                    hits.clear();
                    for (const CompiledShaft& shaft : shafts) list(shaft, tree, hits);
                  } else {
                    list_many(shafts, tree, lists);
                  }
                  benchmark::ClobberMemory();
                }
                state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
              },
              {.threads = threads, .wall_clock = threads > 1 || count == few, .brief = true});
  };
  const SweptSetting& tiny_long = swept_settings[1];
  const SweptSetting& big_long = swept_settings[3];
  add(fmt::format("tree/list_each/{}", several), several, tiny_long, 1, true);
  add(fmt::format("tree/list_many/{}", several), several, tiny_long, 1, false);
  suite.add_time_ratio_target(fmt::format("tree/list_many/{}", several), fmt::format("tree/list_each/{}", several), 1);
  for (const unsigned threads : thread_counts()) {
    add(fmt::format("tree/list_many/{}/{}", few, threads), few, big_long, threads, false);
  }
  if (all_threads() > 1) {
    suite.add_target(fmt::format("tree/list_many/{}/2", few), fmt::format("tree/list_many/{}/1", few), 1.4);
  }
}

}  // namespace

void declare_tree(Suite& suite, const Workload& /*workload*/) {
  const auto scene = std::make_shared<TreeScene>(suite.quick() ? quick_bounds : full_bounds);
  declare_queries(suite, scene);
  declare_reach(suite, scene);
  declare_sizes(suite);
  declare_build(suite, scene);
  declare_large_builds(suite);
  declare_refit(suite, suite.quick() ? quick_bounds : std::size_t{1} << 22);
  declare_threads(suite, scene);
  declare_list_many(suite, scene);
#ifdef SHAFTCULL_BENCH_WITH_BULLET
  suite.note(
      "tree/build: its target was set where Bullet takes 12.5 s for a million boxes, and is as hard to reach as Bullet "
      "is quick (docs/measurements.md)");
#else
  suite.note("tree/…/bullet is not measured: this build found no Bullet (Debian: libbullet-dev)");
#endif
  if (suite.quick())
    suite.note(
        fmt::format("--quick: tree/… has {} boxes, not {}; its targets are set for those", quick_bounds, full_bounds));
}

}  // namespace shaftcull::bench
