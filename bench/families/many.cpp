// SPDX-License-Identifier: MIT
/// test/…: many shafts × many bounds on one thread, results as bits, on each instruction set.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "harness/suite.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull::bench {
namespace {

/// The shafts, and the rows of bits that all benchmarks of this family write to in turn.
struct Bench {
  explicit Bench(const Workload& workload) {
    for (std::size_t i = 0; i < Workload::test_shafts; ++i) {
      shafts.push_back(compile(workload.a[i], workload.b[i]));
      complete(shafts.back());
    }
    const std::size_t words = Workload::test_shafts * bit_words(workload.boxes.size());
    kept.resize(words);
    inside.resize(words);
  }
  std::vector<CompiledShaft> shafts;
  std::vector<std::uint64_t> kept;
  std::vector<std::uint64_t> inside;
};

void run(benchmark::State& state, Bench& bench, const Bounds& bounds, bool classify, Form form, Isa isa) {
  select_isa(isa);
  set_form(bench.shafts, form);
  for (auto _ : state) {
    if (classify) {
      classify_many(bench.shafts, bounds, bench.kept, bench.inside);
    } else {
      cull_many(bench.shafts, bounds, bench.kept);
    }
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bench.shafts.size() * bounds.size()));
}

void declare(Suite& suite, const std::shared_ptr<Bench>& bench, const std::string& kind, const Bounds& bounds) {
  const std::vector<Isa> available = available_isas();
  for (const bool classify : {false, true}) {
    const std::string job = classify ? "classify" : "cull";
    const std::string paper = kind == "spheres" ? "paper/spheres_cull" : "paper/boxes_" + job;
    for (const Form form : {Form::planes, Form::slab}) {
      for (const Isa isa : available) {
        std::string name_of = "test/" + kind + '/' + job + (form == Form::slab ? "/slab/" : "/planes/");
        name_of += name(isa);
        suite.add(name_of, paper, [bench, bounds, classify, form, isa](benchmark::State& state) {
          run(state, *bench, bounds, classify, form, isa);
        });
      }
    }
  }
}

}  // namespace

void declare_many(Suite& suite, const Workload& workload) {
  const auto bench = std::make_shared<Bench>(workload);
  declare(suite, bench, "boxes", workload.boxes);
  declare(suite, bench, "spheres", workload.spheres);

  suite.add_target("test/boxes/cull/slab/scalar", "paper/boxes_cull", 4.0);
  for (const double ratio : {12.0, 16.0}) suite.add_target("test/boxes/cull/slab/sse4_2", "paper/boxes_cull", ratio);
  for (const double ratio : {35.0, 48.0}) suite.add_target("test/boxes/cull/slab/avx2", "paper/boxes_cull", ratio);
  suite.add_target("test/boxes/cull/slab/avx512", "paper/boxes_cull", 60.0);
  suite.add_target("test/boxes/cull/planes/avx2", "paper/boxes_cull", 10.0);
  suite.add_target("test/boxes/classify/slab/avx2", "paper/boxes_classify", 32.0);
  suite.add_target("test/spheres/cull/slab/avx2", "paper/spheres_cull", 20.0);

  suite.note("test/spheres/classify is compared with paper/spheres_cull, which answers less");

  const std::vector<Isa> available = available_isas();
  for (const Isa isa : {Isa::sse4_2, Isa::avx2, Isa::avx512}) {
    if (std::find(available.begin(), available.end(), isa) == available.end()) {
      suite.note(std::string(name(isa)) + " is not measured: this machine or this build does not have it");
    }
  }
}

}  // namespace shaftcull::bench
