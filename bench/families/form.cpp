// SPDX-License-Identifier: MIT
/// form/…: from two boxes to a test-ready shaft.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "harness/suite.hpp"
#include "scenes/random.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/paper.hpp"

namespace shaftcull::bench {
namespace {

/// Shafts formed into the same memory each time, as a program forms a batch and then uses it; fits an L2 cache.
constexpr std::size_t batch_shafts = 1024;
static_assert(Workload::pairs % batch_shafts == 0);

void set_items(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(Workload::pairs));
}

void form_each(benchmark::State& state, const Workload& workload, Formation formation) {
  std::vector<CompiledShaft> out(batch_shafts);
  for (auto _ : state) {
    for (std::size_t i = 0; i < Workload::pairs; ++i) {
      out[i % batch_shafts] = compile(Shaft(workload.a[i], workload.b[i], {.formation = formation}));
      benchmark::ClobberMemory();
    }
  }
  set_items(state);
}

/// Pair by pair, each with one call of compile(), as a program forms a shaft for one query. So does the paper's.
void form_one(benchmark::State& state, const Workload& workload, Isa isa, bool with_planes) {
  select_isa(isa);
  for (auto _ : state) {
    for (std::size_t i = 0; i < Workload::pairs; ++i) {
      CompiledShaft shaft = compile(workload.a[i], workload.b[i]);
      if (with_planes) complete(shaft);
      benchmark::DoNotOptimize(shaft);
    }
  }
  set_items(state);
}

struct PairStreams {
  explicit PairStreams(const Workload& workload)
      : a(std::span<const Box>(workload.a)), b(std::span<const Box>(workload.b)) {
    Random random(4010);
    for (std::size_t i = 0; i < Workload::pairs; ++i) {
      index.push_back({random.below(batch_shafts), random.below(batch_shafts)});
      plane.push_back({{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}, random.uniform(-5, 5)});
    }
  }
  BoxStream a;
  BoxStream b;
  std::vector<IndexPair> index;  ///< within a batch
  std::vector<Plane> plane;
};

}  // namespace

void declare_form(Suite& suite, const Workload& workload) {
  const std::string paper = "paper/form_table";
  const auto each = [&](const char* name, const std::string& against, Formation formation) {
    suite.add(name, against,
              [&workload, formation](benchmark::State& state) { form_each(state, workload, formation); });
  };
  each("form/runtime", "paper/form_runtime", Formation::search);
  each("form/table64", paper, Formation::table64);
  each("form/table729", paper, Formation::table729);

  for (const Isa each_isa : available_isas()) {
    const std::string set(name(each_isa));
    const auto one = [&](const std::string& row, bool with_planes, double ratio) {
      suite.add(row + '/' + set, paper, [&workload, each_isa, with_planes](benchmark::State& state) {
        form_one(state, workload, each_isa, with_planes);
      });
      if (each_isa >= Isa::avx2) suite.add_target(row + '/' + set, paper, ratio);
    };
    one("form/one", false, 6.0);
    one("form/one_with_planes", true, 1.0);
  }

  const auto pairs = std::make_shared<const PairStreams>(workload);
  for (const Isa each_isa : available_isas()) {
    const std::string set(name(each_isa));
    const auto batch = [&](const std::string& row, const auto& compile_some) {
      suite.add(row + '/' + set, paper, [pairs, each_isa, compile_some](benchmark::State& state) {
        select_isa(each_isa);
        std::vector<CompiledShaft> out(batch_shafts);
        for (auto _ : state) {
          for (std::size_t first = 0; first < Workload::pairs; first += batch_shafts) {
            compile_some(*pairs, first, std::span(out));
            benchmark::ClobberMemory();
          }
        }
        set_items(state);
      });
    };
    batch("form/batch_alone", [](const PairStreams& from, std::size_t first, std::span<CompiledShaft> out) {
      compile_batch(from.a.view().slice(first, batch_shafts), from.b.view().slice(first, batch_shafts), out);
    });
    batch("form/batch_of_index_pairs", [](const PairStreams& from, std::size_t first, std::span<CompiledShaft> out) {
      const BoxView boxes = from.a.view().slice(first, batch_shafts);
      compile_batch(boxes, boxes, std::span(from.index).subspan(first, batch_shafts), out);
    });
    batch("form/batch_with_plane", [](const PairStreams& from, std::size_t first, std::span<CompiledShaft> out) {
      compile_batch(from.a.view().slice(first, batch_shafts), from.b.view().slice(first, batch_shafts), out,
                    {.a = std::span(from.plane).subspan(first, batch_shafts)});
    });
    batch("form/batch_with_two_planes", [](const PairStreams& from, std::size_t first, std::span<CompiledShaft> out) {
      const auto planes = std::span(from.plane).subspan(first, batch_shafts);
      compile_batch(from.a.view().slice(first, batch_shafts), from.b.view().slice(first, batch_shafts), out,
                    {.a = planes, .b = planes});
    });
    if (each_isa < Isa::avx2) continue;
    for (const char* row : {"form/batch_of_index_pairs/", "form/batch_with_plane/"}) {
      suite.add_time_ratio_target(row + set, "form/batch_alone/" + set, 2);
    }
  }
  // Other benchmarks leave other instruction sets behind, in random order.
  const Isa isa = active_isa();
  suite.add("form/batch", paper, [pairs, isa](benchmark::State& state) {
    select_isa(isa);
    std::vector<CompiledShaft> out(batch_shafts);
    for (auto _ : state) {
      for (std::size_t first = 0; first < Workload::pairs; first += batch_shafts) {
        compile_batch(pairs->a.view().slice(first, batch_shafts), pairs->b.view().slice(first, batch_shafts), out);
        benchmark::ClobberMemory();
      }
    }
    set_items(state);
  });

  for (const double ratio : {10.0, 25.0}) suite.add_target("form/batch", paper, ratio);
  suite.note(
      "form/batch and form/one leave joining planes pending, so their shafts are ready for slab form only; "
      "paper/form_table and form/{runtime,table64,table729,one_with_planes} make the planes");
}

}  // namespace shaftcull::bench
