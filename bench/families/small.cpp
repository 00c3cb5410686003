// SPDX-License-Identifier: MIT
/// small/…: what calls cost that test few bounds.
///
/// small/one_shaft_64_boxes is the whole cost of cull() for a full word of boxes. small/n/N, small/list_many/N and
/// small/refine_many/N are calls for N boxes, just below and above a word too: fewer bounds must not cost more.
/// small/refine_many/N passes these N as candidates (Query::only). small/one_box/cull and small/one_box/classify are
/// keeps() and classify() of a Box instead of a view, for the boxes of small/n/1. small/formed/N is compile() of two
/// boxes and cull() of N boxes, and small/formed/N/loop a loop over records that does the same. small/polygons/11 is
/// cull() of eleven boxes by shafts between turned rectangles, and small/n/11 by shafts between boxes.
/// small/one_box/frustum and small/one_box/endless are classify() of them by turned views, and by all that lies from
/// these towards the sun.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "harness/suite.hpp"
#include "peers/slab_loop.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull::bench {
namespace {

constexpr std::size_t word_boxes = 64;
constexpr std::size_t sizes[] = {1, 8, 16, 32, 63, word_boxes, 65};
constexpr std::size_t most_boxes = 65;  // their slices overlap by one
/// Pieces of the boxes that calls take in turn, with each shaft: too many calls for a branch predictor to learn by
/// heart, few enough boxes for an L1 cache.
constexpr std::size_t slices = 16;

/// Time at most so many times that of a full word: fewer than a word, and one more than a word.
constexpr double most_of_fewer = 1.3;
constexpr double most_of_one_more = 1.6;

struct Small {
  std::vector<Box> from;
  std::vector<Box> to;
  std::vector<CompiledShaft> shafts;
  std::vector<ConvexHull> views;
  std::vector<ConvexHull> casters;
  std::vector<ConvexHull> polygons;
  BoxView boxes;
  std::vector<std::uint32_t> candidates;
  IndexLists lists;
};

template <class Shafts>
void run_cull(benchmark::State& state, const Small& small, const Shafts& shafts, std::size_t count) {
  std::uint64_t kept[bit_words(most_boxes)] = {};
  for (auto _ : state) {
    for (const CompiledShaft& shaft : shafts) {
      for (std::size_t p = 0; p < slices; ++p) {
        cull(shaft, small.boxes.slice(p * word_boxes, count), std::span(kept).first(bit_words(count)));
        benchmark::DoNotOptimize(kept);
      }
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(shafts.size() * slices));
}

void run_formed(benchmark::State& state, const Small& small, std::size_t count) {
  std::uint64_t kept[1] = {};
  for (auto _ : state) {
    for (std::size_t s = 0; s != small.from.size(); ++s) {
      const CompiledShaft shaft = compile(small.from[s], small.to[s]);
      cull(shaft, small.boxes.slice(s % slices * word_boxes, count), kept);
      benchmark::DoNotOptimize(kept);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(small.from.size()));
}

void run_loop(benchmark::State& state, const Small& small, std::size_t count) {
  std::vector<Box> records;
  for (std::size_t i = 0; i != small.boxes.count; ++i) records.push_back(small.boxes[i]);
  std::uint64_t met = 0;
  std::uint64_t kept[1] = {};
  for (auto _ : state) {
    for (std::size_t s = 0; s != small.from.size(); ++s) {
      const SlabLoop shaft(small.from[s], small.to[s]);
      const std::uint64_t bits = shaft.meets(std::span(records).subspan(s % slices * word_boxes, count));
      benchmark::DoNotOptimize(met = bits);
    }
  }
  for (std::size_t s = 0; s != small.from.size(); ++s) {
    cull(compile(small.from[s], small.to[s]), small.boxes.slice(s % slices * word_boxes, count), kept);
    met = SlabLoop(small.from[s], small.to[s]).meets(std::span(records).subspan(s % slices * word_boxes, count));
    if (met != kept[0]) state.SkipWithError("the loop keeps others than cull()");
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(small.from.size()));
}

/// Asks every shaft about the first box of every slice, one box a call.
template <class Shafts, class Ask>
void run_one_box(benchmark::State& state, const Small& small, const Shafts& shafts, const Ask& ask) {
  std::vector<Box> boxes;
  for (std::size_t p = 0; p < slices; ++p) boxes.push_back(small.boxes[p * word_boxes]);
  for (auto _ : state) {
    for (const CompiledShaft& shaft : shafts) {
      for (const Box& box : boxes) benchmark::DoNotOptimize(ask(shaft, box));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(shafts.size() * slices));
}

/// What is seen through a turned rectangle around the middle of one box, up to one three times as large around the
/// middle of another.
ConvexHull view_between(const Box& from, const Box& to) {
  const double side[2][3] = {{0.8, 0.5, -0.3}, {-0.2, 0.7, 0.6}};
  std::vector<Vec3> corners;
  for (const Box* const end : {&from, &to}) {
    for (const int corner : {0, 1, 2, 3}) {
      Vec3& point = corners.emplace_back();
      for (std::size_t k = 0; k != 3; ++k) {
        const double size = (end == &to ? 1.5 : 0.5) * (double{from.hi[k]} - from.lo[k]);
        const double u = (corner & 1) != 0 ? size : -size;
        const double v = (corner & 2) != 0 ? size : -size;
        point[k] = static_cast<float>(0.5 * (double{end->lo[k]} + end->hi[k]) + u * side[0][k] + v * side[1][k]);
      }
    }
  }
  return ConvexHull(corners);
}

void run_list_many(benchmark::State& state, Small& small, std::size_t count) {
  std::size_t next = 0;
  for (auto _ : state) {
    list_many(small.shafts, small.boxes.slice(next++ % slices * word_boxes, count), small.lists);
    benchmark::DoNotOptimize(small.lists.indices.data());
  }
  state.SetItemsProcessed(state.iterations());
}

void run_refine_many(benchmark::State& state, Small& small, std::size_t count) {
  std::size_t next = 0;
  for (auto _ : state) {
    const std::size_t first = next++ % slices * word_boxes;
    list_many(small.shafts, small.boxes, small.lists, {.only = std::span(small.candidates).subspan(first, count)});
    benchmark::DoNotOptimize(small.lists.indices.data());
  }
  state.SetItemsProcessed(state.iterations());
}

void declare_sizes(Suite& suite, const std::shared_ptr<Small>& small, Isa isa, const std::string& family,
                   void (*run)(benchmark::State&, Small&, std::size_t)) {
  const auto name_of = [&](std::size_t count) { return fmt::format("small/{}/{}/{}", family, count, name(isa)); };
  for (const std::size_t count : sizes) {
    suite.add(name_of(count), "",
              [=](benchmark::State& state) {
                select_isa(isa);
                run(state, *small, count);
              },
              {.brief = true});
    if (count == word_boxes) continue;
    suite.add_time_ratio_target(name_of(count), name_of(word_boxes),
                                count < word_boxes ? most_of_fewer : most_of_one_more);
  }
}

}  // namespace

void declare_small(Suite& suite, const Workload& workload) {
  const auto small = std::make_shared<Small>();
  for (std::size_t i = 0; i < Workload::test_shafts; ++i) {
    small->from.push_back(workload.a[i]);
    small->to.push_back(workload.b[i]);
    small->shafts.push_back(compile(workload.a[i], workload.b[i]));
    complete(small->shafts.back());
    small->views.push_back(view_between(workload.a[i], workload.b[i]));
    const std::span<const Vec3> ends = small->views.back().points();
    small->polygons.push_back(between_polygons(ends.first(4), ends.subspan(4)));
    small->casters.push_back(casters_towards(small->views.back(), {0.4F, 0.8F, 0.2F}));
  }
  small->boxes = workload.boxes.view().slice(0, slices * word_boxes + most_boxes - word_boxes);
  small->candidates.resize(small->boxes.count);
  std::iota(small->candidates.begin(), small->candidates.end(), 0U);

  const std::vector<Isa> available = available_isas();
  for (const Isa isa : available) {
    suite.add("small/one_shaft_64_boxes/" + std::string(name(isa)), "", [=](benchmark::State& state) {
      select_isa(isa);
      run_cull(state, *small, small->shafts, word_boxes);
    });
    if (isa == Isa::avx2) suite.add_time_target("small/one_shaft_64_boxes/avx2", 60.0);
  }
  for (const Isa isa : std::set<Isa>{Isa::avx2, available.back()}) {
    if (isa > available.back()) continue;
    declare_sizes(suite, small, isa, "n", [](benchmark::State& state, Small& some, std::size_t count) {
      run_cull(state, some, some.shafts, count);
    });
    constexpr std::size_t few = 11;  // patches of a cluster, say
    const std::string by_boxes = fmt::format("small/n/{}/{}", few, name(isa));
    const std::string by_polygons = fmt::format("small/polygons/{}/{}", few, name(isa));
    suite.add(by_boxes, "",
              [=](benchmark::State& state) {
                select_isa(isa);
                run_cull(state, *small, small->shafts, few);
              },
              {.brief = true});
    suite.add(by_polygons, "",
              [=](benchmark::State& state) {
                select_isa(isa);
                run_cull(state, *small, small->polygons, few);
              },
              {.brief = true});
    suite.add_time_ratio_target(by_polygons, by_boxes, 2);
    suite.add(fmt::format("small/one_box/cull/{}", name(isa)), "",
              [=](benchmark::State& state) {
                select_isa(isa);
                run_one_box(state, *small, small->shafts,
                            [](const CompiledShaft& shaft, const Box& box) { return keeps(shaft, box); });
              },
              {.brief = true});
    suite.add(fmt::format("small/one_box/classify/{}", name(isa)), "",
              [=](benchmark::State& state) {
                select_isa(isa);
                run_one_box(state, *small, small->shafts,
                            [](const CompiledShaft& shaft, const Box& box) { return classify(shaft, box); });
              },
              {.brief = true});
    for (const auto& [what, hulls] : {std::pair("frustum", &small->views), std::pair("endless", &small->casters)}) {
      suite.add(fmt::format("small/one_box/{}/{}", what, name(isa)), "",
                [isa, small, of = hulls](benchmark::State& state) {
                  select_isa(isa);
                  run_one_box(state, *small, *of,
                              [](const CompiledShaft& shaft, const Box& box) { return classify(shaft, box); });
                },
                {.brief = true});
    }
    for (const auto& [count, most] : {std::pair{std::size_t{8}, 1.3}, std::pair{std::size_t{16}, 1.0}}) {
      const std::string row = fmt::format("small/formed/{}", count);
      suite.add(fmt::format("{}/{}", row, name(isa)), "",
                [isa, small, of = count](benchmark::State& state) {
                  select_isa(isa);
                  run_formed(state, *small, of);
                },
                {.brief = true});
      if (isa == available.back()) {
        suite.add(row + "/loop", "", [small, of = count](benchmark::State& state) { run_loop(state, *small, of); },
                  {.brief = true});
      }
      suite.add_time_ratio_target(fmt::format("{}/{}", row, name(isa)), row + "/loop", most);
    }
    declare_sizes(suite, small, isa, "list_many", run_list_many);
    declare_sizes(suite, small, isa, "refine_many", run_refine_many);
  }
  suite.note("small/… counts calls, not tests: a call's whole cost");
}

}  // namespace shaftcull::bench
